#pragma once
#include <string>
#include <vector>

#include "devices/controller.hpp"

namespace drycut::sim::loop {

/// Parameters with which hardly an axis works well, a phrase each: "AxisX.feedfw is 100: ...". Asked when the
/// program has set them, and where nothing else tells why a run failed.
std::vector<Finding> odd_parameters(devices::Controller& controller);

/// Sampling times of axes with which no position loop works, a phrase each: "AxisX TCamp is 0.2 s, ...".
std::vector<Finding> rarely_sampled(devices::Controller& controller);

}  // namespace drycut::sim::loop
