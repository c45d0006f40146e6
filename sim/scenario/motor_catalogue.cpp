#include "sim/scenario/motor_catalogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/embedded.hpp"
#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/motor_estimates.hpp"
#include "sim/scenario/parameter_text.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

constexpr std::uintmax_t largest_series = std::uintmax_t{1} << 20U;  // [bytes]

constexpr std::string_view of_program = "estimate: drycut's, ";
constexpr std::string_view former_name = "formerly";
constexpr std::string_view source_words[] = {"sheet: ", "unchecked: ", "estimate: "};

// Of values by where they are from.
std::string standing_of(const std::vector<std::string_view>& sources) {
  const auto count = [&](std::string_view begin) {
    return std::count_if(sources.begin(), sources.end(), [&](auto from) { return from.starts_with(begin); });
  };
  const auto estimated = count(source_words[2]);
  const auto* const word = estimated == std::ssize(sources)                      ? "estimated"
                           : count("checked") + estimated == std::ssize(sources) ? "checked"
                                                                                 : "unchecked";
  const auto completed = count(of_program);
  return completed == 0 ? word : fmt::format("{}, {} estimated", word, completed);
}

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

  // "checked 2026-11-24: "
  static bool says_check(std::string_view text) {
    constexpr std::string_view form = "checked dddd-dd-dd: ";
    if (text.size() <= form.size()) return false;
    for (std::size_t i = 0; i < form.size(); ++i)
      if (i >= 8 && form[i] == 'd' ? std::isdigit(static_cast<unsigned char>(text[i])) == 0
                                   : text[i] != form[i])
        return false;
    return true;
  }
  static bool says_source(std::string_view text) {
    return says_check(text) || std::any_of(std::begin(source_words), std::end(source_words), [&](auto word) {
             return text.starts_with(word) && text.size() > word.size();
           });
  }
  // What a sheet's values are until somebody has compared them.
  static std::string told_source(const std::string& text) {
    constexpr std::string_view sheet = source_words[0];
    return text.starts_with(sheet) ? fmt::format("{}{}", source_words[1], text.substr(sheet.size())) : text;
  }

  void refuse_source(const Text& text, const std::string& name, const std::vector<std::string>& words) {
    const auto near = nearest(text.text, words);
    findings().add(
        "plant.motor-sheet"_code, text.place,
        fmt::format("{} says neither which sheet nor why an estimate", name),
        near.empty()
            ? R"(write "sheet: ...", "checked 2026-11-24: ..." or "estimate: ...", or a word of sources)"
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
      sources_.emplace_back(entry.key.text, told_source(entry.value.text.text));
    }
  }

  // "sheet: ...", said or by a word of `sources`; "" after a problem.
  std::string source(const Text& from, const std::string& name) {
    std::vector<std::string> words;
    for (const auto& [word, text] : sources_) {
      if (word == from.text) return text;
      words.push_back(word);
    }
    if (says_source(from.text)) return told_source(from.text);
    refuse_source(from, name, words);
    return "";
  }

  // The values of a map, those that are wrong left out.
  std::vector<MotorModel::Value> read_values(const YamlNode& map, const std::string& name) {
    std::vector<MotorModel::Value> values;
    MotorTable scratch(kind_);  // takes the values
    refuse_duplicates(map, name, findings());
    for (const auto& entry : map.entries) {
      if (entry.is_repeated() || entry.key.text == former_name) continue;
      const auto full = fmt::format("{}.{}", name, entry.key.text);
      const auto* const row = scratch.find(entry.key.text);
      if (row == nullptr) {
        findings().add("scenario.unknown-key"_code, entry.key.place,
                       fmt::format("unknown key '{}' in {}", entry.key.text, name),
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
      findings().add("plant.motor-sheet"_code, entry.key.place,
                     fmt::format("'{}' cannot name a motor", entry.key.text),
                     "write what is on its name plate");
    MotorModel motor{entry.key, "", kind_, vendor_, series_, {}};
    if (const auto* const former = child(entry.value, former_name))
      form(motor.formerly)
          .read(*former, {fmt::format("{}.{}", name, former_name), entry.key.place}, findings());
    const auto own = read_values(entry.value, name);
    const MotorTable table(kind_);
    for (const auto& row : table.rows) {
      for (const auto* values : {&own, &std::as_const(common_)}) {
        const auto given = std::find_if(values->begin(), values->end(),
                                        [&](const auto& value) { return value.parameter == row.name; });
        if (given == values->end()) continue;
        motor.values.push_back(*given);
        break;
      }
    }
    if (findings().count() == before) judge_motor(motor, name);
    if (findings().count() == before) complete(motor);
    motors_.push_back(std::move(motor));
  }

  void judge_motor(const MotorModel& motor, const std::string& name) {
    for (const auto& keys : needed_values(kind_)) {
      const bool given = std::any_of(keys.begin(), keys.end(), [&](auto key) {
        return motor.find(key) != nullptr || is_wrong_in_common(key);
      });
      if (!given)
        findings().add("plant.motor-incomplete"_code, motor.name.place,
                       fmt::format("{}.{} is missing", name, fmt::join(keys, " or ")),
                       "write it from the motor's sheet; drycut plants --motor-template shows which values "
                       "a motor needs and which are estimated without");
    }
    const auto* const power = motor.find("rated_power");
    const auto* const torque = motor.find("rated_torque");
    const auto* const speed = motor.find("rated_speed");
    if (power == nullptr || torque == nullptr || speed == nullptr) return;
    const double given = si(*power);
    const double made = si(*torque) * si(*speed);
    if (std::abs(made - given) > 0.03 * given)
      findings().add("plant.motor-sheet"_code, power->text.place,
                     fmt::format("{}.rated_power is {}, but rated torque at rated speed gives {:.3g} kW",
                                 name, power->text.text, made / 1e3),
                     "within 3 % of each other");
  }

  // The rest of the values, as estimates.
  void complete(MotorModel& motor) {
    std::vector<MotorModel::Value> all;
    MotorTable table(kind_);
    for (const auto& value : motor.values) table.set(value.parameter, si(value));
    const auto estimates = table.estimates();
    for (const auto& row : table.rows) {
      if (const auto* const given = motor.find(row.name)) {
        all.push_back(*given);
        continue;
      }
      const auto estimate = std::find_if(estimates.begin(), estimates.end(),
                                         [&](const auto& made) { return made.parameter == row.name; });
      if (estimate == estimates.end()) continue;
      const auto shown = value_text(row);
      all.push_back({row.name, {shown, motor.name.place}, shown, std::string(of_program) + estimate->why});
    }
    motor.values = std::move(all);
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
      findings.add("plant.motor-twice"_code, motor.name.place,
                   fmt::format("there are two motors named '{}'", motor.name.text),
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
      findings.add(problem.code, {problem.line, problem.column, source}, problem.what, problem.remedy);
    if (text) read_series(*text, source, false, motors, findings);
  }
}

void read_shipped(std::vector<MotorModel>& motors, Findings& findings) {
  auto names = embedded_names();
  std::erase_if(names, [](std::string_view name) { return !name.starts_with("catalogue/"); });
  std::sort(names.begin(), names.end());
  for (const auto& name : names) {
    const int source = findings.add_source(fmt::format("scenes/{}", name));
    read_series(embedded_file(name), source, true, motors, findings);
  }
}

}  // namespace

const MotorModel::Value* MotorModel::find(std::string_view parameter) const {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const auto& value) { return value.parameter == parameter; });
  return found == values.end() ? nullptr : &*found;
}

