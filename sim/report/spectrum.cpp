#include "sim/report/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace drycut::sim::report {

namespace {

constexpr std::size_t most_values = 500;  // what is found from them takes a tenth of a second
constexpr std::size_t fewest_values = 10;
constexpr std::size_t shortest_order = 5;
constexpr double other_order = 0.02;  // of the value
constexpr double per_resolution = 4;  // frequencies for each that the values can tell apart
constexpr std::size_t most_frequencies = 40000;
constexpr std::size_t most_peaks = 4;
constexpr double by_chance = 1e-3;
constexpr double least_share = 1e-3;  // of the variance: less is nobody's concern
constexpr double fits_as_well = 0.9;  // share of a sine's variance

double variance_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// Takes the mean of each order off.
void level(std::vector<double>& values, const std::vector<std::size_t>& orders, std::size_t order_count) {
  std::vector<double> sums(order_count);
  std::vector<double> counts(order_count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    sums[orders[i]] += values[i];
    counts[orders[i]] += 1;
  }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= sums[orders[i]] / counts[orders[i]];
}

/// a cos + b sin over the places, less the means of the orders.
struct Fit {
  double a = 0;
  double b = 0;
  double variance = 0;  ///< that it takes off
  std::vector<double> cosines;
  std::vector<double> sines;
};

/// `fit` keeps its memory from one frequency to the next.
void fit_sine(const SampledValues& of, double frequency, Fit& fit) {
  const auto count = of.places.size();
  fit.cosines.resize(count);
  fit.sines.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * frequency * (of.places[i] - of.places.front());
    fit.cosines[i] = std::cos(angle);
    fit.sines[i] = std::sin(angle);
  }
  level(fit.cosines, of.orders, of.order_count);
  level(fit.sines, of.orders, of.order_count);
  double yc = 0, ys = 0, cc = 0, ss = 0, cs = 0;
  for (std::size_t i = 0; i < count; ++i) {
    yc += of.values[i] * fit.cosines[i];
    ys += of.values[i] * fit.sines[i];
    cc += fit.cosines[i] * fit.cosines[i];
    ss += fit.sines[i] * fit.sines[i];
    cs += fit.cosines[i] * fit.sines[i];
  }
  const double determinant = cc * ss - cs * cs;
  const auto n = static_cast<double>(count);
  fit.a = fit.b = fit.variance = 0;
  // The pieces meet it always in the same phase, or in two: no sine can be told there.
  if (determinant < 1e-3 * n * n) return;
  fit.a = (yc * ss - ys * cs) / determinant;
  fit.b = (ys * cc - yc * cs) / determinant;
  fit.variance = std::max(0.0, (fit.a * yc + fit.b * ys) / n);
}

/// What of the values is that sine.
std::vector<double> part_of(const Fit& fit) {
  std::vector<double> part(fit.cosines.size());
  for (std::size_t i = 0; i < part.size(); ++i) part[i] = fit.a * fit.cosines[i] + fit.b * fit.sines[i];
  return part;
}

/// The highest place between two neighbours of a grid's maximum.
double refined(const SampledValues& of, double low, double high, Fit& fit) {
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 40; ++i) {
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    fit_sine(of, left, fit);
    const double at_left = fit.variance;
    fit_sine(of, right, fit);
    (at_left < fit.variance ? low : high) = at_left < fit.variance ? left : right;
  }
  return (low + high) / 2;
}

/// Looks for one peak after the other, each in what the ones before leave.
class PeakSearch {
 public:
  PeakSearch(const SampledValues& values, const Spectrum& spectrum, const std::vector<double>& known)
      : rest_(values), spectrum_(spectrum), known_(known), total_(variance_of(values.values)) {}

  std::vector<SpectrumPeak> run() {
    std::vector<SpectrumPeak> peaks;
    while (peaks.size() < most_peaks) {
      auto peak = next();
      if (!peak) break;
      peaks.push_back(std::move(*peak));
    }
    return peaks;
  }

 private:
  double step() const { return spectrum_.frequencies[1] - spectrum_.frequencies[0]; }

