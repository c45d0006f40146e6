#include "devices/plcopen/st/code.hpp"

#include <algorithm>
#include <bit>
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

Cell shifted(StOp op, Basic basic, Cell a, Cell count) {
  const int width = bits_of(basic);
  const std::uint64_t value = in_width(basic, a);
  const bool rotates = op == StOp::rotate_left || op == StOp::rotate_right;
  std::int64_t by = rotates ? count % width : count;
  if (rotates && by < 0) by += width;
  if (rotates && by != 0) {
    const std::int64_t left = op == StOp::rotate_left ? by : width - by;
    return wrapped(basic, cell((value << left) | (value >> (width - left))));
  }
  if (by <= 0 && (rotates || by == 0)) return a;
  if (by < 0 || by >= width) return 0;
  return wrapped(basic, cell(op == StOp::shift_left ? value << by : value >> by));
}

bool holds_bcd(std::uint64_t digits) {
  for (; digits != 0; digits >>= 4)
    if ((digits & 15) > 9) return false;
  return true;
}

std::uint64_t swapped(std::uint64_t value, int bytes) {
  std::uint64_t result = 0;
  for (int i = 0; i < bytes; ++i, value >>= 8) result = (result << 8) | (value & 255);
  return result;
}

double real_result(StOp op, double a, double b) {
  switch (op) {
    case StOp::add_real:
      return a + b;
    case StOp::subtract_real:
      return a - b;
    case StOp::multiply_real:
      return a * b;
    case StOp::divide_real:
      return a / b;
    case StOp::negate_real:
      return -a;
    case StOp::round_real:
      return a;
    case StOp::absolute_real:
      return std::abs(a);
    case StOp::square_root:
      return std::sqrt(a);
    case StOp::sine:
      return std::sin(a);
    case StOp::cosine:
      return std::cos(a);
    case StOp::tangent:
      return std::tan(a);
    case StOp::arc_sine:
      return std::asin(a);
    case StOp::arc_cosine:
      return std::acos(a);
    case StOp::arc_tangent:
      return std::atan(a);
    case StOp::arc_tangent_2:
      return std::atan2(a, b);
    case StOp::exponential:
      return std::exp(a);
    case StOp::logarithm:
      return std::log(a);
    case StOp::logarithm_10:
      return std::log10(a);
    case StOp::power:
      return std::pow(a, b);
    case StOp::floor:
      return std::floor(a);
    case StOp::ceiling:
      return std::ceil(a);
    case StOp::minimum_real:
      return b < a ? b : a;
    default:
      return a < b ? b : a;  // maximum_real
  }
}

NoResult division_by_zero() {
  return {"st.division-by-zero"_code, "division by 0", "test the divisor before"};
}

/// Of a function that takes what `taken` says only; no number is not taken either.
std::optional<NoResult> outside(std::string_view function, double value, bool takes, std::string_view taken) {
  if (takes) return std::nullopt;
  return NoResult{"st.no-result"_code, fmt::format("{} of {}", function, value),
                  fmt::format("it takes {}: test the value before", taken)};
}

}  // namespace

std::optional<NoResult> no_result(StOp op, Basic basic, Cell a, Cell b) {
  switch (op) {
    case StOp::divide:
    case StOp::modulo:
      if (b == 0) return division_by_zero();
      return std::nullopt;
    case StOp::divide_real:
    case StOp::divide_time:
      if (real_of(b) == 0) return division_by_zero();
      return std::nullopt;
    case StOp::square_root:
      return outside("SQRT", real_of(a), real_of(a) >= 0, "0 and more");
    case StOp::logarithm:
      return outside("LN", real_of(a), real_of(a) > 0, "more than 0");
    case StOp::logarithm_10:
      return outside("LOG", real_of(a), real_of(a) > 0, "more than 0");
    case StOp::arc_sine:
      return outside("ASIN", real_of(a), std::abs(real_of(a)) <= 1, "-1 to 1");
    case StOp::arc_cosine:
      return outside("ACOS", real_of(a), std::abs(real_of(a)) <= 1, "-1 to 1");
    case StOp::power:
      if (std::isfinite(rounded(basic, std::pow(real_of(a), real_of(b))))) return std::nullopt;
      return NoResult{"st.no-result"_code,
                      fmt::format("{} to the power of {} is no finite number", real_of(a), real_of(b)),
                      "test both before"};
    case StOp::exponential:
      if (std::isfinite(rounded(basic, std::exp(real_of(a))))) return std::nullopt;
      return NoResult{"st.no-result"_code, fmt::format("EXP of {} is no finite number", real_of(a)),
                      "test the value before"};
    default:
      return std::nullopt;
  }
}

