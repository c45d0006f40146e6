#pragma once
#include <cstdint>

#include "devices/camming4/laws.hpp"

namespace drycut::devices::camming4 {

// The trigonometric sectors 170-175 (spec qem.md 8.6; 000 1.2.4). The master runs along the arc, so that s is
// the arc's abscissa; the start of the arc is the origin.

enum class Turn : bool { clockwise, counterclockwise };
/// Error of an arc's data: 0, 50 (radius too small to join the points), 51 (no displacement but a radius).
/// Exact for all 32-bit values.
int arc_error(std::int32_t radius, std::int32_t dx, std::int32_t dy);
/// The arc of signed radius (+ short way, - long way). Requires arc_error() == 0 and a displacement.
Arc make_arc(std::int32_t radius, std::int32_t dx, std::int32_t dy, Turn turn);

/// Largest |dv/dm| while |v| grows, or falls.
double peak_acceleration(const Arc& arc, ArcAxis axis);
double peak_deceleration(const Arc& arc, ArcAxis axis);

}  // namespace drycut::devices::camming4
