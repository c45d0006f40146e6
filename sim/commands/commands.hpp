#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/bode/loop.hpp"
#include "sim/cam/course.hpp"
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
  bool verify_step = false;      ///< again at half the step: how far every margin moves
  bool gltf = false;             ///< the run as an animated .glb file, with or without pictures
  std::vector<std::string> set;  ///< "plants.web.speed=80 m/min"
};
/// drycut run
int run_scenarios(const RunOptions& options);

struct CheckOptions {
  std::vector<std::filesystem::path> files;
  bool expand = false;
  std::vector<std::string> set = {};  ///< overrides of the scenarios: path=value
};
/// drycut check: scenarios (.yaml), configurations (.cnf), QCL modules (.mod, .qcl; against the .cnf before
/// them), instruction lists (.il), cam tables and registers (.csv)
int check_files(const CheckOptions& options);

struct CamOptions {
  std::filesystem::path table;
  std::string device = {};  ///< "" = by the table's header
  CamDuty duty;
  std::vector<double> at;  ///< master positions, empty = 1000 a pass and every boundary
  std::string csv;         ///< "" = none, "-" = standard output
  std::string png;         ///< "" = none
  std::string rows = {};   ///< file for the rows that the device makes from parameters, "" = none
  int loops = 1;
  bool strict = false;  ///< warnings and cautions fail too
};
/// drycut cam: 0 sound, 1 an error or a violated limit, 2 bad input
int validate_cam(const CamOptions& options);

struct BodeOptions {
  std::filesystem::path scenario;
  LoopRequest loop;
  bool limit_cycle = false;                ///< sweeps the amplitude too; shows the one with the least margin
  std::optional<double> min_phase_margin;  ///< [deg], less fails
  std::optional<double> min_gain_margin;   ///< [dB], less fails
  std::string csv;                         ///< "" = none, "-" = standard output
  std::string png;                         ///< "" = none
  std::filesystem::path out;               ///< folder for report, plot and table, "" = none
  std::vector<std::string> set;            ///< overrides of the scenario: path=value
};
/// drycut bode: 0 measured, 1 not stable, open, not to be trusted or below a limit, 2 bad input, 3 the
/// simulation failed
int measure_bode(const BodeOptions& options);

struct TuneOptions {
  std::vector<std::filesystem::path> scenarios;
  std::vector<std::string> vary;         ///< "controller.qmove.set.AxisX.pgain=1..100"
  std::string minimise;                  ///< "rms(AxisX.follerr)"
  std::vector<std::string> constraints;  ///< "max(abs(knife.motor.torque)) <= 20", "phase_margin >= 45"
  LoopRequest loop;                      ///< how stability margins in the constraints are measured
  std::string from = "0 s";              ///< metric and constraints look from here on
  bool ignore_checks = false;            ///< failed checks of the scenarios do not count
  int budget = 100;                 ///< simulated runs of the search, those that measure margins included
  int jobs = 1;                     ///< runs at the same time; the result is the same
  std::uint64_t seed = 1;           ///< of the search and the spread
  std::vector<std::string> spread;  ///< "plants.knife.inertia=±30%"
  int spread_runs = 20;
  std::vector<std::string> set;  ///< "plants.web.speed=80 m/min", before everything else
  std::filesystem::path out = "out/tune";
  bool pictures = true;
};
/// drycut tune: 0 the tuned values keep all limits, 1 no values were found that do, 2 bad input, 3 nothing
/// could be simulated or written
int tune_scenarios(const TuneOptions& options);

struct CompareOptions {
  std::vector<std::filesystem::path> runs;  ///< folders that drycut run made of scenarios, two or more
  std::filesystem::path out = "out/compare";
  std::string from = {};            ///< "4 s": figures look from here on; "" = as the runs' plots say
  bool fail_on_difference = false;  ///< exit status 1 where the runs differ
  bool pictures = true;
};
/// drycut compare: 0 compared, 1 different and --fail-on-difference, 2 bad input, 3 cannot be written
int compare_runs(const CompareOptions& options);

/// drycut devices, drycut plants: the tables; of one type if `name` is given.
int list_devices(const std::string& name, bool json);
int list_plants(const std::string& name, bool json);

/// Prints problems in order on standard error; says how many.
void print_problems(const Problems& problems);

}  // namespace drycut::sim
