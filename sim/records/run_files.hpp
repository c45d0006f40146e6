#pragma once
#include <filesystem>

#include "sim/loop/simulation.hpp"
#include "sim/output_folder.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::records {

/// The files of a run that grow while it goes on, as its scenario's record.format has them.
class RunFiles {
 public:
  /// Before `simulation` runs. Throws std::runtime_error when something cannot be written.
  RunFiles(const scenario::Scenario& scenario, loop::Simulation& simulation, OutputFolder& folder);
  /// After it ran to its end: what the checks came to, where it goes into the same file. Throws likewise.
  void finish(const loop::Outcome& outcome) const;

 private:
  std::filesystem::path hdf5_;  ///< "" = CSV
};

}  // namespace drycut::sim::records
