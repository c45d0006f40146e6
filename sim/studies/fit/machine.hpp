#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {
class Simulation;
}

namespace drycut::sim::studies {

// The machine of a scenario as a fit has it: without controller, timeline and checks, its servo a source of
// torque.

/// A quantity of a plant by its path, "plants.axis.mass".
struct FitPath {
  std::string plant;
  std::string row;  ///< "guide_friction.coulomb"

  [[nodiscard]] std::string text() const { return "plants." + plant + "." + row; }
};

/// A machine and what is looked for in it.
struct FitQuestion {
  std::filesystem::path file;
  std::string text;  ///< of the scenario
  std::vector<scenario::Override> set;
  std::string plant;          ///< whose motor was recorded
  std::vector<FitPath> vary;  ///< its values that are looked for
  /// The whole scenario runs, drive's loops, controller, inputs and all; else the recorded torque drives the
  /// machine alone.
  bool closed = false;
};

/// What a path names in a scenario; nullptr if it is no quantity of one of its plants.
const plants::Parameter* quantity_at(scenario::Scenario& scenario, const FitPath& path,
                                     plants::Parameters& rows);
/// The path of a text, if it has the form of one.
std::optional<FitPath> fit_path(const std::string& text);

/// Sets the quantity that a path names [SI]. False if there is none.
bool set_quantity(scenario::Scenario& scenario, const FitPath& path, double si);

/// Takes away what looks at a run and judges it.
void strip_onlookers(scenario::Scenario& scenario);
/// Takes away all but the plants.
void strip(scenario::Scenario& scenario);
/// Its servo gives the torque that its test signal asks for, at once and without limit. False if the plant
/// has no servo that works so.
bool make_source_of_torque(scenario::Scenario& scenario, const std::string& plant);
/// A gear whose stiffness is not known (0) becomes as stiff as the steps can follow: nothing that was guessed
/// shall bend what is found.
void make_rigid(scenario::Scenario& scenario, const std::string& plant);
/// Whether the machine can be built with these values: no objection of its definition.
bool is_sound(const scenario::Scenario& scenario);
/// It, about to begin: nothing is kept, and but for a closed loop no drive trips.
std::unique_ptr<loop::Simulation> machine_of(const scenario::Scenario& scenario, bool closed);

}  // namespace drycut::sim::studies
