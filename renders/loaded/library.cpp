#include <assimp/version.h>
#include <fmt/format.h>

#include <memory>

#include "renders/loaded/faces.hpp"
#include "renders/loaded/gl_renderer.hpp"

namespace drycut::renders {
namespace {

std::string assimp_version() {
  return fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionRevision());
}

DrawParts drawer(const Stage& stage) {
  return [renderer = std::make_shared<GlRenderer>(stage)](const std::vector<Placement>& placements,
                                                          const Camera& camera, Image& image) {
    renderer->draw(placements, camera, image);
  };
}

}  // namespace
}  // namespace drycut::renders

extern "C" __attribute__((visibility("default"))) const drycut::renders::PictureLibrary drycut_library;
const drycut::renders::PictureLibrary drycut_library = {
    drycut::renders::assimp_version, drycut::renders::corners_of_file, drycut::renders::corners_of_stl,
    drycut::renders::glb, drycut::renders::drawer};
