#pragma once
#include "devices/camming4/camming4.hpp"
#include "devices/camming4/messages.hpp"
#include "devices/camming4/sector.hpp"
#include "tests/devices/coverage.hpp"

namespace drycut::devices::camming4 {

/// What the tests of CAMMING4 must show (coverage.hpp): its table, "sector 150", "error 4", "warning 12",
/// "normal input 9", "interrupt input 9", "output 5".
inline coverage::Marks all_marks() {
  coverage::Marks marks;
  coverage::add_table(camming4_type, marks);
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

inline void covers(std::initializer_list<std::string> names) {
  static const coverage::Marks known = all_marks();
  coverage::cover(known, names);
}

}  // namespace drycut::devices::camming4
