#pragma once
#include <optional>
#include <vector>

#include "renders/camera.hpp"
#include "renders/gl_context.hpp"
#include "renders/gl_parts.hpp"
#include "renders/png_image.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

/// What stays the same over a film.
struct Stage {
  Extent extent;           ///< what the light and the depth range are made for [m]
  double floor_level = 0;  ///< [m]
  int width = 960;         ///< pixels
  int height = 540;        ///< pixels
};

/// Draws parts on a floor, lit by one lamp with shadows, antialiased. Owns its context; use it in the thread
/// that made it.
class GlRenderer {
 public:
  /// Throws std::runtime_error if the context, a shader or a framebuffer cannot be made.
  GlRenderer(const Stage& stage, const std::vector<SolidPart>& parts);

  /// Draws the parts, placed one by one, as `camera` sees them, into the upper stage.height rows of `image`,
  /// which is stage.width wide.
  void draw(const std::vector<Placement>& placements, const Camera& camera, Image& image);

 private:
  using Name = unsigned int;  ///< of a GL object; the context frees them all when it goes

  void make_programs();
  void look_through(const Camera& camera);
  void set_stage(Name program) const;
  void make_targets();
  void make_backdrop();
  void draw_backdrop();
  void draw_shadows(const std::vector<Placement>& placements);
  void draw_picture(const std::vector<Placement>& placements);
  void read_into(Image& image);

  Stage stage_;
  std::optional<Camera> camera_;  ///< that the programs know
  GlContext context_;
  GlParts parts_;
  Matrix4 view_matrix_{};
  Matrix4 light_matrix_{};
  Vec3 to_light_{};
  Vec3 centre_{};
  double radius_ = 1;
  Name solids_program_ = 0, shadowed_program_ = 0, depth_program_ = 0, backdrop_program_ = 0;
  Name empty_array_ = 0;
  Name shadow_map_ = 0, backdrop_ = 0, shadow_target_ = 0, picture_target_ = 0, backdrop_target_ = 0;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace drycut::renders
