#include "sim/studies/bode/response.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace drycut::sim::studies {

namespace {

// Half power.
const double three_decibels = 10 * std::log10(2.0);

double angle_at(std::int64_t cycles, std::int64_t samples, std::int64_t k) {
  const auto rest = static_cast<double>(cycles * (k % samples) % samples);
  return 2 * std::numbers::pi * rest / static_cast<double>(samples);
}

/// Between two points: the frequency at `share` of the way on a logarithmic axis.
double frequency_between(double low, double high, double share) { return low * std::pow(high / low, share); }

/// The first frequency at which `gains` [dB] fall through `level`.
std::optional<double> falls_through(const std::vector<BodePoint>& points, const std::vector<double>& gains,
                                    double level) {
  for (std::size_t i = 1; i < gains.size(); ++i) {
    if (!(gains[i - 1] >= level && gains[i] < level)) continue;
    const double share = (gains[i - 1] - level) / (gains[i - 1] - gains[i]);
    return frequency_between(points[i - 1].frequency, points[i].frequency, share);
  }
  return {};
}

/// The smallest distance of the phase from -180 deg (mod 360) at any |L| = 1.
std::optional<AtFrequency> phase_margin(const std::vector<BodePoint>& points,
                                        const std::vector<double>& gains, const std::vector<double>& angles) {
  std::optional<AtFrequency> least;
  for (std::size_t i = 1; i < gains.size(); ++i) {
    if ((gains[i - 1] >= 0) == (gains[i] >= 0)) continue;
    const double share = gains[i - 1] / (gains[i - 1] - gains[i]);
    const double angle = angles[i - 1] + share * (angles[i] - angles[i - 1]);
    const double margin = std::remainder(180 + angle, 360);
    if (!least || std::abs(margin) < std::abs(least->value))
      least = {frequency_between(points[i - 1].frequency, points[i].frequency, share), margin};
  }
  return least;
}

/// Looks at every passage of the phase through -180 deg (mod 360).
void find_gain_margins(const std::vector<BodePoint>& points, const std::vector<double>& gains,
                       const std::vector<double>& angles, Margins& margins) {
  // At half the sampling frequency L is real: the phase reaches -180 deg there and goes no further.
  constexpr double reached = 0.01;
  for (std::size_t i = 1; i < gains.size(); ++i) {
    const auto half_turns = [&](double angle) { return std::floor((angle + 180 - reached) / 360); };
    const double before = half_turns(angles[i - 1]);
    const double after = half_turns(angles[i]);
    if (before == after) continue;
    const double level = std::max(before, after) * 360 - 180;
    const double share = std::clamp((angles[i - 1] - level) / (angles[i - 1] - angles[i]), 0.0, 1.0);
    const AtFrequency found = {frequency_between(points[i - 1].frequency, points[i].frequency, share),
                               -(gains[i - 1] + share * (gains[i] - gains[i - 1]))};
    auto& margin = found.value >= 0 ? margins.gain : margins.gain_down;
    if (!margin || std::abs(found.value) < std::abs(margin->value)) margin = found;
  }
}

}  // namespace

double cosine_at(std::int64_t cycles, std::int64_t samples, std::int64_t k) {
  return std::cos(angle_at(cycles, samples, k));
}

void Correlator::add(double value) {
  sum_ += value * std::polar(1.0, -angle_at(cycles_, samples_, taken_++));
  total_ += value;
  squares_ += value * value;
}

std::complex<double> Correlator::tone() const {
  const double share = 2 * cycles_ == samples_ ? 1 : 2;
  return sum_ * (share / static_cast<double>(samples_));
}

double Correlator::error() const {
  const auto count = static_cast<double>(samples_);
  const double power = std::norm(tone()) / (2 * cycles_ == samples_ ? 1 : 2);
  const double mean = total_ / count;
  const double rest = std::max(0.0, squares_ / count - mean * mean - power);
  return power > 0 ? std::sqrt(rest / power / count) : std::numeric_limits<double>::infinity();
}

double decibels(std::complex<double> gain) { return 20 * std::log10(std::abs(gain)); }

std::vector<double> phases(const std::vector<std::complex<double>>& responses) {
  std::vector<double> angles;
  for (const auto& response : responses) {
    double angle = std::arg(response) * 180 / std::numbers::pi;
    // A loop begins at -90 deg for an integrator, at -180 deg for two.
    const double near = angles.empty() ? -90 : angles.back();
    angle -= 360 * std::round((angle - near) / 360);
    angles.push_back(angle);
  }
  return angles;
}

Margins margins_of(const std::vector<BodePoint>& all) {
  std::vector<BodePoint> points;
  std::copy_if(all.begin(), all.end(), std::back_inserter(points), [](const auto& p) { return !p.silent; });
  std::vector<std::complex<double>> open;
  std::vector<double> gains;
  std::vector<double> closed;
  std::vector<double> speed;
  Margins margins;
  for (const auto& point : points) {
    open.push_back(point.open_loop);
    gains.push_back(decibels(point.open_loop));
    closed.push_back(decibels(point.closed_loop()));
    if (point.speed) speed.push_back(decibels(*point.speed));
    const double left = std::abs(point.sensitivity());
    if (!margins.sensitivity || left > margins.sensitivity->value)
      margins.sensitivity = {point.frequency, left};
  }
  const auto angles = phases(open);
  margins.phase = phase_margin(points, gains, angles);
  find_gain_margins(points, gains, angles, margins);
  margins.closed_bandwidth = falls_through(points, closed, -three_decibels);
  if (!speed.empty() && speed.size() == points.size())
    margins.speed_bandwidth = falls_through(points, speed, speed.front() - three_decibels);
  return margins;
}

}  // namespace drycut::sim::studies
