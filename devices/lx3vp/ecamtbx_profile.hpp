#pragma once
#include <vector>

namespace drycut::devices::lx3vp {

// The exact laws behind ECAMTBX (003 6.3 and its appendix), before anything is rounded to pulses: the ratio
// of the slave to the master over the master's position, as a row of pieces.

/// How the ratio goes over from the one end of a piece to the other, u = 0..1.
enum class Transition {
  constant,              ///< no transition: both ends are the same ratio
  uniform_acceleration,  ///< P6 = 1: w = u
  b_type,                ///< P6 = 2: w = 3u^2 - 2u^3, the clamped cubic B-spline
  cosine,                ///< K0: w = (1 - cos pi u) / 2
  parabolas              ///< K1: w = 2u^2, then 1 - 2(1 - u)^2
};

/// A piece of a profile: the ratio from `r0` to `r1` over `length` of the master. Positions in pulses.
struct RatioPiece {
  double master = 0;  ///< where it begins
  double length = 0;  ///< of the master, above 0
  double slave = 0;   ///< where the slave stands at its beginning
  double r0 = 0;
  double r1 = 0;
  Transition law = Transition::constant;

  [[nodiscard]] bool is_curved() const { return law != Transition::constant; }
};

/// The slave at one master position: position [pulses] and its derivatives with respect to the master.
struct ProfilePoint {
  double position = 0;
  double ratio = 0;
  double gradient = 0;
  double jerk = 0;
};

/// A cam cycle as ECAMTBX constructs it.
struct CamProfile {
  std::vector<RatioPiece> pieces;  ///< one after the other, from master 0
  double master_length = 0;
  double slave_length = 0;  ///< where the slave ends; negative backwards
  double sync_begin = 0;    ///< of the synchronous zone on the master; equal to `sync_end`: there is none
  double sync_end = 0;
  bool stops = false;  ///< midCAMend: the cam stops by itself at the end of the cycle

  /// Appends a piece; one without length is left out, one that goes on at the same constant ratio is joined.
  void add(double length, double r0, double r1, Transition law);
  /// The same profile run in the opposite direction.
  void mirror();
};

/// The profile at `master` within 0..master_length; a boundary belongs to the piece that it begins.
ProfilePoint at(const CamProfile& profile, double master);
/// Place of the piece that holds `master`.
std::size_t piece_at(const CamProfile& profile, double master);
/// The slave's travel in a piece.
double travel(const RatioPiece& piece);
/// Largest |ratio| and largest |gradient| [1/pulse] of a piece.
double peak_ratio(const RatioPiece& piece);
double peak_gradient(const RatioPiece& piece);

}  // namespace drycut::devices::lx3vp
