#pragma once
#include <string>

#include "sim/studies/fit/move.hpp"

namespace drycut::sim::studies {

// The strokes of a move as programs, and the scenarios in which they run on the very machine. A program waits
// for `panel.start`; `panel.done` is on when it is through.

/// A program and the sections of its scenario.
struct MoveProgram {
  std::string controller;                                   ///< "qmove"
  std::string maker;                                        ///< "QEM QMOVE, EANPOS"
  std::vector<std::pair<std::string, std::string>> files;   ///< name, text
  std::vector<std::pair<std::string, std::string>> plants;  ///< values of the plant, other than its own
  std::string sections;                                     ///< controller and wiring, YAML
};

/// Its texts are of files that lie beside the scenario.
MoveProgram qmove_program(const FitMove& move);
MoveProgram plcopen_program(const FitMove& move);
/// Only for an axis whose servo can take pulses.
MoveProgram lx3vp_program(const FitMove& move);

}  // namespace drycut::sim::studies
