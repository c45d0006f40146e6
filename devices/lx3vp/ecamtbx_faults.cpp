// What ECAMTBX tells about parameters that make no table, with the numbers and registers at hand.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "devices/lx3vp/ecamtbx_registers.hpp"

namespace drycut::devices::lx3vp {

namespace {

/// "P3 (D504) is 9400".
template <typename Value>
std::string is(std::span<const EcamtbxWord> words, int list, int offset, Value value) {
  const auto word = std::find_if(words.begin(), words.end(),
                                 [&](const EcamtbxWord& candidate) { return candidate.offset == offset; });
  return fmt::format("{} (D{}) is {}", word->number, list + offset, value);
}

class SawFault {
 public:
  SawFault(const SawParameters& parameters, EcamType type, int list)
      : p_(parameters), type_(type), list_(list) {}

  [[nodiscard]] std::string text(EcamError error) const {
    if (auto slip = integer_for_float(); !slip.empty()) return slip;
    switch (error) {
      case EcamError::type:
        return wrong_type();
      case EcamError::length:
        return wrong_length();
      case EcamError::sync_zone:
        return wrong_sync_zone();
      case EcamError::ratio:
        return wrong_ratio();
      case EcamError::resolution:
        return wrong_resolution();
      case EcamError::number:
        return fmt::format("{} and {}; write ratios above 0", p4(), p5());
      default:
        return std::string(error_text(error));
    }
  }

 private:
  template <typename Value>
  [[nodiscard]] std::string is(int offset, Value value) const {
    return lx3vp::is(saw_words(), list_, offset, value);
  }
  [[nodiscard]] std::string p1() const { return is(saw_word::master_length, p_.master_length); }
  [[nodiscard]] std::string p2() const { return is(saw_word::slave_length, p_.slave_length); }
  [[nodiscard]] std::string p3() const { return is(saw_word::sync_length, p_.sync_length); }
  [[nodiscard]] std::string p4() const { return is(saw_word::sync_ratio, p_.sync_ratio); }
  [[nodiscard]] std::string p5() const { return is(saw_word::max_ratio, p_.max_ratio); }
  [[nodiscard]] double slave() const { return std::abs(static_cast<double>(p_.slave_length)); }
  [[nodiscard]] double k() const { return static_cast<double>(p_.sync_ratio); }

  /// DMOV K2 in place of DEMOV E2: as a float an integer is next to nothing, a negative one no number.
  [[nodiscard]] std::string integer_for_float() const {
    constexpr std::int32_t as_float = 1 << 23;  // from here on it could be meant as one
    for (const auto& [offset, value] :
         {std::pair{saw_word::sync_ratio, p_.sync_ratio}, std::pair{saw_word::max_ratio, p_.max_ratio}}) {
      const auto bits = std::bit_cast<std::int32_t>(value);
      if (bits != 0 && bits > -as_float && bits < as_float)
        return fmt::format("{}, a float that looks like the integer {}; write DEMOV E{}.0 D{}",
                           is(offset, value), bits, bits, list_ + offset);
    }
    return "";
  }
  [[nodiscard]] std::string wrong_type() const {
    constexpr int last_law = 2;
    if (p_.acceleration > last_law)
      return is(saw_word::acceleration, p_.acceleration) + "; write 0, 1 or 2 for the acceleration";
    return is(saw_word::curve, p_.curve) + "; write 0, 1, 2, 3 or 5 for the cam curve, plus H1000 backwards";
  }
  [[nodiscard]] std::string wrong_length() const {
    if (p_.master_length <= 0) return p1() + "; write a master length above 0";
    if (p_.slave_length == 0) return p2() + "; write a slave length other than 0";
    if (p_.sync_length < 0) return p3() + "; write 0 or more";
    if (type_ == EcamType::fly_saw && p_.master_length > std::numeric_limits<std::int32_t>::max() / 2)
      return p1() + "; both strokes go beyond 32 bits, write 1073741823 at most";
    return p2() + ", which does not fit 32 bits the other way round";
  }
  [[nodiscard]] std::string wrong_sync_zone() const {
    if (p_.sync_length > slave())
      return fmt::format("{}: the synchronous zone is longer than the slave, {}", p3(), p2());
    const double least = type_ == EcamType::fly_saw
                             ? (p_.acceleration == 0 ? slave() : 2 * slave() - p_.sync_length) / k()
                             : p_.sync_length / k();
    return fmt::format("{}, but {} takes {} master pulses ({}, {}, {})", p1(),
                       type_ == EcamType::fly_saw ? "a stroke" : "the synchronous zone alone",
                       std::ceil(least), p2(), p3(), p4());
  }
  [[nodiscard]] std::string wrong_ratio() const {
    if (p_.max_ratio < p_.sync_ratio) return fmt::format("{}, less than {}", p5(), p4());
    return fmt::format(
        "{}, but the cycle needs more: outside the synchronous zone the mean ratio is {:.6g} "
        "({}, {}, {}, {})",
        p5(), (slave() - p_.sync_length) / (p_.master_length - p_.sync_length / k()), p1(), p2(), p3(), p4());
  }
  [[nodiscard]] std::string wrong_resolution() const {
    const auto rows = is(saw_word::resolution, p_.resolution);
    if (p_.resolution != 0 && (p_.resolution < 10 || p_.resolution > 512))
      return rows + "; write 0 (automatic) or 10 to 512";
    return fmt::format("{}: a ramp gets no row of its own; give more rows, or ramps of some pulses ({})",
                       rows, p1());
  }

  SawParameters p_;
  EcamType type_;
  int list_;
};

std::string s_curve_fault(const SCurveParameters& p, EcamError error, int list) {
  const auto is = [&](int offset, auto value) { return lx3vp::is(s_curve_words(), list, offset, value); };
  switch (error) {
    case EcamError::length:
      if (p.length == 0) return is(s_curve_word::length, 0) + "; write a way other than 0";
      return fmt::format("{} and {}: the cycle takes longer than 2147483647 x 100 us",
                         is(s_curve_word::length, p.length), is(s_curve_word::top_speed, p.top_speed));
    case EcamError::resolution:
      if (p.resolution < 51 || p.resolution > 512)
        return is(s_curve_word::resolution, p.resolution) + "; write 51 to 512";
      return is(s_curve_word::resolution, p.resolution) +
             ": a ramp gets no row of its own; give the ramps more time";
    case EcamError::speed:
      if (p.top_speed < 1 || p.top_speed > 150'000)
        return is(s_curve_word::top_speed, p.top_speed) + "; write 1 to 150000 Hz";
      if (p.acceleration < 0) return is(s_curve_word::acceleration, p.acceleration) + "; write 0 to 32767 ms";
      return is(s_curve_word::deceleration, p.deceleration) + "; write 0 to 32767 ms";
    default:
      return std::string(error_text(error));
  }
}

}  // namespace

std::string ecamtbx_fault(const Registers& registers, int list, std::int32_t type, EcamError error) {
  const auto kind = static_cast<EcamType>(type);
  switch (kind) {
    case EcamType::s_curve_0:
    case EcamType::s_curve_1:
      return s_curve_fault(read_s_curve_parameters(registers, list), error, list);
    case EcamType::rotary_saw:
    case EcamType::fly_saw:
      return SawFault(read_saw_parameters(registers, list), kind, list).text(error);
  }
  return fmt::format("the type is {}; write K0, K1, K100 or K101", type);
}

}  // namespace drycut::devices::lx3vp
