#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/scenario/yaml_node.hpp"
#include "sim/studies/why/ddmin.hpp"
#include "sim/studies/why/differences.hpp"

namespace drycut::sim::studies {

/// A run, or a scenario, with all that it is made of.
struct RunSide {
  std::filesystem::path given;        ///< as the user named it
  std::filesystem::path file;         ///< the scenario's own, from which its paths lead on
  std::string text;                   ///< the scenario with every value in force
  scenario::YamlNode tree;            ///< of it, without what changes no run
  std::vector<std::string> channels;  ///< that it records
  std::vector<std::pair<std::string, std::string>>
      programs;  ///< files of the controller by their names, texts
  [[nodiscard]] bool is_folder() const;
};
/// Reads a folder that `drycut run` made of a scenario, or a scenario's file. What is wrong is told in
/// `problems`; then there is nothing.
std::optional<RunSide> read_side(const std::filesystem::path& given, Problems& problems);

/// Anything between a run that is good and one that fails.
class Mixture {
 public:
  Mixture(RunSide good, RunSide failed);

  [[nodiscard]] const std::vector<Difference>& differences() const { return differences_; }
  /// What one of the sides records.
  [[nodiscard]] std::vector<std::string> channels() const;
  /// A scenario and the files that it reads in place of those on the disk.
  struct Made {
    std::filesystem::path file;
    std::string text;
    std::map<std::string, std::string> files = {};
  };
  /// The good side with these differences. `late`: entries that only the failing side has are there, but
  /// never due.
  [[nodiscard]] Made with(const Subset& taken, bool late = false) const;
  /// True if what the line of a program has come to on one side fits the other.
  [[nodiscard]] bool states_fit(const Subset& differences) const;

 private:
  Made walk(const Take& take) const;

  RunSide good_;
  RunSide failed_;
  struct Program {
    std::string name;  ///< as the good side calls it
    std::string good;
    std::string failed;
  };
  std::vector<Program> programs_;
  std::vector<Difference> differences_;
};

}  // namespace drycut::sim::studies
