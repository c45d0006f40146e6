#include "devices/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "devices/contradictions.hpp"
#include "devices/controller.hpp"

namespace drycut::devices {
namespace {

constexpr int init_state = 0;
constexpr int init_command = 0;

/// The row that `name` gives to a table variable called `base` ("codeQm17" -> 16), or nullopt.
std::optional<int> row_of(std::string_view name, std::string_view base, int rows) {
  if (name.size() <= base.size() || !same_word(name.substr(0, base.size()), base)) return std::nullopt;
  const std::optional<int> number = parsed<int>(name.substr(base.size()));
  if (!number || *number < 1 || *number > rows) return std::nullopt;
  return *number - 1;
}

std::optional<Symbol> find_exact(const DeviceType& type, std::string_view name) {
  for (std::size_t i = 0; i < type.variables.size(); ++i) {
    const DeviceVariable& variable = type.variables[i];
    if (variable.rows == 1) {
      if (same_word(name, variable.name)) return Symbol{Symbol::Kind::variable, static_cast<int>(i), 0};
    } else if (const auto row = row_of(name, variable.name, variable.rows)) {
      return Symbol{Symbol::Kind::variable, static_cast<int>(i), *row};
    }
  }
  for (std::size_t i = 0; i < type.states.size(); ++i)
    if (same_word(name, type.states[i].name)) return Symbol{Symbol::Kind::state, static_cast<int>(i), 0};
  return std::nullopt;
}

std::int32_t reset_value(Retention retention) { return retention == Retention::one ? 1 : 0; }

/// Where each variable's rows begin, and where the last one's end.
std::vector<int> offsets_of(const DeviceType& type) {
  std::vector<int> offsets = {0};
  for (const DeviceVariable& variable : type.variables) offsets.push_back(offsets.back() + variable.rows);
  return offsets;
}

}  // namespace

std::optional<Symbol> find_symbol(const DeviceType& type, std::string_view name) {
  if (const auto symbol = find_exact(type, name)) return symbol;
  for (const Alias& alias : type.aliases)
    if (same_word(name, alias.spelling)) return find_exact(type, alias.name);
  return std::nullopt;
}

std::optional<int> find_command(const DeviceType& type, std::string_view name) {
  for (std::size_t i = 0; i < type.commands.size(); ++i)
    if (same_word(name, type.commands[i].name)) return static_cast<int>(i);
  return std::nullopt;
}

std::vector<std::string> symbol_names(const DeviceType& type) {
  std::vector<std::string> names;
  for (const DeviceVariable& variable : type.variables)
    names.push_back(std::string(variable.name) + (variable.rows > 1 ? "1" : ""));
  for (const State& state : type.states) names.emplace_back(state.name);
  return names;
}

std::string name_of(const DeviceType& type, Symbol symbol) {
  if (symbol.kind == Symbol::Kind::state) return std::string(type.states[symbol.index].name);
  const DeviceVariable& variable = type.variables[symbol.index];
  if (variable.rows == 1) return std::string(variable.name);
  return fmt::format("{}{}", variable.name, symbol.row + 1);
}

std::int32_t wrap(Size size, std::int64_t value) {
  switch (size) {
    case Size::F:
      return value != 0 ? 1 : 0;
    case Size::B:
      return static_cast<std::int8_t>(value);
    case Size::W:
      return static_cast<std::int16_t>(value);
    case Size::L:
    case Size::S:
      break;
  }
  return static_cast<std::int32_t>(value);
}

Device::Device(const DeviceType& type)
    : type_(type), offsets_(offsets_of(type)), contradictions_(contradictions(type)) {
  assert(type.states.size() <= 64 && type.commands.size() <= 64);
  values_.assign(static_cast<std::size_t>(offsets_.back()), 0);
  told_contradictions_.assign(contradictions_.size(), 0);
  reset_values();
}

void Device::reset_values() {
  for (std::size_t i = 0; i < type_.variables.size(); ++i) {
    const DeviceVariable& variable = type_.variables[i];
    if (variable.retention == Retention::retentive) continue;
    std::fill_n(values_.begin() + offsets_[i], variable.rows, reset_value(variable.retention));
  }
  for (std::size_t i = 0; i < type_.states.size(); ++i) {
    const Retention retention = type_.states[i].retention;
    if (retention != Retention::retentive) set_state(static_cast<int>(i), retention == Retention::one);
  }
}

void Device::write(Symbol symbol, std::int32_t value) {
  if (state(init_state)) {
    pending_writes_.push_back({symbol, value});
  } else {
    apply({symbol, value});
  }
}

void Device::command(int index, std::string_view giver) {
  pending_commands_ |= std::uint64_t{1} << index;
  const bool known = std::any_of(given_.begin(), given_.end(), [&](const Given& other) {
    return other.command == index && other.giver == giver;
  });
  if (!known) given_.push_back({index, std::string(giver)});
}

bool Device::settled() const {
  return !state(init_state) || (pending_writes_.empty() && pending_commands_ == 0);
}

std::int32_t Device::read(Symbol symbol) const {
  if (symbol.kind == Symbol::Kind::state) return state(symbol.index) ? 1 : 0;
  return value(symbol.index, symbol.row);
}

void Device::restore(Symbol symbol, std::int32_t value) {
  assert(!state(init_state));
  if (symbol.kind == Symbol::Kind::state) {
    if (type_.states[symbol.index].retention == Retention::retentive) set_state(symbol.index, value != 0);
  } else if (type_.variables[symbol.index].retention == Retention::retentive) {
    this->value(symbol.index, symbol.row) = wrap(type_.variables[symbol.index].size, value);
  }
}

void Device::sample() {
  latch();
  if (!pending_writes_.empty()) {
    const std::vector<PendingWrite> writes = std::exchange(pending_writes_, {});
    for (const PendingWrite& pending : writes) apply(pending);
  }
  const std::uint64_t commands = std::exchange(pending_commands_, 0);
  for (std::uint64_t set = commands; set != 0; set &= set - 1) run(std::countr_zero(set));
  if (commands != 0) {
    tell_contradictions(commands);
    given_.clear();
  }
  if (state(init_state)) step();
}

void Device::interrupt(int, bool) {}

void Device::power_up() {
  pending_writes_.clear();
  pending_commands_ = 0;
  given_.clear();
  std::ranges::fill(told_contradictions_, 0);
  reset_values();
}

std::vector<Diagnostic> Device::take_diagnostics() { return std::exchange(diagnostics_, {}); }

bool Device::may_write(Symbol, std::int32_t) { return true; }
void Device::written(Symbol symbol, std::int32_t new_value) { value(symbol.index, symbol.row) = new_value; }
bool Device::may_execute(int) { return true; }
void Device::refused(int) {}

void Device::report(Diagnostic diagnostic) { diagnostics_.push_back(std::move(diagnostic)); }

void Device::report_outside(int variable, std::int32_t low, int high) {
  const std::int32_t current = value(variable);
  if (current >= low && current <= value(high)) return;
  report({Diagnostic::Kind::out_of_range, std::string(type_.variables[variable].name),
          fmt::format("{} is outside {}..{} ({}), taken anyway", current, low, value(high),
                      type_.variables[high].name)});
}

void Device::apply(const PendingWrite& pending) {
  const Symbol symbol = pending.symbol;
  const std::string name = name_of(type_, symbol);
  if (symbol.kind == Symbol::Kind::state || type_.variables[symbol.index].access == Access::read) {
    report({Diagnostic::Kind::write_refused, name, "read only"});
    return;
  }
  const DeviceVariable& variable = type_.variables[symbol.index];
  if (std::string failed = unmet(variable.write); !failed.empty()) {
    report({Diagnostic::Kind::write_refused, name, std::move(failed)});
    return;
  }
  const std::int32_t stored = wrap(variable.size, pending.value);
  if (!may_write(symbol, stored)) {
    report({Diagnostic::Kind::write_refused, name, fmt::format("needs {}", variable.write.also)});
    return;
  }
  if (stored != pending.value) {
    report({Diagnostic::Kind::out_of_range, name,
            fmt::format("{} does not fit size {}, taken as {}", pending.value,
                        static_cast<char>(variable.size), stored)});
  } else if (stored < variable.min || stored > variable.max) {
    report({Diagnostic::Kind::out_of_range, name,
            fmt::format("{} is outside {}..{}, taken anyway", stored, variable.min, variable.max)});
  }
  written(symbol, stored);
}

void Device::run(int command) {
  const DeviceCommand& entry = type_.commands[command];
  const Effect& effect = entry.effect;
  if (state(init_state) && effect.quiet && state(effect.state) == effect.on) return;
  std::string failed = unmet(entry.condition);
  if (failed.empty() && !may_execute(command)) failed = fmt::format("needs {}", entry.condition.also);
  if (!failed.empty()) {
    report({Diagnostic::Kind::command_refused, std::string(entry.name), std::move(failed)});
    if (state(init_state)) refused(command);
    return;
  }
  if (command == init_command) {
    reset_values();
    set_state(init_state, true);
    initialise();
  } else {
    if (effect.state >= 0) set_state(effect.state, effect.on);
    execute(command);
  }
}

// The table's order is kept: the first of two is executed first, whoever gave it.
void Device::tell_contradictions(std::uint64_t commands) {
  for (std::uint64_t set = commands; set != 0; set &= set - 1) {
    const int first = std::countr_zero(set);
    const std::uint64_t against = contradictions_[first] & set;
    const std::uint64_t fresh = against & ~std::exchange(told_contradictions_[first], against);
    for (std::uint64_t others = fresh; others != 0; others &= others - 1) {
      const int second = std::countr_zero(others);
      const int state = type_.commands[second].effect.state;
      report({Diagnostic::Kind::contradiction, given(first) + " and " + given(second),
              fmt::format("both in one sample, {} is taken first{}", type_.commands[first].name,
                          state < 0 ? ""
                                    : fmt::format("; {} is {} after both", type_.states[state].name,
                                                  this->state(state) ? 1 : 0))});
    }
  }
}

// "EMRG of saw", "EMRG of saw and of panel".
std::string Device::given(int command) const {
  std::string text(type_.commands[command].name);
  std::string_view joint = " of ";
  for (const Given& given : given_) {
    if (given.command != command || given.giver.empty()) continue;
    text += fmt::format("{}{}", std::exchange(joint, " and of "), given.giver);
  }
  return text;
}

std::string Device::unmet(const Condition& condition) const {
  std::string text;
  for (std::uint64_t wrong = (states_ ^ condition.value) & condition.mask; wrong != 0; wrong &= wrong - 1) {
    const int i = std::countr_zero(wrong);
    text += fmt::format("{}{} is {}, must be {}", text.empty() ? "" : "; ", type_.states[i].name,
                        state(i) ? 1 : 0, state(i) ? 0 : 1);
  }
  return text;
}

std::optional<CamAxis> Device::cam_axis() { return std::nullopt; }

void Symbol::visit(StateArchive& archive) { STATE(archive, kind, index, row); }
void Diagnostic::visit(StateArchive& archive) { STATE(archive, kind, subject, text); }
void Device::PendingWrite::visit(StateArchive& archive) { STATE(archive, symbol, value); }
void Device::Given::visit(StateArchive& archive) { STATE(archive, command, giver); }

void visit_values(StateArchive& archive, std::string_view name, std::span<std::int32_t> values) {
  if (values.size() == 1) return archive.named(name, values.front());
  std::vector<std::int32_t> all(values.begin(), values.end());
  archive.named(name, all);
  if (all.size() != values.size()) throw BadState("a list of another length");
  std::ranges::copy(all, values.begin());
}

void Device::visit(StateArchive& archive) {
  for (std::size_t i = 0; i < type_.variables.size(); ++i) {
    const DeviceVariable& variable = type_.variables[i];
    visit_values(archive, variable.name,
                 {values_.begin() + offsets_[i], static_cast<std::size_t>(variable.rows)});
  }
  for (std::size_t i = 0; i < type_.states.size(); ++i) {
    bool on = state(static_cast<int>(i));
    archive.named(type_.states[i].name, on);
    set_state(static_cast<int>(i), on);
  }
  STATE(archive, pending_writes_, pending_commands_, given_, told_contradictions_, diagnostics_);
}

}  // namespace drycut::devices
