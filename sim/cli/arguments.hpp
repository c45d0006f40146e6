#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/cluster/workers.hpp"

namespace CLI {
class App;
}

namespace drycut::sim::cli {

// Options that several commands have.

/// `--set path=value`, any number of them; `whose`: "scenario", "scenarios".
void add_set(CLI::App& command, std::vector<std::string>& set, const std::string& whose);
/// `--out FOLDER`; what it is already is the default.
void add_out(CLI::App& command, std::filesystem::path& out, const std::string& help);
/// `--on` and `--stage`: where a study's runs are run, "" = here.
struct ClusterOptions {
  std::string on;               ///< "dask://HOST:PORT", "slurm", "slurm:PARTITION"
  std::filesystem::path stage;  ///< a folder that Slurm's machines see, "" = that of the results
};
void add_on(CLI::App& command, ClusterOptions& cluster);
/// Whoever does the runs of a study whose results go to `out`; what is wrong with the cluster goes to
/// `problems`.
cluster::Workers workers_of(const ClusterOptions& cluster, int jobs, const std::filesystem::path& out,
                            Problems& problems);
/// `--annotate`: whom annotate() is for, "github" or "gitlab".
void add_annotate(CLI::App& command, std::string& whom);
/// `--no-pictures`
void add_no_pictures(CLI::App& command, bool& pictures, const std::string& help);

// Arguments that several commands take. What is wrong goes to `problems`, by the name of the option.

/// The texts of `--set` as overrides; one that is no assignment path=value is a problem.
std::vector<scenario::Override> overrides_of(const std::vector<std::string>& set, Problems& problems);

/// A file that a command reads, which its results must not overwrite.
struct InputFile {
  std::filesystem::path file;
  std::string kind;  ///< "scenario", "table"
};
/// What an option's file may replace: what drycut wrote (record::is_own_file), all else only with --force.
struct Replacing {
  bool force = false;
  std::string_view header = {};  ///< with which the first line of a table of its kind begins
};
/// `--force`
void add_force(CLI::App& command, bool& force);
/// The file of an option can be written, is not the input and replaces nobody's work.
void check_output(const char* option, const std::string& file, const InputFile& input,
                  const Replacing& replacing, Problems& problems);
/// The files of `--csv` ("" = none, "-" = standard output) and `--png` ("" = none), likewise; they are not
/// each other, and the picture's name ends in .png. `replacing` has the header of the former.
void check_outputs(const std::string& csv, const std::string& png, const InputFile& input,
                   const Replacing& replacing, Problems& problems);

}  // namespace drycut::sim::cli
