#include "sim/recordings/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>


namespace drycut::sim::recordings {

std::optional<std::pair<double, double>> Clock::take(const DataCell& cell, int line) {
  now.reset();
  if (cell.kind != DataCell::Kind::number) return {};
  const double since = cell.value * (source.column == none ? source.step : source.unit);
  // A date counts from 1970; here the first sample is the beginning.
  constexpr double years = 3e8;
  if (times.empty()) origin = source.column != none && !source.counts && since > years ? since : 0;
  const double time = since - origin + (source.column == none || source.counts ? source.start : 0);
  if (!times.empty() && time == times.back()) {
    if (repeated++ == 0) first_repeated = line;
    return {};
  }
  if (!times.empty() && time < times.back()) return std::pair{times.back(), time};
  if (lines.empty() || line != lines.back().second + static_cast<int>(times.size() - lines.back().first))
    lines.emplace_back(times.size(), line);
  times.push_back(time);
  now = time;
  return {};
}

int Clock::line_of(std::size_t index) const {
  const auto behind = std::upper_bound(lines.begin(), lines.end(), index,
                                       [](std::size_t i, const auto& entry) { return i < entry.first; });
  const auto& entry = *std::prev(behind);
  return entry.second + static_cast<int>(index - entry.first);
}

double step_of(const std::vector<double>& times) {
  constexpr std::size_t enough = 1001;
  std::vector<double> steps;
  for (std::size_t i = 1; i < std::min(times.size(), enough); ++i) steps.push_back(times[i] - times[i - 1]);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

namespace {

std::string in_ms(double seconds) { return fmt::format("{:.6g} ms", seconds * 1000); }

/// From where on the steps are others than before for good; 0 = nowhere.
std::size_t change_of_rate(const std::vector<double>& times, double step) {
  constexpr std::size_t enough = 20;
  std::size_t run = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double now = times[i] - times[i - 1];
    const bool is_other = now > 1.5 * step || now < step / 1.5;
    const bool goes_on = run > 0 && std::abs(now / (times[i - 1] - times[i - 2]) - 1) < 0.1;
    run = !is_other ? 0 : goes_on ? run + 1 : 1;
    if (run == enough) return i - enough + 1;
  }
  return 0;
}

}  // namespace

std::vector<Doubt> doubts_of(const Clock& clock) {
  std::vector<Doubt> doubts;
  const auto& times = clock.times;
  if (clock.repeated > 0)
    doubts.push_back(
        {"recording.time-repeats"_code, clock.first_repeated,
         fmt::format("{} the time of the row before, left out",
                     clock.repeated == 1 ? "1 row has" : fmt::format("{} rows have", clock.repeated))});
  if (clock.source.column == none || times.size() < 2) return doubts;
  const double told = clock.source.step;
  const double step = clock.source.counts && told > 0 ? told : step_of(times);
  if (told > 0 && std::abs(step / told - 1) > 0.005)
    doubts.push_back({"recording.two-rates"_code, clock.line_of(0),
                      fmt::format("the times are {} apart, and {} says {}; the times are taken", in_ms(step),
                                  clock.source.is_told ? "the recording" : "the header", in_ms(told))});
  if (const auto at = change_of_rate(times, step); at > 0) {
    doubts.push_back({"recording.two-rates"_code, clock.line_of(at),
                      fmt::format("from here on the times are {} apart, before {}",
                                  in_ms(times[at] - times[at - 1]), in_ms(step))});
    return doubts;
  }
  std::size_t gaps = 0;
  std::size_t widest = 0;
  int first = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] - times[i - 1] <= 1.5 * step) continue;
    if (gaps++ == 0) first = clock.line_of(i);
    if (widest == 0 || times[i] - times[i - 1] > times[widest] - times[widest - 1]) widest = i;
  }
  if (gaps > 0)
    doubts.push_back(
        {"recording.gap"_code, first,
         fmt::format("samples are missing before this row{}: {} from one to the next, {} is usual{}",
                     gaps > 1 ? fmt::format(" and {} more", gaps - 1) : "",
                     in_ms(times[widest] - times[widest - 1]), in_ms(step),
                     gaps > 1 ? fmt::format("; the widest is at line {}", clock.line_of(widest)) : "")});
  return doubts;
}

}  // namespace drycut::sim::recordings
