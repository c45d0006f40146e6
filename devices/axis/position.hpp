#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace drycut {
class StateArchive;
}

namespace drycut::devices::axis {

/// Resolution of an axis: `measure` Um while the transducer gives `pulse` bits x4 (spec qem.md 1.2). EPICPOS
/// and its kin have measure = cntratio and pulse = 400000 (1.3).
struct Resolution {
  std::int64_t measure = 1;  ///< [Um]
  std::int64_t pulse = 1;    ///< [bits x4]
  bool operator==(const Resolution&) const = default;
  void visit(StateArchive& archive);
};

/// A resolution that can be computed with, whatever was written into the parameters: values outside 1..2^30
/// act as the nearest of the two.
inline Resolution usable(std::int64_t measure, std::int64_t pulse) {
  constexpr std::int64_t most = std::int64_t{1} << 30;
  return {std::clamp<std::int64_t>(measure, 1, most), std::clamp<std::int64_t>(pulse, 1, most)};
}

/// a + b*c that wraps where a counter of absurd size would overflow.
inline std::int64_t multiply_add(std::int64_t a, std::int64_t b, std::int64_t c) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) +
                                   static_cast<std::uint64_t>(b) * static_cast<std::uint64_t>(c));
}

/// a - b that wraps likewise.
inline std::int64_t difference(std::int64_t a, std::int64_t b) { return multiply_add(a, b, -1); }

/// The whole bits of a way, without what is below one bit; held at +-1e15, further than any quota can be.
inline std::int64_t whole_bits(double way) { return static_cast<std::int64_t>(std::clamp(way, -1e15, 1e15)); }

/// What a device makes of a hardware counter: bits x4 counted since INIT, with lock and reversal (CNTLOCK,
/// CNTREV). The total never jumps, so motion is computed in it; quotas are kept beside it (Quota).
class Transducer {
 public:
  /// Starts from the hardware count `raw` without counting.
  void rebase(std::int64_t raw) { last_ = raw; }
  /// Follows the hardware count; returns the bits x4 counted.
  std::int64_t follow(std::int64_t raw, bool locked, bool reversed) {
    const std::int64_t moved = locked ? 0 : reversed ? difference(last_, raw) : difference(raw, last_);
    last_ = raw;
    total_ = multiply_add(total_, moved, 1);
    return moved;
  }
  [[nodiscard]] std::int64_t total() const { return total_; }
  /// The total that belongs to a hardware count of the recent past, such as a latched one.
  [[nodiscard]] std::int64_t total_at(std::int64_t raw, bool locked, bool reversed) const {
    return locked ? total_ : multiply_add(total_, difference(raw, last_), reversed ? -1 : 1);
  }
  void visit(StateArchive& archive);

 private:
  std::int64_t last_ = 0;
  std::int64_t total_ = 0;
};

/// A position as programs see it, exact: a whole number of 1/pulse Um (spec 1.2, 1.4).
class Quota {
 public:
  void count(std::int64_t bits, Resolution r) { numerator_ = multiply_add(numerator_, bits, r.measure); }
  /// Adds a whole number of 1/pulse Um; keeps the remainder (DELCNT, cam updates).
  void shift(std::int64_t numerator) { numerator_ = multiply_add(numerator_, numerator, 1); }
  void add_um(std::int64_t um, Resolution r) { numerator_ = multiply_add(numerator_, um, r.pulse); }
  /// Exactly `um`.000: the remainder is dropped.
  void set_um(std::int64_t um, Resolution r) { numerator_ = multiply_add(0, um, r.pulse); }
  void set_bits(std::int64_t bits, Resolution r) { numerator_ = multiply_add(0, bits, r.measure); }
  /// A resolution other than `now`, which it becomes, keeps the quota [Um] and drops the remainder.
  void rescale(Resolution& now, Resolution to) {
    if (to != now) set_um(um(now), to);
    now = to;
  }

