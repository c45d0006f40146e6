#include "devices/cam/law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/state_archive.hpp"
#include "devices/cam/table.hpp"

namespace drycut::devices {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// Ramps.

CamMotion at_straight(const CamRamp& ramp, double x) {
  const double slope = (ramp.v1 - ramp.v0) / ramp.length;
  return {ramp.position + x * (ramp.v0 + slope * x / 2), ramp.v0 + slope * x, slope, 0};
}

CamMotion at_cycloidal(const CamRamp& ramp, double x) {
  const double change = ramp.v1 - ramp.v0;
  const double length = ramp.length;
  const double p = x / length;
  const double sine = std::sin(two_pi * p);
  const double lift = 1 - std::cos(two_pi * p);
  const double done = p - sine / two_pi;
  CamMotion motion;
  motion.position = ramp.position + length * (ramp.v0 * p + change * (p * p / 2 - lift / (two_pi * two_pi))) +
                    ramp.excess * done;
  motion.velocity = ramp.v0 + change * done + ramp.excess / length * lift;
  motion.acceleration = (change * lift + ramp.excess / length * two_pi * sine) / length;
  motion.jerk = two_pi * (change * sine + ramp.excess / length * two_pi * (1 - lift)) / (length * length);
  return motion;
}

CamExtremes between(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

CamExtremes speeds(const CamRamp& ramp, double length) {
  auto speed = between(at(ramp, 0).velocity, at(ramp, length).velocity);
  if (!ramp.cycloidal || ramp.excess == 0) return speed;
  // dv/dm = 0 inside: tan(pi p) = -2 pi excess / (length change).
  const double change = ramp.v1 - ramp.v0;
  const double angle = std::atan2(-two_pi * ramp.excess, ramp.length * change);
  const double p = (angle < 0 ? angle + std::numbers::pi : angle) / std::numbers::pi;
  const double m = ramp.start + p * ramp.length;
  if (m <= 0 || m >= length) return speed;
  const double turn = at(ramp, m).velocity;
  return {std::min(speed.low, turn), std::max(speed.high, turn)};
}

CamExtremes accelerations(const CamRamp& ramp) {
  const double most = (ramp.cycloidal ? 2 : 1) * (ramp.v1 - ramp.v0) / ramp.length;
  return between(ramp.cycloidal ? 0 : most, most);
}

// Arcs.

/// True if the angle passes a whole number of half turns after `offset`.
bool passes(const Arc& arc, double offset) {
  const double begin = arc.sense * (arc.start_angle - offset) / std::numbers::pi;
  return std::floor(begin + arc.sweep / std::numbers::pi) >= std::ceil(begin);
}

/// |v| is a sine of the angle, |dv/dm| its cosine: largest where the axis runs along the tangent, and where
/// it turns round.
CamExtremes extremes_of(const CamArc& law, CamOrder order) {
  const bool x = law.axis == ArcAxis::x;
  const bool speed = order == CamOrder::velocity;
  const auto value = [&](double m) {
    const auto motion = at(law.arc, law.axis, m, 0);
    return speed ? motion.velocity : motion.acceleration;
  };
  const double most = passes(law.arc, x == speed ? std::numbers::pi / 2 : 0)
                          ? (speed ? 1 : 1 / law.arc.radius)
                          : std::max(std::abs(value(0)), std::abs(value(law.arc.length)));
  return {-most, most};
}

// Transitions.

/// A transition at u: w, its integral from 0, its first two derivatives.
struct PieceShape {
  double w = 0;
  double integral = 0;
  double slope = 0;
  double bend = 0;
};

PieceShape shape_at(Transition law, double u) {
  using std::numbers::pi;
  switch (law) {
    case Transition::constant:
      return {};
    case Transition::uniform_acceleration:
      return {u, u * u / 2, 1, 0};
    case Transition::b_type:
      return {u * u * (3 - 2 * u), u * u * u * (1 - u / 2), 6 * u * (1 - u), 6 - 12 * u};
    case Transition::cosine:
      return {(1 - std::cos(pi * u)) / 2, u / 2 - std::sin(pi * u) / (2 * pi), pi / 2 * std::sin(pi * u),
              pi * pi / 2 * std::cos(pi * u)};
    case Transition::parabolas: {
      const double rest = 1 - u;
      if (u < 0.5) return {2 * u * u, 2 * u * u * u / 3, 4 * u, 4};
      return {1 - 2 * rest * rest, 0.5 - rest + 2 * rest * rest * rest / 3, 4 * rest, -4};
    }
  }
  return {};
}

double peak_slope(Transition law) {
  switch (law) {
    case Transition::constant:
      return 0;
    case Transition::uniform_acceleration:
      return 1;
    case Transition::b_type:
      return 1.5;
    case Transition::cosine:
      return std::numbers::pi / 2;
    case Transition::parabolas:
      return 2;
  }
  return 0;
}

CamMotion motion_of(const CamTransition& law, double u, double length) {
  const auto shape = shape_at(law.shape, u);
  const double change = law.r1 - law.r0;
  return {length * (law.r0 * u + change * shape.integral), law.r0 + change * shape.w,
          change * shape.slope / length, change * shape.bend / (length * length)};
}

CamExtremes accelerations(const CamTransition& law, double length) {
  const double most = peak_slope(law.shape) * (law.r1 - law.r0) / length;
  return between(law.shape == Transition::uniform_acceleration ? most : 0, most);
}

// Polynomials.

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

CamExtremes extremes_of(const CamPolynomial& polynomial, CamOrder order, double length) {
  Coefficients c = polynomial.c;
  for (int i = 0; i < static_cast<int>(order); ++i) {
    c = derived(c);
    for (double& number : c) number /= length;
  }
  std::vector<double> places = zeros_of(derived(c));
  places.push_back(1);
  CamExtremes found{value(c, 0), value(c, 0)};
  for (const double u : places) {
    const double here = value(c, u);
    found.low = std::min(found.low, here);
    found.high = std::max(found.high, here);
  }
  return found;
}

// Any law.

double number_of(const CamMotion& motion, int order) {
  const std::array numbers = {motion.position, motion.velocity, motion.acceleration, motion.jerk};
  return numbers[static_cast<std::size_t>(order)];
}

/// Where the next derivative passes 0 the value turns round.
CamExtremes searched(const CamPiece& piece, CamOrder order) {
  constexpr int steps = 256;
  constexpr int halvings = 50;
  const int k = static_cast<int>(order);
  CamExtremes found{number_of(piece.begin(), k), number_of(piece.begin(), k)};
  const auto take = [&](double m) {
    const double here = number_of(piece.at(m), k);
    found = {std::min(found.low, here), std::max(found.high, here)};
  };
  const auto rises = [&](double m) { return order != CamOrder::jerk && number_of(piece.at(m), k + 1) > 0; };
  const double step = piece.length / steps;
  for (int i = 0; i < steps; ++i) {
    double begin = i * step;
    double end = i + 1 == steps ? piece.length : (i + 1) * step;
    take(end);
    const bool forwards = rises(begin);
    if (forwards == rises(end)) continue;
    for (int half = 0; half < halvings; ++half) {
      const double middle = (begin + end) / 2;
      (rises(middle) == forwards ? begin : end) = middle;
    }
    take(begin);
  }
  return found;
}

}  // namespace

CamMotion at(const CamRamp& ramp, double m) {
  return ramp.cycloidal ? at_cycloidal(ramp, m - ramp.start) : at_straight(ramp, m - ramp.start);
}

double space(const CamRamp& ramp) { return ramp.length * (ramp.v0 + ramp.v1) / 2 + ramp.excess; }

CamMotion at(const Arc& arc, ArcAxis axis, double m, double um_per_turn) {
  if (axis == ArcAxis::tangent) {
    const double speed = arc.sense * um_per_turn / (two_pi * arc.radius);
    return {speed * m, speed, 0, 0};
  }
  const double angle = arc.start_angle + arc.sense * m / arc.radius;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const double square_of_radius = arc.radius * arc.radius;
  if (axis == ArcAxis::x)
    return {arc.centre_x + arc.radius * cosine, -arc.sense * sine, -cosine / arc.radius,
            arc.sense * sine / square_of_radius};
  return {arc.centre_y + arc.radius * sine, arc.sense * cosine, -sine / arc.radius,
          -arc.sense * cosine / square_of_radius};
}

CamMotion at(const CamPolynomial& polynomial, double u, double length) {
  const auto& c = polynomial.c;
  const double h = length;
  return {c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * (c[4] + u * c[5])))),
          (c[1] + u * (2 * c[2] + u * (3 * c[3] + u * (4 * c[4] + u * 5 * c[5])))) / h,
          (2 * c[2] + u * (6 * c[3] + u * (12 * c[4] + u * 20 * c[5]))) / (h * h),
          (6 * c[3] + u * (24 * c[4] + u * 60 * c[5])) / (h * h * h)};
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

