#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/studies/faults/bench.hpp"

namespace drycut::sim::studies {

/// A kind of cell that somebody has judged and lives with.
struct AcceptedCells {
  std::string fault;  ///< pattern of its full name
  std::string when;   ///< pattern of the moment's name, or a stretch of the cycle: "20..45 %"
  FaultCell::Kind cell = FaultCell::Kind::wrong;
  std::string why;
  int line = 1;

  [[nodiscard]] bool covers(const TriedFault& tried, const FaultMoment& moment, const FaultCell& came) const;
};

/// Reads a list of {fault, when, cell, why}; what is wrong with it goes to `problems`.
std::vector<AcceptedCells> read_accepted(const std::filesystem::path& file, Problems& problems);

}  // namespace drycut::sim::studies
