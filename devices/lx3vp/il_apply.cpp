#include "devices/lx3vp/il_apply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "devices/lx3vp/block.hpp"
#include "devices/lx3vp/il_call.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

void multiply(Call& call) {
  const std::int64_t product = static_cast<std::int64_t>(call.value(0)) * call.value(1);
  auto& registers = call.registers();
  registers.set_i32(call.number(2), static_cast<std::int32_t>(static_cast<std::uint64_t>(product)));
  if (call.wide()) registers.set_i32(call.number(2) + 2, static_cast<std::int32_t>(product >> 32));
  registers.m[zero_flag] = product == 0;
}

void divide(Call& call) {
  const std::int64_t dividend = call.value(0);
  const std::int64_t divisor = call.value(1);
  if (divisor == 0) throw RuntimeError(bad_operand, "division by 0");
  // The smallest number by -1 wraps back to itself.
  const auto quotient = static_cast<std::int32_t>(static_cast<std::uint64_t>(dividend / divisor));
  const auto rest = static_cast<std::int32_t>(dividend % divisor);
  auto& registers = call.registers();
  if (call.wide()) {
    registers.set_i32(call.number(2), quotient);
    registers.set_i32(call.number(2) + 2, rest);
  } else {
    registers.set_i16(call.number(2), static_cast<std::int16_t>(quotient));
    registers.set_i16(call.number(2) + 1, static_cast<std::int16_t>(rest));
  }
  registers.m[zero_flag] = quotient == 0;
  registers.m[carry_flag] = dividend / divisor > largest(call.wide());
}

void move_block(Call& call) {
  const int count = call.count(2);
  call.need_words(0, count);
  call.need_words(1, count);
  auto& registers = call.registers();
  const int from = call.number(0);
  const int to = call.number(1);
  const auto move = [&](int i) { registers.put(to + i, registers.d[static_cast<std::size_t>(from + i)]); };
  // Blocks may overlap: nothing is overwritten before it was moved.
  if (to <= from)
    for (int i = 0; i < count; ++i) move(i);
  else
    for (int i = count; i-- > 0;) move(i);
}

void fill_block(Call& call) {
  const int width = call.wide() ? 2 : 1;
  const int count = call.count(2);
  call.need_words(1, count * width);
  const auto value = call.value(0);
  for (int i = 0; i < count; ++i) {
    const int at = call.number(1) + i * width;
    if (call.wide())
      call.registers().set_i32(at, value);
    else
      call.registers().set_i16(at, static_cast<std::int16_t>(value));
  }
}

template <typename Number>
int zone_of(Number value, Number low, Number high) {
  return value < low ? 0 : value > high ? 2 : 1;
}

void to_integer(Call& call) {
  const auto real = static_cast<double>(call.registers().f32(call.number(0)));
  const double whole = std::trunc(real);
  auto& m = call.registers().m;
  if (std::isnan(whole)) throw RuntimeError(bad_operand, "S is no floating-point number");
  m[borrow_flag] = whole < static_cast<double>(smallest(call.wide()));
  m[carry_flag] = whole > static_cast<double>(largest(call.wide()));
  if (m[borrow_flag] || m[carry_flag])
    throw RuntimeError(bad_operand, fmt::format("{} does not fit the whole number", real));
  call.set(1, static_cast<std::int32_t>(whole));
  m[zero_flag] = whole == 0;
}

void apply_words(Call& call, Op op) {
  const auto bits = [&](std::size_t i) { return static_cast<std::uint32_t>(call.value(i)); };
  const auto sum = [&](std::int64_t change) {
    call.set(0, static_cast<std::int32_t>(static_cast<std::uint32_t>(call.value(0) + change)));
  };
  switch (op) {
    case Op::mov:
      call.set(1, call.value(0));
      break;
    case Op::cml:
      call.set(1, ~call.value(0));
      break;
    case Op::xch: {
      const auto first = call.value(0);
      call.set(0, call.value(1));
      call.set(1, first);
      break;
    }
    case Op::add:
      call.set_sum(2, static_cast<std::int64_t>(call.value(0)) + call.value(1));
      break;
    case Op::sub:
      call.set_sum(2, static_cast<std::int64_t>(call.value(0)) - call.value(1));
      break;
    case Op::inc:
      sum(1);
      break;
    case Op::dec:
      sum(-1);
      break;
    case Op::neg:
      call.set(0, static_cast<std::int32_t>(0U - bits(0)));
      break;
    case Op::wand:
      call.set(2, static_cast<std::int32_t>(bits(0) & bits(1)));
      break;
    case Op::wor:
      call.set(2, static_cast<std::int32_t>(bits(0) | bits(1)));
      break;
    case Op::wxor:
      call.set(2, static_cast<std::int32_t>(bits(0) ^ bits(1)));
      break;
    case Op::cmp:
      call.set_three(2, call.value(0) > call.value(1) ? 0 : call.value(0) == call.value(1) ? 1 : 2);
      break;
    case Op::zcp:
      call.set_three(3, zone_of(call.value(2), call.value(0), call.value(1)));
      break;
    case Op::mul:
      multiply(call);
      break;
    case Op::div:
      divide(call);
      break;
    case Op::bmov:
      move_block(call);
      break;
    case Op::fmov:
      fill_block(call);
      break;
    default:
      break;
  }
}

