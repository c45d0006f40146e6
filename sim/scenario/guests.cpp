#include "sim/scenario/guests.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

using plants::GuestVariable;

/// An FMU with units that are the scenario's word.
class GuestInUnits : public plants::GuestType {
 public:
  explicit GuestInUnits(std::shared_ptr<const plants::GuestType> type)
      : type_(std::move(type)), variables_(type_->variables()) {}
  [[nodiscard]] const std::string& origin() const override { return type_->origin(); }
  [[nodiscard]] const std::vector<GuestVariable>& variables() const override { return variables_; }
  [[nodiscard]] std::vector<GuestVariable>& variables() { return variables_; }
  [[nodiscard]] bool keeps_state() const override { return type_->keeps_state(); }
  [[nodiscard]] double fixed_step() const override { return type_->fixed_step(); }
  std::unique_ptr<plants::GuestModel> start(const Start& start, std::span<double> outputs) const override {
    return type_->start(start, outputs);
  }

 private:
  std::shared_ptr<const plants::GuestType> type_;
  std::vector<GuestVariable> variables_;
};

/// Of an element "A[1,2]" the array: "A".
std::string array_of(const std::string& name) {
  return name.ends_with(']') ? name.substr(0, name.rfind('[')) : name;
}

/// Of one that declares no unit `unit` is that of its numbers; of another one it is recorded in `unit`.
void give_unit(GuestVariable& variable, const std::string& unit) {
  const double zero = to_si(0, unit);
  const double one = to_si(1, unit) - zero;
  if (variable.unit.empty()) {
    variable.si_factor = one;
    variable.si_offset = zero;
  } else {
    const auto converted = [&, was = variable.unit](double limit) {
      constexpr double none = 1e300;
      return std::abs(limit) < none ? from_si(to_si(limit, was), unit) : limit;
    };
    variable.min = converted(variable.min);
    variable.max = converted(variable.max);
  }
  variable.factor = variable.si_factor / one;
  variable.offset = (variable.si_offset - zero) / one;
  variable.unit = unit;
  variable.is_voltage = same_dimension(unit, "V");
}

/// The units of one plant, as its file gives them.
class GuestUnits {
 public:
  GuestUnits(PlantEntry& plant, Findings& findings) : plant_(plant), findings_(findings) {}

  void read(const YamlNode& node) {
    const auto full = "plants." + plant_.name.text + ".units";
    if (node.kind != YamlNode::Kind::map) return;  // the form says so
    refuse_duplicates(node, full, findings_);
    for (const auto& entry : node.entries) {
      if (entry.is_repeated()) continue;
      const auto name = full + "." + entry.key.text;
      if (entry.value.kind != YamlNode::Kind::scalar)
        refuse_kind(entry.value, name, YamlNode::Kind::scalar, findings_);
      else if (const auto& unit = entry.value.text; !is_unit(unit.text) || unit.text.empty())
        findings_.add("scenario.unknown-unit"_code, unit.place,
                      fmt::format("{}: unknown unit '{}'", name, unit.text),
                      "V, mm/s, rad/s: 'drycut plants --units' lists them");
      else
        plant_.units.emplace_back(entry.key, unit);
    }
  }

  std::shared_ptr<const plants::GuestType> applied_to(std::shared_ptr<const plants::GuestType> type,
                                                      const std::string& file) {
    auto made = std::make_shared<GuestInUnits>(std::move(type));
    std::set<std::string> names;
    for (const auto& variable : made->variables()) names.insert({variable.name, array_of(variable.name)});
    for (const auto& [name, unit] : plant_.units) {
      if (!names.contains(name.text)) {
        findings_.add("scenario.unknown-name"_code, name.place,
                      fmt::format("the FMU has no input, output or parameter '{}'", name.text),
                      did_you_mean(name.text, {names.begin(), names.end()},
                                   fmt::format("'drycut plants {}' lists them", file)));
        continue;
      }
      for (auto& variable : made->variables())
        if ((variable.name == name.text || array_of(variable.name) == name.text) &&
            !give(variable, name, unit))
          break;
    }
    return made;
  }

 private:
  bool give(GuestVariable& variable, const Text& name, const Text& unit) {
    if (variable.type != GuestVariable::Type::real) {
      findings_.add("scenario.wrong-unit"_code, unit.place,
                    fmt::format("{} is no real number and has no unit", name.text),
                    "take it out: whole numbers are counts, Booleans switches");
      return false;
    }
    if (!variable.unit.empty() && !same_dimension(variable.unit, unit.text)) {
      findings_.add("scenario.wrong-unit"_code, unit.place,
                    fmt::format("{} is {} by the FMU's own word, in {}, and not {}", name.text,
                                dimension_name(variable.unit), variable.unit, dimension_name(unit.text)),
                    "take it out, or give a unit of the same kind");
      return false;
    }
    give_unit(variable, unit.text);
    return true;
  }

  PlantEntry& plant_;
  Findings& findings_;
};

}  // namespace

bool read_guest(const YamlNode& plant, PlantEntry& entry, const std::filesystem::path& folder,
                Findings& findings) {
  auto* const guest = dynamic_cast<plants::GuestDefinition*>(entry.definition.get());
  if (guest == nullptr) return true;
  const auto full = fmt::format("plants.{}.file", entry.name.text);
  const auto* const file = child(plant, "file");
  if (file != nullptr && file->kind != YamlNode::Kind::scalar && file->kind != YamlNode::Kind::null) {
    refuse_kind(*file, full, YamlNode::Kind::scalar, findings);
    return false;
  }
  if (file == nullptr || file->kind == YamlNode::Kind::null || file->text.text.empty()) {
    findings.add("scenario.missing-key"_code, entry.name.place,
                 fmt::format("{} is missing: which FMU is it?", full), "file: drive.fmu");
    return false;
  }
  guest->file() = findings.path_from(file->text);
  Problems unread;
  auto bytes = read_bytes(folder / guest->file(), unread, {}, largest_guest);
  for (const auto& problem : unread)
    findings.add(problem.code, file->text.place, problem.what, problem.remedy);
  if (!bytes) return false;
  GuestUnits units(entry, findings);
  if (const auto* const given = child(plant, "units")) units.read(*given);
  try {
    auto type = open_guest(std::move(*bytes), guest->file());
    if (!entry.units.empty()) type = units.applied_to(std::move(type), guest->file());
    guest->open(std::move(type), entry.name.text);
  } catch (const GuestRefused& refused) {
    findings.add(refused.code(), file->text.place, fmt::format("{}: {}", guest->file(), refused.what()),
                 refused.remedy());
    return false;
  }
  return true;
}

Form guest_units_form(const std::vector<std::pair<Text, Text>>& units) {
  return whole(
      YamlNode::Kind::map, [](const YamlNode&, const Form::Name&, Findings&) {},
      [&units] {
        std::vector<std::string> items;
        for (const auto& [variable, unit] : units)
          items.push_back(fmt::format("{}: {}", yaml_text(variable.text), yaml_text(unit.text)));
        return items.empty() ? "" : yaml_map(items);
      },
      map_schema(R"({"type": "string"})"));
}

}  // namespace drycut::sim::scenario
