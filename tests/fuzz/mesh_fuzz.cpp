// Meshes: our own reader of STL, which takes what nobody else has looked at.
#include "renders/mesh_file.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) { renders::read_stl(text); }

}  // namespace drycut
