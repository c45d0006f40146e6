#pragma once
#include <numbers>

// Inside, everything is in metres, radians, kilograms, seconds. These factors lead to what people read.
namespace drycut::units {

inline constexpr double turn = 2 * std::numbers::pi;  ///< [rad]
inline constexpr double rpm = 60 / turn;              ///< rad/s -> rpm
inline constexpr double degrees = 360 / turn;         ///< rad -> deg
inline constexpr double millimetres = 1000;           ///< m -> mm
inline constexpr double metres_a_minute = 60;         ///< m/s -> m/min
inline constexpr double milliseconds = 1000;          ///< s -> ms
inline constexpr double microsecond = 1e-6;           ///< [s]
inline constexpr double gravity = 9.80665;            ///< [m/s2]

}  // namespace drycut::units
