#pragma once
#include <drycut/problem.hpp>
#include <string>
#include <vector>

namespace drycut {

std::string to_string(const Problem& problem);

/// The candidate nearest to `word` (edit distance, case-insensitive), or "" if none is near enough to
/// suggest.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace drycut
