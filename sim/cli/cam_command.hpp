#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/cams/course.hpp"
#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

struct CamOptions {
  std::filesystem::path table;
  std::string device = {};  ///< "" = by the table's header
  std::filesystem::path scene =
      {};  ///< whose values a table with ${name} takes; "" = that beside it which names it
  cams::CamDuty duty;
  std::vector<double> at;  ///< master positions, empty = 1000 a pass and every boundary
  std::string csv;         ///< "" = none, "-" = standard output
  std::string png;         ///< "" = none
  std::string rows = {};   ///< file for the rows that the device makes from parameters, "" = none
  int loops = 1;
  bool strict = false;  ///< warnings and cautions fail too
  bool force = false;   ///< files that drycut did not write are replaced too
};
/// drycut cam: 0 sound, 1 an error or a violated limit, 2 bad input
int validate_cam(const CamOptions& options);

}  // namespace drycut::sim::cli
