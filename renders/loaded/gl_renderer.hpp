#pragma once
#include <array>
#include <optional>
#include <vector>

#include "renders/loaded/gl_context.hpp"
#include "renders/loaded/gl_lamps.hpp"
#include "renders/loaded/gl_parts.hpp"
#include "renders/png_image.hpp"
#include "renders/stage.hpp"

namespace drycut::renders {

/// Draws parts on a floor, lit by a lamp with shadows and by the sky, antialiased. What stands still over the
/// film is drawn once, and the floor is lit anew only where moving parts change its light. Owns its
/// context; use it in the thread that made it. Renderers of several threads take turns at OpenGL.
class GlRenderer {
 public:
  /// `stage` must outlive it. Throws std::runtime_error if the context, a shader or a framebuffer cannot be
  /// made.
  explicit GlRenderer(const Stage& stage) : GlRenderer(stage, GlTurn()) {}

  /// Draws the parts, placed one by one, as `camera` sees them, into the upper stage.height rows of `image`,
  /// which is stage.width wide. Another renderer may have drawn in this thread before. The still parts'
  /// placements are those of any frame.
  void draw(const std::vector<Placement>& placements, const Camera& camera, Image& image);

 private:
  using Name = unsigned int;  ///< of a GL object; the context frees them all when it goes

  GlRenderer(const Stage& stage, const GlTurn& turn);
  void draw_pixels(const std::vector<Placement>& placements, const Camera& camera);
  void look_through(const Camera& camera);
  void draw_still(const std::vector<Placement>& placements);
  void mark_floor() const;
  void mark_floor(const std::vector<std::array<Vec3, 8>>& moving) const;
  std::vector<std::size_t> in_view(const std::vector<Placement>& placements) const;
  void light() const;
  void put_into(Image& image) const;

  const Stage& stage_;
  std::optional<Camera> camera_;  ///< that the programs know
  GlContext context_;
  GlParts parts_;
  GlLamps lamps_;
  GlProgram surface_program_, hall_program_, mark_program_, parts_program_, floor_program_;
  GlCanvas surfaces_;  ///< what every pixel shows: paint, normal, distance
  GlCanvas hall_;      ///< the floor without shadows
  GlCanvas picture_;
  Matrix4 view_matrix_;
  Name empty_array_ = 0;
  std::vector<std::uint8_t> pixels_;  ///< of the last frame, RGBA, rows from below
};

}  // namespace drycut::renders
