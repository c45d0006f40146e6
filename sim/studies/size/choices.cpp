#include "sim/studies/size/choices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "base/text.hpp"
#include "plants/efficiency.hpp"
#include "plants/plant.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

namespace {

/// The parameter itself, while `parameters` live.
const plants::Parameter* row_in(const plants::Parameters& parameters, std::string_view name) {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&](const auto& row) { return row.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

std::vector<std::string> split_items(const std::string& text, std::vector<std::size_t>& columns) {
  std::vector<std::string> items;
  for (std::size_t at = 0; at <= text.size(); ++at) {
    const auto comma = std::min(text.find(',', at), text.size());
    columns.push_back(at + 1);
    items.emplace_back(trimmed(std::string_view(text).substr(at, comma - at)));
    at = comma;
  }
  return items;
}

std::string types_with_motors() {
  std::vector<std::string> names;
  for (const auto& type : plants::plant_types()) {
    const auto definition = type.define();
    const auto parameters = definition->parameters();
    if (std::any_of(parameters.begin(), parameters.end(),
                    [](const auto& row) { return !scenario::motor_kind(row.name).empty(); }))
      names.emplace_back(type.name);
  }
  return fmt::format("plants of type {} have one", fmt::join(names, ", "));
}

/// The drives of the scenario whose motor the catalogue has.
std::vector<SizedDrive> drives_of(const scenario::Scenario& scenario) {
  std::vector<SizedDrive> drives;
  Problems told;  // by prepare()
  loop::Simulation simulation(scenario, told);
  for (const auto& [name, plant] : simulation.plants()) {
    for (const auto& drive : plant->drives()) {
      const auto kind = scenario::motor_kinds[drive.name == "servo" ? 0 : 1];
      const SizedDrive sized{name, drive.name, std::string(kind)};
      const auto parameters = plant_of(sized, scenario).definition->parameters();
      const bool has_own = drive.name == "servo" || drive.name == "drive";
      if (has_own && row_in(parameters, sized.kind + ".model") != nullptr) drives.push_back(sized);
    }
  }
  return drives;
}

std::optional<SizedDrive> read_drive(const std::string& text, const scenario::Scenario& scenario,
                                     Problems& problems) {
  const auto drives = drives_of(scenario);
  std::vector<std::string> names;
  names.reserve(drives.size());
  for (const auto& drive : drives) names.push_back(drive.full_name());
  for (const auto& drive : drives)
    if (drive.full_name() == text || (text.empty() && drives.size() == 1)) return drive;
  constexpr auto* option = "--drive";
  if (drives.empty())
    problems.push_back({"study.unknown-name"_code, option, 1, 1,
                        "no drive of the scenario has a motor of the catalogue", types_with_motors()});
  else if (text.empty())
    problems.push_back({"option.missing"_code, option, 1, 1,
                        fmt::format("the scenario has {} drives", drives.size()),
                        fmt::format("name one: {}", fmt::join(names, ", "))});
  else
    problems.push_back({"study.unknown-name"_code, option, 1, 1, fmt::format("there is no drive '{}'", text),
                        did_you_mean(text, names)});
  return {};
}

/// Motors that contactors connect by turns are alike: one of them is not sized alone.
void check_shared(const SizedDrive& drive, const scenario::Scenario& scenario, Problems& problems) {
  for (const auto& plant : scenario.plants)
    if (word_in(plant, "drive") == "shared" && word_in(plant, "shared.drive") == drive.plant)
      problems.push_back(
          {"option.does-not-apply"_code, "--drive", 1, 1,
           fmt::format("{} drives the motor of {} by turns", drive.full_name(), plant.name.text),
           "motors on one drive are alike: size them with a scenario of each"});
}

/// What the scenario gives beside the model would go with each motor.
void check_motor_values(const SizedDrive& drive, const std::vector<scenario::MotorModel>& motors,
                        const scenario::Scenario& scenario, Problems& problems) {
  for (const auto& [parameter, place] : plant_of(drive, scenario).places) {
    const auto prefix = drive.kind + ".";
    if (!parameter.starts_with(prefix)) continue;
    const auto name = std::string_view(parameter).substr(prefix.size());
    if (name.starts_with("supply.")) continue;  // the machine's mains, whatever motor is on them
    if (std::any_of(motors.begin(), motors.end(),
                    [&](const auto& motor) { return motor.find(name) != nullptr; }))
      problems.push_back(scenario::problem_at(
          "option.does-not-apply"_code, scenario, place,
          fmt::format("{} is given: every motor that is tried would keep it", drive.path(parameter)),
          fmt::format("leave it out; {} says it", drive.path(prefix + "model"))));
  }
}

std::vector<scenario::MotorModel> read_motors_of(const std::string& text, const SizedDrive& drive,
                                                 const PointQuestion& question, Problems& problems) {
  scenario::Findings findings({question.file.string()});
  auto motors = scenario::read_motors(question.file.parent_path(), findings);
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  std::erase_if(motors, [&](const auto& motor) { return motor.kind != drive.kind; });
  std::vector<std::string> names;
  names.reserve(motors.size());
  for (const auto& motor : motors) names.push_back(motor.name.text);
  std::vector<bool> chosen(motors.size(), false);
  std::vector<std::size_t> columns;
  const auto items = split_items(text, columns);
  for (std::size_t i = 0; i < items.size(); ++i) {
    bool any = false;
    for (std::size_t k = 0; k < motors.size(); ++k) {
      const bool fits =
          items[i] == "all" || fnmatch(items[i].c_str(), names[k].c_str(), 0) == 0 ||
          (!motors[k].formerly.empty() && fnmatch(items[i].c_str(), motors[k].formerly.c_str(), 0) == 0);
      chosen[k] = chosen[k] || fits;
      any = any || fits;
    }
    if (any) continue;
    const auto near = nearest(items[i], names);
    problems.push_back(
        {"study.unknown-name"_code, "--motors", 1, static_cast<int>(columns[i]),
         items[i].empty() ? "a motor without a name"
                          : fmt::format("there is no motor '{}' for {}", items[i], drive.full_name()),
         near.empty() ? "all, NAME or a pattern such as 'HG-SR*'; drycut plants --motors lists them"
                      : fmt::format("did you mean {}?", near)});
  }
  std::vector<scenario::MotorModel> taken;
  for (std::size_t k = 0; k < motors.size(); ++k)
    if (chosen[k]) taken.push_back(std::move(motors[k]));
  return taken;
}

/// Kinds that stand behind ratios, "5 planetary, 20 worm", "3..8:6 planetary", and the text without them; its
/// columns stay as they are.
std::vector<std::string> take_kinds(std::string& text, Problems& problems) {
  std::vector<std::string> kinds;
  std::vector<std::size_t> columns;
  std::vector<std::string> known;
  for (const auto& kind : plants::gear_types()) known.emplace_back(kind.name);
  const auto items = split_items(text, columns);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto space = items[i].find(' ');
    kinds.push_back(space == std::string::npos ? "" : std::string(trimmed(items[i].substr(space))));
    if (kinds.back().empty()) continue;
    const auto begin = text.find(kinds.back(), columns[i] - 1);
    if (std::ranges::find(known, kinds.back()) == known.end())
      problems.push_back(
          {"study.argument"_code, "--gears", 1, static_cast<int>(begin) + 1,
           fmt::format("'{}' is no kind of gear", kinds.back()),
           did_you_mean(kinds.back(), known,
                        fmt::format("a ratio, or a ratio and one of: {}", fmt::join(known, ", ")))});
    text.replace(begin, kinds.back().size(), kinds.back().size(), ' ');
  }
  return kinds;
}

/// What the scenario gives beside the kind of its gear would go with each.
void check_gear_values(const SizedDrive& drive, const scenario::Scenario& scenario, Problems& problems) {
  for (const auto& [parameter, place] : plant_of(drive, scenario).places)
    if (parameter == "gear.efficiency" || parameter == "gear.back_efficiency")
      problems.push_back(scenario::problem_at(
          "option.does-not-apply"_code, scenario, place,
          fmt::format("{} is given: every gear that is tried would keep it", drive.path(parameter)),
          fmt::format("leave it out; {} says it", drive.path("gear.type"))));
}

void read_gears(std::string text, const scenario::Scenario& scenario, SizeChoices& choices,
                Problems& problems) {
  if (text.empty()) return;
  constexpr auto* option = "--gears";
  const auto& drive = choices.drive;
  const auto& plant = plant_of(drive, scenario);
  choices.gear_is_tied = text.find('=') != std::string::npos;
  if (!number_in(plant, "gear.ratio")) {
    problems.push_back(
        {"option.does-not-apply"_code, option, 1, 1,
         fmt::format("{} has no gear.ratio: plants of type {} have none", drive.plant, plant.type.text),
         "leave --gears out"});
    return;
  }
  if (!drive.is_servo() && !choices.gear_is_tied) {
    problems.push_back(
        {"option.does-not-apply"_code, option, 1, 1,
         fmt::format("the speeds of {} are its frequencies, which go with the gear", drive.full_name()),
         "tie them to a variable in the scenario and write --gears variables.gear=5,7,10"});
    return;
  }
  const auto before = problems.size();
  if (!choices.gear_is_tied) choices.gear_kinds = take_kinds(text, problems);
  if (problems.size() != before) return;
  if (choices.has_gear_kinds()) check_gear_values(drive, scenario, problems);
  const auto path = choices.gear_is_tied ? "" : drive.path("gear.ratio=");
  auto axis = parse_axis(path + text, option, false, problems);
  for (auto i = before; i < problems.size(); ++i)
    problems[i].column = std::max(1, problems[i].column - static_cast<int>(path.size()));
  if (!axis) return;
  axis->parameter.low_column = std::max(1, axis->parameter.low_column - static_cast<int>(path.size()));
  axis->parameter.high_column = std::max(1, axis->parameter.high_column - static_cast<int>(path.size()));
  choices.gears.push_back(std::move(*axis));
}

/// "13 ohm 100 W", "100 W", "100" with the unit of the last, "none".
class ResistorReader {
 public:
  ResistorReader(const std::string& text, Problems& problems) : problems_(problems) {
    items_ = split_items(text, columns_);
  }

