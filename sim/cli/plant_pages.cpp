// `drycut plants`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>

#include "base/json.hpp"
#include "plants/plant.hpp"
#include "sim/cli/pages.hpp"
#include "sim/scenario/parameter_text.hpp"
#include "sim/scenario/specimens.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::cli {

namespace {

/// Something that a plant of the type offers, and with which drives if not with all of them.
template <typename Item>
struct Offered {
  Item item;
  std::vector<std::string> drives;
};

/// What the specimens of a type offer. A drive brings plugs, channels and faults of its own.
class Specimens {
 public:
  explicit Specimens(const plants::PlantType& type) : specimens_(scenario::specimens_of(type)) {}

  [[nodiscard]] plants::Parameters parameters() const {
    return specimens_.front()->definition().parameters();
  }

  /// What the specimens offer by `list`, each once: those whose `same` is equal are one.
  template <typename Item, typename Same>
  std::vector<Offered<Item>> offered(std::vector<Item> (plants::Plant::*list)(), Same same) const {
    std::vector<Offered<Item>> all;
    for (std::size_t i = 0; i < specimens_.size(); ++i) {
      for (auto& item : (specimens_[i]->plant().*list)()) {
        auto known =
            std::find_if(all.begin(), all.end(), [&](const auto& o) { return same(o.item) == same(item); });
        if (known == all.end()) known = all.insert(all.end(), {std::move(item), {}});
        known->drives.push_back(specimens_[i]->drive());
      }
    }
    for (auto& one : all)
      if (one.drives.size() == specimens_.size()) one.drives.clear();
    return all;
  }

 private:
  std::vector<std::unique_ptr<scenario::Specimen>> specimens_;
};

/// In text with the drives that have it: "runs forward (drive: inverter, contactors)".
template <typename Item>
Sheet::Cell meaning_cell(const Offered<Item>& offered) {
  std::string text(offered.item.meaning);
  if (!offered.drives.empty()) text += fmt::format(" (drive: {})", fmt::join(offered.drives, ", "));
  return {offered.item.meaning, text};
}

/// Absent where all drives have it.
template <typename Item>
Sheet::Cell drives_cell(const Offered<Item>& offered) {
  return offered.drives.empty() ? Sheet::Cell(nullptr) : Sheet::Cell(offered.drives);
}

std::string_view plug_text(const plants::Port& port) {
  constexpr std::string_view names[] = {"encoder (to a counter)", "signal (to an input or interrupt line)",
                                        "command (from an output)", "reference (from an analogue output)",
                                        "pulse train (from a pulse output)"};
  return names[port.plug.index()];
}

std::string range_text(const plants::Range& range) {
  return fmt::format("{:.12g} {} {:.12g}", range.min, range.whole && range.max == 1 ? "or" : "to", range.max);
}
std::string range_text(const plants::Parameter& parameter) {
  if (!parameter.choices.empty()) return fmt::format("{}", fmt::join(parameter.choices, " | "));
  if (!parameter.reference.empty()) return fmt::format("name of a {}", parameter.reference);
  if (std::holds_alternative<bool*>(parameter.value)) return "true | false";
  if (std::holds_alternative<std::string*>(parameter.value)) return "";
  return fmt::format("{:g}..{:g}", parameter.min, parameter.max);
}

/// The value that `drycut faults` tries, in its unit; "" = it alone does nothing.
std::string strong_text(const plants::Fault& fault) {
  if (fault.strong == 0) return "";
  return fmt::format("{:.12g}", scenario::from_si(fault.strong, fault.unit));
}

/// In text "length [mm], force [N]".
Sheet::Cell values_cell(const plants::EventType& event) {
  Sheet::Cell cell(Json::array(), "");
  for (const auto& [name, unit] : event.values) {
    cell.value.push_back({{"name", name}, {"unit", unit}});
    cell.text += fmt::format("{}{}{}", cell.text.empty() ? "" : ", ", name,
                             unit.empty() ? "" : fmt::format(" [{}]", unit));
  }
  return cell;
}

/// "600 x 75 x 40 mm" of the part with the default parameters.
std::string part_size(const plants::Part& part) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", part.size[0] * 1e3, part.size[1] * 1e3,
                     part.size[2] * 1e3);
}

/// "blade 3": what is before the number; the number, 0 = none.
std::pair<std::string, int> stem_of(const std::string& name) {
  const auto space = name.find_last_not_of("0123456789");
  if (space == std::string::npos || space + 1 == name.size() || name[space] != ' ') return {name, 0};
  return {name.substr(0, space), std::stoi(name.substr(space + 1))};
}

