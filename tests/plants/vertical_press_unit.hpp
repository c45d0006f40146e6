#pragma once
#include <gtest/gtest.h>

#include <cmath>

#include "plants/vertical_press.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {

/// A press without a controller.
struct Press : Machine {
  explicit Press(VerticalPressDefinition definition = {}, std::uint64_t seed = 1)
      : Machine(definition, nullptr, seed) {}
  Slide& ram() { return static_cast<VerticalPress&>(*plant).ram(); }
  Shaft& rotor() { return static_cast<VerticalPress&>(*plant).rotor(); }
};

inline VerticalPressDefinition frictionless_press() {
  VerticalPressDefinition definition;
  definition.data.motor_friction = {};
  definition.data.guide_friction = {};
  return definition;
}

}  // namespace drycut::plants
