#pragma once
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/loop/bus.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

// What looks like a slip in the wiring, a phrase each.

/// The wire at a terminal, nullptr = nothing is wired to it.
const scenario::Wire* wire_at(const scenario::Scenario& scenario, devices::Controller& controller,
                              const devices::Address& address);

/// Outputs that no program and no device works, one encoder on two counters, zero pulses of another encoder,
/// drives that are on always.
std::vector<Finding> doubtful_wires(const scenario::Scenario& scenario, devices::Controller& controller);

/// Faults of the timeline at encoders that nothing is wired to.
std::vector<Finding> faults_of_nothing(const scenario::Scenario& scenario,
                                       const std::vector<NamedPlant>& plants);

/// Two wires whose terminals have each the name of the other's plug in the program.
std::vector<Finding> crossed_wires(const scenario::Scenario& scenario, devices::Controller& controller);

/// Lines of zero pulses that a PRESET seeks and nothing is wired to: asked when the program has set prsmode.
std::vector<Finding> without_zero_pulse(const scenario::Scenario& scenario, devices::Controller& controller);

/// Terminals that nothing is wired to: "Y1 gives pulses, and nothing is wired to it".
struct OpenTerminals {
  std::vector<Finding> moving;  ///< pulses, references, counters: without them nothing moves as it should
  std::vector<Finding> others;  ///< inputs and outputs that the program names
  std::vector<std::string> unnamed;  ///< of which nothing is amiss; the terminals' names
};
/// `unwired`: Bus::unwired(). Pulses are no slip where no plant could take any.
OpenTerminals open_terminals(devices::Controller& controller, const std::vector<std::string>& unwired,
                             const std::vector<NamedPlant>& plants);

}  // namespace drycut::sim::loop