bool MotorModel::Value::is_completed() const { return from.starts_with(of_program); }

std::string MotorModel::standing() const {
  std::vector<std::string_view> sources;
  for (const auto& value : values) sources.push_back(value.from);
  return standing_of(sources);
}

std::vector<Finding> notes_of_models(const PlantEntry& plant) {
  std::vector<Finding> notes;
  for (const auto& row : plant.definition->parameters()) {
    if (motor_kind(row.name).empty()) continue;
    const auto group =
        std::string_view(row.name).substr(0, row.name.size() - std::string_view("model").size());
    std::string motor;
    std::vector<std::string_view> sources;
    for (const auto& value : plant.modelled) {
      if (value.by_class || !value.parameter.starts_with(group)) continue;
      const auto comma = value.from.find(", ");
      motor = value.from.substr(0, comma);
      sources.push_back(std::string_view(value.from).substr(comma + 2));
    }
    if (sources.empty()) continue;
    const auto parameter = fmt::format("{}.{}", plant.name.text, row.name);
    if (const auto name = value_text(row); name != motor)
      notes.emplace_back("plant.motor-renamed"_code,
                         fmt::format("{}: {} is called {} now; the next release does not know the old name",
                                     parameter, name, motor));
    if (const auto standing = standing_of(sources); standing != "checked")
      notes.emplace_back(
          "plant.motor-unchecked"_code,
          fmt::format("{}: the values of {} are {}; compare them with its sheet: drycut plants --motors {}",
                      parameter, motor, standing, motor));
  }
  return notes;
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
    if (motor.kind == kind && (motor.name.text == name.text || motor.formerly == name.text)) return &motor;
    if (motor.kind == kind) known.push_back(motor.name.text);
  }
  // It may be in a file that cannot be read.
  if (!is_sound_) return nullptr;
  const auto near = nearest(name.text, known);
  findings_.add(
      "plant.unknown-motor"_code, name.place, fmt::format("{}: there is no motor '{}'", full, name.text),
      near.empty() ? "'drycut plants --motors' lists them; your own are in catalogue/ beside the scenario"
                   : fmt::format("did you mean {}?", near));
  return nullptr;
}

