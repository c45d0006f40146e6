#include "sim/report/chosen_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "plants/plant.hpp"

namespace drycut::sim::report {

namespace {

constexpr double another_length = 0.01;  // of the length of the cut before

/// The cut at the worst moment of the first check that looks at cuts.
std::optional<double> worst_cut(const std::vector<double>& cuts,
                                const std::vector<record::CheckResult>& checks) {
  constexpr double same = 1e-6;  // [s]
  for (const auto& check : checks) {
    if (!check.at) continue;
    for (const auto cut : cuts)
      if (std::abs(cut - *check.at) < same) return cut;
  }
  return std::nullopt;
}

std::size_t nearest_frame(const std::vector<double>& times, double time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  const auto index = static_cast<std::size_t>(after - times.begin());
  if (index == times.size()) return index - 1;
  return index > 0 && time - times[index - 1] < times[index] - time ? index - 1 : index;
}

/// The frame in the middle of the longest time between two that are chosen; nullopt if all are.
std::optional<std::size_t> in_widest_gap(const std::vector<double>& times,
                                         const std::map<std::size_t, std::string>& chosen) {
  std::optional<std::size_t> found;
  double widest = 0;
  for (auto next = chosen.begin(), before = next++; next != chosen.end(); before = next++) {
    const double gap = times[next->first] - times[before->first];
    if (next->first - before->first < 2 || gap <= widest * (1 + 1e-9)) continue;
    widest = gap;
    found =
        std::clamp(nearest_frame(times, times[before->first] + gap / 2), before->first + 1, next->first - 1);
  }
  return found;
}

}  // namespace

std::vector<Moment> moments_of(const record::EventLog& events, const std::vector<record::CheckResult>& checks,
                               double begin_s, double end_s) {
  const auto is_in = [&](double at) { return at >= begin_s && at <= end_s; };
  std::vector<Moment> faults, changes, others;
  std::vector<double> cuts;
  int cuts_before = 0;
  std::map<std::string, double> lengths;  // of a station's last cut
  std::set<std::string> known;
  for (const auto& event : events) {
    const auto at = event.at_seconds();
    if (event.event == plants::cut_event) {
      cuts_before += at < begin_s ? 1 : 0;
      if (is_in(at)) cuts.push_back(at);
      const auto* length = event.find("length");
      if (length == nullptr) continue;
      const auto [before, is_first] = lengths.try_emplace(event.source, length->number);
      if (!is_first && std::abs(length->number - before->second) > another_length * before->second &&
          is_in(at))
        changes.push_back({at, fmt::format("cut to {:.0f} {}", length->number, length->unit)});
      before->second = length->number;
    } else if (!is_in(at)) {
      continue;
    } else if (event.event == "fault") {
      faults.push_back({at, "fault", true});
    } else if (event.source != "timeline" && event.source != "controller" && event.source != "card" &&
               known.insert(event.source + "." + event.event).second) {
      others.push_back({at, event.source + " " + event.event, true});
    }
  }
  std::vector<Moment> moments;
  if (!cuts.empty()) moments.push_back({cuts.front(), cuts_before == 0 ? "first cut" : "cut"});
  moments.insert(moments.end(), faults.begin(), faults.end());
  for (const auto& check : checks) {
    const auto at = check.failed_at ? check.failed_at : check.at;
    if (!check.passed && at && is_in(*at)) moments.push_back({*at, "failed: " + check.name});
  }
  if (const auto worst = worst_cut(cuts, checks)) moments.push_back({*worst, "worst cut"});
  moments.push_back({end_s, "last picture"});
  moments.insert(moments.end(), changes.begin(), changes.end());
  moments.insert(moments.end(), others.begin(), others.end());
  return moments;
}

std::vector<Moment> moments_around(double event_s, double begin_s, double end_s) {
  return {{event_s, ""}, {begin_s, ""}, {end_s, ""}};
}

std::vector<ChosenFrame> chosen_frames(const std::vector<double>& times_s, const std::vector<Moment>& moments,
                                       std::size_t wanted) {
  if (times_s.empty() || wanted == 0) return {};
  std::map<std::size_t, std::string> chosen;
  for (const auto& moment : moments) {
    auto frame = nearest_frame(times_s, moment.time_s);
    if (moment.changes && times_s[frame] < moment.time_s && frame + 1 < times_s.size()) ++frame;
    if (chosen.size() == wanted && !chosen.contains(frame)) continue;
    auto& what = chosen[frame];
    what += (what.empty() || moment.what.empty() ? "" : ", ") + moment.what;
  }
  if (chosen.size() < std::min<std::size_t>(2, wanted)) {
    chosen.try_emplace(times_s.size() - 1);
    const double way = (times_s.back() - times_s.front()) / static_cast<double>(wanted);
    if (chosen.size() < wanted) chosen.try_emplace(nearest_frame(times_s, times_s.front() + way));
  }
  while (chosen.size() < wanted) {
    const auto between = in_widest_gap(times_s, chosen);
    if (!between) break;
    chosen.try_emplace(*between);
  }
  std::vector<ChosenFrame> frames;
  frames.reserve(chosen.size());
  for (auto& [frame, what] : chosen) frames.push_back({frame, std::move(what)});
  return frames;
}

std::size_t poster_frame(const std::vector<double>& times_s, const std::vector<Moment>& moments) {
  for (const auto& moment : moments)
    if (moment.time_s < times_s.back()) return nearest_frame(times_s, moment.time_s);
  return times_s.size() / 2;
}

}  // namespace drycut::sim::report
