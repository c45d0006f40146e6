#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "renders/scene3d.hpp"
#include "sim/loop/bus.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::report {

/// Meshes by the full names of the parts that they replace ("knife.drum").
using PartMeshes = std::map<std::string, std::shared_ptr<const renders::Mesh>>;

/// Loads what `pictures.meshes` names. Parts that no plant has (also those that the camera follows or looks
/// at) and files that are refused are reported in `problems`.
PartMeshes load_part_meshes(const scenario::Scenario& scenario, const std::vector<loop::NamedPlant>& plants,
                            Problems& problems);

}  // namespace drycut::sim::report
