#pragma once
#include <array>
#include <cstdint>

namespace drycut::devices::axis {

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

 private:
  std::int64_t bits_ = 0;
  int elapsed_ms_ = 0;
  double bits_per_second_ = 0;
};

}  // namespace drycut::devices::axis