  std::vector<BrakeResistor> run() {
    const auto last = scenario::parse_quantity(power_part(items_.back()));
    unit_ = last ? last->unit : "";
    std::vector<BrakeResistor> resistors;
    for (std::size_t i = 0; i < items_.size(); ++i)
      if (auto resistor = read(items_[i], columns_[i])) resistors.push_back(std::move(*resistor));
    return resistors;
  }

 private:
  static constexpr std::string_view ohm_ = "ohm";

  static std::string power_part(const std::string& item) {
    const auto ohm = item.find(ohm_);
    return std::string(
        trimmed(std::string_view(item).substr(ohm == std::string::npos ? 0 : ohm + ohm_.size())));
  }

  std::optional<BrakeResistor> read(const std::string& item, std::size_t column) {
    if (item == "none") return BrakeResistor{item, 0.0, {}};
    BrakeResistor resistor{item, {}, {}};
    bool good = true;
    const auto ohm = item.find(ohm_);
    if (ohm != std::string::npos) {
      const auto given = scenario::parse_quantity(trimmed(std::string_view(item).substr(0, ohm)));
      good = given && given->unit.empty() && given->number > 0;
      if (good) resistor.ohm = given->number;
    }
    const auto power = scenario::parse_quantity(power_part(item));
    const auto unit = power && !power->unit.empty() ? power->unit : unit_;
    good =
        good && power && power->number > 0 && scenario::is_unit(unit) && scenario::same_dimension(unit, "W");
    if (!good) {
      problems_.push_back({"study.argument"_code, "--resistors", 1, static_cast<int>(column),
                           fmt::format("'{}' is no brake resistor", item),
                           "such as \"100,200 W\", \"13 ohm 100 W, 6.7 ohm 3 kW\" or none"});
      return {};
    }
    if (power->unit.empty()) resistor.text += " " + unit;
    resistor.power = scenario::to_si(power->number, unit);
    return resistor;
  }

