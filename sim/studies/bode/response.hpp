#pragma once
#include <complex>
#include <cstdint>
#include <optional>
#include <vector>

namespace drycut::sim::studies {

// The frequency response of a closed loop as numbers, without a machine: correlation and margins.

/// One frequency's share of a signal, found by correlation over a whole number of its periods: exact for a
/// sine, blind to the mean and to whole multiples.
class Correlator {
 public:
  /// For `cycles` periods in `samples` samples, 0 < 2 cycles <= samples.
  Correlator(std::int64_t cycles, std::int64_t samples) : cycles_(cycles), samples_(samples) {}
  /// The next sample; exactly `samples` of them make a measurement.
  void add(double value);
  /// Amplitude and phase against a cosine that begins with the measurement.
  [[nodiscard]] std::complex<double> tone() const;
  /// Standard error of tone() relative to it, if what else is in the signal were white noise; infinite where
  /// there is no tone.
  [[nodiscard]] double error() const;

 private:
  std::int64_t cycles_;
  std::int64_t samples_;
  std::int64_t taken_ = 0;
  std::complex<double> sum_;
  double total_ = 0;
  double squares_ = 0;
};

/// The cosine of `cycles` periods in `samples` samples at sample `k`.
double cosine_at(std::int64_t cycles, std::int64_t samples, std::int64_t k);

/// What was measured at one frequency.
struct BodePoint {
  double frequency = 0;                       ///< [Hz]
  std::complex<double> open_loop;             ///< L: controller's output over what it answers, sign turned
  std::optional<std::complex<double>> speed;  ///< motor speed over volts at the drive [unit of speed / V]
  double error = 0;                           ///< standard error of open_loop, relative
  /// What the error may change of the distance of L to -1, relative: a loop is judged by that distance, and
  /// where L is small its error is of no account.
  [[nodiscard]] double doubt() const { return error * std::abs(closed_loop()); }
  bool saturated = false;  ///< the output stood at +-10 V
  bool silent = false;     ///< the output stood still: nothing is known of L
  double quantum = 0;      ///< smallest change of the output that was seen [V]; 0 = none
  /// L / (1 + L): the position loop closed.
  [[nodiscard]] std::complex<double> closed_loop() const { return open_loop / (1.0 + open_loop); }
  /// 1 / (1 + L): what the loop leaves of a disturbance.
  [[nodiscard]] std::complex<double> sensitivity() const { return 1.0 / (1.0 + open_loop); }
};

double decibels(std::complex<double> gain);
/// Phases [deg], continuous over the points; the first lies in (-270, 90].
std::vector<double> phases(const std::vector<std::complex<double>>& responses);

/// A value found at a frequency between two points.
struct AtFrequency {
  double frequency = 0;  ///< [Hz]
  double value = 0;
};

/// What a loop is judged by; absent: not met between the first and the last frequency.
struct Margins {
  std::optional<AtFrequency> phase;        ///< the smallest, at a crossover |L| = 1 [deg]
  std::optional<AtFrequency> gain;         ///< smallest factor of gain that makes the loop unstable [dB]
  std::optional<AtFrequency> gain_down;    ///< the same for less gain, below 0 [dB]
  std::optional<AtFrequency> sensitivity;  ///< largest |1 / (1 + L)|, a factor; 1 / the distance of L to -1
  std::optional<double> closed_bandwidth;  ///< position loop at -3 dB [Hz]
  std::optional<double> speed_bandwidth;   ///< speed loop at -3 dB of its gain at the first frequency [Hz]
};

/// Between the points gains are taken as straight lines of dB, phases of degrees, over the logarithm of the
/// frequency. Points in ascending order of frequency; silent ones do not count.
Margins margins_of(const std::vector<BodePoint>& points);

}  // namespace drycut::sim::studies
