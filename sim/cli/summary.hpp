#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "sim/report/results.hpp"

namespace drycut::sim::cli {

/// What a pull request or the page of a job is told, in Markdown (GitHub's): a table of the scenes with their
/// verdicts, what failed with its figures and place, and pictures. `links`: what stands before a path from
/// the folder of all results on, "https://host/page/"; nothing: no links and no pictures.
struct Summary {
  std::filesystem::path out;  ///< the folder of all results
  std::optional<std::string> links;
};
inline constexpr std::string_view summary_header = "## Drycut: ";  ///< how it begins
std::string summary_text(const std::vector<report::RunResult>& results, const Summary& summary);
/// What it is told where nothing could be run.
std::string summary_text(const Problems& problems);

/// How a summary in `file` links to `out`: relative where it lies in `out` or above it, so that both travel
/// together; else not at all, unless `given` says where the results will be found.
std::optional<std::string> links_from(const std::filesystem::path& file, const std::filesystem::path& out,
                                      const std::string& given);

}  // namespace drycut::sim::cli