CamMotion CamPiece::at(double m) const {
  const double u = std::clamp(m / length, 0.0, 1.0);
  CamMotion motion;
  if (const auto* polynomial = std::get_if<CamPolynomial>(&law))
    motion = devices::at(*polynomial, u, length);
  else if (const auto* transition = std::get_if<CamTransition>(&law))
    motion = motion_of(*transition, u, length);
  else if (const auto* ramp = std::get_if<CamRamp>(&law))
    motion = devices::at(*ramp, m);
  else if (const auto* arc = std::get_if<CamArc>(&law))
    motion = devices::at(arc->arc, arc->axis, m, 0);
  motion.position = slave + motion.position;
  return motion;
}

CamExtremes CamPiece::extremes(CamOrder order) const {
  if (const auto* polynomial = std::get_if<CamPolynomial>(&law)) {
    const auto found = extremes_of(*polynomial, order, length);
    return order == CamOrder::position ? CamExtremes{slave + found.low, slave + found.high} : found;
  }
  const bool speed = order == CamOrder::velocity;
  if (!speed && order != CamOrder::acceleration) return searched(*this, order);
  if (const auto* transition = std::get_if<CamTransition>(&law))
    return speed ? between(transition->r0, transition->r1) : accelerations(*transition, length);
  if (const auto* ramp = std::get_if<CamRamp>(&law))
    return speed ? speeds(*ramp, length) : accelerations(*ramp);
  return extremes_of(std::get<CamArc>(law), order);
}

