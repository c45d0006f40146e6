#include "base/problem.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include <fmt/format.h>

#include "base/text.hpp"

namespace drycut {

namespace {

// Edits that turn `a` into `b`: insert, delete, replace, or swap two neighbours (the typist's slip).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string to_string(const Problem& problem) {
  std::string text = fmt::format("{}:{}:{}: {}", problem.file, problem.line, problem.column, problem.what);
  if (!problem.remedy.empty()) text += "; " + problem.remedy;
  return fmt::format("{} [{}]", text, problem.code.text());
}

std::string to_string(const Finding& finding) { return fmt::format("{} [{}]", finding.text, finding.code); }

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string wanted = lower(word);
  // More than a third of the letters wrong is another word, not a slip.
  std::size_t best_distance = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  std::string best;
  for (const std::string& candidate : candidates) {
    const std::size_t lengths_differ = candidate.size() > wanted.size() ? candidate.size() - wanted.size()
                                                                        : wanted.size() - candidate.size();
    if (candidate.empty() || lengths_differ >= best_distance) continue;
    const std::string other = lower(candidate);
    const std::size_t distance = edit_distance(wanted, other);
    // A word of which nothing is left is no suggestion ("x" for "y").
    if (distance < best_distance && distance < std::max(wanted.size(), other.size())) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace drycut
