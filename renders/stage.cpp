#include "renders/stage.hpp"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "renders/mesh.hpp"
#include "renders/tiles.hpp"

namespace drycut::renders {
namespace {

static_assert(sizeof(Vertex) == 11 * sizeof(float), "vertices are compared by their bytes");

void append(Surfaces& surfaces, const std::vector<Vertex>& corners) {
  const std::size_t first_vertex = surfaces.vertices.size();
  surfaces.parts.push_back({surfaces.indices.size(), corners.size(), first_vertex});
  std::unordered_map<std::string_view, std::uint32_t> known;
  known.reserve(corners.size());
  for (const Vertex& corner : corners) {
    const std::string_view bytes(reinterpret_cast<const char*>(&corner), sizeof(Vertex));
    const auto next = static_cast<std::uint32_t>(surfaces.vertices.size() - first_vertex);
    const auto [found, fresh] = known.emplace(bytes, next);
    if (fresh) surfaces.vertices.push_back(corner);
    surfaces.indices.push_back(found->second);
  }
}

Extent box_of(const SolidPart& part) {
  if (part.mesh) return extent_of(*part.mesh);
  return {-part.size / 2, part.size / 2};
}

bool stands(const Film& film, std::size_t part) {
  const Placement& first = film.frames.front().placements[part];
  return std::all_of(film.frames.begin(), film.frames.end(), [&](const Frame& frame) {
    const Placement& now = frame.placements[part];
    return now.visible && now.position == first.position && now.rotation == first.rotation &&
           now.scale == first.scale;
  });
}

}  // namespace

Stage stage_of(const Film& film, int height) {
  Stage stage;
  stage.width = film.width;
  stage.height = height;
  stage.extent = mechanism_extent(film);
  stage.floor_level = floor_level(film);
  stage.camera_stands = !film.follow;
  for (std::size_t i = 0; i < film.parts.size(); ++i) {
    append(stage.surfaces, solid_surface(film.parts[i]));
    stage.boxes.push_back(box_of(film.parts[i]));
    (stands(film, i) ? stage.still : stage.moving).push_back(i);
  }
  return stage;
}

std::vector<Stage> stages_of(const Film& film) {
  const std::vector<Tile> tiles = tiles_of(film);
  std::vector<Stage> stages(tiles.size(), stage_of(film, tiles.front().height));
  for (std::size_t view = 0; view < tiles.size(); ++view) {
    stages[view].width = tiles[view].width;
    stages[view].height = tiles[view].height;
    if (view > 0) stages[view].camera_stands = true;
  }
  return stages;
}

}  // namespace drycut::renders
