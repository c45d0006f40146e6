#pragma once
#include <functional>
#include <optional>
#include <string>

#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::studies {

// Play and stiction let a loop rest that hunts for ever once something has moved it. No single sine finds
// that: one that is too small never leaves the play, a larger one hides it. So the loop is pushed, at the
// gain in force and then at more of it, until an oscillation keeps itself up; from there the gain goes down
// again, under way, until the oscillation dies.

/// From which gain on a loop hunts.
struct Hunting {
  std::optional<double> from;  ///< times the gain in force: from there on an oscillation keeps itself up
  double tried = 0;            ///< the largest factor at which every push died out; 0 = none
  double frequency = 0;        ///< of the oscillation at `from` [Hz]
  double amplitude = 0;        ///< of the oscillation at `from`, at the wire [V]
  std::string failure;  ///< why nothing can be told: the axis moves, the simulation stopped; "" if it can

  [[nodiscard]] bool hunts_now() const { return from && *from <= 1; }
};

/// The pushes [V], each for a quarter of a period.
inline constexpr double least_push = 0.1;
inline constexpr double largest_push = 1.6;

/// Pushes the loop at `wire` of Bus::analogue_wires() from time `at` on. `excited` and `still` are the same
/// scenario twice; `period` is about that of an oscillation [s], 0 = not known.
Hunting find_hunting(loop::Simulation& excited, loop::Simulation& still, std::size_t wire, Time at,
                     Time sampling, double period);

/// Play and stiction of the plant that a plug belongs to: "axis.gap 0.4 mm"; "" if it has none.
std::string play_of(const scenario::Scenario& scenario, const std::string& plug);

}  // namespace drycut::sim::studies
