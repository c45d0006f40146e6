#pragma once
#include <map>
#include <string>

#include "devices/lx3vp/il_lines.hpp"
#include "devices/lx3vp/il_program.hpp"

namespace drycut::devices::lx3vp::il {

/// Where a label stands.
struct Label {
  int line = 0;
  std::size_t place = 0;  ///< among the steps
};
using Labels = std::map<int, Label>;

/// Looks only whether each jump and call has its label.
void find_labels(Program& program, const Labels& labels, const TellLine& tell);

/// Joins what belongs together in a program that is read: jumps and calls with their labels, FOR with NEXT,
/// the steps of sequences, subroutines with SRET; sets Step::target, Step::depth and Program::states. Tells
/// what has no counterpart, stands where it may not, or is jumped into from outside.
void join_structure(Program& program, const Labels& labels, const TellLine& tell);

}  // namespace drycut::devices::lx3vp::il
