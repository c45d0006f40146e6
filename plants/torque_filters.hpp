#pragma once
#include <array>
#include <complex>
#include <string_view>
#include <vector>

#include "plants/plant.hpp"

namespace drycut::plants {

/// A notch in a drive's torque command. Over s / w, w the angular frequency in its middle:
///   (s2 + depth width s + 1) / (s2 + width s + 1)
struct NotchData {
  double frequency = 0;  ///< in its middle, 0 = there is none [Hz]
  double depth = 0.03;   ///< gain in its middle, 0 = nothing passes
  double width = 1;      ///< between the frequencies where half the power passes, over its frequency
};

/// What a servo drive does with the torque that its speed loop asks for, before the current loop has it.
struct TorqueFilterData {
  double low_pass = 0;  ///< time constant, 0 = none [s]
  std::array<NotchData, 2> notches;

  [[nodiscard]] bool any() const {
    return low_pass > 0 || notches[0].frequency > 0 || notches[1].frequency > 0;
  }
};

/// Rows `torque_filter`, `notch1.` and `notch2.`.
Parameters torque_filter_parameters(TorqueFilterData& data);
/// A notch that steps of `h` seconds cannot make: above a quarter of their frequency. `group`: "servo.".
std::vector<PlantDefinition::Objection> torque_filter_objections(const std::string& group,
                                                                 const TorqueFilterData& data, double h);

/// The response of the filters, as steps of `h` seconds have them, at `frequency` [Hz].
[[nodiscard]] std::complex<double> response(const TorqueFilterData& data, double frequency, double h);

/// The filters in steps: the notches by the bilinear transform, right at their frequencies.
class TorqueFilters {
 public:
  explicit TorqueFilters(const TorqueFilterData& data) : data_(data), any_(data.any()) {}

  [[nodiscard]] bool any() const { return any_; }
  [[nodiscard]] double pass(double torque, double h);
  /// Nothing was asked for until now.
  void clear();
  void visit(StateArchive& archive);

  /// y = b0 x + b1 x(-1) + b2 x(-2) - a1 y(-1) - a2 y(-2).
  struct Coefficients {
    double b0 = 1;
    double b1 = 0;
    double b2 = 0;
    double a1 = 0;
    double a2 = 0;
  };

 private:
  const TorqueFilterData data_;
  const bool any_;
  double h_ = 0;  // the step for which the coefficients hold
  double low_share_ = 1;
  std::array<Coefficients, 2> coefficients_;

  struct Memory {
    double first = 0;
    double second = 0;
    void visit(StateArchive& archive);
  };
  double low_ = 0;  // [N m]
  std::array<Memory, 2> memory_;
};

}  // namespace drycut::plants
