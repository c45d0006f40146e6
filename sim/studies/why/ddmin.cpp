#include "sim/studies/why/ddmin.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>

namespace drycut::sim::studies {

namespace {

/// So many sets are tried at the same time, whatever the number of jobs is, for the next ones depend on them.
constexpr std::size_t together = 4;

std::vector<Subset> split(const Subset& set, std::size_t parts) {
  std::vector<Subset> all;
  for (std::size_t i = 0; i < parts; ++i) {
    const auto from = static_cast<std::ptrdiff_t>(i * set.size() / parts);
    const auto to = static_cast<std::ptrdiff_t>((i + 1) * set.size() / parts);
    all.emplace_back(set.begin() + from, set.begin() + to);
  }
  return all;
}

Subset without(const Subset& set, const Subset& part) {
  Subset rest;
  std::ranges::set_difference(set, part, std::back_inserter(rest));
  return rest;
}

class Search {
 public:
  explicit Search(const TrySets& try_sets) : try_sets_(try_sets) {}

  /// The first of them that fails.
  std::optional<std::size_t> first_failing(const std::vector<Subset>& sets) {
    for (std::size_t from = 0; from < sets.size() && !ended_; from += together) {
      const auto to = std::min(sets.size(), from + together);
      const std::vector<Subset> asked(sets.begin() + static_cast<std::ptrdiff_t>(from),
                                      sets.begin() + static_cast<std::ptrdiff_t>(to));
      const auto answers = try_sets_(asked);
      const auto failing = std::ranges::find(answers, TrialCame::failed);
      if (failing != answers.end()) return from + static_cast<std::size_t>(failing - answers.begin());
      ended_ = answers.size() < asked.size();
    }
    return {};
  }
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  const TrySets& try_sets_;
  bool ended_ = false;
};

}  // namespace

LeastSet least_failing(std::size_t count, const TrySets& try_sets) {
  Subset set(count);
  std::iota(set.begin(), set.end(), std::size_t{0});
  Search search(try_sets);
  std::size_t parts = 2;
  while (set.size() > 1 && !search.ended()) {
    parts = std::min(parts, set.size());
    const auto subsets = split(set, parts);
    if (const auto failing = search.first_failing(subsets)) {
      set = subsets[*failing];
      parts = 2;
      continue;
    }
    if (parts > 2) {  // of two, each is the other's complement
      std::vector<Subset> complements;
      for (const auto& subset : subsets) complements.push_back(without(set, subset));
      if (const auto failing = search.first_failing(complements)) {
        set = complements[*failing];
        --parts;
        continue;
      }
    }
    if (parts == set.size()) break;
    parts *= 2;
  }
  return {std::move(set), !search.ended()};
}

}  // namespace drycut::sim::studies
