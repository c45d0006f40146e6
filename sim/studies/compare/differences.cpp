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
class Order {
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

/// What rounding leaves of a margin that did not change [its unit].
constexpr double margin_noise = 1e-8;

bool same_margin(const loop::CheckResult& a, const loop::CheckResult& b) {
  if (!a.margin || !b.margin) return a.margin.has_value() == b.margin.has_value();
  return *a.margin == *b.margin || std::abs(*a.margin - *b.margin) <= margin_noise;
}

std::string change_of(const CheckRow& row, const std::vector<RunFolder>& runs) {
  std::vector<std::string> having;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (row.results[i]) having.push_back(runs[i].label);
  if (having.size() < runs.size()) return fmt::format("only in {}", fmt::join(having, ", "));
  const auto same = [&](auto field) {
    return all_same(row.results, [&](const loop::CheckResult& a, const loop::CheckResult& b) {
      return field(a) == field(b);
    });
  };
  if (!same([](const loop::CheckResult& c) { return c.passed; })) return "verdict";
  if (!same([](const loop::CheckResult& c) { return c.expectation; })) return "expectation";
  if (all_same(row.results, same_margin)) return "";
  const auto& first = *row.results[0];
  const auto& last = *row.results[1];
  if (runs.size() != 2 || !first.margin || !last.margin) return "margin";
  return fmt::format("margin {:+.4g}{}{}", *last.margin - *first.margin, first.unit.empty() ? "" : " ",
                     first.unit);
}

std::string event_text(const loop::RecordedEvent& event) {
  const auto values = loop::values_text(event);
  return fmt::format("{:.6f} s{}{}", event.at_seconds(), values.empty() ? "" : ": ", values);
}

}  // namespace

std::vector<CheckRow> compare_checks(const std::vector<RunFolder>& runs) {
  Order order;
  for (const auto& run : runs)
    for (const auto& check : run.checks) order.add(check.name);
  std::vector<CheckRow> rows;
  for (const auto& name : order.names()) {
    CheckRow row{name, {}, ""};
    for (const auto& run : runs) {
      const auto found = std::find_if(run.checks.begin(), run.checks.end(),
                                      [&](const loop::CheckResult& check) { return check.name == name; });
      row.results.push_back(found == run.checks.end() ? std::nullopt : std::optional(*found));
    }
    row.change = change_of(row, runs);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<EventRow> differing_events(const std::vector<RunFolder>& runs, std::size_t& all) {
  std::map<std::string, std::size_t> place;
  std::vector<EventRow> rows;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::map<std::string, int> count;
    for (const auto& event : runs[i].recording.events()) {
      const auto kind = event.source + "." + event.event;
      const auto name = fmt::format("{} {}", kind, ++count[kind]);
      const auto [found, fresh] = place.emplace(name, rows.size());
      if (fresh) rows.push_back({name, std::vector<std::optional<std::string>>(runs.size())});
      rows[found->second].told[i] = event_text(event);
    }
  }
  all = rows.size();
  std::erase_if(rows, [](const EventRow& row) { return all_same(row.told, std::equal_to<>()); });
  return rows;
}

std::vector<ParameterRow> differing_parameters(const std::vector<RunFolder>& runs) {
  Order order;
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
