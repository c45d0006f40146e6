// The controller's terminals and values by name, and what it keeps without power.
#include <fmt/format.h>

#include <algorithm>

#include "devices/lx3vp/lx3vp_controller.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

namespace {

bool keeps_value(const RegisterName& name) {
  const bool two_words = name.kind == RegisterName::Kind::wide || name.kind == RegisterName::Kind::real;
  const char letter = letter_of(name);
  return is_retentive(letter, name.number) && (!two_words || is_retentive(letter, name.number + 1));
}

// Calls `act` with every name that holds a retentive value.
template <typename Act>
void for_each_retentive(Act act) {
  using Kind = RegisterName::Kind;
  const auto all = [&](Kind kind, int count) {
    for (int i = 0; i < count; ++i)
      if (const RegisterName name{kind, i}; keeps_value(name)) act(name);
  };
  all(Kind::word, data_words);
  all(Kind::m, relays);
  all(Kind::s, states);
  all(Kind::timer, timers);
  all(Kind::timer_contact, timers);
  all(Kind::counter, counters);
  all(Kind::counter_contact, counters);
}

}  // namespace

void Lx3vpController::add_used_terminals() {
  const auto used = [&](il::OperandType kind, int number) {
    if (kind == il::OperandType::X) cards_.inputs.try_emplace({Kind::input, 0, number});
    if (kind == il::OperandType::Y) cards_.outputs.try_emplace({Kind::output, 0, number});
    if (kind == il::OperandType::C && number >= first_high_speed_counter)
      cards_.counters.try_emplace({Kind::counter, 0, number});
  };
  for (const il::Step& step : program_.steps) {
    for (std::size_t i = 0; i < step.operands.size(); ++i) {
      const il::Operand& operand = step.operands[i];
      if (step.kind(i) == 'p') {
        cards_.pulse_outputs.try_emplace({Kind::output, 0, operand.number});
      } else if (operand.kind == il::OperandType::bits) {
        for (int bit = 0; bit < 4 * operand.count; ++bit) used(operand.of, operand.number + bit);
      } else {
        used(operand.kind, operand.number);
      }
    }
  }
}

// For suggestions and the report's table: what the program itself is about, not 20000 registers.
void Lx3vpController::add_names() {
  using Kind = RegisterName::Kind;
  const auto add_name = [&](const std::string& name) {
    if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
  };
  const auto add = [&](Kind kind, int number) { add_name(to_string(RegisterName{kind, number})); };
  const auto add_operand = [&](il::Operand operand, bool wide) {
    if (std::string_view("XYMSTCDVZ").find(letter_of(operand.kind)) == std::string_view::npos) return;
    operand.index = il::Operand::no_index;
    add_name((wide && operand.kind == il::OperandType::D ? "D" : "") + to_string(operand));
  };
  constexpr std::size_t block_operand = 1;
  for (const il::Step& step : program_.steps) {
    for (std::size_t i = 0; i < step.operands.size(); ++i) {
      if (step.op() != il::Op::decam || i != block_operand) add_operand(step.operands[i], step.wide());
    }
    if (step.op() != il::Op::decam) continue;
    for (const BlockWord& entry : block_words()) {
      const int number = step.operands[block_operand].number + entry.offset;
      if (entry.access == BlockWord::Access::reserved || entry.offset >= block_length) continue;
      if (number + entry.words <= data_words) add(entry.words == 2 ? Kind::wide : Kind::word, number);
    }
  }
  for (const auto& [address, output] : cards_.pulse_outputs)
    add(Kind::wide, std::array{8140, 8142, 8150, 8152}[static_cast<std::size_t>(address.number)]);
}

std::optional<ControllerValue> Lx3vpController::find(const std::string& name) {
  const auto named = parse_register(name);
  if (!named || !is_served(*named)) return std::nullopt;
  ControllerValue value{to_string(*named), "", {}, {}, {}};
  for (const SpecialRegister& row : special_registers())
    if (value.name == row.name || value.name == "D" + std::string(row.name)) value.meaning = row.meaning;
  const auto at = static_cast<std::size_t>(named->number);
  if (named->kind == RegisterName::Kind::x) {
    value.read = [this, at] {
      if (powered_ && !ticks_inputs_) take_inputs();
      return inputs_[at] ? 1.0 : 0.0;
    };
  } else if (named->kind == RegisterName::Kind::y) {
    value.read = [this, at] { return outputs_[at] ? 1.0 : 0.0; };
    value.write = [this, at](double on) { registers_.y[at] = on != 0; };
    value.range = range_of(*named);
  } else {
    value.read = [this, at = *named] { return lx3vp::read(registers_, at); };
    value.write = [this, at = *named](double number) { lx3vp::write(registers_, at, number); };
    value.range = range_of(*named);
  }
  return value;
}

std::string Lx3vpController::retentive_state() const {
  std::string text = fmt::format("; retentive registers of {}\n", program_.file);
  for_each_retentive([&](const RegisterName& name) {
    const double value = lx3vp::read(registers_, name);
    // A 0 that was written is not the same as a word that never was.
    const bool written =
        name.kind == RegisterName::Kind::word && registers_.written[static_cast<std::size_t>(name.number)];
    if (value != 0 || written) text += fmt::format("{} = {}\n", to_string(name), value);
  });
  return text;
}

bool Lx3vpController::restore(const std::string& text, Problems& problems, const std::string& file_name) {
  const std::size_t before = problems.size();
  const auto values = read_register_values(text, file_name, '=', problems);
  if (problems.size() > before) return false;
  for_each_retentive([&](const RegisterName& name) {
    lx3vp::write(registers_, name, 0);
    if (name.kind == RegisterName::Kind::word)
      registers_.written.reset(static_cast<std::size_t>(name.number));
  });
  for (const RegisterValue& entry : values)
    if (keeps_value(entry.name)) lx3vp::write(registers_, entry.name, entry.value);
  return true;
}

}  // namespace drycut::devices::lx3vp
