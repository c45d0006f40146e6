#include "devices/lx3vp/ecamtbx_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drycut::devices::lx3vp {

namespace {

/// A transition at u: w, its integral from 0, its first two derivatives.
struct Shape {
  double w = 0;
  double integral = 0;
  double slope = 0;
  double bend = 0;
};

Shape shape_at(Transition law, double u) {
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

}  // namespace

double travel(const RatioPiece& piece) { return piece.length * (piece.r0 + piece.r1) / 2; }

double peak_ratio(const RatioPiece& piece) { return std::max(std::abs(piece.r0), std::abs(piece.r1)); }

double peak_gradient(const RatioPiece& piece) {
  return peak_slope(piece.law) * std::abs(piece.r1 - piece.r0) / piece.length;
}

void CamProfile::add(double length, double r0, double r1, Transition law) {
  // What rounding leaves of a length that is 0.
  constexpr double nothing = 1e-9;
  if (length <= nothing) return;
  if (r0 == r1) law = Transition::constant;
  const bool goes_on =
      !pieces.empty() && !pieces.back().is_curved() && law == Transition::constant && pieces.back().r0 == r0;
  if (goes_on)
    pieces.back().length += length;
  else
    pieces.push_back({master_length, length, slave_length, r0, r1, law});
  master_length += length;
  slave_length += length * (r0 + r1) / 2;
}

void CamProfile::mirror() {
  for (auto& piece : pieces) {
    piece.slave = -piece.slave;
    piece.r0 = -piece.r0;
    piece.r1 = -piece.r1;
  }
  slave_length = -slave_length;
}

std::size_t piece_at(const CamProfile& profile, double master) {
  const auto next = std::upper_bound(profile.pieces.begin(), profile.pieces.end(), master,
                                     [](double m, const RatioPiece& piece) { return m < piece.master; });
  return next == profile.pieces.begin() ? 0 : static_cast<std::size_t>(next - profile.pieces.begin()) - 1;
}

ProfilePoint at(const CamProfile& profile, double master) {
  if (profile.pieces.empty()) return {};
  const auto& piece = profile.pieces[piece_at(profile, master)];
  const double u = std::clamp((master - piece.master) / piece.length, 0.0, 1.0);
  const auto shape = shape_at(piece.law, u);
  const double change = piece.r1 - piece.r0;
  return {piece.slave + piece.length * (piece.r0 * u + change * shape.integral), piece.r0 + change * shape.w,
          change * shape.slope / piece.length, change * shape.bend / (piece.length * piece.length)};
}

}  // namespace drycut::devices::lx3vp
