#pragma once
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <set>
#include <string>

#include "devices/eanpos/eanpos.hpp"
#include "devices/epicpos/epicpos.hpp"

namespace drycut::devices::epicpos {

// What the tests of EPICPOS and EANPOS must show, by name. A test says covers({"st_toll", "START refused"})
// beside the expectations that would fail if the thing did not work; epicpos_coverage_test.cpp runs them all
// and asks for every name.

/// Every name: of variables and states as the tables spell them, "START accepted" and "START refused" for the
/// commands.
inline std::set<std::string> all_marks() {
  std::set<std::string> marks;
  for (const DeviceType* type : {&epicpos_type, &eanpos::eanpos_type}) {
    for (const Variable& variable : type->variables) marks.emplace(variable.name);
    for (const State& state : type->states) marks.emplace(state.name);
    for (const Command& command : type->commands) {
      marks.insert(std::string(command.name) + " accepted");
      marks.insert(std::string(command.name) + " refused");
    }
  }
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

}  // namespace drycut::devices::epicpos