double CamPiece::peak(CamOrder order) const {
  const auto found = extremes(order);
  return std::max(std::abs(found.low), std::abs(found.high));
}

std::size_t piece_at(const CamLaw& law, double master) {
  if (law.even) {
    const auto count = static_cast<double>(law.pieces.size());
    const double number = std::floor(master * count / law.master_length);
    return static_cast<std::size_t>(std::clamp(number, 0.0, count - 1));
  }
  const auto next = std::upper_bound(law.pieces.begin(), law.pieces.end(), master,
                                     [](double m, const CamPiece& piece) { return m < piece.master; });
  return next == law.pieces.begin() ? 0 : static_cast<std::size_t>(next - law.pieces.begin()) - 1;
}

CamMotion at(const CamLaw& law, std::size_t piece, double master) {
  const CamPiece& found = law.pieces[piece];
  if (!law.even) return found.at(master - found.master);
  // In intervals, so that a knot is met exactly where its master is a whole number.
  const auto count = static_cast<double>(law.pieces.size());
  const double u = master * count / law.master_length - static_cast<double>(piece);
  return at(std::get<CamPolynomial>(found.law), std::clamp(u, 0.0, 1.0), found.length);
}

CamMotion at(const CamLaw& law, double master) {
  return law.pieces.empty() ? CamMotion{} : at(law, piece_at(law, master), master);
}

void CamTravel::visit(StateArchive& archive) { STATE(archive, least, most); }
void CamRamp::visit(StateArchive& archive) {
  STATE(archive, from, start, length, position, v0, v1, excess, cycloidal);
}
void Arc::visit(StateArchive& archive) {
  STATE(archive, radius, centre_x, centre_y, start_angle, sweep, sense, length);
}
void CamArc::visit(StateArchive& archive) { STATE(archive, arc, axis); }
void CamTransition::visit(StateArchive& archive) { STATE(archive, r0, r1, shape); }
void CamPolynomial::visit(StateArchive& archive) { STATE(archive, c); }
void CamPiece::visit(StateArchive& archive) { STATE(archive, master, length, slave, row, law); }
void CamLaw::visit(StateArchive& archive) { STATE(archive, pieces, master_length, slave_length, even); }

}  // namespace drycut::devices
