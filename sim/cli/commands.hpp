#pragma once
#include <string>

#include "base/problem.hpp"
#include "sim/record/verdict.hpp"

namespace CLI {
class App;
}

namespace drycut::sim::cli {

using record::ExitStatus;
using enum record::ExitStatus;

/// All of them, in the order of --help, which is then a HelpPage.
void add_commands(CLI::App& app, int& status);

/// drycut devices, drycut plants, drycut plants --motors: the tables; of one if `name` is given.
int list_devices(const std::string& name, bool json);
int list_plants(const std::string& name, bool json);
/// drycut plants FILE.fmu: the variables of a foreign FMU.
int list_fmu(const std::string& file, bool json);
int list_motors(const std::string& name, bool json);
/// drycut plants --units, drycut plants --motor-template: the file for a motor of `kind`, "" = servo.
int list_units(const std::string& quantity, bool json);
int print_motor_template(const std::string& kind);

/// Prints problems in order on standard error; says how many.
void print_problems(const Problems& problems);
/// Why a command could not go on; the status that says so.
int print_failure(const std::string& why);
/// What of the results could not be made; the rest is there.
void print_left_out(const std::vector<std::string>& lost);

/// While one lives, of one thread, what that prints as problems is kept in `problems`, too.
class ProblemKeeper {
 public:
  explicit ProblemKeeper(Problems& problems);
  ~ProblemKeeper();
  ProblemKeeper(const ProblemKeeper&) = delete;
  ProblemKeeper& operator=(const ProblemKeeper&) = delete;
};

}  // namespace drycut::sim::cli
