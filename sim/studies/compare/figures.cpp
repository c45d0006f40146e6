// Numbers out of events and channels, run by run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sim/report/statistics.hpp"
#include "sim/studies/compare/differences.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A value of an event: source, event, value, unit.
struct ValueName {
  std::string source;
  std::string event;
  std::string value;
  std::string unit;
};

std::vector<ValueName> event_values(const std::vector<RunFolder>& runs) {
  std::vector<ValueName> names;
  std::set<std::string> seen;
  for (const auto& run : runs)
    for (const auto& event : run.recording.events())
      for (const auto& value : event.values)
        if (seen.insert(event.source + "." + event.event + " " + value.name).second)
          names.push_back({event.source, event.event, value.name, value.unit});
  return names;
}

std::vector<double> numbers_of(const RunFolder& run, const ValueName& name, const Tolerance* tolerance,
                               std::optional<double> from) {
  constexpr double end = std::numeric_limits<double>::infinity();
  const bool window = !from && tolerance != nullptr;
  return report::event_numbers(run.recording.events(), name.source + "." + name.event, name.value,
                               window ? tolerance->from : from.value_or(0),
                               window ? tolerance->until.value_or(end) : end)
      .numbers;
}

double room(const Tolerance& tolerance, double number) {
  return std::min(tolerance.high - number, number - tolerance.low);
}

/// Rows of one value; each is filled run by run.
struct ValueFigures {
  explicit ValueFigures(const ValueName& name) {
    const auto of = fmt::format("{}.{} {}: ", name.source, name.event, name.value);
    const auto make = [&](const char* what, const std::string& unit) { return Figure{of + what, unit, {}}; };
    number = make("number", "");
    mean = make("mean", name.unit);
    spread = make("standard deviation", name.unit);
    least = make("least", name.unit);
    greatest = make("greatest", name.unit);
    slope = make("slope from one to the next", name.unit);
    low = make("lower limit", name.unit);
    high = make("upper limit", name.unit);
    worst = make("worst", name.unit);
    capability = make("Cpk", "");
  }

  void add(const std::vector<double>& numbers, const Tolerance* tolerance) {
    const auto statistic = report::statistics(numbers);
    const bool any = !numbers.empty();
    const bool two = numbers.size() > 1;
    number.numbers.push_back(static_cast<double>(numbers.size()));
    mean.numbers.push_back(any ? statistic[0] : nothing);
    least.numbers.push_back(any ? statistic[1] : nothing);
    greatest.numbers.push_back(any ? statistic[2] : nothing);
    spread.numbers.push_back(two ? statistic[3] : nothing);
    slope.numbers.push_back(two ? statistic[4] : nothing);
    const bool judged = tolerance != nullptr;
    low.numbers.push_back(judged ? tolerance->low : nothing);
    high.numbers.push_back(judged ? tolerance->high : nothing);
    const auto nearer = [&](double a, double b) { return room(*tolerance, a) < room(*tolerance, b); };
    worst.numbers.push_back(judged && any ? *std::min_element(numbers.begin(), numbers.end(), nearer)
                                          : nothing);
    const auto found =
        judged ? sim::report::capability(statistic, tolerance->low, tolerance->high) : std::nullopt;
    capability.numbers.push_back(found ? found->cpk : nothing);
  }

  void append_to(std::vector<Figure>& figures) {
    for (auto* figure :
         {&number, &mean, &spread, &least, &greatest, &slope, &low, &high, &worst, &capability})
      if (std::any_of(figure->numbers.begin(), figure->numbers.end(),
                      [](double n) { return !std::isnan(n); }))
        figures.push_back(std::move(*figure));
  }

  Figure number, mean, spread, least, greatest, slope, low, high, worst, capability;
};

bool has(const RunFolder& run, const ChannelRow& row) {
  const auto* column = run.recording.column(row.name);
  return column != nullptr && column->unit == row.unit;
}

