// Numbers out of events and channels, run by run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sim/loop/statistics.hpp"
#include "sim/studies/compare/differences.hpp"
#include "sim/studies/compare/pieces.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

constexpr auto* length_value = "length";
constexpr auto* number_value = "number";  ///< a counter: its mean tells nothing

/// A value of an event: source, event, value, unit.
struct ValueName {
  std::string source;
  std::string event;
  std::string value;
  std::string unit;
};

std::vector<ValueName> event_values(const std::vector<ComparedRun>& runs) {
  std::vector<ValueName> names;
  std::set<std::string> seen;
  for (const auto& run : runs)
    for (const auto& event : run.recording.events())
      for (const auto& value : event.values)
        if (seen.insert(event.source + "." + event.event + " " + value.name).second)
          names.push_back({event.source, event.event, value.name, value.unit});
  return names;
}

std::vector<double> numbers_of(const ComparedRun& run, const ValueName& name, std::optional<double> from) {
  const auto event = name.source + "." + name.event;
  const auto window = window_of(run, event, name.value, from);
  return loop::event_numbers(run.recording.events(), event, name.value, window.from, window.until).numbers;
}

double room(const Tolerance& tolerance, double number) {
  return std::min(tolerance.high - number, number - tolerance.low);
}

/// "knife.cut length"
std::string words_of(const ValueName& name) {
  return fmt::format("{}.{} {}", name.source, name.event, name.value);
}

/// Rows of one value, of all pieces or of a lot; each is filled run by run.
struct ValueFigures {
  explicit ValueFigures(const ValueName& name, const std::string& lot = "") {
    const auto of = words_of(name) + lot + ": ";
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
    const auto statistic = loop::statistics(numbers);
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
        judged ? sim::loop::capability(statistic, tolerance->low, tolerance->high) : std::nullopt;
    capability.numbers.push_back(found ? found->cpk : nothing);
  }

  /// `in_lots`: what each lot tells for itself says nothing about all of them.
  void append_to(std::vector<Figure>& figures, bool in_lots = false) {
    std::vector<Figure*> all = {&number, &mean, &spread, &least, &greatest,
                                &slope,  &low,  &high,   &worst, &capability};
    if (in_lots) all = {&number, &low, &high, &worst};
    for (auto* figure : all)
      if (std::any_of(figure->numbers.begin(), figure->numbers.end(),
                      [](double n) { return !std::isnan(n); }))
        figures.push_back(std::move(*figure));
  }

  Figure number, mean, spread, least, greatest, slope, low, high, worst, capability;
};

/// The numbers of a value, run by run.
using Series = std::vector<std::vector<double>>;

/// The rows of each lot; false where no run has more than one.
bool add_lots(const ValueName& name, const Series& series, const std::vector<std::vector<Lot>>& lots,
              std::vector<Figure>& figures) {
  std::size_t most = 0;
  for (const auto& own : lots) most = std::max(most, own.size());
  if (most < 2) return false;
  for (std::size_t k = 0; k < most; ++k) {
    ValueFigures rows(name, fmt::format(", lot {}", k + 1));
    for (std::size_t i = 0; i < series.size(); ++i) {
      const auto lot = k < lots[i].size() ? lots[i][k] : Lot{};
      const auto first =
          series[i].begin() + static_cast<std::ptrdiff_t>(std::min(lot.first, series[i].size()));
      const auto left = static_cast<std::size_t>(series[i].end() - first);
      rows.add({first, first + static_cast<std::ptrdiff_t>(std::min(lot.count, left))}, nullptr);
    }
    rows.append_to(figures);
  }
  return true;
}

/// The lots of every run that the lengths of this event make.
std::vector<std::vector<Lot>> lots_of_runs(const std::vector<ComparedRun>& runs, ValueName name,
                                           std::optional<double> from) {
  name.value = length_value;
  std::vector<std::vector<Lot>> lots;
  lots.reserve(runs.size());
  for (const auto& run : runs) lots.push_back(lots_of(numbers_of(run, name, from)));
  return lots;
}

bool has(const ComparedRun& run, const ChannelRow& row) {
  const auto* column = run.recording.column(row.name);
  return column != nullptr && column->unit == row.unit;
}

void measure(const ComparedRun& run, ChannelRow& row, double from) {
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

/// How far a channel counts before it begins again; 0 where it does not, or not alike in both runs.
double turn_of(const ComparedRun& first, const ComparedRun& other, const std::string& name) {
  const auto own = first.turns.find(name);
  const auto others = other.turns.find(name);
  const bool alike = own != first.turns.end() && others != other.turns.end() && own->second == others->second;
  return alike ? own->second : 0;
}

/// Notes the largest difference of run `in` to `first`. What begins again lies on a circle: 359.9 deg and
/// 0.1 deg are 0.2 deg apart.
void subtract(const ComparedRun& first, const ComparedRun& other, std::size_t in, double from,
              ChannelRow& row) {
  const auto& times = first.recording.times();
  const auto& other_times = other.recording.times();
  const auto& values = first.recording.column(row.name)->values;
  const auto& other_values = other.recording.column(row.name)->values;
  const double turn = turn_of(first, other, row.name);
  const auto apart = [&](double a, double b) {
    return std::abs(turn > 0 ? std::remainder(b - a, turn) : b - a);
  };
  std::size_t k = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    while (k < other_times.size() && other_times[k] < times[i]) ++k;
    if (k == other_times.size()) return;
    if (other_times[k] != times[i] || seconds(times[i]) < from) continue;
    const double a = values[i];
    const double b = other_values[k];
    const double difference =
        std::isnan(a) == std::isnan(b) ? apart(a, b) : std::numeric_limits<double>::infinity();
    if (!(difference > row.difference)) continue;
    row.difference = difference;
    row.at = seconds(times[i]);
    row.in = in;
  }
}

