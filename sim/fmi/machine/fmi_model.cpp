#include "sim/fmi/machine/fmi_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

namespace drycut::sim::fmi {

FmiModel::~FmiModel() = default;
FmiSource::~FmiSource() = default;

FmiVariable fmi_output(std::string name, std::string meaning, FmiVariable::Type type, std::string unit,
                       std::function<double()> get) {
  FmiVariable made{std::move(name), std::move(meaning), type, FmiVariable::Role::output, std::move(unit)};
  made.get = std::move(get);
  return made;
}

FmiVariable fmi_parameter(const std::string& name, const plants::Parameter& row) {
  using Type = FmiVariable::Type;
  constexpr Type types[] = {Type::real, Type::whole, Type::flag, Type::word};
  const auto type = types[row.value.index()];
  FmiVariable made{"parameters." + name, std::string(row.meaning), type,
                   row.live ? FmiVariable::Role::live_parameter : FmiVariable::Role::parameter,
                   std::string(row.unit)};
  made.in_si = true;
  made.ranged = type == Type::real || type == Type::whole;
  made.min = row.min;
  made.max = row.max;
  made.choices = row.choices;
  made.get = [row] {
    return std::visit(
        [](const auto* value) {
          if constexpr (std::is_same_v<decltype(value), const std::string*>)
            return 0.0;
          else
            return static_cast<double>(*value);
        },
        row.value);
  };
  if (auto* const* word = std::get_if<std::string*>(&row.value)) made.word = *word;
  return made;
}

FmiVariable fmi_setting(std::string name, std::string meaning, std::string_view unit, double min, double max,
                        bool whole) {
  const bool is_switch = unit.empty() && whole && min == 0 && max == 1;
  FmiVariable made{std::move(name), std::move(meaning),
                   is_switch ? FmiVariable::Type::flag : FmiVariable::Type::real, FmiVariable::Role::input,
                   std::string(unit)};
  made.in_si = true;
  made.ranged = !is_switch;
  made.integral = whole && !is_switch;
  made.min = min;
  made.max = max;
  return made;
}

void FmiModel::add(FmiVariable variable) {
  if (!names_.emplace(variable.name, static_cast<std::uint32_t>(variables_.size())).second) return;
  variables_.push_back(std::move(variable));
}

const FmiVariable& FmiModel::checked(std::uint32_t reference, const FmiValue& value) const {
  if (reference >= variables_.size())
    throw Refusal(fmt::format("there is no variable of value reference {}", reference));
  const auto& variable = variables_[reference];
  const auto& name = variable.name;
  if (variable.role == FmiVariable::Role::output || variable.role == FmiVariable::Role::time)
    throw Refusal(fmt::format("{} is an output and cannot be set", name));
  if (const auto* word = std::get_if<std::string>(&value)) {
    if (variable.type != FmiVariable::Type::word) throw Refusal(fmt::format("{} takes no text", name));
    if (!variable.choices.empty() && std::ranges::find(variable.choices, *word) == variable.choices.end())
      throw Refusal(fmt::format("{}: '{}' is none of: {}", name, *word, fmt::join(variable.choices, ", ")));
    return variable;
  }
  const double number = std::get<double>(value);
  if (variable.type == FmiVariable::Type::word) throw Refusal(fmt::format("{} takes a text", name));
  if (!std::isfinite(number)) throw Refusal(fmt::format("{}: {} is no finite number", name, number));
  if (!variable.ranged) return variable;
  const auto scale = variable.in_si && units_.contains(variable.unit) ? units_.at(variable.unit) : SiScale();
  const double inside = (number - scale.offset) / scale.factor;
  const double slack = 1e-12 * std::max(std::abs(variable.min), std::abs(variable.max));  // of the conversion
  if (inside < variable.min - slack || inside > variable.max + slack)
    throw Refusal(fmt::format("{}: {:.12g}{}{} is out of range; {:.12g} to {:.12g}{}{}", name, inside,
                              variable.unit.empty() ? "" : " ", variable.unit, variable.min, variable.max,
                              variable.unit.empty() ? "" : " ", variable.unit));
  if (variable.integral && inside != std::round(inside))
    throw Refusal(fmt::format("{}: {:.12g} is no whole number", name, inside));
  return variable;
}

}  // namespace drycut::sim::fmi
