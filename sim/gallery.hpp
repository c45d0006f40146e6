#pragma once
#include <filesystem>

#include "renders/plots.hpp"
#include "renders/report.hpp"
#include "renders/scene3d.hpp"
#include "sim/simulation.hpp"

namespace drycut::sim {

// From what was recorded to what is shown: fills the structs of renders/.

/// The frames of a run, with captions.
renders::Film film_of(const Scenario& scenario, const Simulation& simulation);

/// The plots that the scenario asks for; where it asks for none, one with the recorded channels, a panel a
/// unit.
std::vector<renders::Plot> plots_of(const Scenario& scenario, const Recording& recording);

/// The report of a run; `frames` and `plots` are the picture files made for it.
renders::Report report_of(const Scenario& scenario, Simulation& simulation, const Outcome& outcome,
                          const std::vector<std::filesystem::path>& frames,
                          const std::vector<std::filesystem::path>& plots);

}  // namespace drycut::sim