  std::optional<SpectrumPeak> next() {
    const double before = variance_of(rest_.values);
    if (before == 0) return {};
    double most = 0;
    double where = 0;
    for (const double frequency : spectrum_.frequencies) {
      fit_sine(rest_, frequency, fit_);
      if (fit_.variance <= most) continue;
      most = fit_.variance;
      where = frequency;
    }
    const auto count = static_cast<double>(rest_.places.size());
    const double freedom = count - 2 - static_cast<double>(rest_.order_count);
    const double left = std::max(0.0, 1 - most / before);
    if (where == 0 || most < least_share * total_ || count * std::pow(left, freedom / 2) > by_chance)
      return {};
    where = refined(rest_, std::max(where - step(), step() / 2), where + step(), fit_);
    fit_sine(rest_, where, fit_);
    SpectrumPeak peak;
    peak.sine = {where, std::hypot(fit_.a, fit_.b), fit_.variance / total_};
    auto part = part_of(fit_);
    find_equals(part, peak);
    // A known one that fits as well is what it is; it is exact.
    if (peak.known.size() == 1) {
      const double exact = known_[peak.known.front()];
      peak.others.push_back(where);
      std::erase_if(peak.others, [&](double other) { return std::abs(other - exact) < 2 * step(); });
      std::sort(peak.others.begin(), peak.others.end());
      fit_sine(rest_, exact, fit_);
      part = part_of(fit_);
      peak.sine = {exact, std::hypot(fit_.a, fit_.b), fit_.variance / total_};
    }
    for (std::size_t i = 0; i < part.size(); ++i) rest_.values[i] -= part[i];
    return peak;
  }

  /// Frequencies at which the same sine fits: what is between two pieces nobody sees.
  void find_equals(std::vector<double> sine, SpectrumPeak& peak) {
    SampledValues alone = rest_;
    alone.values = std::move(sine);
    const double all = variance_of(alone.values);
    std::vector<double> shares;
    shares.reserve(spectrum_.frequencies.size());
    for (const double frequency : spectrum_.frequencies) {
      fit_sine(alone, frequency, fit_);
      shares.push_back(fit_.variance / all);
    }
    for (std::size_t i = 1; i + 1 < shares.size(); ++i) {
      const double frequency = spectrum_.frequencies[i];
      const bool top = shares[i] > shares[i - 1] && shares[i] >= shares[i + 1];
      if (top && shares[i] > fits_as_well && std::abs(frequency - peak.sine.frequency) > 2 * step())
        peak.others.push_back(refined(alone, frequency - step(), frequency + step(), fit_));
    }
    for (std::size_t k = 0; k < known_.size(); ++k) {
      fit_sine(alone, known_[k], fit_);
      if (fit_.variance > fits_as_well * all) peak.known.push_back(k);
    }
  }

  SampledValues rest_;
  const Spectrum& spectrum_;
  const std::vector<double>& known_;
  double total_;
  Fit fit_;
};

}  // namespace

SampledValues sampled(const std::vector<double>& numbers, const std::vector<double>& lengths) {
  std::vector<double> places(numbers.size());
  std::vector<std::size_t> orders(numbers.size());
  std::vector<std::size_t> sizes;
  double end = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double length = lengths.empty() ? 1 : lengths[i];
    const bool other = i == 0 || (!lengths.empty() &&
                                  std::abs(length - lengths[i - 1]) > other_order * std::abs(lengths[i - 1]));
    if (other) sizes.push_back(0);
    orders[i] = sizes.size() - 1;
    ++sizes.back();
    places[i] = end + length / 2;
    end += length;
  }
  SampledValues all;
  const auto first = numbers.size() - std::min(numbers.size(), most_values);
  std::size_t last = 0;
  for (auto i = first; i < numbers.size(); ++i) {
    if (sizes[orders[i]] < shortest_order) continue;
    if (all.values.empty() || orders[i] != last) ++all.order_count;
    last = orders[i];
    all.places.push_back(places[i]);
    all.values.push_back(numbers[i]);
    all.orders.push_back(all.order_count - 1);
  }
  level(all.values, all.orders, all.order_count);
  return all;
}

Sine fitted(const SampledValues& values, double frequency) {
  const double all = variance_of(values.values);
  Fit fit;
  if (values.places.size() < fewest_values || all == 0) return {frequency, 0, 0};
  fit_sine(values, frequency, fit);
  return {frequency, std::hypot(fit.a, fit.b), fit.variance / all};
}

Spectrum spectrum_of(const SampledValues& values, double highest, const std::vector<double>& known) {
  Spectrum spectrum;
  if (values.places.size() < fewest_values) return spectrum;
  const double lowest = 1 / (values.places.back() - values.places.front());
  const double step = lowest / per_resolution;
  const auto count =
      std::clamp<std::size_t>(static_cast<std::size_t>((highest - lowest) / step), 2, most_frequencies);
  Fit fit;
  for (std::size_t i = 0; i < count; ++i) {
    spectrum.frequencies.push_back(lowest + static_cast<double>(i) * step);
    fit_sine(values, spectrum.frequencies.back(), fit);
    spectrum.amplitudes.push_back(std::sqrt(2 * fit.variance));
  }
  spectrum.peaks = PeakSearch(values, spectrum, known).run();
  return spectrum;
}

}  // namespace drycut::sim::report
