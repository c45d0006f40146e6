#pragma once
#include "devices/epicpos/epicpos.hpp"
#include "tests/devices/coverage.hpp"

namespace drycut::devices::epicpos {

/// What the tests of EPICPOS and EANPOS must show (coverage.hpp).
inline coverage::Marks all_marks() {
  coverage::Marks marks;
  coverage::add_table(epicpos_type, marks);
  coverage::add_table(eanpos::eanpos_type, marks);
  return marks;
}

inline void covers(std::initializer_list<std::string> names) {
  static const coverage::Marks known = all_marks();
  coverage::cover(known, names);
}

}  // namespace drycut::devices::epicpos
