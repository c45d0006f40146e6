#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// The quantity as what is called `name` and has `unit` takes it: in SI, or as it is where `unit` is "".
/// Another dimension is a problem at its place; nullopt then. `bare`: the remedy where no unit belongs.
std::optional<double> in_si(const scenario::Scenario& scenario, Problems& problems, const std::string& name,
                            std::string_view unit, const scenario::Quantity& quantity,
                            const std::string& bare = "leave the unit away");

}  // namespace drycut::sim::loop