Cell apply(StOp op, Basic basic, Cell a, Cell b) {
  switch (op) {
    case StOp::add:
      return wrapped(basic, cell(bits(a) + bits(b)));
    case StOp::subtract:
      return wrapped(basic, cell(bits(a) - bits(b)));
    case StOp::multiply:
      return wrapped(basic, cell(bits(a) * bits(b)));
    case StOp::divide:
      return is_wide(basic) ? cell(bits(a) / bits(b)) : wrapped(basic, quotient(a, b));
    case StOp::modulo:
      return is_wide(basic) ? cell(bits(a) % bits(b)) : wrapped(basic, remainder(a, b));
    case StOp::negate:
      return wrapped(basic, cell(0 - bits(a)));
    case StOp::scale_time:
      return wrapped(basic, whole(std::nearbyint(static_cast<double>(a) * real_of(b))));
    case StOp::divide_time:
      return wrapped(basic, whole(std::nearbyint(static_cast<double>(a) / real_of(b))));
    case StOp::bit_and:
      return a & b;
    case StOp::bit_or:
      return a | b;
    case StOp::bit_xor:
      return a ^ b;
    case StOp::bit_not:
      return wrapped(basic, ~a);
    case StOp::equal:
      return a == b ? 1 : 0;
    case StOp::not_equal:
      return a != b ? 1 : 0;
    case StOp::less:
      return a < b ? 1 : 0;
    case StOp::less_equal:
      return a <= b ? 1 : 0;
    case StOp::greater:
      return a > b ? 1 : 0;
    case StOp::greater_equal:
      return a >= b ? 1 : 0;
    case StOp::equal_real:
      return real_of(a) == real_of(b) ? 1 : 0;
    case StOp::not_equal_real:
      return real_of(a) != real_of(b) ? 1 : 0;
    case StOp::less_real:
      return real_of(a) < real_of(b) ? 1 : 0;
    case StOp::less_equal_real:
      return real_of(a) <= real_of(b) ? 1 : 0;
    case StOp::greater_real:
      return real_of(a) > real_of(b) ? 1 : 0;
    case StOp::greater_equal_real:
      return real_of(a) >= real_of(b) ? 1 : 0;
    case StOp::shift_left:
    case StOp::shift_right:
    case StOp::rotate_left:
    case StOp::rotate_right:
      return shifted(op, basic, a, b);
    case StOp::wrap:
      return wrapped(basic, a);
    case StOp::to_real:
      return cell_of(rounded(basic, static_cast<double>(a)));
    case StOp::unsigned_to_real:
      return cell_of(rounded(basic, static_cast<double>(bits(a))));
    case StOp::to_whole:
      return whole_in(basic, std::nearbyint(real_of(a)));
    case StOp::truncate:
      return whole_in(basic, std::trunc(real_of(a)));
    case StOp::seconds_of_day:
      return a % 86400;
    case StOp::bits_to_real:
      if (basic == Basic::lreal) return a;
      return cell_of(static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(a))));
    case StOp::real_to_bits:
      if (basic == Basic::lword) return a;
      return static_cast<Cell>(std::bit_cast<std::uint32_t>(static_cast<float>(real_of(a))));
    case StOp::valid_real:
      return std::isfinite(real_of(a)) ? 1 : 0;
    case StOp::valid_bcd:
      return holds_bcd(bits(a)) ? 1 : 0;
    case StOp::swap_bytes:
      return wrapped(basic, cell(swapped(bits(a), bits_of(basic) / 8)));
    case StOp::nonzero:
      return a != 0 ? 1 : 0;
    case StOp::nonzero_real:
      return real_of(a) != 0 ? 1 : 0;
    case StOp::absolute:
      return a < 0 && !is_wide(basic) ? wrapped(basic, cell(0 - bits(a))) : a;
    case StOp::minimum:
      return is_wide(basic) ? cell(std::min(bits(a), bits(b))) : std::min(a, b);
    case StOp::maximum:
      return is_wide(basic) ? cell(std::max(bits(a), bits(b))) : std::max(a, b);
    default:
      return cell_of(rounded(basic, real_result(op, real_of(a), real_of(b))));
  }
}

}  // namespace drycut::devices::plcopen::st
