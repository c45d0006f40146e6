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

// Each adds its command with its options to the program; what the chosen one comes to goes to `status`.
void add_run(CLI::App& app, int& status);
void add_live(CLI::App& app, int& status);
void add_replay(CLI::App& app, int& status);
void add_check(CLI::App& app, int& status);
void add_cam(CLI::App& app, int& status);
void add_design(CLI::App& app, int& status);
void add_tune(CLI::App& app, int& status);
void add_sweep(CLI::App& app, int& status);
void add_envelope(CLI::App& app, int& status);
void add_size(CLI::App& app, int& status);
void add_bode(CLI::App& app, int& status);
void add_compare(CLI::App& app, int& status);
void add_index(CLI::App& app, int& status);
void add_convert(CLI::App& app, int& status);
void add_new(CLI::App& app, int& status);
void add_devices(CLI::App& app, int& status);
void add_plants(CLI::App& app, int& status);
/// drycut reference DIR, which --help does not list: `drycut.1`, the manual page, `drycut.bash`, completion
/// for bash, and in Markdown `commands.md`, `devices.md`, `plants.md`, a page for each device and plant,
/// `scenario.md`, `comparison.md` and `cam_tables.md`.
void add_reference(CLI::App& app, int& status);
/// drycut work BUNDLE, which --help does not list either: runs what a study has asked of a cluster.
void add_work(CLI::App& app, int& status);

/// drycut help, drycut help TOPIC: a command's --help, or a page of docs/.
void add_help(CLI::App& app, int& status);
/// All of them, in the order of --help, which is then a HelpPage.
void add_commands(CLI::App& app, int& status);

/// drycut devices, drycut plants, drycut plants --motors: the tables; of one if `name` is given.
int list_devices(const std::string& name, bool json);
int list_plants(const std::string& name, bool json);
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

}  // namespace drycut::sim::cli