std::vector<ChannelRow> all_channels(const std::vector<ComparedRun>& runs) {
  std::vector<ChannelRow> rows;
  std::set<std::pair<std::string, std::string>> seen;
  for (const auto& run : runs)
    for (const auto& column : run.recording.columns())
      if (seen.emplace(column.name, column.unit).second) rows.push_back({column.name, column.unit, {}, {}});
  return rows;
}

std::size_t runs_with(const std::vector<ComparedRun>& runs, const ChannelRow& row) {
  return static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [&](const ComparedRun& run) { return has(run, row); }));
}

}  // namespace

bool differs(const Figure& figure) {
  const double first = figure.numbers.front();
  return std::any_of(figure.numbers.begin(), figure.numbers.end(), [&](double number) {
    return std::isnan(number) != std::isnan(first) || (!std::isnan(number) && number != first);
  });
}

std::vector<Figure> compare_events(const std::vector<ComparedRun>& runs, std::optional<double> from) {
  std::vector<Figure> figures;
  std::vector<Figure> alone;  // of what happens once
  for (const auto& name : event_values(runs)) {
    if (name.value == number_value) continue;
    Series series;
    std::size_t most = 0;  // in a whole run
    ValueFigures rows(name);
    for (const auto& run : runs) {
      series.push_back(numbers_of(run, name, from));
      most = std::max(most, numbers_of(run, name, 0).size());
      rows.add(series.back(), run.tolerance(name.source, name.event, name.value));
    }
    if (most < 2) {
      const auto& once = rows.mean.numbers;
      if (!std::all_of(once.begin(), once.end(), [](double number) { return std::isnan(number); }))
        alone.push_back({words_of(name), name.unit, once});
      continue;
    }
    std::vector<Figure> of_lots;
    const bool in_lots = add_lots(name, series, lots_of_runs(runs, name, from), of_lots);
    rows.append_to(figures, in_lots);
    for (auto& figure : of_lots) figures.push_back(std::move(figure));
  }
  for (auto& figure : alone) figures.push_back(std::move(figure));
  return figures;
}

std::vector<FigureFault> figures_beyond(const std::vector<Figure>& figures, const Allowances& allowances) {
  std::vector<FigureFault> faults;
  for (const auto& figure : figures) {
    if (allowances.find(figure.name) == nullptr) continue;
    const double first = figure.numbers.front();
    const double allowed = allowances.of_channel(figure.name, figure.unit, std::abs(first));
    double most = 0;
    for (const double number : figure.numbers) {
      if (std::isnan(number) && std::isnan(first)) continue;
      const double apart = std::abs(number - first);
      most = std::isnan(apart) ? std::numeric_limits<double>::infinity() : std::max(most, apart);
    }
    if (most > allowed) faults.push_back({figure.name, figure.unit, most, allowed});
  }
  return faults;
}

std::vector<PieceRows> compare_pieces(const std::vector<ComparedRun>& runs, std::optional<double> from) {
  std::vector<PieceRows> pieces;
  for (const auto& name : event_values(runs)) {
    if (name.value != length_value) continue;
    PieceRows rows{name.source + "." + name.event, name.unit, {}};
    std::size_t most = 0;
    for (const auto& run : runs) {
      rows.runs.push_back(numbers_of(run, name, from));
      most = std::max(most, rows.runs.back().size());
    }
    if (most > 1) pieces.push_back(std::move(rows));
  }
  return pieces;
}

std::vector<ChannelRow> compare_channels(const std::vector<ComparedRun>& runs, std::optional<double> from,
                                         const Allowances& allowances) {
  auto rows = all_channels(runs);
  std::erase_if(rows, [&](const ChannelRow& row) { return runs_with(runs, row) < 2; });
  for (auto& row : rows) {
    const ComparedRun* first = nullptr;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      measure(runs[i], row, from.value_or(settled(runs[i])));
      if (!has(runs[i], row)) continue;
      if (first == nullptr) {
        first = &runs[i];
        double largest = 0;
        for (const double number : first->recording.column(row.name)->values)
          largest = std::max(largest, std::abs(number));
        row.allowed = allowances.of_channel(row.name, row.unit, largest);
      } else {
        subtract(*first, runs[i], i, from.value_or(0), row);
      }
    }
  }
  return rows;
}

std::vector<std::string> unmatched_channels(const std::vector<ComparedRun>& runs) {
  std::vector<std::string> names;
  for (const auto& row : all_channels(runs)) {
    if (runs_with(runs, row) > 1) continue;
    const auto owner =
        std::find_if(runs.begin(), runs.end(), [&](const ComparedRun& run) { return has(run, row); });
    names.push_back(fmt::format("{}: {} [{}]", owner->label, row.name, row.unit.empty() ? "-" : row.unit));
  }
  return names;
}

}  // namespace drycut::sim::studies
