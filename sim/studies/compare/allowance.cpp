#include "sim/studies/compare/allowance.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "base/text.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

namespace {

constexpr auto* option = "--tolerance";
constexpr auto* time_name = "time";
/// What rounding leaves of a margin that did not change [its unit].
constexpr double margin_noise = 1e-8;

bool fits(const std::string& given, const std::string& unit) {
  if (given == unit || (given == "-" && unit.empty())) return true;
  return scenario::is_unit(given) && scenario::is_unit(unit) && scenario::same_dimension(given, unit);
}

/// 0.151 - 0.15 is 0.001, whatever doubles make of it.
constexpr double slack = 1 + 1e-9;

/// In `unit`; nothing where the allowance is in another dimension.
std::optional<double> in_unit(const Allowance& allowance, const std::string& unit, double largest) {
  if (allowance.relative) return allowance.number * largest * slack;
  if (!fits(allowance.unit, unit)) return {};
  if (allowance.unit == unit || unit.empty()) return allowance.number * slack;
  return slack * scenario::from_si(scenario::to_si(allowance.number, allowance.unit), unit);
}

/// Something that an allowance can be for.
struct ComparedQuantity {
  std::string name;
  std::string unit;
  bool operator<(const ComparedQuantity& other) const {
    return std::tie(name, unit) < std::tie(other.name, other.unit);
  }
};

std::set<ComparedQuantity> quantities_of(const ComparedRun& run) {
  std::set<ComparedQuantity> all;
  for (const auto& column : run.recording.columns()) all.insert({column.name, column.unit});
  for (const auto& event : run.recording.events()) {
    for (const auto& value : event.values) {
      all.insert({value.name, value.unit});
      all.insert({event.event + "." + value.name, value.unit});
      all.insert({event.source + "." + event.event + "." + value.name, value.unit});
    }
  }
  return all;
}

/// Its largest absolute number in the run, in that unit.
double largest_of(const ComparedRun& run, const std::string& name, const std::string& unit) {
  double largest = 0;
  if (const auto* column = run.recording.column(name); column != nullptr && column->unit == unit)
    for (const double number : column->values) largest = std::max(largest, std::abs(number));
  for (const auto& event : run.recording.events())
    for (const auto& value : event.values)
      if (value.unit == unit && (name == value.name || name == event.event + "." + value.name ||
                                 name == event.source + "." + event.event + "." + value.name))
        largest = std::max(largest, std::abs(value.number));
  return largest;
}

std::optional<Allowance> read_value(const std::string& text, std::size_t at, Problems& problems) {
  auto value = trimmed(std::string_view(text).substr(at));
  const bool percent = value.ends_with('%');
  if (percent) value.remove_suffix(1);
  const auto quantity = scenario::parse_quantity(trimmed(value));
  if (!quantity || !std::isfinite(quantity->number) || quantity->number < 0 ||
      (percent && !quantity->unit.empty())) {
    problems.push_back({"compare.tolerance"_code, option, 1, static_cast<int>(at) + 1,
                        fmt::format("{} is no tolerance", in_quotes(std::string_view(text).substr(at))),
                        "0 or more: with a unit, as 0.01mm, or of the largest value, as 0.1% or 1e-6"});
    return {};
  }
  return Allowance{"", percent ? quantity->number / 100 : quantity->number, quantity->unit,
                   quantity->unit.empty(), static_cast<int>(at) + 1};
}

}  // namespace

const Allowance* Allowances::find(const std::string& name) const {
  const auto found =
      std::find_if(named.begin(), named.end(), [&](const Allowance& one) { return one.name == name; });
  return found == named.end() ? nullptr : &*found;
}

double Allowances::of_channel(const std::string& name, const std::string& unit, double largest) const {
  const auto* own = find(name);
  const auto allowed = own == nullptr ? std::nullopt : in_unit(*own, unit, largest);
  return allowed.value_or(usual.number * largest);
}

