#include "sim/scenario/motor_catalogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/text.hpp"
#include "plants/induction_motor.hpp"
#include "plants/servo_drive.hpp"
#include "renders/embedded.hpp"
#include "sim/file.hpp"
#include "sim/scenario/forms.hpp"
#include "sim/scenario/parameter_text.hpp"
#include "sim/scenario/units.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim::scenario {

namespace {

constexpr std::uintmax_t largest_series = std::uintmax_t{1} << 20U;  // [bytes]

// What every motor says, where its group has the parameter: else it would be another motor's.
constexpr std::string_view required[] = {
    "rotor_inertia",         "rated_torque",      "rated_speed",       "peak_torque",
    "torque_at_max_speed",   "max_speed",         "rated_frequency",   "synchronous_speed",
    "pullout_torque",        "stall_torque",      "torque_constant",   "winding_resistance",
    "winding_time_constant", "amplifier_current", "overload_time",     "amplifier_peak_current",
    "housing_time_constant", "temperature_rise",  "temperature_limit", "stator_resistance",
    "rated_current",         "no_load_current"};

// A group's table, to try values on, and the name plate's power.
struct Scratch {
  plants::ServoData servo;
  plants::InductionMotorData induction_motor;
  double rated_power = 0;  // [W]
  plants::Parameters rows;

  explicit Scratch(std::string_view kind) {
    rows = kind == motor_kinds[0] ? servo_parameters(servo) : induction_motor_parameters(induction_motor);
    rows.push_back(plants::row("rated_power", "kW", "power of the name plate", rated_power, 1e-3, 1e4, ""));
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] const plants::Parameter* find(std::string_view name) const {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name; });
    return found == rows.end() ? nullptr : &*found;
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const auto& row : rows) names.push_back(row.name);
    return names;
  }
};

// Reads one file.
class SeriesReader : public MapReader {
 public:
  SeriesReader(const YamlNode& root, Findings& findings) : MapReader(root, "", findings) {}

  std::vector<MotorModel> run() {
    value({"vendor", ""}, form(vendor_));
    value({"series", ""}, form(series_));
    const std::vector<std::string> kinds(std::begin(motor_kinds), std::end(motor_kinds));
    std::size_t kind = kinds.size();
    value({"kind", ""}, choice_form(kinds, kind));
    demand("vendor", "for example vendor: Mitsubishi Electric");
    demand("series", "for example series: HG-SR");
    demand("kind", fmt::format("write kind: {}", fmt::join(kinds, " or kind: ")));
    demand("motors", "write motors: {HG-SR202: {rated_torque: {value: 9.55 N m, from: sheet}, ...}}");
    const auto* const sources = of_kind("sources", YamlNode::Kind::map);
    const auto* const common = of_kind("common", YamlNode::Kind::map);
    const auto* const motors = of_kind("motors", YamlNode::Kind::map);
    finish();
    if (kind == kinds.size()) return {};  // what the values are is not known
    kind_ = kinds[kind];
    if (sources != nullptr) read_sources(*sources);
    if (common != nullptr) common_ = read_values(*common, "common");
    if (motors != nullptr) {
      refuse_duplicates(*motors, "motors", findings());
      for (const auto& entry : motors->entries)
        if (!entry.is_repeated()) read_motor(entry);
    }
    return std::move(motors_);
  }

 private:
  void demand(std::string_view key, const std::string& remedy) {
    if (!has(key)) missing(key, remedy);
  }

  static bool says_source(const std::string& text) {
    return text.starts_with("sheet: ") || text.starts_with("estimate: ");
  }

  void refuse_source(const Text& text, const std::string& name, const std::vector<std::string>& words) {
    const auto near = nearest(text.text, words);
    findings().add(text.place, fmt::format("{} says neither which sheet nor why an estimate", name),
                   near.empty() ? R"(write "sheet: ..." or "estimate: ...", or a word of sources)"
                                : fmt::format("did you mean {}?", near));
  }

  void read_sources(const YamlNode& map) {
    refuse_duplicates(map, "sources", findings());
    for (const auto& entry : map.entries) {
      const auto name = "sources." + entry.key.text;
      if (entry.value.kind != YamlNode::Kind::scalar)
        refuse_kind(entry.value, name, YamlNode::Kind::scalar, findings());
      else if (!says_source(entry.value.text.text))
        refuse_source(entry.value.text, name, {});
      sources_.emplace_back(entry.key.text, entry.value.text.text);
    }
  }

