#include "devices/plcopen/st/code.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace drycut::devices::plcopen::st {
namespace {

std::uint64_t bits(Cell cell) { return static_cast<std::uint64_t>(cell); }
Cell cell(std::uint64_t value) { return static_cast<Cell>(value); }

/// A rounded number as a whole one; beyond 64 bit the nearest there is, 0 for no number.
std::int64_t whole(double value) {
  constexpr double limit = 9223372036854775808.0;
  if (std::isnan(value)) return 0;
  if (value >= limit) return std::numeric_limits<std::int64_t>::max();
  if (value < -limit) return std::numeric_limits<std::int64_t>::min();
  return static_cast<std::int64_t>(value);
}

/// The same for ULINT and LWORD.
std::uint64_t whole_unsigned(double value) {
  constexpr double limit = 18446744073709551616.0;
  if (std::isnan(value) || value <= 0) return 0;
  return value >= limit ? std::numeric_limits<std::uint64_t>::max() : static_cast<std::uint64_t>(value);
}

Cell whole_in(Basic basic, double value) {
  return is_wide(basic) && value > 0 ? cell(whole_unsigned(value)) : wrapped(basic, whole(value));
}

/// Division towards zero; the one quotient that does not fit wraps.
std::int64_t quotient(std::int64_t a, std::int64_t b) { return b == -1 ? cell(0 - bits(a)) : a / b; }
std::int64_t remainder(std::int64_t a, std::int64_t b) { return b == -1 ? 0 : a % b; }

/// The bits of the number in its type's width.
std::uint64_t in_width(Basic basic, Cell a) {
  const int width = bits_of(basic);
  return width == 64 ? bits(a) : bits(a) & ((std::uint64_t{1} << width) - 1);
}

Cell shifted(Op op, Basic basic, Cell a, Cell count) {
  const int width = bits_of(basic);
  const std::uint64_t value = in_width(basic, a);
  const bool rotates = op == Op::rotate_left || op == Op::rotate_right;
  std::int64_t by = rotates ? count % width : count;
  if (rotates && by < 0) by += width;
  if (rotates && by != 0) {
    const std::int64_t left = op == Op::rotate_left ? by : width - by;
    return wrapped(basic, cell((value << left) | (value >> (width - left))));
  }
  if (by <= 0 && (rotates || by == 0)) return a;
  if (by < 0 || by >= width) return 0;
  return wrapped(basic, cell(op == Op::shift_left ? value << by : value >> by));
}

double real_result(Op op, double a, double b) {
  switch (op) {
    case Op::add_real:
      return a + b;
    case Op::subtract_real:
      return a - b;
    case Op::multiply_real:
      return a * b;
    case Op::divide_real:
      return a / b;
    case Op::negate_real:
      return -a;
    case Op::round_real:
      return a;
    case Op::absolute_real:
      return std::abs(a);
    case Op::square_root:
      return std::sqrt(a);
    case Op::sine:
      return std::sin(a);
    case Op::cosine:
      return std::cos(a);
    case Op::tangent:
      return std::tan(a);
    case Op::arc_sine:
      return std::asin(a);
    case Op::arc_cosine:
      return std::acos(a);
    case Op::arc_tangent:
      return std::atan(a);
    case Op::arc_tangent_2:
      return std::atan2(a, b);
    case Op::exponential:
      return std::exp(a);
    case Op::logarithm:
      return std::log(a);
    case Op::logarithm_10:
      return std::log10(a);
    case Op::power:
      return std::pow(a, b);
    case Op::minimum_real:
      return b < a ? b : a;
    default:
      return a < b ? b : a;  // maximum_real
  }
}

NoResult division_by_zero() { return {"division by 0", "test the divisor before"}; }

/// Of a function that takes what `taken` says only; no number is not taken either.
std::optional<NoResult> outside(std::string_view function, double value, bool takes, std::string_view taken) {
  if (takes) return std::nullopt;
  return NoResult{fmt::format("{} of {}", function, value),
                  fmt::format("it takes {}: test the value before", taken)};
}

}  // namespace

