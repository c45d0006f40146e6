#include "devices/lx3vp/il_apply.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr int zero_flag = 8020;    ///< M8020: the result is 0
constexpr int borrow_flag = 8021;  ///< M8021: below the smallest number
constexpr int carry_flag = 8022;   ///< M8022: above the largest

/// Narrowest and widest number of an instruction.
std::int64_t smallest(bool wide) {
  return wide ? std::numeric_limits<std::int32_t>::min() : std::numeric_limits<std::int16_t>::min();
}
std::int64_t largest(bool wide) {
  return wide ? std::numeric_limits<std::int32_t>::max() : std::numeric_limits<std::int16_t>::max();
}

/// The operands of a step as it is executed.
class Call {
 public:
  Call(Registers& registers, const Step& step) : registers_(registers), step_(step), wide_(step.wide()) {}

  [[nodiscard]] std::int32_t value(std::size_t i) const {
    return read_value(registers_, step_.operands[i], wide_);
  }
  void set(std::size_t i, std::int32_t value) { write_value(registers_, step_.operands[i], wide_, value); }
  [[nodiscard]] float real(std::size_t i) const { return read_float(registers_, step_.operands[i]); }
  [[nodiscard]] int number(std::size_t i) const { return step_.operands[i].number; }
  [[nodiscard]] bool wide() const { return wide_; }
  [[nodiscard]] Registers& registers() const { return registers_; }

  /// A sum or a difference: wraps, and the flags say so.
  void set_sum(std::size_t i, std::int64_t sum) {
    registers_.m[borrow_flag] = sum < smallest(wide_);
    registers_.m[carry_flag] = sum > largest(wide_);
    const auto wrapped = static_cast<std::int32_t>(static_cast<std::uint32_t>(sum));
    set(i, wrapped);
    registers_.m[zero_flag] = value(i) == 0;
  }

  void set_real(std::size_t i, double result) {
    const auto rounded = static_cast<float>(result);
    if (!std::isfinite(rounded)) throw RuntimeError(bad_operand, "the result is no floating-point number");
    registers_.m[zero_flag] = rounded == 0;
    registers_.set_f32(number(i), rounded);
  }

  /// The three devices of CMP and ZCP: exactly one is ON.
  void set_three(std::size_t i, int which) {
    auto device = step_.operands[i];
    for (int n = 0; n < 3; ++n, ++device.number) write_bit(registers_, device, n == which);
  }

  /// K or D that counts devices.
  [[nodiscard]] int count(std::size_t i) const {
    constexpr int most = 512;  // FX
    const int count = read_value(registers_, step_.operands[i], false);
    if (count < 1 || count > most)
      throw RuntimeError(bad_operand, fmt::format("a count of {} is none of 1 to {}", count, most));
    return count;
  }
  void need_words(std::size_t i, int words) const {
    if (number(i) + words > data_words)
      throw RuntimeError(bad_operand,
                         fmt::format("{} words from D{} on go beyond D{}", words, number(i), data_words - 1));
  }

 private:
  Registers& registers_;
  const Step& step_;
  bool wide_;
};

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
  auto& d = call.registers().d;
  const auto from = static_cast<std::size_t>(call.number(0));
  const auto to = static_cast<std::size_t>(call.number(1));
  const auto size = static_cast<std::size_t>(count);
  // Blocks may overlap: nothing is overwritten before it was moved.
  if (to <= from)
    for (std::size_t i = 0; i < size; ++i) d[to + i] = d[from + i];
  else
    for (std::size_t i = size; i-- > 0;) d[to + i] = d[from + i];
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
  else
    apply_words(call, step.op());
}

EcamtbxReport apply_ecamtbx(Registers& registers, const Step& step) {
  const auto& type = step.operands[1];
  // The type is read from the low word: a program may have written it with MOV.
  return run_ecamtbx(registers, step.operands[0].number,
                     read_value(registers, type, type.kind == Kind::constant), step.operands[2].number,
                     step.operands[3].number);
}

void drive_outputs(const Registers& registers, const Step& step, bool powered, Instructions& instructions) {
  const auto number = [&](std::size_t i) { return step.operands[i].number; };
  const auto value = [&](std::size_t i) { return read_value(registers, step.operands[i], step.wide()); };
  if (step.op() == Op::plsv) {
    instructions.plsv(step.number, value(0), number(1), number(2), powered);
  } else if (step.op() == Op::decam) {
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
    instructions.decam(step.number, operands, powered);
  } else {
    instructions.drive(step.number, step.op() == Op::drva, value(0), value(1), number(2), number(3), powered);
  }
}

}  // namespace drycut::devices::lx3vp::il