  // "sheet: ...", said or by a word of `sources`; "" after a problem.
  std::string source(const Text& from, const std::string& name) {
    std::vector<std::string> words;
    for (const auto& [word, text] : sources_) {
      if (word == from.text) return text;
      words.push_back(word);
    }
    if (says_source(from.text)) return from.text;
    refuse_source(from, name, words);
    return "";
  }

  // The values of a map, those that are wrong left out.
  std::vector<MotorModel::Value> read_values(const YamlNode& map, const std::string& name) {
    std::vector<MotorModel::Value> values;
    Scratch scratch(kind_);  // takes the values
    refuse_duplicates(map, name, findings());
    for (const auto& entry : map.entries) {
      if (entry.is_repeated()) continue;
      const auto full = fmt::format("{}.{}", name, entry.key.text);
      const auto* const row = scratch.find(entry.key.text);
      if (row == nullptr) {
        findings().add(entry.key.place, fmt::format("unknown key '{}' in {}", entry.key.text, name),
                       did_you_mean(entry.key.text, scratch.names()));
        continue;
      }
      const auto before = findings().count();
      MapReader reader(entry.value, full, findings());
      MotorModel::Value value{row->name, {}, "", ""};
      Text from;
      reader.value({"value", ""}, form(value.text));
      reader.value({"from", ""}, form(from));
      const auto example = fmt::format("write value: 1 {}", row->unit);
      reader.require("value", example);
      reader.require("from", R"(write from: "sheet: ..." or from: "estimate: ...")");
      reader.finish();
      if (findings().count() != before) continue;
      value.from = source(from, full + ".from");
      form(*row).read(YamlNode(YamlNode::Kind::scalar, value.text), {full, entry.key.place}, findings());
      value.shown = value_text(*row);
      if (findings().count() == before) values.push_back(std::move(value));
    }
    return values;
  }

  void read_motor(const YamlNode::Entry& entry) {
    const auto before = findings().count();
    const auto name = "motors." + entry.key.text;
    if (entry.value.kind != YamlNode::Kind::map)
      return refuse_kind(entry.value, name, YamlNode::Kind::map, findings());
    if (entry.key.text.empty() || entry.key.text == plants::no_model)
      findings().add(entry.key.place, fmt::format("'{}' cannot name a motor", entry.key.text),
                     "write what is on its name plate");
    MotorModel motor{entry.key, kind_, vendor_, series_, {}};
    const auto own = read_values(entry.value, name);
    const Scratch scratch(kind_);
    for (const auto& row : scratch.rows) {
      for (const auto* values : {&own, &std::as_const(common_)}) {
        const auto given = std::find_if(values->begin(), values->end(),
                                        [&](const auto& value) { return value.parameter == row.name; });
        if (given == values->end()) continue;
        motor.values.push_back(*given);
        break;
      }
    }
    if (findings().count() == before) judge_motor(motor, name, scratch);
    motors_.push_back(std::move(motor));
  }

  void judge_motor(const MotorModel& motor, const std::string& name, const Scratch& scratch) {
    for (const auto& key : required) {
      if (scratch.find(key) == nullptr || motor.find(key) != nullptr || is_wrong_in_common(key)) continue;
      findings().add(motor.name.place, fmt::format("{}.{} is missing", name, key),
                     "left out it would be that of the motor that is the default");
    }
    const auto* const power = motor.find("rated_power");
    const auto* const torque = motor.find("rated_torque");
    const auto* const speed = motor.find("rated_speed");
    if (power == nullptr || torque == nullptr || speed == nullptr) return;
    const double given = si(*power);
    const double made = si(*torque) * si(*speed);
    if (std::abs(made - given) > 0.03 * given)
      findings().add(power->text.place,
                     fmt::format("{}.rated_power is {}, but rated torque at rated speed gives {:.3g} kW",
                                 name, power->text.text, made / 1e3),
                     "within 3 % of each other");
  }

  // It is told once, where it stands.
  bool is_wrong_in_common(std::string_view key) {
    const auto* const map = find("common");
    return map != nullptr && child(map->value, key) != nullptr;
  }

  static double si(const MotorModel::Value& value) {
    const auto quantity = parse_quantity(value.text.text);
    return quantity ? to_si(quantity->number, quantity->unit) : 0;
  }

  std::string vendor_;
  std::string series_;
  std::string kind_;
  std::vector<std::pair<std::string, std::string>> sources_;
  std::vector<MotorModel::Value> common_;
  std::vector<MotorModel> motors_;
};

