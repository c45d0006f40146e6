#include "devices/plcopen/cam_laws.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::devices::plcopen {
namespace {

std::vector<double> column(const CamTable& table, int number) {
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

void fill_even(CamCurve& curve, const std::vector<double>& y, Interpolation interpolation) {
  const std::size_t n = y.size() - 1;
  const auto step = [&](std::size_t i) { return y[i % n + 1] - y[i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    CamSegment& segment = curve.segments[i];
    if (interpolation == Interpolation::step_direct) {
      segment.c = {y[i]};
      segment.step = true;
    } else if (interpolation == Interpolation::linear) {
      segment.c = {y[i], step(i)};
    } else {
      // Bezier points b1 = y0 + m0/3, b2 = y1 - m1/3 with the slopes of the chords over the neighbours.
      const double m0 = (step(i + n - 1) + step(i)) / 2;
      const double m1 = (step(i) + step(i + 1)) / 2;
      segment.c = {y[i], m0, 3 * step(i) - 2 * m0 - m1, m0 + m1 - 2 * step(i)};
    }
  }
}

void fill_coefficients(CamCurve& curve, const CamTable& table, Endless endless) {
  for (std::size_t i = 0; i < curve.segments.size(); ++i)
    for (int k = 0; k < 4; ++k) curve.segments[i].c[static_cast<std::size_t>(k)] = table.value(i, k);
  if (endless == Endless::no || curve.slave_modulo <= 0) return;
  // The last polynomial ends in the turn in which the cam goes on.
  const double end = at(curve.segments.back(), 1).position - curve.segments.front().c[0];
  curve.turns = std::llround(end / curve.slave_modulo);
}

/// Lines and quintics alternately. The type names first what arrives at point 0: POLY5_LINE's last
/// interval is the quintic, so its first is a line.
void fill_pairs(CamCurve& curve, const std::vector<double>& x, const std::vector<double>& y,
                Interpolation interpolation) {
  const std::size_t n = x.size();
  const double cycle = static_cast<double>(curve.turns) * curve.slave_modulo;
  curve.even = false;
  curve.first = x[0];
  const auto length = [&](std::size_t i) { return (i + 1 < n ? x[i + 1] : x[0] + curve.modulo) - x[i]; };
  const auto slope = [&](std::size_t i) { return (y[i % n + 1] - y[i % n]) / length(i % n); };
  for (std::size_t i = 0; i < n; ++i) {
    CamSegment& segment = curve.segments[i];
    segment.start = x[i];
    segment.length = length(i);
    const bool line = (i % 2 == 0) == (interpolation == Interpolation::poly5_line);
    if (line)
      segment.c = {y[i], y[i + 1] - y[i]};
    else
      segment.c = quintic(y[i], y[i + 1], slope(i + n - 1), slope(i + 1), segment.length);
  }
  // Masters before the first point belong to the last interval of the turn before.
  if (x[0] <= 0) return;
  CamSegment before = curve.segments.back();
  before.start -= curve.modulo;
  before.c[0] -= cycle;
  curve.segments.insert(curve.segments.begin(), before);
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

CamCurve curve_of(const CamTable& table, Interpolation interpolation, double modulo, double slave_modulo,
                  Endless endless) {
  CamCurve curve{.modulo = modulo, .slave_modulo = slave_modulo, .segments = {}};
  curve.segments.resize(table.lines());
  const auto count = static_cast<double>(curve.segments.size());
  for (std::size_t i = 0; i < curve.segments.size(); ++i) {
    curve.segments[i].start = static_cast<double>(i) * modulo / count;
    curve.segments[i].length = modulo / count;
  }
  if (interpolation == Interpolation::polynom_3_koeff) {
    fill_coefficients(curve, table, endless);
  } else if (interpolation == Interpolation::line_poly5 || interpolation == Interpolation::poly5_line) {
    const std::vector<double> y = unwrapped(column(table, 1), slave_modulo, endless, curve.turns);
    fill_pairs(curve, column(table, 0), y, interpolation);
  } else {
    fill_even(curve, unwrapped(column(table, 0), slave_modulo, endless, curve.turns), interpolation);
  }
  return curve;
}

std::size_t segment_at(const CamCurve& curve, double x) {
  if (curve.even) {
    const auto count = static_cast<double>(curve.segments.size());
    const double number = std::floor(x * count / curve.modulo);
    return static_cast<std::size_t>(std::clamp(number, 0.0, count - 1));
  }
  const auto next = std::upper_bound(curve.segments.begin(), curve.segments.end(), x,
                                     [](double value, const CamSegment& s) { return value < s.start; });
  return next == curve.segments.begin() ? 0 : static_cast<std::size_t>(next - curve.segments.begin()) - 1;
}

CamMotion at(const CamSegment& segment, double u) {
  const auto& c = segment.c;
  const double h = segment.length;
  return {c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * (c[4] + u * c[5])))),
          (c[1] + u * (2 * c[2] + u * (3 * c[3] + u * (4 * c[4] + u * 5 * c[5])))) / h,
          (2 * c[2] + u * (6 * c[3] + u * (12 * c[4] + u * 20 * c[5]))) / (h * h),
          (6 * c[3] + u * (24 * c[4] + u * 60 * c[5])) / (h * h * h)};
}

CamMotion at(const CamCurve& curve, double x) {
  const std::size_t i = segment_at(curve, x);
  const CamSegment& segment = curve.segments[i];
  if (!curve.even) return at(segment, (x - segment.start) / segment.length);
  // In table intervals, so that a knot is met exactly where its master is a whole number.
  return at(segment, x * static_cast<double>(curve.segments.size()) / curve.modulo - static_cast<double>(i));
}

}  // namespace drycut::devices::plcopen
