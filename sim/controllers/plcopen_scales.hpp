#pragma once
#include <string>
#include <vector>

#include "devices/plcopen/cam_table.hpp"
#include "sim/controllers/kinds.hpp"

namespace drycut::sim::controllers {

/// Where an axis' path, its speed at 10 V or its modulo do not fit the machine that its terminals are wired
/// to.
std::vector<Finding> contradicting_scales(const PlcopenSection& section, const scenario::Scenario& scenario,
                                          const scenario::ControllerSection::ScaleOf& scale_of);
/// Where no line of a cam of a rotary knife runs at the speed of its web: the cam is for another drum.
std::vector<Finding> contradicting_cams(const PlcopenSection& section,
                                        const std::vector<devices::plcopen::McCamTable>& cams,
                                        const scenario::Scenario& scenario);

}  // namespace drycut::sim::controllers
