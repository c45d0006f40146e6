#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/file.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/output_folder.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::cli {

/// How a run is asked for, as far as its results depend on it.
struct RunKind {
  std::string name;  ///< of its results
  bool pictures = true;
  bool gltf = false;
  bool verify_step = false;
  bool strict = false;
};

/// All bytes that determine the results of a run, each as its fingerprint: the program, the scenario with
/// every value in force, `files`, which it was read from, the meshes that it names, and what reports and
/// films are made with.
std::string inputs_of_run(const scenario::Scenario& scenario, const FileSet& files, const RunKind& kind);

/// What a run left beside its files.
struct CachedRun {
  record::Outcome outcome;
  bool has_report = false;
  std::vector<Finding> notes;
  std::string scene;  ///< name of the glTF file, "" = none

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("outcome", self.outcome);
    archive("has_report", self.has_report);
    archive("notes", self.notes);
    archive("scene", self.scene);
  }
};

/// Results of runs, kept by what determines them: a folder an entry, DIR/FINGERPRINT. An entry takes its name
/// when it is complete. One that is damaged is no entry. Beyond `most_bytes` in all those go that were not
/// used for the longest time.
class RunCache {
 public:
  static constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30U;
  /// Makes the folder where there is none; a problem of `--cache` if that cannot be done.
  RunCache(std::filesystem::path folder, Problems& problems, std::uintmax_t most = most_bytes);

  /// Puts the files of the run of these inputs into `to`; nullopt if there is no such run, it is damaged,
  /// or it cannot be copied: what was written of it until then the run writes anew.
  [[nodiscard]] std::optional<CachedRun> take(const std::string& inputs, OutputFolder& to) const;
  /// Throws std::runtime_error if it cannot be kept.
  void keep(const std::string& inputs, const OutputFolder& from, const CachedRun& run) const;

 private:
  [[nodiscard]] std::filesystem::path entry_of(const std::string& inputs) const;
  void make_room() const;
  std::filesystem::path folder_;
  std::uintmax_t most_;
};

}  // namespace drycut::sim::cli
