#pragma once
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <set>
#include <string>

#include "devices/camming4/camming4.hpp"
#include "devices/camming4/codes.hpp"
#include "devices/camming4/messages.hpp"

namespace drycut::devices::camming4 {

// What the tests of CAMMING4 must show, by name. A test says covers({"warning 12", "st_sync"}) beside the
// expectations that would fail if the thing did not work; camming4_coverage_test.cpp runs them all and
// asks for every name.

/// Every name: of variables and states as the table spells them, "START accepted" and "START refused" for
/// the commands, "sector 150", "error 4", "warning 12", "normal input 9", "interrupt input 9", "output 5".
inline std::set<std::string> all_marks() {
  std::set<std::string> marks;
  for (const Variable& variable : camming4_type.variables) marks.emplace(variable.name);
  for (const State& state : camming4_type.states) marks.emplace(state.name);
  for (const Command& command : camming4_type.commands) {
    marks.insert(std::string(command.name) + " accepted");
    marks.insert(std::string(command.name) + " refused");
  }
  for (const Code& code : codes) marks.insert("sector " + std::to_string(code.code));
  for (int code = 0; code <= 100; ++code) {
    if (!error_text(code).empty()) marks.insert("error " + std::to_string(code));
    if (!warning_text(code).empty()) marks.insert("warning " + std::to_string(code));
  }
  for (int function = 0; function <= 12; ++function)  // 000 1.7
    for (const char* input : {"normal input ", "interrupt input "})
      marks.insert(input + std::to_string(function));
  for (int function = 0; function <= 9; ++function)  // 000 1.8
    marks.insert("output " + std::to_string(function));
  return marks;
}

/// Says that the running test shows these things; a name that does not exist fails it.
inline void covers(std::initializer_list<std::string> names) {
  static const std::set<std::string> known = all_marks();
  for (const std::string& name : names) {
    if (!known.contains(name)) ADD_FAILURE() << "no such thing to cover: " << name;
    if (std::getenv("DRYCUT_COVERS") != nullptr) std::printf("[  COVERS  ] %s\n", name.c_str());
  }
}

}  // namespace drycut::devices::camming4
