#pragma once
#include <array>
#include <cstddef>
#include <variant>
#include <vector>

namespace drycut {
class StateArchive;
}

namespace drycut::devices {

// A cam as a function of the master: pieces one after the other, each with a law of its own. What the
// devices' cams share. Positions in the unit of the cam's table (Um, pulses, 0.1 um or 0.0001 deg);
// derivatives are with respect to the master.

/// The slave at one master position.
struct CamMotion {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
};

/// Which of them.
enum class CamOrder : int { position = 0, velocity = 1, acceleration = 2, jerk = 3 };

/// Smallest and largest value.
struct CamExtremes {
  double low = 0;
  double high = 0;
};

// The laws. Master positions m are from where the piece begins, slave positions from where it puts them.

/// A change of speed over `length` of the master, straight or cycloidal, which take the same space (CAMMING4,
/// spec qem.md 8.4; 000 1.2.1).
struct CamRamp {
  double from = 0;      ///< in a sector of several: master position from which the ramp is in force
  double start = 0;     ///< master position of its zero; a softening is entered half-way, at start + length/2
  double length = 0;    ///< > 0
  double position = 0;  ///< slave position at `start`
  double v0 = 0;
  double v1 = 0;
  double excess = 0;  ///< cycloidal: slave space beyond length*(v0+v1)/2, spread without touching the ends
  bool cycloidal = false;

  void visit(StateArchive& archive);
};
/// The ramp's motion at m, start <= m <= start + length.
CamMotion at(const CamRamp& ramp, double m);
/// Slave space of the whole ramp.
double space(const CamRamp& ramp);

enum class ArcAxis : unsigned char { x, y, tangent };

/// A circle arc from (0, 0) to (dX, dY), along which the master runs (CAMMING4, spec qem.md 8.6; 000 1.2.4).
struct Arc {
  double radius = 0;    ///< > 0 [Um]
  double centre_x = 0;  ///< [Um]
  double centre_y = 0;
  double start_angle = 0;  ///< of the start point, seen from the centre [rad]
  double sweep = 0;        ///< angle run through, > 0 [rad]
  double sense = 1;        ///< +1 counterclockwise, -1 clockwise
  double length = 0;       ///< radius*sweep [Um]

  void visit(StateArchive& archive);
};
/// Motion of one axis at arc length m. The tangent axis turns through `um_per_turn` Um a turn.
CamMotion at(const Arc& arc, ArcAxis axis, double m, double um_per_turn);
/// The slave as axis x or y of an arc.
struct CamArc {
  Arc arc;
  ArcAxis axis = ArcAxis::x;

  void visit(StateArchive& archive);
};

/// How a ratio goes over from the one end of a piece to the other, u = 0..1 (LX3VP, 003 6.3).
enum class Transition {
  constant,              ///< no transition: both ends are the same ratio
  uniform_acceleration,  ///< P6 = 1: w = u
  b_type,                ///< P6 = 2: w = 3u^2 - 2u^3, the clamped cubic B-spline
  cosine,                ///< K0: w = (1 - cos pi u) / 2
  parabolas              ///< K1: w = 2u^2, then 1 - 2(1 - u)^2
};
/// The ratio of the slave to the master from `r0` to `r1`.
struct CamTransition {
  double r0 = 0;
  double r1 = 0;
  Transition shape = Transition::constant;

  [[nodiscard]] bool is_curved() const { return shape != Transition::constant; }
  void visit(StateArchive& archive);
};

/// y = sum c[k] u^k, u = 0..1 over the piece (MC_CamIn, 004 "table_fkt_type"). One without coefficients holds
/// the slave where it is.
struct CamPolynomial {
  std::array<double, 6> c{};

  void visit(StateArchive& archive);
};
/// At u over a piece of this length.
CamMotion at(const CamPolynomial& polynomial, double u, double length);
/// Where the polynomial has its zeros in 0..1, ascending; none if it is 0 everywhere.
std::vector<double> zeros_of(const std::array<double, 6>& coefficients);

/// A piece of a cam.
struct CamPiece {
  double master = 0;  ///< where it begins
  double length = 0;  ///< of the master, above 0
  double slave = 0;   ///< from where its law counts the slave
  int row = 0;        ///< of the table, from 1, that makes it
  std::variant<CamPolynomial, CamTransition, CamRamp, CamArc> law = {};

  /// The slave m after its beginning.
  [[nodiscard]] CamMotion at(double m) const;
  [[nodiscard]] CamMotion begin() const { return at(0); }
  [[nodiscard]] CamMotion end() const { return at(length); }
  /// Exact but for rounding; of a position that is no polynomial's looked for in 256 steps, likewise jerks.
  [[nodiscard]] CamExtremes extremes(CamOrder order) const;
  /// Largest absolute value.
  [[nodiscard]] double peak(CamOrder order) const;
  void visit(StateArchive& archive);
};

/// The law of a piece that has such a one.
inline const CamTransition& ratio_of(const CamPiece& piece) { return std::get<CamTransition>(piece.law); }
inline const CamPolynomial& polynomial_of(const CamPiece& piece) {
  return std::get<CamPolynomial>(piece.law);
}

/// A cycle of a cam.
struct CamLaw {
  std::vector<CamPiece> pieces;  ///< one after the other
  double master_length = 0;      ///< of the cycle
  double slave_length = 0;       ///< how far on the slave is in the next one; negative backwards
  bool even = false;             ///< polynomials of one length each, from master 0

  void visit(StateArchive& archive);
};
/// Place of the piece that holds `master`, 0..master_length; a boundary belongs to the piece that it begins.
std::size_t piece_at(const CamLaw& law, double master);
/// The slave at `master` by one of the pieces.
CamMotion at(const CamLaw& law, std::size_t piece, double master);
CamMotion at(const CamLaw& law, double master);

}  // namespace drycut::devices
