#include "sim/studies/compare/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "sim/report/results.hpp"

namespace drycut::sim::studies {

namespace {

std::ptrdiff_t changed_checks(const Comparison& comparison) {
  return std::count_if(comparison.checks.begin(), comparison.checks.end(),
                       [](const CheckRow& row) { return !row.change.empty(); });
}

std::ptrdiff_t changed_channels(const Comparison& comparison) {
  return std::count_if(comparison.channels.begin(), comparison.channels.end(),
                       [](const ChannelRow& row) { return !row.is_kept(); });
}

bool end_alike(const Comparison& comparison) {
  const auto& first = comparison.runs.front();
  return std::all_of(comparison.runs.begin(), comparison.runs.end(), [&](const ComparedRun& run) {
    return run.outcome.end == first.outcome.end && run.outcome.failure == first.outcome.failure &&
           run.recording.times() == first.recording.times();
  });
}

/// A page must stay readable: the rest is in its tables.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 3;
  const auto shown = names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size()));
  const auto text = fmt::format("{}", fmt::join(names.begin(), shown, "; "));
  return names.size() > most ? fmt::format("{}; and {} more", text, names.size() - most) : text;
}

/// Rows of words and numbers, a cell a run.
class RunRows {
 public:
  explicit RunRows(const Comparison& comparison) : comparison_(comparison), table_(columns_of(comparison)) {}
  template <typename Cell>
  void add(const std::string& what, const std::string& name, const std::string& unit, Cell cell) {
    std::vector<Table::Cell> cells = {what, name, unit};
    for (std::size_t i = 0; i < comparison_.runs.size(); ++i) cells.emplace_back(cell(i));
    table_.add(std::move(cells));
  }
  void numbers(const std::string& what, const std::string& name, const std::string& unit,
               const std::vector<double>& numbers) {
    add(what, name, unit, [&](std::size_t i) {
      return std::isnan(numbers[i]) ? numbers[i] : record::without_noise(numbers[i]);
    });
  }
  [[nodiscard]] Table table() && { return std::move(table_); }

 private:
  static std::vector<Column> columns_of(const Comparison& comparison) {
    std::vector<Column> columns = {{"what", "what"}, {"name", "name"}, {"unit", "unit"}};
    for (std::size_t i = 0; i < comparison.runs.size(); ++i)
      columns.push_back({fmt::format("run.{}", i), comparison.runs[i].label});
    return columns;
  }

  const Comparison& comparison_;
  Table table_;
};

}  // namespace

Comparison compare(std::vector<ComparedRun> runs, std::optional<double> from, const Allowances& allowances) {
  Comparison comparison;
  comparison.runs = std::move(runs);
  comparison.from = from;
  comparison.checks = compare_checks(comparison.runs, allowances);
  comparison.events = compare_events(comparison.runs, from);
  comparison.figures_beyond = figures_beyond(comparison.events, allowances);
  comparison.pieces = compare_pieces(comparison.runs, from);
  comparison.channels = compare_channels(comparison.runs, from, allowances);
  comparison.unmatched = unmatched_channels(comparison.runs);
  comparison.event_differences = differing_events(comparison.runs, allowances, comparison.events_looked_at);
  comparison.parameters = differing_parameters(comparison.runs);
  return comparison;
}

bool kept(const Comparison& comparison) {
  return changed_checks(comparison) == 0 && changed_channels(comparison) == 0 &&
         comparison.unmatched.empty() && comparison.event_differences.empty() &&
         comparison.figures_beyond.empty() && end_alike(comparison);
}

bool same(const Comparison& comparison) { return kept(comparison) && comparison.parameters.empty(); }

std::vector<record::CheckResult> judgement(const Comparison& comparison, bool parameters) {
  std::vector<record::CheckResult> rows;
  const auto judge = [&](const char* name, const char* expectation, std::size_t beyond, std::size_t all,
                         std::string detail) {
    record::CheckResult row{name, expectation, beyond == 0, {}, "", {}, {}};
    row.detail = all == 0 ? "none differs"
                 : beyond == 0
                     ? fmt::format("{} of {} kept", all, all)
                     : fmt::format("{} of {} differ{}{}", beyond, all, detail.empty() ? "" : ": ", detail);
    rows.push_back(std::move(row));
  };
  std::vector<std::string> names;
  for (const auto& check : comparison.checks)
    if (!check.change.empty()) names.push_back(fmt::format("{} ({})", check.name, check.change));
  judge("verdicts", "as in the first run, with margins", names.size(), comparison.checks.size(),
        some_of(names));
  const auto& events = comparison.event_differences;
  judge("events", "as in the first run", events.size(), comparison.events_looked_at,
        events.empty() ? "" : events.front().name + " is the first");
  names.clear();
  for (const auto& channel : comparison.channels)
    if (!channel.is_kept()) names.push_back(apart_text(channel, comparison));
  names.insert(names.end(), comparison.unmatched.begin(), comparison.unmatched.end());
  judge("channels", "as in the first run", names.size(),
        comparison.channels.size() + comparison.unmatched.size(), some_of(names));
  names.clear();
  for (const auto& figure : comparison.figures_beyond)
    names.push_back(fmt::format("{} by {:.4g} {}, {:.4g} allowed", figure.name, figure.difference,
                                figure.unit, figure.allowed));
  if (!names.empty()) judge("figures", "as in the first run", names.size(), names.size(), some_of(names));
  judge("end", "equally long, the same instants", end_alike(comparison) ? 0 : 1, 1, "");
  if (!parameters) return rows;
  names.clear();
  for (const auto& parameter : comparison.parameters) names.push_back(parameter.path);
  judge("parameters", "as in the first run", names.size(), names.size(), some_of(names));
  return rows;
}

