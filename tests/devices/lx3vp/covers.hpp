#pragma once
#include <fmt/format.h>

#include "devices/lx3vp/registers.hpp"
#include "tests/devices/coverage.hpp"

namespace drycut::devices::lx3vp {

/// What the tests of the LX3VP must show: every word and every flag of the manual's register map, as "word
/// 14" and "word 1 bit 10", and every special register, by its name.
inline coverage::Marks all_marks() {
  coverage::Marks marks;
  for (const BlockWord& word : block_words())
    if (word.access != BlockWord::Access::reserved) marks.insert(fmt::format("word {}", word.offset));
  for (const BlockFlag& flag : block_flags())
    marks.insert(fmt::format("word {} bit {}", flag.word, flag.bit));
  for (const SpecialRegister& special : special_registers()) marks.emplace(special.name);
  return marks;
}

inline void covers(std::initializer_list<std::string> names) {
  static const coverage::Marks known = all_marks();
  coverage::cover(known, names);
}

}  // namespace drycut::devices::lx3vp