double Allowances::of_value(const std::string& source, const std::string& event, const std::string& value,
                            const std::string& unit, double largest) const {
  for (const auto& name : {source + "." + event + "." + value, event + "." + value, value})
    if (const auto* own = find(name))
      if (const auto allowed = in_unit(*own, unit, largest)) return *allowed;
  return usual.number * largest;
}

double Allowances::of_time(double end) const { return of_channel(time_name, "s", end); }

double Allowances::of_margin(const record::CheckResult& check, const ComparedRun& first) const {
  const double margin = std::abs(check.margin.value_or(0));
  if (const auto* own = find(check.name))
    if (const auto allowed = in_unit(*own, check.unit, margin)) return *allowed;
  std::optional<double> widest;
  for (const auto& one : named) {
    if (std::ranges::find(check.names, one.name) == check.names.end()) continue;
    const auto allowed = in_unit(one, check.unit, one.relative ? largest_of(first, one.name, check.unit) : 0);
    if (allowed) widest = std::max(widest.value_or(0), *allowed);
  }
  return std::max(widest.value_or(usual.number * margin), margin_noise);
}

Allowances read_allowances(const std::vector<std::string>& texts, Problems& problems) {
  Allowances allowances;
  bool usual_given = false;
  for (const auto& text : texts) {
    const auto equals = text.rfind('=');
    const auto at = equals == std::string::npos ? 0 : equals + 1;
    auto read = read_value(text, at, problems);
    if (!read) continue;
    const auto refuse = [&](Code code, std::string what, std::string remedy) {
      problems.push_back({code, option, 1, 1, std::move(what), std::move(remedy)});
    };
    if (equals == std::string::npos) {
      if (!read->relative)
        refuse("compare.tolerance"_code, fmt::format("{} is for nothing that has a name", in_quotes(text)),
               "write NAME=VALUE, or for everything else a part of the largest value: 1e-6");
      else if (usual_given)
        refuse("study.twice"_code, "there are two tolerances without a name", "keep one");
      else
        allowances.usual = *read;
      usual_given = true;
      continue;
    }
    read->name = trimmed(std::string_view(text).substr(0, equals));
    if (read->name.empty())
      refuse("compare.tolerance"_code, fmt::format("{} names nothing", in_quotes(text)),
             "write NAME=VALUE, as length=0.01mm");
    else if (allowances.find(read->name) != nullptr)
      refuse("study.twice"_code, fmt::format("there are two tolerances of {}", read->name), "keep one");
    else
      allowances.named.push_back(std::move(*read));
  }
  return allowances;
}

void check_allowances(const Allowances& allowances, const std::vector<ComparedRun>& runs,
                      const std::vector<std::pair<std::string, std::string>>& figures, Problems& problems) {
  std::set<ComparedQuantity> known = {{time_name, "s"}};
  for (const auto& run : runs) {
    known.merge(quantities_of(run));
    for (const auto& check : run.outcome.checks) known.insert({check.name, check.unit});
  }
  for (const auto& [name, unit] : figures) known.insert({name, unit});
  std::vector<std::string> names;
  for (const auto& quantity : known)
    if (names.empty() || names.back() != quantity.name) names.push_back(quantity.name);
  for (const auto& one : allowances.named) {
    std::vector<std::string> units;
    bool good = false;
    for (const auto& quantity : known) {
      if (quantity.name != one.name) continue;
      units.push_back(quantity.unit.empty() ? "a pure number" : "in " + quantity.unit);
      good = good || one.relative || fits(one.unit, quantity.unit);
    }
    if (units.empty())
      problems.push_back({"compare.unknown-name"_code, option, 1, 1,
                          fmt::format("there is no {} in these runs", in_quotes(one.name)),
                          did_you_mean(one.name, names)});
    else if (!good)
      problems.push_back({"study.wrong-unit"_code, option, 1, one.column,
                          fmt::format("{} is {}, not in {}", one.name, fmt::join(units, " or "), one.unit),
                          "give it in that unit, or as a part of the largest value: 0.1%"});
  }
}

}  // namespace drycut::sim::studies
