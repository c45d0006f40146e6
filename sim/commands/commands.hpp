#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/cam/run.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim {

/// Exit status of the program (design §6).
enum ExitStatus : int {
  all_passed = 0,
  check_failed = 1,
  bad_input = 2,         ///< one line a problem on standard error; nothing was written
  simulation_failed = 3  ///< diverged, or a result could not be written; what was recorded is kept
};

struct RunOptions {
  std::vector<std::filesystem::path> scenarios;
  std::filesystem::path out = "out";
  int jobs = 1;
  std::optional<std::uint64_t> seed;  ///< in place of the scenarios'
  bool pictures = true;
  std::vector<std::string> set;  ///< "plants.web.speed=80 m/min"
};
/// drycut run
int run_scenarios(const RunOptions& options);

struct CheckOptions {
  std::vector<std::filesystem::path> files;
  bool expand = false;
};
/// drycut check: scenarios (.yaml), configurations (.cnf), QCL modules (.mod, .qcl; against the .cnf before
/// them), cam tables (.csv)
int check_files(const CheckOptions& options);

struct CamOptions {
  std::filesystem::path table;
  std::string device = "camming4";
  CamDuty duty;
  std::vector<double> at;  ///< master positions [Um], empty = 1000 a pass and every boundary
  std::string csv;         ///< "" = none, "-" = standard output
  std::string png;         ///< "" = none
  int loops = 1;
  bool strict = false;  ///< warnings and cautions fail too
};
/// drycut cam: 0 sound, 1 an error or a violated limit, 2 bad input
int validate_cam(const CamOptions& options);

/// drycut devices, drycut plants: the tables; of one type if `name` is given.
int list_devices(const std::string& name, bool json);
int list_plants(const std::string& name, bool json);

/// Prints problems in order on standard error; says how many.
void print_problems(const devices::Problems& problems);

}  // namespace drycut::sim
