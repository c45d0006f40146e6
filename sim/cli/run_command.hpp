#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

/// How much the terminal is told.
enum class Say { failures, results, more };

struct RunOptions {
  std::vector<std::filesystem::path> scenarios = {};
  std::filesystem::path out = "out";
  int jobs = 1;
  std::optional<std::uint64_t> seed = {};  ///< in place of the scenarios'
  bool pictures = true;
  bool verify_step = false;           ///< again at half the step: how far every margin moves
  bool strict = false;                ///< warnings fail it, too
  bool coverage = false;              ///< of the controllers' programs
  bool gltf = false;                  ///< the run as an animated .glb file, with or without pictures
  std::vector<std::string> set = {};  ///< "plants.web.speed=80 m/min"
  Say say = Say::results;
  std::filesystem::path cache = {};    ///< keeps results by what determines them, "" = nothing is kept
  std::filesystem::path summary = {};  ///< in Markdown, "" = none
  std::string links = {};              ///< where a summary's readers find the results, "" = beside it
  bool force = false;                  ///< a summary's file that drycut did not write is replaced too
  std::string states = {};             ///< keeps the run's moments so often, "" = never
  std::optional<Time> every = {};      ///< that, when it was read
  int most_states = 64;
  std::filesystem::path resume = {};  ///< folder of a run that goes on, "" = none
  std::string from = {};              ///< "out/x@12.5 s": a run branches there, "" = from zero
  std::string annotate = {};          ///< what failed at its line, for "github" or "gitlab"; "" = for nobody
};
/// drycut run
int run_scenarios(const RunOptions& options);

}  // namespace drycut::sim::cli