void apply_reals(Call& call, Op op) {
  const auto real = [&](std::size_t i) {
    const auto value = static_cast<double>(call.real(i));
    if (!std::isfinite(value)) throw RuntimeError(bad_operand, "an operand is no floating-point number");
    return value;
  };
  switch (op) {
    case Op::flt:
      call.registers().set_f32(call.number(1), static_cast<float>(call.value(0)));
      break;
    case Op::int_:
      to_integer(call);
      break;
    case Op::emov:
      call.registers().set_f32(call.number(1), call.real(0));
      break;
    case Op::eadd:
      call.set_real(2, real(0) + real(1));
      break;
    case Op::esub:
      call.set_real(2, real(0) - real(1));
      break;
    case Op::emul:
      call.set_real(2, real(0) * real(1));
      break;
    case Op::ediv:
      if (real(1) == 0) throw RuntimeError(bad_operand, "division by 0");
      call.set_real(2, real(0) / real(1));
      break;
    case Op::ecmp:
      call.set_three(2, real(0) > real(1) ? 0 : real(0) == real(1) ? 1 : 2);
      break;
    case Op::ezcp:
      call.set_three(3, zone_of(real(2), real(0), real(1)));
      break;
    default:
      break;
  }
}

}  // namespace

bool compare(const Registers& registers, const Step& step) {
  const auto left = read_value(registers, step.operands[0], step.wide());
  const auto right = read_value(registers, step.operands[1], step.wide());
  switch (step.op()) {
    case Op::ld_equal:
    case Op::and_equal:
    case Op::or_equal:
      return left == right;
    case Op::ld_gt:
    case Op::and_gt:
    case Op::or_gt:
      return left > right;
    case Op::ld_lt:
    case Op::and_lt:
    case Op::or_lt:
      return left < right;
    case Op::ld_unequal:
    case Op::and_unequal:
    case Op::or_unequal:
      return left != right;
    case Op::ld_le:
    case Op::and_le:
    case Op::or_le:
      return left <= right;
    default:
      return left >= right;
  }
}

void apply(Registers& registers, const Step& step) {
  Call call(registers, step);
  if (step.op() >= Op::flt)
    apply_reals(call, step.op());
  else if (step.op() >= Op::sftl)
    apply_shifts(call, step.op());
  else
    apply_words(call, step.op());
}

std::int64_t work_of(const Registers& registers, const Step& step) {
  const auto count = [&](std::size_t i) {
    return std::int64_t{std::max(0, read_value(registers, step.operands[i], false))};
  };
  switch (step.op()) {
    case Op::bmov:
    case Op::fmov:
    case Op::mean:
    case Op::sftl:
    case Op::sftr:
      return count(2);
    case Op::zrst:
      return std::max(0, step.operands[1].number - step.operands[0].number);
    case Op::ecamtbx:
      return 10 * max_rows;
    default:
      return 0;
  }
}

EcamtbxReport apply_ecamtbx(Registers& registers, const Step& step) {
  const auto& type = step.operands[1];
  // The type is read from the low word: a program may have written it with MOV.
  return run_ecamtbx(registers, step.operands[0].number,
                     read_value(registers, type, type.kind == Kind::constant), step.operands[2].number,
                     step.operands[3].number);
}

namespace {

/// A frequency that PLSY and ZRN take, a count that PLSY takes.
void need_at_least(std::int64_t value, int least, std::string_view name) {
  if (value < least)
    throw RuntimeError(bad_operand, fmt::format("{} is {}; write {} or more", name, value, least));
}

DecamOperands decam_operands(const Step& step) {
  const auto number = [&](std::size_t i) { return step.operands[i].number; };
  const auto& master = step.operands[0];
  DecamOperands operands;
  operands.master.kind = master.kind == Kind::C   ? MasterSource::Kind::counter
                         : master.kind == Kind::D ? MasterSource::Kind::word
                                                  : MasterSource::Kind::time;
  operands.master.number = master.kind == Kind::constant ? master.value : master.number;
  operands.block = number(1);
  operands.start = {step.operands[2].kind == Kind::X, number(2)};
  operands.output = number(3);
  operands.direction = number(4);
  return operands;
}

DogSignal dog_signal(const Operand& operand) {
  switch (operand.kind) {
    case Kind::X:
      return {DogSignal::Kind::x, operand.number};
    case Kind::Y:
      return {DogSignal::Kind::y, operand.number};
    case Kind::M:
      return {DogSignal::Kind::m, operand.number};
    default:
      return {DogSignal::Kind::s, operand.number};
  }
}

}  // namespace

void drive_outputs(const Registers& registers, const Step& step, bool powered, Instructions& instructions) {
  const auto number = [&](std::size_t i) { return step.operands[i].number; };
  // Without power index registers are not applied, and nobody looks at the values.
  const auto value = [&](std::size_t i) {
    return powered || !step.indexed ? read_value(registers, step.operands[i], step.wide()) : 0;
  };
  switch (step.op()) {
    case Op::plsv:
      return instructions.plsv(step.number, value(0), number(1), number(2), powered);
    case Op::decam:
      return instructions.decam(step.number, decam_operands(step), powered);
    case Op::plsy:
      if (powered) need_at_least(value(0), 0, "the frequency S1");
      if (powered) need_at_least(value(1), 0, "the number of pulses S2");
      return instructions.pulse_train(step.number, value(0), value(1), number(2), powered);
    case Op::zrn:
      if (powered) need_at_least(value(0), 1, "the speed S1");
      if (powered) need_at_least(value(1), 1, "the creep speed S2");
      return instructions.zero_return(step.number, value(0), value(1), dog_signal(step.operands[2]),
                                      number(3), powered);
    default:
      return instructions.drive(step.number, step.op() == Op::drva, value(0), value(1), number(2), number(3),
                                powered);
  }
}

}  // namespace drycut::devices::lx3vp::il
