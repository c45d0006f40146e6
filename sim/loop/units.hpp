#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/loop/bus.hpp"
#include "sim/loop/cam_doubt.hpp"
#include "sim/record/outcome.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

// Where controller and machine say different things of one length, speed or direction, a phrase each.

/// Of counts, speeds, cams, as the scenario has them.
std::vector<Finding> contradictions(const scenario::Scenario& scenario,
                                    const std::vector<NamedPlant>& plants);

/// Axes whose parameters take another speed for 10 V than drive and encoder give: asked, as all below, when
/// the program has set them.
std::vector<Finding> contradicting_speeds(const scenario::Scenario& scenario, devices::Controller& controller,
                                          const std::vector<NamedPlant>& plants);

/// Counters whose counts make units of no round length or angle: "AxisX: measurem, pulsem: a unit is 0.4 mm
/// by web.wheel".
std::vector<Finding> strange_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                   const std::vector<NamedPlant>& plants);

/// The same of axes whose unit is another length than that of their master.
std::vector<Finding> different_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                     const std::vector<NamedPlant>& plants);

/// Axes that count their master down as it runs forward.
std::vector<Finding> backward_masters(const scenario::Scenario& scenario, devices::Controller& controller,
                                      const std::vector<NamedPlant>& plants);

/// Cams of which no whole number of cycles makes the piece that a check wants, nor the other way round:
/// "a cycle of the cam of Saw is 660 mm of material, and check 'cut length' wants 1000 mm".
std::vector<Finding> strange_cycles(const std::vector<CamCycle>& cycles,
                                    const std::vector<std::pair<std::string, record::Tolerance>>& limits);

}  // namespace drycut::sim::loop