std::string motor_template(std::string_view kind) {
  MotorTable table(kind);
  const auto needed = needed_values(kind);
  const auto unit = [&](std::string_view name) { return std::string(table.find(name)->unit); };
  std::string text = fmt::format(
      "# A motor of your own, from the values of its data sheet. Fill in each ___ and keep the file in "
      "catalogue/\n"
      "# beside the scenario, which then says {}: {{model: NAME}}. Write the sheet's own units: N m, lb in, "
      "oz in;\n"
      "# kg cm2, lb in2, oz in s2; rpm; kW, hp. The page of units: drycut plants --units.\n"
      "vendor: ___\nseries: ___\nkind: {}\nsources:\n"
      "  # Once the values were compared with the sheet: \"checked 2026-11-24: which sheet, p. 12\"\n"
      "  sheet: \"sheet: which sheet, and which page of it\"\nmotors:\n  NAME: # as on the name plate\n",
      kind, kind);
  for (const auto& keys : needed) {
    for (const auto& key : keys) table.set(std::string(key), 1);
    text += fmt::format("    {}: {{value: ___ {}, from: sheet}}", keys.front(), unit(keys.front()));
    for (std::size_t i = 1; i < keys.size(); ++i)
      text += fmt::format(" # or {}: {{value: ___ {}, from: sheet}}", keys[i], unit(keys[i]));
    text += "\n";
  }
  text +=
      "    # What is not given is estimated on the safe side, and marked so. From the sheet it is better:\n";
  text += fmt::format("    # rated_power: {{value: ___ {}, from: sheet}} # compared with torque and speed\n",
                      unit("rated_power"));
  if (table.find("largest_inertia_ratio") != nullptr)
    text +=
        "    # largest_inertia_ratio: {value: ___, from: sheet} # load over rotor that the maker recommends; "
        "drycut size goes by it\n";
  for (const auto& estimate : table.estimates())
    text += fmt::format("    # {}: {{value: ___ {}, from: sheet}} # else {}\n", estimate.parameter,
                        unit(estimate.parameter), estimate.why);
  return text;
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
