#include "plants/torque_filters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/lag.hpp"

namespace drycut::plants {

namespace {

TorqueFilters::Coefficients coefficients_of(const NotchData& notch, double h) {
  if (notch.frequency <= 0) return {};
  const double k = std::tan(std::numbers::pi * notch.frequency * h);
  const double whole = 1 + k * notch.width + k * k;
  const double middle = 2 * (k * k - 1) / whole;
  return {(1 + k * notch.depth * notch.width + k * k) / whole, middle,
          (1 - k * notch.depth * notch.width + k * k) / whole, middle, (1 - k * notch.width + k * k) / whole};
}

}  // namespace

double TorqueFilters::pass(double torque, double h) {
  if (h != h_) {
    h_ = h;
    low_share_ = share_of(data_.low_pass, h);
    for (std::size_t i = 0; i < coefficients_.size(); ++i)
      coefficients_[i] = coefficients_of(data_.notches[i], h);
  }
  low_ += (torque - low_) * low_share_;
  double through = low_;
  for (std::size_t i = 0; i < coefficients_.size(); ++i) {
    const auto& [b0, b1, b2, a1, a2] = coefficients_[i];
    auto& [first, second] = memory_[i];
    const double out = b0 * through + first;
    first = b1 * through - a1 * out + second;
    second = b2 * through - a2 * out;
    through = out;
  }
  return through;
}

void TorqueFilters::clear() {
  low_ = 0;
  memory_ = {};
}

void TorqueFilters::Memory::visit(StateArchive& archive) { STATE(archive, first, second); }
void TorqueFilters::visit(StateArchive& archive) { STATE(archive, low_, memory_); }

std::complex<double> response(const TorqueFilterData& data, double frequency, double h) {
  const auto back = std::polar(1.0, -units::turn * frequency * h);  // a step earlier
  const double share = share_of(data.low_pass, h);
  std::complex<double> sum = share / (1.0 - (1 - share) * back);
  for (const auto& notch : data.notches) {
    const auto [b0, b1, b2, a1, a2] = coefficients_of(notch, h);
    sum *= (b0 + (b1 + b2 * back) * back) / (1.0 + (a1 + a2 * back) * back);
  }
  return sum;
}

Parameters torque_filter_parameters(TorqueFilterData& data) {
  Parameters rows = {row("torque_filter", "ms", "time constant of the low-pass on the torque, 0 = none",
                         data.low_pass, 0, 100, "none: drives set it by auto-tuning")};
  for (std::size_t i = 0; i < data.notches.size(); ++i) {
    auto& notch = data.notches[i];
    rows = joined(std::move(rows),
                  group(fmt::format("notch{}.", i + 1),
                        {row("frequency", "Hz", "middle of a notch in the torque, 0 = none", notch.frequency,
                             0, 5000, "none: set it where the machine resonates"),
                         row("depth", "", "gain in its middle", notch.depth, 0, 1, "usual: -30 dB"),
                         row("width", "", "between its points of half power, over its frequency", notch.width,
                             0.05, 5, "usual: about an octave and a half")}));
  }
  return rows;
}

std::vector<PlantDefinition::Objection> torque_filter_objections(const std::string& group,
                                                                 const TorqueFilterData& data, double h) {
  std::vector<PlantDefinition::Objection> found;
  constexpr double most = 0.25;
  for (std::size_t i = 0; i < data.notches.size(); ++i)
    if (data.notches[i].frequency * h > most * (1 + 1e-9))
      found.push_back(
          {"plant.step-too-long"_code, fmt::format("{}notch{}.frequency", group, i + 1),
           fmt::format("steps of {:g} us make no notch at {:g} Hz", h * 1e6, data.notches[i].frequency),
           fmt::format("at most {:g} Hz, or a shorter scene.step", most / h)});
  return found;
}

}  // namespace drycut::plants
