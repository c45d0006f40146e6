#include "sim/cam/mc_camin/polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace drycut::sim {

namespace {

using Coefficients = std::array<double, 6>;

double value(const Coefficients& c, double u) {
  double sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * u + c[k];
  return sum;
}

Coefficients derived(const Coefficients& c) {
  Coefficients d{};
  for (std::size_t k = 1; k < c.size(); ++k) d[k - 1] = static_cast<double>(k) * c[k];
  return d;
}

/// The zero between two places of different sign.
double bisected(const Coefficients& c, double low, double high) {
  const bool rises = value(c, low) < 0;
  for (int i = 0; i < 100; ++i) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    ((value(c, middle) < 0) == rises ? low : high) = middle;
  }
  return low;
}

}  // namespace

std::array<double, 6> coefficients_of(const devices::plcopen::CamSegment& segment, CamOrder order) {
  Coefficients c = segment.c;
  for (int i = 0; i < static_cast<int>(order); ++i) {
    c = derived(c);
    for (double& number : c) number /= segment.length;
  }
  return c;
}

std::vector<double> zeros_of(const std::array<double, 6>& coefficients) {
  std::size_t degree = coefficients.size() - 1;
  while (degree > 0 && coefficients[degree] == 0) --degree;
  if (degree == 0) return {};
  // Between the zeros of its derivative a polynomial rises or falls all the way.
  std::vector<double> ends = zeros_of(derived(coefficients));
  ends.insert(ends.begin(), 0);
  ends.push_back(1);
  std::vector<double> zeros;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double here = value(coefficients, ends[i]);
    if (here == 0 && (zeros.empty() || zeros.back() != ends[i])) zeros.push_back(ends[i]);
    if (i + 1 == ends.size() || here == 0) continue;
    const double next = value(coefficients, ends[i + 1]);
    if (here * next < 0) zeros.push_back(bisected(coefficients, ends[i], ends[i + 1]));
  }
  return zeros;
}

Extremes extremes_of(const devices::plcopen::CamSegment& segment, CamOrder order) {
  const Coefficients c = coefficients_of(segment, order);
  std::vector<double> places = zeros_of(derived(c));
  places.push_back(1);
  Extremes found{value(c, 0), value(c, 0)};
  for (const double u : places) {
    const double here = value(c, u);
    found.low = std::min(found.low, here);
    found.high = std::max(found.high, here);
  }
  return found;
}

}  // namespace drycut::sim
