#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "base/problem.hpp"
#include "devices/coverage.hpp"
#include "sim/loop/kept_states.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/output_folder.hpp"
#include "sim/report/part_meshes.hpp"
#include "sim/report/results.hpp"

namespace drycut::sim::report {

/// How a run is asked for.
struct RunRequest {
  bool pictures = true;                ///< frames, film, plots and report
  bool gltf = false;                   ///< the run as an animated scene
  bool strict = false;                 ///< warnings fail it
  bool coverage = false;               ///< of the controller's programs
  bool in_memory = false;              ///< rows and events are read behind it, whatever is drawn
  scenario::Scenario* half = nullptr;  ///< the same at half its step, to be run too; it is used up
  int threads = 1;                     ///< that draw
  std::optional<Time> states = {};     ///< its moments are kept so often
  std::size_t most_states = 64;
  const loop::KeptMoment* from = nullptr;     ///< it goes on from there, and not from zero ...
  bool branches = false;                      ///< ... with other values
  std::vector<scenario::Stimulus> then = {};  ///< which are set there
  std::function<void(const char* doing, double done)> progress = [](const char*, double) {};
  std::function<bool()> is_interrupted = [] { return false; };
};

/// What a run left besides its files and its outcome.
struct RunLeft {
  std::string left_out = {};         ///< because a helper program is missing, and what to install
  std::filesystem::path scene = {};  ///< the glTF file, "" = none
  devices::Coverage coverage = {};   ///< by files as seen from the current folder
  std::string states_lost = {};      ///< why no more states were kept, "" = they were
  double simulating = 0;             ///< [s] of the clock, the run alone
};

/// What a run leaves, whoever runs it: scenario.yaml, trace and events as record.format says, checks.json,
/// pictures and the report, and the controller's retentive values where the scenario keeps them.
class RunFolder {
 public:
  /// Takes the folder, as OutputFolder does.
  RunFolder(const std::filesystem::path& folder, Problems& problems);
  /// Before anything runs, an earlier run goes, but for its states with `keeps_states`: an old verdict goes,
  /// and a new one says that there is none yet. Throws std::runtime_error.
  void begin(bool keeps_states = false);
  /// Runs `simulation`, which was put together of `scenario`, and writes all that it leaves. `result` has its
  /// outcome as soon as there is one. Throws std::runtime_error when something cannot be written.
  RunLeft run(const scenario::Scenario& scenario, loop::Simulation& simulation, const PartMeshes& meshes,
              const RunRequest& request, RunResult& result);

  [[nodiscard]] OutputFolder& files() { return files_; }

 private:
  std::string scene_file_;
  OutputFolder files_;
};

}  // namespace drycut::sim::report
