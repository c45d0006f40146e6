#pragma once
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/loop/bus.hpp"
#include "sim/loop/cam_doubt.hpp"
#include "sim/record/outcome.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Where controller and machine say different things of one thing, a phrase each: counts, speeds, cams.
std::vector<Finding> contradictions(const scenario::Scenario& scenario,
                                    const std::vector<NamedPlant>& plants);

/// What is wired and looks like a slip, a phrase each: outputs that no program and no device works, one
/// encoder on two counters.
std::vector<Finding> doubtful_wires(const scenario::Scenario& scenario, devices::Controller& controller);

/// Faults of the timeline at encoders that nothing is wired to, a phrase each.
std::vector<Finding> faults_of_nothing(const scenario::Scenario& scenario,
                                       const std::vector<NamedPlant>& plants);

/// Two wires whose terminals have each the name of the other's plug in the program, a phrase each.
std::vector<Finding> crossed_wires(const scenario::Scenario& scenario, devices::Controller& controller);

/// Axes that count their master down as it runs forward, a phrase each: asked when the program has run.
std::vector<Finding> backward_masters(const scenario::Scenario& scenario, devices::Controller& controller,
                                      const std::vector<NamedPlant>& plants);

/// Lines of zero pulses that a PRESET seeks and nothing is wired to, a phrase each: asked when the program
/// has set prsmode.
std::vector<Finding> without_zero_pulse(const scenario::Scenario& scenario, devices::Controller& controller);

/// The wire at a terminal, nullptr = nothing is wired to it.
const scenario::Wire* wire_at(const scenario::Scenario& scenario, devices::Controller& controller,
                              const devices::Address& address);

/// A QCL program gives PRESET for that axis; "" = for any.
bool presets(devices::Controller& controller, const std::string& axis);

/// A program surely names that terminal, or what the configuration calls it.
bool names_terminal(devices::Controller& controller, const std::string& terminal);

/// The lines of programs that switch an output on, as the end of a phrase: ", by saw.mod:88, SETOUT
/// ofTrouble";
/// "" where none is found.
std::string switched_on_by(devices::Controller& controller, const std::string& terminal);

/// The text without comments, in small letters: of QCL and IL from ';' on, of Structured Text // and (* *).
std::string program_words(const devices::ProgramText& program);

/// Axes whose parameters take another speed for 10 V than drive and encoder give, a phrase each: asked when
/// the program has set them.
std::vector<Finding> contradicting_speeds(const scenario::Scenario& scenario, devices::Controller& controller,
                                          const std::vector<NamedPlant>& plants);

/// Counters whose counts make units of no round length or angle, a phrase each: "AxisX: measurem, pulsem: a
/// unit is 0.4 mm by web.wheel". Asked when the program has set the parameters.
std::vector<Finding> strange_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                   const std::vector<NamedPlant>& plants);

/// The same of axes whose unit is another length than that of their master.
std::vector<Finding> different_units(const scenario::Scenario& scenario, devices::Controller& controller,
                                     const std::vector<NamedPlant>& plants);

/// Cams of which no whole number of cycles makes the piece that a check wants, nor the other way round, a
/// phrase each: "a cycle of the cam of Saw is 660 mm of material, and check 'cut length' wants 1000 mm".
std::vector<Finding> strange_cycles(const std::vector<CamCycle>& cycles,
                                    const std::vector<std::pair<std::string, record::Tolerance>>& limits);

/// Terminals that nothing is wired to, a phrase each: "Y1 gives pulses, and nothing is wired to it".
struct OpenTerminals {
  std::vector<Finding> moving;  ///< pulses, references, counters: without them nothing moves as it should
  std::vector<Finding> others;  ///< inputs and outputs that the program names
  std::vector<std::string> unnamed;  ///< of which nothing is amiss; the terminals' names
};
/// `unwired`: Bus::unwired(). Pulses are no slip where no plant could take any.
OpenTerminals open_terminals(devices::Controller& controller, const std::vector<std::string>& unwired,
                             const std::vector<NamedPlant>& plants);

}  // namespace drycut::sim::loop
