#pragma once
#include <fmt/format.h>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp::il {

/// An error of an instruction while it runs (D8067).
struct IlError : std::runtime_error {
  IlError(int number, const std::string& text) : std::runtime_error(text), code(number) {}
  int code;
};
/// FX: more than five subroutines call each other.
inline constexpr int calls_too_deep = 6702;
/// FX: an operand's value or device number is out of its range.
inline constexpr int bad_operand = 6706;

/// ON or OFF of a contact.
bool read_bit(const Registers& registers, const Operand& operand);
/// Switches a bit; of timers and counters the contact.
void write_bit(Registers& registers, const Operand& operand, bool on);
/// RST: OFF, or 0.
void reset(Registers& registers, const Operand& device);

/// A number as the instruction sees it: sign-extended 16 bit, or 32 bit.
std::int32_t read_value(const Registers& registers, const Operand& operand, bool wide);
/// Stores the low 16 bit of `value`, or all 32.
void write_value(Registers& registers, const Operand& operand, bool wide, std::int32_t value);

/// Throws if the table has a range for an operand and its number is not in it.
void need_in_range(const Step& step, std::size_t operand, std::int32_t number);

/// Adds the operand's index register to its number, of a constant to its value: V or Z, of a 32-bit
/// instruction V and Z. The number may then be of no device.
void apply_index(const Registers& registers, Operand& operand, bool wide);

/// A floating-point operand: E, D, or a whole number K or H.
float read_float(const Registers& registers, const Operand& operand);

inline constexpr int zero_flag = 8020;    ///< M8020: the result is 0
inline constexpr int borrow_flag = 8021;  ///< M8021: below the smallest number
inline constexpr int carry_flag = 8022;   ///< M8022: above the largest

/// Narrowest and widest number of an instruction.
inline std::int64_t smallest(bool wide) {
  return wide ? std::numeric_limits<std::int32_t>::min() : std::numeric_limits<std::int16_t>::min();
}
inline std::int64_t largest(bool wide) {
  return wide ? std::numeric_limits<std::int32_t>::max() : std::numeric_limits<std::int16_t>::max();
}

/// The operands of a step as it is executed.
class Call {
 public:
  Call(Registers& registers, const Step& step) : registers_(registers), step_(step), wide_(step.wide()) {}

  [[nodiscard]] std::int32_t value(std::size_t i) const {
    return read_value(registers_, step_.operands[i], wide_);
  }
  [[nodiscard]] std::int64_t long_value(std::size_t i) const { return value(i); }
  [[nodiscard]] std::uint32_t bits(std::size_t i) const { return static_cast<std::uint32_t>(value(i)); }
  void set(std::size_t i, std::int32_t value) { write_value(registers_, step_.operands[i], wide_, value); }
  void set_bits(std::size_t i, std::uint32_t bits) { set(i, static_cast<std::int32_t>(bits)); }
  [[nodiscard]] float real(std::size_t i) const { return read_float(registers_, step_.operands[i]); }
  /// The same, which has to be a number.
  [[nodiscard]] double finite(std::size_t i) const {
    const auto value = static_cast<double>(real(i));
    if (!std::isfinite(value)) throw IlError(bad_operand, "an operand is no floating-point number");
    return value;
  }
  [[nodiscard]] int number(std::size_t i) const { return step_.operands[i].number; }
  [[nodiscard]] bool wide() const { return wide_; }
  [[nodiscard]] Registers& registers() const { return registers_; }
  [[nodiscard]] const Operand& operand(std::size_t i) const { return step_.operands[i]; }
  [[nodiscard]] bool flag(int number) const { return registers_.m[static_cast<std::size_t>(number)]; }
  void set_flag(int number, bool on) { registers_.m[static_cast<std::size_t>(number)] = on; }

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
    if (!std::isfinite(rounded)) throw IlError(bad_operand, "the result is no floating-point number");
    registers_.m[zero_flag] = rounded == 0;
    registers_.set_f32(number(i), rounded);
  }

  /// The three devices of CMP: above, equal, below.
  template <typename Number>
  void set_order(std::size_t i, Number a, Number b) {
    set_three(i, a > b ? 0 : a == b ? 1 : 2);
  }
  /// The three devices of ZCP: below, within, above.
  template <typename Number>
  void set_zone(std::size_t i, Number value, Number low, Number high) {
    set_three(i, value < low ? 0 : value > high ? 2 : 1);
  }

  /// A number that the table has a range for.
  [[nodiscard]] std::int32_t ranged(std::size_t i) const;
  /// The n-th value of an operand that stands for several, which has to be there: `need_values`.
  [[nodiscard]] Operand nth(std::size_t i, int n) const {
    Operand value = operand(i);
    value.number += n * stride_of(value, wide_);
    return value;
  }
  void need_values(std::size_t i, int count) const;

 private:
  /// Exactly one of three devices is ON.
  void set_three(std::size_t i, int which) {
    auto device = step_.operands[i];
    for (int n = 0; n < 3; ++n, ++device.number) write_bit(registers_, device, n == which);
  }

  Registers& registers_;
  const Step& step_;
  bool wide_;
};

}  // namespace drycut::devices::lx3vp::il
