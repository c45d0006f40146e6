#pragma once
#include <string_view>
#include <vector>

#include "renders/scene3d.hpp"

namespace drycut::renders {

// The meshes of scenes/meshes/, which are built into the program: wherever it is moved, it can draw.

/// Names of the models, in alphabetical order: "drum", "servo_motor".
std::vector<std::string_view> part_model_names();

/// The bytes of a model's STL file; empty if there is none of that name.
std::string_view part_model_file(std::string_view name);

/// The model of that name [m]. Throws std::logic_error if there is none.
Mesh part_model(std::string_view name);

}  // namespace drycut::renders
