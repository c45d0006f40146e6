#include "devices/qmove/program.hpp"

#include <array>
#include <utility>

namespace drycut::devices::qmove {

std::string_view name_of(NamedThing::Kind kind) {
  constexpr std::array<std::string_view, 10> names = {"a constant",
                                                      "a variable",
                                                      "an array",
                                                      "a datagroup variable",
                                                      "a datagroup variable",
                                                      "a datagroup",
                                                      "a timer",
                                                      "an input",
                                                      "an output",
                                                      "a device"};
  return names[static_cast<std::size_t>(kind)];
}

int cell_count(const NamedThing& thing) {
  switch (thing.kind) {
    case NamedThing::Kind::scalar:
      return 1;
    case NamedThing::Kind::array:
    case NamedThing::Kind::group_static:
      return thing.length;
    case NamedThing::Kind::group_step:
      return thing.length * thing.steps;
    default:
      return 0;
  }
}

SymbolTable::SymbolTable(const Configuration& configuration) {
  using Kind = NamedThing::Kind;
  for (const CnfConstant& constant : configuration.constants)
    add({.kind = Kind::constant, .name = constant.name, .value = constant.value, .real = constant.real});
  add_values(configuration, false);
  volatile_cells_ = cells_;
  add_values(configuration, true);
  for (const DataGroup& group : configuration.groups) {
    add({.kind = Kind::group, .name = group.name});
    for (const GroupVariable& variable : group.statics)
      add({.kind = Kind::group_static,
           .name = variable.name,
           .size = variable.size,
           .length = group.recipes});
    for (const GroupVariable& variable : group.stepped)
      add({.kind = Kind::group_step,
           .name = variable.name,
           .size = variable.size,
           .length = group.recipes,
           .steps = group.steps});
  }
  const auto add_numbered = [&](Kind kind, const auto& entries, Size size) {
    for (std::size_t i = 0; i < entries.size(); ++i)
      add({.kind = kind, .name = entries[i].name, .size = size, .index = static_cast<int>(i)});
  };
  add_numbered(Kind::timer, configuration.timers, Size::L);
  add_numbered(Kind::input, configuration.inputs, Size::F);
  add_numbered(Kind::output, configuration.outputs, Size::F);
  add_numbered(Kind::device, configuration.devices, Size::L);
}

void SymbolTable::add_values(const Configuration& configuration, bool retentive) {
  for (const Scalar& scalar : configuration.scalars)
    if (scalar.retentive == retentive)
      add({.kind = NamedThing::Kind::scalar, .name = scalar.name, .size = scalar.size});
  for (const Array& array : configuration.arrays)
    if (array.retentive == retentive)
      add({.kind = NamedThing::Kind::array, .name = array.name, .size = array.size, .length = array.length});
}

void SymbolTable::add(NamedThing thing) {
  if (const int count = cell_count(thing); count > 0) {
    thing.index = cells_;
    cells_ += count;
  }
  by_name_.emplace(lower(thing.name), things_.size());
  things_.push_back(std::move(thing));
}

const NamedThing* SymbolTable::find(std::string_view name) const {
  const auto found = by_name_.find(lower(name));
  return found == by_name_.end() ? nullptr : &things_[found->second];
}

std::vector<std::string> SymbolTable::names() const {
  std::vector<std::string> names;
  for (const NamedThing& thing : things_) names.push_back(thing.name);
  return names;
}

}  // namespace drycut::devices::qmove
