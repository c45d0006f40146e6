#pragma once
#include <vector>

#include "renders/camera.hpp"
#include "renders/gl_context.hpp"
#include "renders/png_image.hpp"
#include "renders/solid_mesh.hpp"

namespace drycut::renders {

/// What stays the same over a film.
struct Stage {
  Camera camera;
  Extent extent;           ///< what the light and the depth range are made for [m]
  double floor_level = 0;  ///< [m]
  int width = 960;         ///< pixels
  int height = 540;        ///< pixels
};

/// Draws triangles on a floor, lit by one lamp with shadows, antialiased. Owns its context; use it in the
/// thread that made it.
class GlRenderer {
 public:
  /// Throws std::runtime_error if the context, a shader or a framebuffer cannot be made.
  explicit GlRenderer(const Stage& stage);

  /// Draws the triangles into the upper stage.height rows of `image`, which is stage.width wide.
  void draw(const std::vector<Vertex>& triangles, Image& image);

 private:
  using Name = unsigned int;  ///< of a GL object; the context frees them all when it goes

  void make_programs();
  void set_stage(Name program) const;
  void make_targets();
  void make_solids();
  void make_backdrop();
  void draw_shadows(int vertices);
  void draw_picture(int vertices);
  void read_into(Image& image);

  Stage stage_;
  GlContext context_;
  Matrix4 view_matrix_{};
  Matrix4 light_matrix_{};
  Vec3 to_light_{};
  Vec3 centre_{};
  double radius_ = 1;
  Name solids_program_ = 0, shadowed_program_ = 0, depth_program_ = 0;
  Name solids_array_ = 0, solids_buffer_ = 0, empty_array_ = 0;
  Name shadow_map_ = 0, backdrop_ = 0, shadow_target_ = 0, sampled_target_ = 0, resolved_target_ = 0;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace drycut::renders