std::optional<NoResult> no_result(Op op, Basic basic, Cell a, Cell b) {
  switch (op) {
    case Op::divide:
    case Op::modulo:
      if (b == 0) return division_by_zero();
      return std::nullopt;
    case Op::divide_real:
    case Op::divide_time:
      if (real_of(b) == 0) return division_by_zero();
      return std::nullopt;
    case Op::square_root:
      return outside("SQRT", real_of(a), real_of(a) >= 0, "0 and more");
    case Op::logarithm:
      return outside("LN", real_of(a), real_of(a) > 0, "more than 0");
    case Op::logarithm_10:
      return outside("LOG", real_of(a), real_of(a) > 0, "more than 0");
    case Op::arc_sine:
      return outside("ASIN", real_of(a), std::abs(real_of(a)) <= 1, "-1 to 1");
    case Op::arc_cosine:
      return outside("ACOS", real_of(a), std::abs(real_of(a)) <= 1, "-1 to 1");
    case Op::power:
      if (std::isfinite(rounded(basic, std::pow(real_of(a), real_of(b))))) return std::nullopt;
      return NoResult{fmt::format("{} to the power of {} is no finite number", real_of(a), real_of(b)),
                      "test both before"};
    case Op::exponential:
      if (std::isfinite(rounded(basic, std::exp(real_of(a))))) return std::nullopt;
      return NoResult{fmt::format("EXP of {} is no finite number", real_of(a)), "test the value before"};
    default:
      return std::nullopt;
  }
}

Cell apply(Op op, Basic basic, Cell a, Cell b) {
  switch (op) {
    case Op::add:
      return wrapped(basic, cell(bits(a) + bits(b)));
    case Op::subtract:
      return wrapped(basic, cell(bits(a) - bits(b)));
    case Op::multiply:
      return wrapped(basic, cell(bits(a) * bits(b)));
    case Op::divide:
      return is_wide(basic) ? cell(bits(a) / bits(b)) : wrapped(basic, quotient(a, b));
    case Op::modulo:
      return is_wide(basic) ? cell(bits(a) % bits(b)) : wrapped(basic, remainder(a, b));
    case Op::negate:
      return wrapped(basic, cell(0 - bits(a)));
    case Op::scale_time:
      return wrapped(basic, whole(std::nearbyint(static_cast<double>(a) * real_of(b))));
    case Op::divide_time:
      return wrapped(basic, whole(std::nearbyint(static_cast<double>(a) / real_of(b))));
    case Op::bit_and:
      return a & b;
    case Op::bit_or:
      return a | b;
    case Op::bit_xor:
      return a ^ b;
    case Op::bit_not:
      return wrapped(basic, ~a);
    case Op::equal:
      return a == b ? 1 : 0;
    case Op::not_equal:
      return a != b ? 1 : 0;
    case Op::less:
      return a < b ? 1 : 0;
    case Op::less_equal:
      return a <= b ? 1 : 0;
    case Op::greater:
      return a > b ? 1 : 0;
    case Op::greater_equal:
      return a >= b ? 1 : 0;
    case Op::equal_real:
      return real_of(a) == real_of(b) ? 1 : 0;
    case Op::not_equal_real:
      return real_of(a) != real_of(b) ? 1 : 0;
    case Op::less_real:
      return real_of(a) < real_of(b) ? 1 : 0;
    case Op::less_equal_real:
      return real_of(a) <= real_of(b) ? 1 : 0;
    case Op::greater_real:
      return real_of(a) > real_of(b) ? 1 : 0;
    case Op::greater_equal_real:
      return real_of(a) >= real_of(b) ? 1 : 0;
    case Op::shift_left:
    case Op::shift_right:
    case Op::rotate_left:
    case Op::rotate_right:
      return shifted(op, basic, a, b);
    case Op::wrap:
      return wrapped(basic, a);
    case Op::to_real:
      return cell_of(rounded(basic, static_cast<double>(a)));
    case Op::unsigned_to_real:
      return cell_of(rounded(basic, static_cast<double>(bits(a))));
    case Op::to_whole:
      return whole_in(basic, std::nearbyint(real_of(a)));
    case Op::truncate:
      return whole_in(basic, std::trunc(real_of(a)));
    case Op::seconds_of_day:
      return a % 86400;
    case Op::nonzero:
      return a != 0 ? 1 : 0;
    case Op::nonzero_real:
      return real_of(a) != 0 ? 1 : 0;
    case Op::absolute:
      return a < 0 && !is_wide(basic) ? wrapped(basic, cell(0 - bits(a))) : a;
    case Op::minimum:
      return is_wide(basic) ? cell(std::min(bits(a), bits(b))) : std::min(a, b);
    case Op::maximum:
      return is_wide(basic) ? cell(std::max(bits(a), bits(b))) : std::max(a, b);
    default:
      return cell_of(rounded(basic, real_result(op, real_of(a), real_of(b))));
  }
}

}  // namespace drycut::devices::plcopen::st