void measure(const RunFolder& run, ChannelRow& row, double from) {
  if (!has(run, row)) {
    row.rms.push_back(nothing);
    row.peak.push_back(nothing);
    return;
  }
  const auto& times = run.recording.times();
  const auto& values = run.recording.column(row.name)->values;
  double squares = 0;
  double peak = 0;
  double count = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (seconds(times[i]) < from) continue;
    squares += values[i] * values[i];
    peak = std::max(peak, std::abs(values[i]));
    ++count;
  }
  row.rms.push_back(count > 0 ? std::sqrt(squares / count) : nothing);
  row.peak.push_back(count > 0 ? peak : nothing);
}

/// Notes the largest difference of run `in` to `first`.
void subtract(const RunFolder& first, const RunFolder& other, std::size_t in, double from, ChannelRow& row) {
  const auto& times = first.recording.times();
  const auto& other_times = other.recording.times();
  const auto& values = first.recording.column(row.name)->values;
  const auto& other_values = other.recording.column(row.name)->values;
  std::size_t k = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    while (k < other_times.size() && other_times[k] < times[i]) ++k;
    if (k == other_times.size()) return;
    if (other_times[k] != times[i] || seconds(times[i]) < from) continue;
    const double difference = std::abs(other_values[k] - values[i]);
    if (!(difference > row.difference)) continue;
    row.difference = difference;
    row.at = seconds(times[i]);
    row.in = in;
  }
}

std::vector<ChannelRow> all_channels(const std::vector<RunFolder>& runs) {
  std::vector<ChannelRow> rows;
  std::set<std::pair<std::string, std::string>> seen;
  for (const auto& run : runs)
    for (const auto& column : run.recording.columns())
      if (seen.emplace(column.name, column.unit).second) rows.push_back({column.name, column.unit, {}, {}});
  return rows;
}

std::size_t runs_with(const std::vector<RunFolder>& runs, const ChannelRow& row) {
  return static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [&](const RunFolder& run) { return has(run, row); }));
}

}  // namespace

bool differs(const Figure& figure) {
  const double first = figure.numbers.front();
  return std::any_of(figure.numbers.begin(), figure.numbers.end(), [&](double number) {
    return std::isnan(number) != std::isnan(first) || (!std::isnan(number) && number != first);
  });
}

std::vector<Figure> compare_events(const std::vector<RunFolder>& runs, std::optional<double> from) {
  std::vector<Figure> figures;
  for (const auto& name : event_values(runs)) {
    ValueFigures rows(name);
    for (const auto& run : runs) {
      const auto* tolerance = run.tolerance(name.source, name.event, name.value);
      rows.add(numbers_of(run, name, tolerance, from), tolerance);
    }
    rows.append_to(figures);
  }
  return figures;
}

std::vector<ChannelRow> compare_channels(const std::vector<RunFolder>& runs, std::optional<double> from) {
  auto rows = all_channels(runs);
  std::erase_if(rows, [&](const ChannelRow& row) { return runs_with(runs, row) < 2; });
  for (auto& row : rows) {
    const RunFolder* first = nullptr;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      measure(runs[i], row, from.value_or(0));
      if (!has(runs[i], row)) continue;
      if (first == nullptr) {
        first = &runs[i];
      } else {
        subtract(*first, runs[i], i, from.value_or(0), row);
      }
    }
  }
  return rows;
}

std::vector<std::string> unmatched_channels(const std::vector<RunFolder>& runs) {
  std::vector<std::string> names;
  for (const auto& row : all_channels(runs)) {
    if (runs_with(runs, row) > 1) continue;
    const auto owner =
        std::find_if(runs.begin(), runs.end(), [&](const RunFolder& run) { return has(run, row); });
    names.push_back(fmt::format("{}: {} [{}]", owner->label, row.name, row.unit.empty() ? "-" : row.unit));
  }
  return names;
}

}  // namespace drycut::sim::studies