std::string difference_text(const Comparison& comparison) {
  std::vector<std::string> parts;
  if (const auto changed = changed_checks(comparison); changed > 0)
    parts.push_back(fmt::format("{} of {}", changed, counted(comparison.checks.size(), "check")));
  if (!comparison.parameters.empty()) parts.push_back(counted(comparison.parameters.size(), "parameter"));
  if (!comparison.event_differences.empty())
    parts.push_back(fmt::format("{} of {}", comparison.event_differences.size(),
                                counted(comparison.events_looked_at, "event")));
  if (const auto changed = changed_channels(comparison); changed > 0)
    parts.push_back(fmt::format("{} of {}", changed, counted(comparison.channels.size(), "shared channel")));
  if (!comparison.figures_beyond.empty())
    parts.push_back(counted(comparison.figures_beyond.size(), "figure"));
  if (!comparison.unmatched.empty())
    parts.push_back(counted(comparison.unmatched.size(), "channel") + " of one run only");
  if (!end_alike(comparison)) parts.emplace_back("instants or end of the run");
  return parts.empty() ? "no difference" : fmt::format("different: {}", fmt::join(parts, ", "));
}

std::string apart_text(const ChannelRow& channel, const Comparison& comparison) {
  const auto unit = channel.unit.empty() ? "" : " " + channel.unit;
  return fmt::format("{} by {:.4g}{} at {:.4f} s in {}, {:.2g}{} allowed", channel.name, channel.difference,
                     unit, channel.at, comparison.runs[channel.in].label, channel.allowed, unit);
}

std::string result_text(const std::optional<record::CheckResult>& result) {
  if (!result) return "-";
  const auto margin = report::margin_text(*result);
  return fmt::format("{}{}{}",
                     result->so_far   ? "held so far"
                     : result->passed ? "passed"
                                      : "FAILED",
                     margin.empty() ? "" : ", ", margin);
}

Table comparison_table(const Comparison& comparison, const std::vector<Figure>& figures) {
  RunRows rows(comparison);
  const auto& runs = comparison.runs;
  rows.add("run", "drycut", "", [&](auto i) { return runs[i].version; });
  rows.add("run", "passed", "", [&](auto i) { return runs[i].outcome.passed() ? "yes" : "no"; });
  rows.add("run", "simulated", "s", [&](auto i) { return fmt::format("{}", seconds(runs[i].outcome.end)); });
  for (const auto& figure : figures) rows.numbers("figure", figure.name, figure.unit, figure.numbers);
  for (const auto& row : comparison.checks) {
    const auto& results = row.results;
    rows.add("check", row.name, "", [&](auto i) -> std::string {
      if (!results[i]) return "";
      return results[i]->so_far ? "held so far" : results[i]->passed ? "passed" : "failed";
    });
    const auto known =
        std::find_if(results.begin(), results.end(), [](const auto& r) { return r && r->margin; });
    if (known == results.end()) continue;
    rows.add("margin", row.name, (*known)->unit,
             [&](auto i) { return results[i] && results[i]->margin ? *results[i]->margin : NAN; });
  }
  for (const auto& figure : comparison.events)
    rows.numbers("event", figure.name, figure.unit, figure.numbers);
  for (const auto& pieces : comparison.pieces) {
    std::size_t most = 0;
    for (const auto& run : pieces.runs) most = std::max(most, run.size());
    for (std::size_t k = 0; k < most; ++k) {
      std::vector<double> numbers;
      for (const auto& run : pieces.runs) numbers.push_back(k < run.size() ? run[k] : NAN);
      rows.numbers("piece", fmt::format("{} length {}", pieces.event, k + 1), pieces.unit, numbers);
    }
  }
  for (const auto& row : comparison.channels) {
    rows.numbers("channel", row.name + ": rms", row.unit, row.rms);
    rows.numbers("channel", row.name + ": peak", row.unit, row.peak);
  }
  for (const auto& row : comparison.parameters)
    rows.add("parameter", row.path, "", [&](auto i) { return row.values[i].value_or(""); });
  return std::move(rows).table();
}

}  // namespace drycut::sim::studies