  Problems& problems_;
  std::vector<std::string> items_;
  std::vector<std::size_t> columns_;
  std::string unit_;
};

void read_resistors(const std::string& text, const scenario::Scenario& scenario, SizeChoices& choices,
                    Problems& problems) {
  if (text.empty()) return;
  const auto& drive = choices.drive;
  if (!drive.is_servo() && word_in(plant_of(drive, scenario), "drive") != "inverter") {
    problems.push_back(
        {"option.does-not-apply"_code, "--resistors", 1, 1,
         fmt::format("{} has no DC link: contactors feed back into the mains", drive.full_name()),
         "leave --resistors out"});
    return;
  }
  choices.resistors = ResistorReader(text, problems).run();
}

void read_inertia_ratio(const std::string& text, SizeChoices& choices, Problems& problems) {
  if (text.empty()) return;
  if (text == "off") {
    choices.most_inertia_ratio = std::numeric_limits<double>::infinity();
    return;
  }
  const auto ratio = scenario::parse_quantity(text);
  if (ratio && ratio->unit.empty() && ratio->number > 0)
    choices.most_inertia_ratio = ratio->number;
  else
    problems.push_back({"study.argument"_code, "--inertia-ratio", 1, 1,
                        fmt::format("'{}' is no ratio of inertias", text),
                        "load over rotor, above 0, such as 15; off: it is not judged"});
}

}  // namespace

