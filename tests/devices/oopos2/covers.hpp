#pragma once
#include "base/problem.hpp"
#include "devices/oopos2/oopos2.hpp"
#include "tests/devices/coverage.hpp"

namespace drycut::devices::oopos2 {

/// What the tests of OOPOS2 must show (coverage.hpp): its table, every value of its modes ("bklashmode 3")
/// and every output ("OutAva").
inline coverage::Marks all_marks() {
  coverage::Marks marks;
  coverage::add_table(oopos2_type, marks);
  for (const char* mode :
       {"bklashmode", "slowtype", "inertmode", "dobiner", "enstol", "prsmode", "prsdir", "breaktype"}) {
    const DeviceVariable& row =
        oopos2_type.variables[static_cast<std::size_t>(find_symbol(oopos2_type, mode).value().index)];
    for (int number = 0; number <= static_cast<int>(row.max); ++number)
      marks.insert(mode + (" " + std::to_string(number)));
  }
  for (const Field& field : oopos2_type.fields)
    if (field.kind == Field::Kind::output) marks.emplace(field.name);
  return marks;
}

inline void covers(std::initializer_list<std::string> names) {
  static const coverage::Marks known = all_marks();
  coverage::cover(known, names);
}

}  // namespace drycut::devices::oopos2
