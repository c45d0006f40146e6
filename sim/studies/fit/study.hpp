#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "sim/studies/fit/bench.hpp"

namespace drycut::sim::studies {

inline constexpr std::array<std::string_view, 3> words_of(FitKnown) { return {"yes", "joined", "no"}; }

/// A value as it was found, in the unit of its row.
struct FittedValue {
  std::string path;               ///< "plants.axis.mass"
  std::optional<double> value{};  ///< none where it is not known
  std::optional<double> low{};    ///< it lies between these with 95 %
  std::optional<double> high{};
  std::string unit;
  FitKnown known = FitKnown::yes;
  std::string why{};                ///< it is not known, and which move would tell; "" where it is
  double before = 0;                ///< in the scenario
  double used = 0;                  ///< where the fit ended, known or not
  std::vector<double> alone{};      ///< as each recording alone would have it
  std::optional<double> coarser{};  ///< at half the cutoff
  std::optional<double> finer{};    ///< at twice

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("path", self.path);
    archive("value", self.value);
    archive("low", self.low);
    archive("high", self.high);
    archive("unit", self.unit);
    archive("known", self.known);
    archive("why", self.why);
    archive("before", self.before);
    archive("alone", self.alone);
    archive("at_half_cutoff", self.coarser);
    archive("at_twice_cutoff", self.finer);
  }
};

/// Another model of the machine, and what it gains.
struct FitRung {
  std::string model;               ///< "unbalance of what turns"
  std::vector<std::string> paths;  ///< what varies besides
  double error_without = 0;        ///< unexplained torque over the recorded one
  double error = 0;                ///< the same with it
  double gain = 0;                 ///< of the Bayesian information criterion
  bool known = false;              ///< all values of that model are, and what varies besides is not 0

  /// Very strong evidence (Kass and Raftery 1995), and it explains a twentieth of what is left and half a
  /// percent of all torque; and who follows gets values.
  [[nodiscard]] bool is_worth_it() const {
    return known && gain > 10 && error < 0.95 * error_without &&
           error_without * error_without - error * error > 0.005 * 0.005;
  }

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("model", self.model);
    archive("paths", self.paths);
    archive("error_without", self.error_without);
    archive("error_with", self.error);
    archive("bic_gain", self.gain);
    archive("known", self.known);
  }
};

/// What recordings say of a machine: fit.json.
struct FitFound {
  int format = 1;
  std::vector<FittedValue> parameters;
  FittedValue torque_offset;             ///< what the recorded torque has too much
  std::vector<FittedValue> inputs;       ///< share of a recorded force or torque that acts, by its channel
  std::map<std::string, double> delays;  ///< of channels against the motion, positive: late [s]
  double relative_error = 0;             ///< torque that is left unexplained, over the recorded one, both rms
  std::optional<double> cross_error;     ///< the same of the recordings of the cross test, the largest
  double condition = 0;
  double cutoff = 0;                       ///< [Hz]
  std::optional<double> inertia_at_motor;  ///< of all that it moves, with the values found [kg m2]
  std::vector<FitRung> ladder;
  std::vector<std::string> codes;

  std::vector<Replayed> replayed;  ///< each recording with the values found
  std::vector<Replayed> tested;    ///< those of the cross test
  std::vector<Finding> findings;
  std::size_t runs = 0;

  /// A finding with its code.
  void tell(Finding finding) {
    if (std::ranges::find(codes, finding.code) == codes.end()) codes.push_back(finding.code);
    findings.push_back(std::move(finding));
  }
  /// All values are known, no more than a third of the torque is left unexplained, and the cross test keeps
  /// its limit.
  bool passed = false;

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("format", self.format);
    archive("parameters", self.parameters);
    archive("torque_offset", self.torque_offset);
    archive("inputs", self.inputs);
    archive("delays", self.delays);
    archive("relative_error", self.relative_error);
    archive("cross_error", self.cross_error);
    archive("condition", self.condition);
    archive("cutoff", self.cutoff);
    archive("inertia_at_motor", self.inertia_at_motor);
    archive("ladder", self.ladder);
    archive("codes", self.codes);
  }
};

/// Fits the values to the recordings together, and tries what other models would explain besides. `progress`
/// is told what it does. Throws std::runtime_error where no replay can be made.
FitFound fit(const FitQuestion& question, const std::vector<ReplaySeries>& recordings, int jobs,
             const std::function<void(const char* doing)>& progress = {});

/// Replays other recordings with the values found; only their delays are found anew, for their clocks are
/// others. Fills `cross_error` and `tested`, and tells what is above `limit` [%].
void cross_test(const FitQuestion& question, const std::vector<ReplaySeries>& tests,
                std::optional<double> limit, int jobs, FitFound& found);

}  // namespace drycut::sim::studies
