#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drycut {
class StateArchive;
}

namespace drycut::sim::scenario {

/// One number about the numbers of a window, which are taken one after the other: checks, metrics and
/// comparisons mean the same by `rms`. Only a percentile keeps the numbers, those of its window: every one of
/// the first `most_kept`, every second one once there are more, then every fourth, and so on.
class RunningStatistic {
 public:
  static constexpr std::size_t most_kept = 1U << 20U;  ///< numbers of a percentile: 8 MB

  /// max, min, mean, rms, sd (of a sample, n - 1), count, settling, or the percentile pNN: p50, p99, p99.9
  /// (linear between the two nearest numbers); nothing if no statistic is called so.
  static std::optional<RunningStatistic> named(std::string_view name);
  /// The names, "pNN" for the percentiles.
  static const std::vector<std::string>& names();

  /// settling: the time [s] from the window's start until |number| stays at or below the band; the whole
  /// window if it never does.
  [[nodiscard]] bool has_band() const { return function_ == Function::settling; }
  void set_band(double band) { band_ = band; }
  /// The unit of the result, if the numbers are in `unit`.
  [[nodiscard]] std::string unit(const std::string& unit) const;

  /// A window begins at a time [s]; what was taken before is forgotten.
  void start(double at);
  /// A number, at a time [s].
  void take(double at, double number);
  /// NaN if there is nothing to look at, too little of it, or one of the numbers was NaN.
  [[nodiscard]] double result() const;
  void visit(StateArchive& archive);

 private:
  enum class Function { max, min, mean, rms, sd, count, settling, percentile };
  void keep(double number);
  [[nodiscard]] double percentile() const;

  Function function_ = Function::max;
  double percent_ = 0;
  double band_ = 0;

  double start_ = 0;
  std::size_t count_ = 0;
  bool unknown_ = false;  ///< one of the numbers was NaN
  double extreme_ = 0;
  double sum_ = 0;      ///< of the numbers, or of their squares
  double mean_ = 0;     ///< sd: of the numbers so far
  double squares_ = 0;  ///< sd: of the distances from the mean so far
  double settled_ = 0;
  bool beyond_ = false;  ///< settling: the last number was outside the band
  std::vector<double> numbers_;
  std::size_t stride_ = 1;  ///< percentile: every so many numbers one is kept
};

}  // namespace drycut::sim::scenario