const scenario::PlantEntry& plant_of(const SizedDrive& drive, const scenario::Scenario& scenario) {
  return *std::find_if(scenario.plants.begin(), scenario.plants.end(),
                       [&](const auto& plant) { return plant.name.text == drive.plant; });
}

std::optional<double> number_in(const scenario::PlantEntry& plant, std::string_view parameter) {
  const auto parameters = plant.definition->parameters();
  const auto* const row = row_in(parameters, parameter);
  if (row == nullptr) return {};
  if (const auto* const number = std::get_if<double*>(&row->value)) return **number;
  if (const auto* const number = std::get_if<int*>(&row->value)) return **number;
  if (const auto* const on = std::get_if<bool*>(&row->value)) return **on ? 1 : 0;
  return {};
}

std::string word_in(const scenario::PlantEntry& plant, std::string_view parameter) {
  const auto parameters = plant.definition->parameters();
  const auto* const row = row_in(parameters, parameter);
  const auto* const word = row == nullptr ? nullptr : std::get_if<std::string*>(&row->value);
  return word == nullptr ? "" : **word;
}

SizeChoices read_choices(const SizeTexts& texts, const PointQuestion& question,
                         const scenario::Scenario& scenario, Problems& problems) {
  SizeChoices choices;
  const auto drive = read_drive(texts.drive, scenario, problems);
  if (!drive) return choices;
  choices.drive = *drive;
  choices.motors = read_motors_of(texts.motors, choices.drive, question, problems);
  choices.all_motors = texts.motors == "all";
  check_shared(choices.drive, scenario, problems);
  check_motor_values(choices.drive, choices.motors, scenario, problems);
  read_gears(texts.gears, scenario, choices, problems);
  read_resistors(texts.resistors, scenario, choices, problems);
  read_inertia_ratio(texts.inertia_ratio, choices, problems);
  return choices;
}

}  // namespace drycut::sim::studies
