#pragma once
#include "renders/scene3d.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/report/part_meshes.hpp"

namespace drycut::sim::report {

/// The frames of a run, with captions, and where the parts were between them. A part is drawn by the user's
/// mesh, else by its model.
renders::Film film_of(const scenario::Scenario& scenario, const loop::Simulation& simulation,
                      const PartMeshes& meshes = {});

}  // namespace drycut::sim::report
