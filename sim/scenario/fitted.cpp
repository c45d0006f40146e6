// fitted: which values of plants were learnt from recordings, with their limits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/sections.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

/// The plant of a path and the quantity of it that the path names; none without one.
struct FittedRow {
  PlantEntry* plant = nullptr;
  plants::Parameter row;
};

std::optional<FittedRow> row_of(const FittedEntry& entry, Scenario& scenario) {
  for (auto& plant : scenario.plants) {
    const auto prefix = fmt::format("plants.{}.", plant.name.text);
    if (!entry.path.text.starts_with(prefix)) continue;
    for (const auto& row : plant.definition->parameters())
      if (std::holds_alternative<double*>(row.value) && row.name == entry.path.text.substr(prefix.size()))
        return FittedRow{&plant, row};
  }
  return {};
}

std::vector<std::string> paths_of(const Scenario& scenario) {
  std::vector<std::string> paths;
  for (const auto& plant : scenario.plants)
    for (const auto& row : plant.definition->parameters())
      if (std::holds_alternative<double*>(row.value))
        paths.push_back(fmt::format("plants.{}.{}", plant.name.text, row.name));
  return paths;
}

/// The value stands in the same file as its limits, and between them: nobody has given another one since.
bool is_in_force(const FittedEntry& entry, const FittedRow& of, double low, double high) {
  const auto given =
      std::ranges::find(of.plant->places, of.row.name, &decltype(of.plant->places)::value_type::first);
  if (given == of.plant->places.end() || given->second.source != entry.path.place.source) return false;
  const double value = *std::get<double*>(of.row.value);
  const double slack = 1e-12 * std::max(std::abs(low), std::abs(high));  // of units
  return value >= low - slack && value <= high + slack;
}

std::string origin_text(const FittedEntry& entry, const plants::Parameter& row, double low, double high) {
  const auto unit = row.unit.empty() ? "" : fmt::format(" {}", row.unit);
  return fmt::format("fitted, {:.6g} .. {:.6g}{} (95 %), {}", from_si(low, row.unit), from_si(high, row.unit),
                     unit, entry.from);
}

/// True if the entry says something of the machine as it is.
bool take(const FittedEntry& entry, Scenario& scenario, bool names_are_known, Findings& findings) {
  const auto of = row_of(entry, scenario);
  if (!of) {
    if (!names_are_known) return false;
    findings.add("scenario.unknown-name"_code, entry.path.place,
                 fmt::format("fitted: {} is no quantity of a plant", in_quotes(entry.path.text)),
                 did_you_mean(entry.path.text, paths_of(scenario),
                              "plants.PLANT.PARAMETER, as drycut plants lists them"));
    return false;
  }
  const auto name = fmt::format("fitted.{}", entry.path.text);
  const auto low = read_si(entry.low, name + ".low", of->row.unit, findings);
  const auto high = read_si(entry.high, name + ".high", of->row.unit, findings);
  if (!low || !high) return false;
  if (*low > *high) {
    findings.add("scenario.order"_code, entry.high.place, fmt::format("{}.high is below low", name),
                 "the lower limit is low");
    return false;
  }
  if (!is_in_force(entry, *of, *low, *high)) return false;
  of->plant->fitted.push_back({of->row.name, origin_text(entry, of->row, *low, *high), entry.path.place});
  return true;
}

}  // namespace

void visit(Archive& archive, FittedEntry& entry) {
  archive.in_line();
  archive.value({"low", "it lies between this limit and the other with 95 %"}, form(entry.low));
  archive.value({"high", "the upper limit"}, form(entry.high));
  archive.value({"from", "the recordings that it was learnt from"}, form(entry.from));
  archive.require("low", "write both limits: {low: 36.9 kg, high: 37.1 kg, from: move.csv}");
  archive.require("high", "write both limits: {low: 36.9 kg, high: 37.1 kg, from: move.csv}");
  archive.require("from", "name the recording: from: move.csv");
}

void take_fitted(Scenario& scenario, bool names_are_known, Findings& findings) {
  std::erase_if(scenario.fitted,
                [&](const FittedEntry& entry) { return !take(entry, scenario, names_are_known, findings); });
}

}  // namespace drycut::sim::scenario
