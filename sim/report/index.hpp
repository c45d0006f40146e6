#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"

namespace drycut::sim::report {

inline constexpr auto* index_file = "index.html";
/// The manifest of the folder it is in (output_folder.hpp), which also has the file of `drycut run` beside
/// it.
inline constexpr auto* index_kind = "runs";
inline constexpr auto* index_neighbour = "junit.xml";

/// A folder of results below another, as an index shows it.
struct IndexEntry {
  std::string name;                                ///< its path from the index: "three_way/LX3VP"
  std::string kind;                                ///< what wrote it: "run", "compare", "sweep", ...
  std::string title;                               ///< of its scenario or its page
  std::optional<record::Verdict::Came> came = {};  ///< nothing = not known
  std::string word;     ///< "PASS", "FAIL", what a page is headed with that judges nothing; "" = not known
  std::string verdict;  ///< "2 of 5 checks failed", the checks that did; "" where nothing is known
  std::optional<double> simulated = {};  ///< [s]
  std::string version;                   ///< of the drycut that ran it
  std::string page;                      ///< path from the index to what it opens: the report, else the trace
  std::string picture;                   ///< a frame, else a plot; "" = none
  std::string picture_words;             ///< for who does not see it
};

/// What lies below `folder`, by path: folders that drycut wrote into, and what is in those; links not
/// followed. A folder of which the verdict cannot be read is one of which it is not known.
std::vector<IndexEntry> index_entries(const std::filesystem::path& folder);

/// What came of them: "1 of 3 runs failed; all 2 comparisons and studies that judge passed".
std::string index_verdict(const std::vector<IndexEntry>& entries);

/// A page of them, sortable, that opens offline as long as it stays where it is. Same folders, same bytes.
std::string index_page(const std::vector<IndexEntry>& entries);

/// Writes the index of a folder into it; returns what it lists. Throws std::runtime_error if it cannot be
/// written.
std::vector<IndexEntry> write_index(const std::filesystem::path& folder, OutputFolder& out);

}  // namespace drycut::sim::report
