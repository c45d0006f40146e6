#pragma once
#include <array>
#include <vector>

#include "devices/plcopen/cam_laws.hpp"

namespace drycut::sim {

/// Order of a derivative of the cam with respect to the master.
enum class CamOrder : int { position = 0, velocity = 1, acceleration = 2, jerk = 3 };

/// Coefficients of a segment's derivative over u = 0..1.
std::array<double, 6> coefficients_of(const devices::plcopen::CamSegment& segment, CamOrder order);

/// Where the polynomial has its zeros in 0..1, ascending; none if it is 0 everywhere.
std::vector<double> zeros_of(const std::array<double, 6>& coefficients);

/// Smallest and largest value of a segment's derivative.
struct Extremes {
  double low = 0;
  double high = 0;
};
/// Exact but for the rounding of the zeros.
Extremes extremes_of(const devices::plcopen::CamSegment& segment, CamOrder order);

}  // namespace drycut::sim
