#include "renders/gltf.hpp"

#include <stdexcept>

#include "base/output_file.hpp"
#include "renders/picture_library.hpp"
#include "renders/pictures.hpp"

namespace drycut::renders {

std::string gltf(const Film& film, int slow) {
  require_drawable(film);
  if (film.frames.empty()) throw std::invalid_argument("glTF: the film has no frames");
  return picture_library().glb(film, slow);
}

std::string gltf_of_parts(const Film& film) {
  if (film.frames.empty()) throw std::invalid_argument("glTF: the film has no frames");
  Film still;
  still.title = film.title;
  still.parts = film.parts;
  still.frames.resize(1);
  still.frames.front().placements = film.frames.front().placements;
  for (auto& placement : still.frames.front().placements) placement.visible = true;
  return gltf(still);
}

void write_gltf(const Film& film, const std::filesystem::path& file, int slow) {
  write_file(file, gltf(film, slow));
}

}  // namespace drycut::renders
