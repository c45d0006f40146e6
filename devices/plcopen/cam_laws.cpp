#include "devices/plcopen/cam_table.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::devices::plcopen {
namespace {

std::vector<double> column(const McCamTable& table, int number) {
  std::vector<double> values(table.lines());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = table.value(i, number);
  return values;
}

/// Coefficients of the quintic from y0 with slope v0 over h to y1 with slope v1, accelerations 0 at both
/// ends.
std::array<double, 6> quintic(double y0, double y1, double v0, double v1, double h) {
  const double d = y1 - y0 - v0 * h;
  const double e = (v1 - v0) * h;
  return {y0, v0 * h, 0, 10 * d - 4 * e, -15 * d + 7 * e, 6 * d - 3 * e};
}

std::array<double, 6>& coefficients_of(CamCurve& curve, std::size_t piece) {
  return std::get<CamPolynomial>(curve.pieces[piece].law).c;
}

void fill_even(CamCurve& curve, const std::vector<double>& y, Interpolation interpolation) {
  const std::size_t n = y.size() - 1;
  const auto step = [&](std::size_t i) { return y[i % n + 1] - y[i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    auto& c = coefficients_of(curve, i);
    if (interpolation == Interpolation::step_direct) {
      c = {y[i]};
    } else if (interpolation == Interpolation::linear) {
      c = {y[i], step(i)};
    } else {
      // Bezier points b1 = y0 + m0/3, b2 = y1 - m1/3 with the slopes of the chords over the neighbours.
      const double m0 = (step(i + n - 1) + step(i)) / 2;
      const double m1 = (step(i) + step(i + 1)) / 2;
      c = {y[i], m0, 3 * step(i) - 2 * m0 - m1, m0 + m1 - 2 * step(i)};
    }
  }
}

void fill_coefficients(CamCurve& curve, const McCamTable& table, double slave_modulo, Endless endless) {
  for (std::size_t i = 0; i < curve.pieces.size(); ++i)
    for (int k = 0; k < 4; ++k) coefficients_of(curve, i)[static_cast<std::size_t>(k)] = table.value(i, k);
  if (endless == Endless::no || slave_modulo <= 0) return;
  // The last polynomial ends in the turn in which the cam goes on.
  const double end = curve.pieces.back().end().position - coefficients_of(curve, 0)[0];
  curve.turns = std::llround(end / slave_modulo);
}

/// Lines and quintics alternately. The type names first what arrives at point 0: POLY5_LINE's last
/// interval is the quintic, so its first is a line.
void fill_pairs(CamCurve& curve, const std::vector<double>& x, const std::vector<double>& y,
                Interpolation interpolation, double cycle) {
  const std::size_t n = x.size();
  curve.even = false;
  const auto length = [&](std::size_t i) {
    return (i + 1 < n ? x[i + 1] : x[0] + curve.master_length) - x[i];
  };
  const auto slope = [&](std::size_t i) { return (y[i % n + 1] - y[i % n]) / length(i % n); };
  for (std::size_t i = 0; i < n; ++i) {
    CamPiece& piece = curve.pieces[i];
    piece.master = x[i];
    piece.length = length(i);
    const bool line = (i % 2 == 0) == (interpolation == Interpolation::poly5_line);
    if (line)
      coefficients_of(curve, i) = {y[i], y[i + 1] - y[i]};
    else
      coefficients_of(curve, i) = quintic(y[i], y[i + 1], slope(i + n - 1), slope(i + 1), piece.length);
  }
  // Masters before the first point belong to the last interval of the turn before.
  if (x[0] <= 0) return;
  curve.pieces.insert(curve.pieces.begin(), CamPiece(curve.pieces.back()));
  curve.pieces.front().master -= curve.master_length;
  coefficients_of(curve, 0)[0] -= cycle;
}

}  // namespace

std::vector<double> unwrapped(const std::vector<double>& positions, double slave_modulo, Endless endless,
                              std::int64_t& turns) {
  std::vector<double> y = positions;
  turns = 0;
  const auto direction = static_cast<double>(static_cast<int>(endless));
  if (endless == Endless::no || slave_modulo <= 0) {
    y.push_back(positions.front());
    return y;
  }
  const auto inside = [&](double value) { return value >= 0 && value < slave_modulo; };
  double shift = 0;
  for (std::size_t i = 1; i < positions.size(); ++i) {
    const double against = -direction * (positions[i] - positions[i - 1]);
    if (inside(positions[i]) && inside(positions[i - 1]) && against > slave_modulo / 2)
      shift += direction * slave_modulo;
    y[i] += shift;
  }
  turns = static_cast<std::int64_t>(direction * std::ceil(direction * (y.back() - y.front()) / slave_modulo));
  y.push_back(positions.front() + static_cast<double>(turns) * slave_modulo);
  return y;
}

CamCurve curve_of(const McCamTable& table, Interpolation interpolation, double modulo, double slave_modulo,
                  Endless endless) {
  CamCurve curve;
  curve.master_length = modulo;
  curve.even = true;
  const auto count = static_cast<double>(table.lines());
  for (std::size_t i = 0; i < table.lines(); ++i)
    curve.pieces.push_back({static_cast<double>(i) * modulo / count, modulo / count, 0,
                            static_cast<int>(i) + 1, CamPolynomial{}});
  if (interpolation == Interpolation::polynom_3_koeff) {
    fill_coefficients(curve, table, slave_modulo, endless);
  } else if (interpolation == Interpolation::line_poly5 || interpolation == Interpolation::poly5_line) {
    const std::vector<double> y = unwrapped(column(table, 1), slave_modulo, endless, curve.turns);
    fill_pairs(curve, column(table, 0), y, interpolation, static_cast<double>(curve.turns) * slave_modulo);
  } else {
    fill_even(curve, unwrapped(column(table, 0), slave_modulo, endless, curve.turns), interpolation);
  }
  curve.slave_length = static_cast<double>(curve.turns) * slave_modulo;
  return curve;
}

}  // namespace drycut::devices::plcopen