  /// [Um], truncated toward zero.
  [[nodiscard]] std::int64_t um(Resolution r) const { return numerator_ / r.pulse; }
  /// [bits x4], to the nearest; each count moves it by one.
  [[nodiscard]] std::int64_t bits(Resolution r) const {
    const std::int64_t n = multiply_add(numerator_, r.measure / 2, 1);
    return n / r.measure - (n % r.measure < 0 ? 1 : 0);
  }
  [[nodiscard]] std::int64_t numerator() const { return numerator_; }
  /// Way from here to the quota `um` [bits x4].
  [[nodiscard]] double bits_to(std::int64_t um, Resolution r) const {
    return static_cast<double>(difference(multiply_add(0, um, r.pulse), numerator_)) /
           static_cast<double>(r.measure);
  }
  void visit(StateArchive& archive);

 private:
  std::int64_t numerator_ = 0;
};

/// A theoretical position in the total of a transducer [bits x4]: whole bits and a part of -1..1, so that it
/// stays exact to far below 1e-6 bit however far the axis has run.
struct Theoretical {
  std::int64_t whole = 0;
  double part = 0;

  void add(double bits) {
    part += bits;
    const std::int64_t carry = whole_bits(part);
    whole = multiply_add(whole, carry, 1);
    part = std::clamp(part - static_cast<double>(carry), -1.0, 1.0);
  }
  /// This minus `total` [bits x4].
  [[nodiscard]] double minus(std::int64_t total) const {
    return static_cast<double>(difference(whole, total)) + part;
  }
  [[nodiscard]] double minus(const Theoretical& other) const {
    return static_cast<double>(difference(whole, other.whole)) + (part - other.part);
  }
  void visit(StateArchive& archive);
};

/// Um/s of one unit of a speed parameter: whole units of measure per second or minute (spec 1.5).
/// decpt 0..3, others taken as the nearest; unitvel 1 = per second, else per minute.
inline double um_per_second(std::int32_t decpt, std::int32_t unitvel) {
  constexpr std::array<double, 4> powers = {1, 10, 100, 1000};
  const double um = powers[static_cast<std::size_t>(std::clamp(decpt, 0, 3))];
  return unitvel == 1 ? um : um / 60;
}

/// Bits x4 of one Um.
inline double bits_per_um(Resolution r) {
  return static_cast<double>(r.pulse) / static_cast<double>(r.measure);
}

/// A value as a 32-bit variable shows it: nearest, held at the ends of the range.
inline std::int32_t to_long(double value) {
  constexpr double limit = 2147483647.0;
  if (!(value > -limit)) return -2147483647;
  if (value >= limit) return 2147483647;
  return static_cast<std::int32_t>(value < 0 ? value - 0.5 : value + 0.5);
}

/// Measuring window of the time base `tbf` 0..3 [ms] (spec 1.7, 000 1.9.2); other values count as 0.
inline int frequency_window_ms(std::int32_t tbf) {
  constexpr std::array<int, 4> windows = {240, 480, 24, 120};
  return windows[tbf >= 0 && tbf <= 3 ? static_cast<std::size_t>(tbf) : 0];
}

/// Counts bits x4 over a window; the rate changes at the window's end only.
class FrequencyMeter {
 public:
  /// One sample of `period_ms` in which `bits` x4 were counted; true when a window ended.
  bool sample(std::int64_t bits, int period_ms, int window_ms) {
    bits_ += bits;
    elapsed_ms_ += period_ms;
    if (elapsed_ms_ < window_ms) return false;
    const auto counted = static_cast<double>(bits_ < 0 ? -bits_ : bits_);
    bits_per_second_ = counted * 1000.0 / elapsed_ms_;
    bits_ = 0;
    elapsed_ms_ = 0;
    return true;
  }
  /// Magnitude of the rate over the last whole window [bits x4/s]; one phase has a quarter of it [Hz].
  [[nodiscard]] double bits_per_second() const { return bits_per_second_; }
  void visit(StateArchive& archive);

 private:
  std::int64_t bits_ = 0;
  int elapsed_ms_ = 0;
  double bits_per_second_ = 0;
};

}  // namespace drycut::devices::axis
