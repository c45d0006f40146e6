#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/recordings/recording.hpp"
#include "sim/studies/fit/bench.hpp"

namespace drycut::sim::studies {

/// A fit as it is asked for.
struct FitRequest {
  std::filesystem::path scenario;
  std::vector<std::filesystem::path> recordings;  ///< their YAML
  std::vector<std::filesystem::path> tests;       ///< recordings that the values found must explain, too
  std::vector<std::string> vary;                  ///< "plants.axis.mass"
  std::optional<double> limit;                    ///< of the torque that a cross test leaves unexplained [%]
  std::vector<scenario::Override> set;
  bool closed = false;  ///< the scenario runs with its loops and inputs
  int jobs = 1;
};

/// Where values are from.
struct FitSource {
  std::filesystem::path file;  ///< the recording's YAML
  std::filesystem::path from;  ///< the export that it names
  std::uint64_t checksum = 0;  ///< of the export, FNV-1a
  std::size_t rows = 0;
};

struct FitPlan {
  FitRequest request;
  FitQuestion question;
  std::vector<ReplaySeries> recordings;
  std::vector<ReplaySeries> tests;
  std::vector<FitSource> sources;  ///< of the recordings
  std::vector<Finding> findings;   ///< what is doubtful in the recordings
};

/// Reads the scenario, finds what is looked for in it, and makes it a source of torque; no value if there is
/// something wrong.
std::optional<scenario::Scenario> read_question(FitPlan& plan, Problems& problems);

/// Reads scenario and recordings, and finds what is looked for in them. What is wrong goes to `problems`, all
/// of it; the plan is not to be used then.
FitPlan plan_fit(const FitRequest& request, Problems& problems);

}  // namespace drycut::sim::studies
