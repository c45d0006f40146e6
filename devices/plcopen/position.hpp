#pragma once
#include <cmath>
#include <cstdint>

namespace drycut::devices::plcopen {

/// Where an axis is, in whole turns and a part of one: the part of a modulo axis lies in 0..modulo, of a
/// linear axis (modulo 0) it is all there is [0.1 um or 0.0001 deg]. However many turns there were, the part
/// is as fine as in the first one.
struct Position {
  std::int64_t turns = 0;
  double part = 0;
};

/// `position` with `part` brought into 0..modulo.
inline Position normalised(Position position, double modulo) {
  if (modulo <= 0) return position;
  const double turns = std::floor(position.part / modulo);
  position.turns += static_cast<std::int64_t>(turns);
  position.part -= turns * modulo;
  // A part just below 0 rounds up to a whole turn.
  if (position.part >= modulo) {
    position.part -= modulo;
    ++position.turns;
  }
  return position;
}

inline Position advanced(Position position, double by, double modulo) {
  position.part += by;
  return normalised(position, modulo);
}

/// From `b` to `a`.
inline double difference(const Position& a, const Position& b, double modulo) {
  return static_cast<double>(a.turns - b.turns) * modulo + (a.part - b.part);
}

/// The same place modulo, by the shortest way: -modulo/2..modulo/2.
inline double shortest(const Position& a, const Position& b, double modulo) {
  if (modulo <= 0) return a.part - b.part;
  const double way = a.part - b.part;
  return way - modulo * std::round(way / modulo);
}

}  // namespace drycut::devices::plcopen
