#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

struct SizeOptions {
  std::filesystem::path scenario;
  std::string drive;            ///< "knife.servo"; "" = the only one
  std::string motors = "all";   ///< "HG-SR202,SGM7*"
  std::string gears;            ///< "5..20:16", "5,7,10", "variables.gear=5,7"; "" = as it is
  std::string resistors;        ///< "100,200 W"; "" = as it is
  std::string inertia_ratio;    ///< the largest of load over rotor, "15"; "off": any; "" = the maker's or 10
  std::vector<std::string> at;  ///< "variables.length=500 mm,plants.web.speed=120 m/min"
  std::filesystem::path corners;  ///< an envelope.csv; "" = none
  std::vector<std::string> set;
  int jobs = 1;  ///< runs at the same time; the result is the same
  std::filesystem::path out;
  ClusterOptions cluster;
};

/// drycut size: 0 one fits, 1 none does, 2 bad input, 3 nothing could be simulated or written
int size_drive(const SizeOptions& options);

}  // namespace drycut::sim::cli
