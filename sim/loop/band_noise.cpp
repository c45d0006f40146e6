#include "sim/loop/band_noise.hpp"

#include <cmath>
#include <numbers>

#include "base/state_archive.hpp"

namespace drycut::sim::loop {

// A state variable filter by the trapezoidal rule: two integrators, each with its state, so that a band far
// below 1 / step loses no digits, as the coefficients of a direct form would.
//   low-pass   g2 / (s2 + k g s + g2),  k = root 2:  variance for white noise of 1: g (1 + k g) / (k d)
//   band-pass  k g s / (s2 + k g s + g2):            k g / d
// with s = (1 - 1/z) / (1 + 1/z) and d = 1 + k g + g2, from the sum of squares of the response to an impulse.
BandNoise::BandNoise(double low, double high, double step, plants::Random random)
    : random_(random), low_pass_(low <= 0) {
  const double top = std::tan(std::numbers::pi * high * step);
  const double bottom = low_pass_ ? 0 : std::tan(std::numbers::pi * low * step);
  g_ = low_pass_ ? top : std::sqrt(top * bottom);
  k_ = low_pass_ ? std::numbers::sqrt2 : (top - bottom) / g_;
  d_ = 1 + g_ * (g_ + k_);
  gain_ = std::sqrt(low_pass_ ? k_ * d_ / (g_ * (1 + k_ * g_)) : d_ / (k_ * g_));
}

double BandNoise::next() {
  const double in = random_.gaussian() - second_;
  const double middle = (first_ + g_ * in) / d_;
  const double low = second_ + g_ * middle;
  first_ = 2 * middle - first_;
  second_ = 2 * low - second_;
  return gain_ * (low_pass_ ? low : k_ * middle);
}

void BandNoise::visit(StateArchive& archive) { STATE(archive, random_, first_, second_); }

}  // namespace drycut::sim::loop