// The motors of one text. A name that is taken is a problem, or left out if `is_spare`.
void read_series(std::string_view text, int source, bool is_spare, std::vector<MotorModel>& motors,
                 Findings& findings) {
  const auto before = findings.count();
  const auto root = parse_yaml(text, source, findings);
  if (findings.count() != before) return;
  if (root.kind != YamlNode::Kind::map) {
    auto node = root;
    if (node.kind == YamlNode::Kind::null) node.text.place = {1, 1, source};
    return refuse_kind(node, "a series of motors", YamlNode::Kind::map, findings);
  }
  for (auto& motor : SeriesReader(root, findings).run()) {
    const auto taken = std::find_if(motors.begin(), motors.end(), [&](const auto& other) {
      return other.name.text == motor.name.text && other.kind == motor.kind;
    });
    if (taken == motors.end()) {
      motors.push_back(std::move(motor));
    } else if (!is_spare) {
      const auto& other = taken->name.place;
      findings.add(motor.name.place, fmt::format("there are two motors named '{}'", motor.name.text),
                   fmt::format("rename one; the first is in {}:{}",
                               findings.sources().at(static_cast<std::size_t>(other.source)), other.line));
    }
  }
}

void read_own(const std::filesystem::path& folder, std::vector<MotorModel>& motors, Findings& findings) {
  for (const auto& file : files_in(folder / "catalogue", ".yaml")) {
    const int source = findings.add_source(file.string());
    Problems problems;
    const auto text = read_file(file, problems, largest_series);
    for (auto& problem : problems)
      findings.add({problem.line, problem.column, source}, problem.what, problem.remedy);
    if (text) read_series(*text, source, false, motors, findings);
  }
}

void read_shipped(std::vector<MotorModel>& motors, Findings& findings) {
  auto names = renders::embedded_names();
  std::erase_if(names, [](std::string_view name) { return !name.starts_with("catalogue/"); });
  std::sort(names.begin(), names.end());
  for (const auto& name : names) {
    const int source = findings.add_source(fmt::format("scenes/{}", name));
    read_series(renders::embedded_file(name), source, true, motors, findings);
  }
}

}  // namespace

const MotorModel::Value* MotorModel::find(std::string_view parameter) const {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const auto& value) { return value.parameter == parameter; });
  return found == values.end() ? nullptr : &*found;
}

std::vector<MotorModel> read_motors(const std::filesystem::path& folder, Findings& findings) {
  std::vector<MotorModel> motors;
  read_own(folder, motors, findings);
  read_shipped(motors, findings);
  return motors;
}

std::vector<MotorModel> shipped_motors() {
  Findings findings({});
  std::vector<MotorModel> motors;
  read_shipped(motors, findings);
  return motors;
}

const MotorModel* MotorCatalogue::find(std::string_view kind, const Text& name, const std::string& full) {
  if (!motors_) {
    const auto before = findings_.count();
    motors_ = read_motors(folder_, findings_);
    is_sound_ = findings_.count() == before;
  }
  std::vector<std::string> known;
  for (const auto& motor : *motors_) {
    if (motor.kind == kind && motor.name.text == name.text) return &motor;
    if (motor.kind == kind) known.push_back(motor.name.text);
  }
  // It may be in a file that cannot be read.
  if (!is_sound_) return nullptr;
  const auto near = nearest(name.text, known);
  findings_.add(name.place, fmt::format("{}: there is no motor '{}'", full, name.text),
                near.empty()
                    ? "'drycut plants --motors' lists them; your own are in catalogue/ beside the scenario"
                    : fmt::format("did you mean {}?", near));
  return nullptr;
}

std::string_view motor_kind(std::string_view parameter) {
  constexpr std::string_view name = ".model";
  if (!parameter.ends_with(name)) return "";
  parameter.remove_suffix(name.size());
  for (const auto kind : motor_kinds)
    if (parameter == kind ||
        (parameter.ends_with(kind) && parameter.at(parameter.size() - kind.size() - 1) == '.'))
      return kind;
  return "";
}

Form model_form(const plants::Parameter& parameter) {
  auto made = form(parameter);
  made.write = [&parameter] {
    const auto model = value_text(parameter);
    const auto none = std::string(plants::no_model);
    return model == none ? none : fmt::format("{}  # {}: its values are written out", none, model);
  };
  made.schema = [&parameter] {
    std::vector<std::string> names = {std::string(plants::no_model)};
    for (const auto& motor : shipped_motors())
      if (motor.kind == motor_kind(parameter.name)) names.push_back(motor.name.text);
    return fmt::format(R"({{"anyOf": [{{"enum": ["{}"]}}, {{"type": "string"}}]}})",
                       fmt::join(names, R"(", ")"));
  };
  return made;
}

}  // namespace drycut::sim::scenario
