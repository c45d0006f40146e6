// Checks, events one by one, parameters: what is matched by name.
#include "sim/studies/compare/differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/report/results.hpp"

namespace drycut::sim::studies {

namespace {

/// Names in the order in which they are first met.
class EventOrder {
 public:
  void add(const std::string& name) {
    if (place_.emplace(name, names_.size()).second) names_.push_back(name);
  }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  std::map<std::string, std::size_t> place_;
  std::vector<std::string> names_;
};

template <typename T, typename Same>
bool all_same(const std::vector<std::optional<T>>& items, Same same) {
  return std::all_of(items.begin(), items.end(), [&](const std::optional<T>& item) {
    return item.has_value() == items.front().has_value() && (!item || same(*item, *items.front()));
  });
}

std::string change_of(const CheckRow& row, const std::vector<ComparedRun>& runs,
                      const Allowances& allowances) {
  std::vector<std::string> having;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (row.results[i]) having.push_back(runs[i].label);
  if (having.size() < runs.size()) return fmt::format("only in {}", fmt::join(having, ", "));
  const auto same = [&](auto field) {
    return all_same(row.results, [&](const record::CheckResult& a, const record::CheckResult& b) {
      return field(a) == field(b);
    });
  };
  if (!same([](const record::CheckResult& c) { return c.passed; })) return "verdict";
  if (!same([](const record::CheckResult& c) { return c.expectation; })) return "expectation";
  const auto& first = *row.results[0];
  const double allowed = allowances.of_margin(first, runs[0]);
  const auto same_margin = [&](const record::CheckResult& a, const record::CheckResult& b) {
    if (!a.margin || !b.margin) return a.margin.has_value() == b.margin.has_value();
    return *a.margin == *b.margin || std::abs(*a.margin - *b.margin) <= allowed;
  };
  if (all_same(row.results, same_margin)) return "";
  const auto& last = *row.results[1];
  if (runs.size() != 2 || !first.margin || !last.margin) return "margin";
  return fmt::format("margin {:+.4g}{}{}", *last.margin - *first.margin, first.unit.empty() ? "" : " ",
                     first.unit);
}

std::string event_text(const record::RecordedEvent& event) {
  const auto values = record::values_text(event);
  return fmt::format("{:.6f} s{}{}", event.at_seconds(), values.empty() ? "" : ": ", values);
}

/// The largest number of each value of a run's events, by "knife.cut.length".
std::map<std::string, double> largest_values(const ComparedRun& run) {
  std::map<std::string, double> largest;
  for (const auto& event : run.recording.events())
    for (const auto& value : event.values) {
      auto& most = largest[event.source + "." + event.event + "." + value.name];
      most = std::max(most, std::abs(value.number));
    }
  return largest;
}

/// The same event of two runs, as far as tolerances go.
class EventJudge {
 public:
  EventJudge(const ComparedRun& first, const Allowances& allowances)
      : allowances_(allowances),
        largest_(largest_values(first)),
        time_(allowances.of_time(seconds(first.outcome.end))) {}

  [[nodiscard]] bool keeps(const record::RecordedEvent& first, const record::RecordedEvent& other) const {
    if (std::abs(first.at_seconds() - other.at_seconds()) > time_) return false;
    if (first.values.size() != other.values.size()) return false;
    if (first.values.empty()) return first.text == other.text;
    for (std::size_t i = 0; i < first.values.size(); ++i) {
      const auto& a = first.values[i];
      const auto& b = other.values[i];
      if (a.name != b.name || a.unit != b.unit) return false;
      const auto most = largest_.find(first.source + "." + first.event + "." + a.name);
      const double allowed = allowances_.of_value(first.source, first.event, a.name, a.unit,
                                                  most == largest_.end() ? 0 : most->second);
      if (a.number != b.number && !(std::abs(a.number - b.number) <= allowed)) return false;
    }
    return true;
  }

 private:
  const Allowances& allowances_;
  std::map<std::string, double> largest_;
  double time_;
};

}  // namespace

std::vector<CheckRow> compare_checks(const std::vector<ComparedRun>& runs, const Allowances& allowances) {
  EventOrder order;
  for (const auto& run : runs)
    for (const auto& check : run.outcome.checks) order.add(check.name);
  std::vector<CheckRow> rows;
  for (const auto& name : order.names()) {
    CheckRow row{name, {}, ""};
    for (const auto& run : runs) {
      const auto found = std::find_if(run.outcome.checks.begin(), run.outcome.checks.end(),
                                      [&](const record::CheckResult& check) { return check.name == name; });
      row.results.push_back(found == run.outcome.checks.end() ? std::nullopt : std::optional(*found));
    }
    row.change = change_of(row, runs, allowances);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<EventRow> differing_events(const std::vector<ComparedRun>& runs, const Allowances& allowances,
                                       std::size_t& all) {
  struct Seen {
    EventRow row;
    record::RecordedEvent first;  ///< of the runs, as the first that has it
    std::size_t runs = 0;         ///< that have it
    bool kept = true;
  };
  const EventJudge judge(runs.front(), allowances);
  std::map<std::string, std::size_t> place;
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::map<std::string, int> count;
    for (const auto& event : runs[i].recording.events()) {
      const auto kind = event.source + "." + event.event;
      const auto name = fmt::format("{} {}", kind, ++count[kind]);
      const auto [found, fresh] = place.emplace(name, seen.size());
      if (fresh) seen.push_back({{name, std::vector<std::optional<std::string>>(runs.size())}, event});
      auto& one = seen[found->second];
      one.row.told[i] = event_text(event);
      ++one.runs;
      one.kept = one.kept && judge.keeps(one.first, event);
    }
  }
  all = seen.size();
  std::vector<EventRow> rows;
  for (auto& one : seen)
    if (!one.kept || one.runs < runs.size()) rows.push_back(std::move(one.row));
  return rows;
}

std::vector<ParameterRow> differing_parameters(const std::vector<ComparedRun>& runs) {
  EventOrder order;
  std::vector<std::map<std::string, std::string>> values;
  for (const auto& run : runs) {
    values.emplace_back(run.parameters.begin(), run.parameters.end());
    for (const auto& [path, value] : run.parameters) order.add(path);
  }
  std::vector<ParameterRow> rows;
  for (const auto& path : order.names()) {
    ParameterRow row{path, {}};
    for (const auto& own : values) {
      const auto found = own.find(path);
      row.values.push_back(found == own.end() ? std::nullopt : std::optional(found->second));
    }
    if (!all_same(row.values, std::equal_to<>())) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace drycut::sim::studies
