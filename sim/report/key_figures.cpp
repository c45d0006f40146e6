#include "sim/report/key_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "sim/loop/statistics.hpp"
#include "sim/report/gallery_plots.hpp"

namespace drycut::sim::report {

namespace {

constexpr std::size_t enough = 10;  // values for a Cpk

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

/// How many decimals a number needs in which `fine` is to be seen.
int decimals_for(double fine) {
  constexpr double most = 6;
  return fine > 0 ? static_cast<int>(std::clamp(std::ceil(-std::log10(fine)), 0.0, most)) : 3;
}

std::string rounded(double number, int decimals) {
  auto text = fmt::format("{:.{}f}", number, decimals);
  const bool nothing = text.find_first_not_of("-0.") == std::string::npos;
  return nothing && text.front() == '-' ? text.substr(1) : text;
}

/// How far a value is on its way from what is best to what is just allowed: 1 = there.
double used_of(const record::Tolerance& tolerance, double number) {
  if (std::isinf(tolerance.low)) return tolerance.high > 0 ? std::max(0.0, number / tolerance.high) : number;
  if (std::isinf(tolerance.high)) return number > 0 ? std::max(0.0, tolerance.low / number) : -number;
  const double half = (tolerance.high - tolerance.low) / 2;
  return half > 0 ? std::abs(number - tolerance.low - half) / half : 0;
}

bool is_shareable(const record::Tolerance& tolerance) {
  if (std::isinf(tolerance.low)) return tolerance.high > 0;
  return !std::isinf(tolerance.high) || tolerance.low > 0;
}

/// Of accidents, an end stop that was hit and its bounces, a mean says nothing.
bool is_accident(const record::EventLog& events, const std::string& name) {
  return std::any_of(events.begin(), events.end(), [&](const auto& event) {
    return event.severity >= Severity::error && event.source + "." + event.event == name;
  });
}

renders::ReportKey value_key(const record::Tolerance& tolerance, const loop::EventNumbers& series,
                             bool accident) {
  const auto figures = loop::statistics(series.numbers);
  const auto [mean, least, greatest, sd, slope, slope_error] = figures;
  const bool both = std::isfinite(tolerance.low) && std::isfinite(tolerance.high);
  const double room = both ? tolerance.high - tolerance.low
                           : std::abs(std::isfinite(tolerance.low) ? tolerance.low : tolerance.high);
  const int decimals =
      std::max(decimals_for(room / 100), sd >= room / 1000 ? decimals_for(sd) : decimals_for(room));
  renders::ReportKey key{fmt::format("{} of {}", tolerance.value, tolerance.event),
                         with_unit(rounded(mean, decimals), series.unit),
                         {},
                         {}};
  if (series.numbers.size() > 1 && rounded(sd, decimals) != rounded(0, decimals))
    key.value =
        with_unit(fmt::format("{} ± {}", rounded(mean, decimals), rounded(sd, decimals)), series.unit);
  else if (sd > 0)
    key.notes.push_back(fmt::format("{} events, spread below {}", series.numbers.size(),
                                    with_unit(rounded(std::pow(10.0, -decimals), decimals), series.unit)));
  std::size_t worst = 0;
  for (std::size_t i = 1; i < series.numbers.size(); ++i)
    if (used_of(tolerance, series.numbers[i]) > used_of(tolerance, series.numbers[worst])) worst = i;
  const auto of_worst = with_unit(rounded(series.numbers[worst], decimals), series.unit);
  key.notes.push_back(
      fmt::format("worst {}: no. {:.0f}, at {:.3f} s", of_worst, series.order[worst], series.times[worst]));
  if (is_shareable(tolerance)) key.used = used_of(tolerance, series.numbers[worst]);
  const auto count = series.numbers.size();
  if (accident) {
    key.label = "worst " + key.label;
    key.value = of_worst;
    key.notes = {
        fmt::format("no. {:.0f} of {}, at {:.3f} s", series.order[worst], count, series.times[worst])};
    return key;
  }
  const auto found = loop::capability(figures, tolerance.low, tolerance.high);
  if (count < enough)
    key.notes.push_back(fmt::format("of {}, too few for a Cpk", counted(count, "value")));
  else
    key.notes.push_back(!found ? fmt::format("no spread in {} values, so no Cpk", count)
                               : fmt::format("Cpk {}, of {} values",
                                             found->cpk > 100 ? std::string("above 100")
                                             : found->cpk < 0
                                                 ? std::string("below 0: their mean is beyond a limit")
                                                 : fmt::format("{:.2f}", found->cpk),
                                             count));
  return key;
}

/// Events that come with a length: pieces.
void add_pieces(const record::Recording& recording, const std::vector<loop::KnownEvent>& known_events,
                std::vector<renders::ReportKey>& keys) {
  std::vector<std::pair<std::string, loop::EventNumbers>> all;
  for (const auto& known : known_events) {
    const bool has_length = std::any_of(known.values.begin(), known.values.end(),
                                        [](const auto& value) { return value.first == "length"; });
    if (!has_length) continue;
    const auto name = known.source + "." + known.name;
    auto series = loop::event_numbers(recording.events(), name, "length");
    if (!series.numbers.empty()) all.emplace_back(name, std::move(series));
  }
  for (const auto& [name, series] : all) {
    renders::ReportKey key{
        all.size() == 1 ? "pieces" : "pieces of " + name, fmt::format("{}", series.numbers.size()), {}, {}};
    // How fast they come at the end, over ten gaps.
    const auto& times = series.times;
    const auto gaps = std::min<std::size_t>(times.size() - 1, 10);
    if (gaps > 0 && times.back() > times[times.size() - 1 - gaps])
      key.notes.push_back(
          fmt::format("{:.4g} per minute at the end",
                      60 * static_cast<double>(gaps) / (times.back() - times[times.size() - 1 - gaps])));
    keys.push_back(std::move(key));
  }
}

void add_values(const record::Recording& recording, const record::Outcome& outcome,
                std::vector<renders::ReportKey>& keys) {
  std::set<std::pair<std::string, std::string>> told;
  for (const auto& check : outcome.checks) {
    for (const auto& tolerance : check.tolerances) {
      if (told.contains({tolerance.event, tolerance.value})) continue;
      const auto series = loop::event_numbers(recording.events(), tolerance.event, tolerance.value,
                                              tolerance.from, tolerance.until);
      if (series.numbers.empty()) continue;
      told.insert({tolerance.event, tolerance.value});
      keys.push_back(value_key(tolerance, series, is_accident(recording.events(), tolerance.event)));
    }
  }
}

void add_line_speeds(const record::Recording& recording, const std::vector<std::string>& lines,
                     std::vector<renders::ReportKey>& keys) {
  for (const auto& name : lines) {
    const auto* column = recording.column(name + ".speed");
    if (column == nullptr || column->values.empty()) continue;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double speed : column->values) {
      low = std::min(low, speed);
      high = std::max(high, speed);
    }
    const bool even = low == high;
    keys.push_back({(even ? "" : "highest ") + name + " speed",
                    with_unit(fmt::format("{:.4g}", record::without_noise(high)), column->unit),
                    {},
                    {}});
    if (!even) keys.back().notes.push_back(fmt::format("lowest {:.4g}", record::without_noise(low)));
  }
}

/// Of the drives that are nearest to their ratings.
void add_drives(const record::Outcome& outcome, bool all_judged, std::vector<renders::ReportKey>& keys) {
  constexpr std::size_t most = 3;
  std::vector<const record::DriveVerdict*> drives;
  drives.reserve(outcome.drives.size());
  for (const auto& drive : outcome.drives) drives.push_back(&drive);
  std::stable_sort(drives.begin(), drives.end(),
                   [](const auto* a, const auto* b) { return a->tightest().share > b->tightest().share; });
  if (drives.size() > most) drives.resize(most);
  for (const auto* drive : drives) {
    for (const auto& figure : drive->figures) {
      const bool over = !all_judged && figure.share > 1;
      if (!over && figure.name != "rms torque" && figure.name != "peak torque") continue;
      if (all_judged && !figure.judged) continue;  // a limit that works as one
      keys.push_back(
          {fmt::format("{} of {}", figure.name, drive->drive),
           fmt::format("{:.3g} {}", figure.value, figure.unit),
           {fmt::format("limit {:.4g} {}{}", figure.rating, figure.unit, all_judged ? "" : "; not judged"),
            figure.window},
           all_judged || over ? std::optional(figure.share) : std::nullopt});
    }
  }
}

/// How much of its limit a check used: of one that says it by its events' values alone, by the worst of them.
std::optional<double> used_by(const record::CheckResult& check, const record::Recording& recording) {
  auto most = check.used;
  for (const auto& tolerance : check.tolerances) {
    if (check.used || !is_shareable(tolerance)) continue;
    const auto series = loop::event_numbers(recording.events(), tolerance.event, tolerance.value,
                                            tolerance.from, tolerance.until);
    for (const double number : series.numbers) most = std::max(most.value_or(0), used_of(tolerance, number));
  }
  return most;
}

/// The check that failed by most, or would fail first if all went on a little worse. How long a run took to
/// be done says nothing of the machine.
void add_nearest(const record::Recording& recording, const record::Outcome& outcome,
                 std::vector<renders::ReportKey>& keys) {
  const record::CheckResult* nearest = nullptr;
  double most = 0;
  double most_of_deadlines = 0;
  std::size_t count = 0;
  const bool passed = std::all_of(outcome.checks.begin(), outcome.checks.end(),
                                  [](const record::CheckResult& check) { return check.passed; });
  for (const auto& check : outcome.checks) {
    if (check.passed != passed) continue;
    if (check.deadline && check.passed) {
      most_of_deadlines = std::max(most_of_deadlines, check.used.value_or(0));
      continue;
    }
    const auto used = used_by(check, recording);
    if (!used) continue;
    ++count;
    if (nearest != nullptr && *used <= most) continue;
    nearest = &check;
    most = *used;
  }
  if (count < (passed ? 2U : 1U)) return;
  keys.push_back({!nearest->passed           ? "farthest beyond its limit"
                  : most_of_deadlines > most ? "nearest to its limit, deadlines apart"
                                             : "nearest to its limit",
                  nearest->name,
                  {"of the checks that have a margin"},
                  most});
}

}  // namespace

std::vector<renders::ReportKey> key_figures(const record::Recording& recording,
                                            const std::vector<loop::KnownEvent>& known_events,
                                            const std::vector<std::string>& lines,
                                            const record::Outcome& outcome, bool drives_judged) {
  std::vector<renders::ReportKey> keys;
  add_pieces(recording, known_events, keys);
  add_values(recording, outcome, keys);
  add_line_speeds(recording, lines, keys);
  add_drives(outcome, drives_judged, keys);
  add_nearest(recording, outcome, keys);
  return keys;
}

}  // namespace drycut::sim::report
