#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/time.hpp"

namespace drycut::sim::loop {

/// Where a controller's programs have stood for half a second or more, and a twentieth of the run, by `now`.
struct Waits {
  /// A phrase each: "press.mod stands at line 30, WAIT NOT Axis:st_cntrev (Axis.st_cntrev=1), since 0.004 s".
  std::vector<Finding> texts;
  double since = 0;  ///< [s] when the last of them came to its place
  bool all = false;  ///< every program stands
};
Waits waits_of(devices::Controller& controller, Time now);

/// Tasks that ended as they began though they read or work what is wired, a phrase each.
std::vector<Finding> ended_at_once(const scenario::Scenario& scenario, devices::Controller& controller,
                                   Time now);

/// An axis that no program gives LOOPON: "Axis is without LOOPON: no program closes its position loop".
struct OpenLoop {
  std::string axis;
  Finding what;
};
std::optional<OpenLoop> without_loop(devices::Controller& controller);

}  // namespace drycut::sim::loop
