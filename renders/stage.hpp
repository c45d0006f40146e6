#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "renders/camera.hpp"
#include "renders/scene3d.hpp"
#include "renders/solid_mesh.hpp"

namespace drycut::renders {

/// The surfaces of all parts; equal corners of a part are one vertex.
struct Surfaces {
  /// Where a part's triangles are.
  struct Range {
    std::size_t first_index = 0;
    std::size_t indices = 0;
    std::size_t first_vertex = 0;  ///< the indices count from it
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Range> parts;
};

/// What stays the same over a film: found once, whoever draws the frames.
struct Stage {
  int width = 960;         ///< of the picture of the machine [pixels]
  int height = 540;        ///< [pixels]
  Extent extent;           ///< what the light and the depth range are made for [m]
  double floor_level = 0;  ///< [m]
  bool camera_stands = true;
  Surfaces surfaces;
  std::vector<Extent> boxes;        ///< around each part, in its own coordinates [m]
  std::vector<std::size_t> still;   ///< parts that stay where they are and visible over the whole film
  std::vector<std::size_t> moving;  ///< the others

  /// Of a ball around the extent [m].
  double radius() const { return std::max(1e-3, extent.diagonal().norm() / 2); }
};

/// The stage of a film that can be drawn, in a picture `height` pixels high and as wide as the film.
Stage stage_of(const Film& film, int height);
/// The stages of its cameras, each as large as the camera's part of the picture.
std::vector<Stage> stages_of(const Film& film);

}  // namespace drycut::renders