/// In text parts that differ only in their number share a row: "piece 1..24".
Sheet parts_of(const Specimens& specimens) {
  Sheet sheet("parts", "Parts, for pictures.meshes, from their middle",
              {"name=part", "size=size x y z", "drives="});
  const auto parts = specimens.offered(&plants::Plant::parts, [](const auto& p) { return p.name; });
  for (std::size_t i = 0, next = 0; i < parts.size(); i = next) {
    const auto& first = parts[i].item;
    const auto named = stem_of(first.name);
    int last = named.second;
    const auto follows = [&](const plants::Part& part) {
      return last > 0 && part.size == first.size && stem_of(part.name) == std::pair(named.first, last + 1);
    };
    for (next = i + 1; next < parts.size() && follows(parts[next].item); ++next) ++last;
    const auto size = part_size(first);
    sheet.add({{first.name, next > i + 1 ? fmt::format("{}..{}", first.name, last) : first.name},
               size,
               drives_cell(parts[i])});
    for (++i; i < next; ++i) sheet.add({{parts[i].item.name, ""}, {size, ""}, drives_cell(parts[i])});
  }
  return sheet;
}

/// What the choices of a parameter stand for: a row a value.
Sheet presets_of(const plants::Parameter& chooser, const plants::Parameters& parameters) {
  Sheet sheet("presets", fmt::format("What {} stands for", chooser.name),
              {"name=" + chooser.name, "parameter", "value", "meaning", "source=from"});
  for (const auto& preset : *chooser.presets)
    for (const auto& value : preset.values) {
      auto shown = *std::ranges::find(parameters, value.parameter, &plants::Parameter::name);
      double si = value.value;
      shown.value = &si;
      sheet.add({preset.name, value.parameter,
                 value.of.empty() ? scenario::value_text(shown)
                                  : fmt::format("{:g} % of {}", 100 * value.value, value.of),
                 preset.meaning, value.source});
    }
  return sheet;
}

Page plant_page(const plants::PlantType& type) {
  const auto name = [](const auto& item) { return item.name; };
  const auto name_and_unit = [](const auto& item) { return std::pair(item.name, item.unit); };
  const Specimens specimens(type);
  Sheet parameters("parameters", "Parameters",
                   {"name=parameter", "default", "unit=", "range", "live", "meaning", "source=from"});
  for (const auto& p : specimens.parameters()) {
    const auto range = range_text(p);
    const bool in_unit = !p.unit.empty() && !range.empty();
    parameters.add({p.name,
                    scenario::value_text(p),
                    p.unit,
                    {range, in_unit ? fmt::format("{} {}", range, p.unit) : range},
                    {p.live, p.live ? "live" : ""},
                    p.meaning,
                    p.source});
  }
  Sheet ports("ports", "Plugs, for wiring", {"name=plug", "kind", "meaning", "drives="});
  for (const auto& o : specimens.offered(
           &plants::Plant::ports, [](const auto& port) { return std::pair(port.name, port.plug.index()); }))
    ports.add({o.item.name, plug_text(o.item), meaning_cell(o), drives_cell(o)});
  Sheet channels("channels", "Channels, for record, checks and plots",
                 {"name=channel", "unit", "meaning", "drives="});
  for (const auto& o : specimens.offered(&plants::Plant::channels, name_and_unit))
    channels.add({o.item.name, o.item.unit, meaning_cell(o), drives_cell(o)});
  Sheet settings("settings", "Settings, for the timeline",
                 {"name=setting", "unit", "range", "meaning", "drives="});
  for (const auto& o : specimens.offered(&plants::Plant::settings, name_and_unit))
    settings.add({o.item.name, o.item.unit, range_text(o.item.range), meaning_cell(o), drives_cell(o)});
  Sheet faults("faults", "Faults, for the timeline",
               {"component", "name=fault", "unit", "range", "strong", "meaning", "drives="});
  for (const auto& o : specimens.offered(
           &plants::Plant::faults, [](const auto& f) { return std::tuple(f.component, f.name, f.unit); }))
    faults.add({o.item.component, o.item.name, o.item.unit, range_text(o.item.range), strong_text(o.item),
                meaning_cell(o), drives_cell(o)});
  Sheet events("events", "Events, for checks", {"name=event", "values", "severity", "meaning", "drives="});
  for (const auto& o : specimens.offered(&plants::Plant::event_types, name))
    events.add({o.item.name, values_cell(o.item), name_of(o.item.severity), meaning_cell(o), drives_cell(o)});
  std::vector<Sheet> sheets = {parameters};
  const auto table = specimens.parameters();
  for (const auto& row : table)
    if (row.presets != nullptr) sheets.push_back(presets_of(row, table));
  for (auto& sheet : {ports, channels, settings, faults, events, parts_of(specimens)})
    sheets.push_back(sheet);
  return {std::string(type.name), std::string(type.summary), "", sheets};
}

}  // namespace

std::vector<Page> plant_pages() {
  std::vector<Page> pages;
  for (const auto& type : plants::plant_types()) pages.push_back(plant_page(type));
  return pages;
}

}  // namespace drycut::sim::cli
