#pragma once

namespace drycut::plants {

/// Two bodies, or a body and what stands, with a spring and a damper between them. All seen at one place:
/// along an axis [N/m, N s/m, kg] or about it [N m/rad, N m s/rad, kg m2].
struct StiffPair {
  double stiffness = 0;
  double damping = 0;
  double inertia = 1;  ///< reduced, > 0
};

/// What two bodies that move against each other weigh together.
[[nodiscard]] constexpr double reduced(double one, double other) { return one * other / (one + other); }

// What the integrator takes. Symplectic Euler with an explicit damper does not grow while stiffness h^2 + 2
// damping h < 4 inertia, but it is far from right there. A turn of 0.6 rad a step, ten steps an oscillation,
// has its frequency right to 0.6^2 / 24 = 1.5 %; five steps in a time constant have the decay right to a half
// of 1/5. So what a pair does is then in its place to half a step for each oscillation and each time
// constant.
inline constexpr double most_turn = 0.6;   ///< [rad] a step
inline constexpr double most_decay = 0.2;  ///< share of a time constant a step

/// Longest steps that follow the spring and the damper of a pair [s]; infinite where there is none.
[[nodiscard]] double longest_step_of_spring(const StiffPair& pair);
[[nodiscard]] double longest_step_of_damper(const StiffPair& pair);

}  // namespace drycut::plants
