// `drycut plants --units`.
#include <fmt/format.h>

#include <cctype>
#include <string>
#include <vector>

#include "sim/cli/commands.hpp"
#include "sim/cli/pages.hpp"
#include "sim/scenario/unit_groups.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::cli {

namespace {

Sheet sheet_of(const scenario::UnitGroup& group) {
  const auto si = group.units.front();
  auto title = std::string(group.quantity);
  title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
  if (!group.remark.empty()) title += fmt::format(" ({})", group.remark);
  Sheet sheet(std::string(group.quantity), title,
              {"unit", si == "%" ? "value" : fmt::format("in_si=in {}", si)});
  for (const auto& unit : group.units) {
    const double one = scenario::to_si(1, unit);
    const double from = scenario::to_si(0, unit);
    const double number = si == "%" ? one : scenario::from_si(one, si);
    sheet.add({std::string(unit),
               {number, from == 0 ? fmt::format("{:.9g}", number)
                                  : fmt::format("{:.9g} (0 is {:.9g})", number, from)}});
  }
  return sheet;
}

}  // namespace

std::vector<Sheet> unit_tables() {
  std::vector<Sheet> sheets;
  for (const auto& group : scenario::unit_groups()) sheets.push_back(sheet_of(group));
  return sheets;
}

int list_units(const std::string& quantity, bool json) {
  std::vector<Page> pages;
  for (const auto& group : scenario::unit_groups()) {
    std::string units;
    for (const auto& unit : group.units) units += (units.empty() ? "" : ", ") + std::string(unit);
    pages.push_back({std::string(group.quantity), std::move(units), "", {sheet_of(group)}});
  }
  return show({"drycut plants --units", "quantity"}, pages, quantity, json, unit_tables());
}

}  // namespace drycut::sim::cli
