#pragma once
#include <string>
#include <vector>

#include "devices/controller.hpp"

namespace drycut::sim::loop {

/// Parameters with which hardly an axis works well, a phrase each: "AxisX.feedfw is 100: ...". Asked when the
/// program has set them, and where nothing else tells why a run failed.
std::vector<Finding> odd_parameters(devices::Controller& controller);

}  // namespace drycut::sim::loop
