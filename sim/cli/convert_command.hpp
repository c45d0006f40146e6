#pragma once
#include <filesystem>
#include <string>

#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

struct ConvertOptions {
  std::filesystem::path run;       ///< the folder of a run, or trace.csv, or trace.h5
  std::string to;                  ///< csv, hdf5, mcap
  std::filesystem::path out = {};  ///< "" = beside the run, under its name
  bool force = false;              ///< files that drycut did not write are replaced too
};
/// drycut convert: 0 converted, 2 bad input, 3 cannot be written
int convert_run(const ConvertOptions& options);

}  // namespace drycut::sim::cli
