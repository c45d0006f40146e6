#include "renders/loaded/gl_renderer.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <string>

#include "renders/antialias.hpp"
#include "renders/loaded/gl_shaders.hpp"

namespace drycut::renders {
namespace {

constexpr double kFloorReach = 8;  ///< from the middle, in radii of the mechanism; it fades on the way

/// Texture units.
enum TextureUnit : int { kScratch, kKeyMap, kSkyMap, kPaints, kNormals, kHall };

/// Floor squares of 1, 2 or 5 times a power of ten metres, about twelve over the mechanism.
double floor_spacing(double radius) {
  const double wanted = radius / 6;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * decade >= wanted) return step * decade;
  }
  return 10 * decade;
}

std::array<Vec3, 8> corners_as_placed(const Extent& box, const Placement& placement) {
  std::array<Vec3, 8> corners = corners_of(box);
  for (Vec3& corner : corners) corner = placed(placement, corner);
  return corners;
}

}  // namespace

GlRenderer::GlRenderer(const Stage& stage, const GlTurn& turn)
    : stage_(stage),
      context_(turn),
      parts_(stage.surfaces),
      lamps_(stage),
      surface_program_(shaders::kSurfaceVertex, shaders::kSurfaceFragment),
      hall_program_(shaders::kWholeVertex, std::string(shaders::kShown) + shaders::kRay +
                                               shaders::kFloorPoint + shaders::kHallFragment),
      mark_program_(shaders::kPatchVertex, shaders::kDepthFragment),
      parts_program_(shaders::kWholeVertex, std::string(shaders::kShown) + shaders::kRay + shaders::kLamps +
                                                shaders::kPartsFragment),
      floor_program_(shaders::kWholeVertex, std::string(shaders::kRay) + shaders::kLamps +
                                                shaders::kFloorPoint + shaders::kFloorFragment),
      surfaces_(stage.width, stage.height, {GL_RGBA8, GL_RGBA32F}, GL_DEPTH24_STENCIL8),
      hall_(surfaces_, {GL_RGBA8}),
      picture_(surfaces_, {GL_RGBA8}),
      pixels_(static_cast<std::size_t>(stage.width) * static_cast<std::size_t>(stage.height) * 4) {
  glGenVertexArrays(1, &empty_array_);
  for (const GlProgram* program : {&parts_program_, &floor_program_}) {
    lamps_.tell(*program);
    program->set_texture("key_map", kKeyMap);
    program->set_texture("sky_map", kSkyMap);
    program->set_texture("paints", kPaints);
    program->set_texture("normals", kNormals);
    program->set_texture("hall", kHall);
  }
  const auto bind = [](TextureUnit unit, Name texture) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture);
  };
  bind(kKeyMap, lamps_.key_map());
  bind(kSkyMap, lamps_.sky_map());
  bind(kPaints, surfaces_.colour(0));
  bind(kNormals, surfaces_.colour(1));
  bind(kHall, hall_.colour(0));
  const Vec3 centre = stage.extent.center();
  for (const GlProgram* program : {&hall_program_, &floor_program_}) {
    program->set("centre", Vec3{centre[0], stage.floor_level, centre[2]});
    program->set("reach", kFloorReach * stage.radius());
    program->set("spacing", floor_spacing(stage.radius()));
  }
  for (const GlProgram* program : {&hall_program_, &parts_program_, &floor_program_})
    program->set("pixel_size", 2.0 / stage.width, 2.0 / stage.height);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("pictures: OpenGL could not be set up");
}

void GlRenderer::draw(const std::vector<Placement>& placements, const Camera& camera, Image& image) {
  draw_pixels(placements, camera);
  put_into(image);
  antialias(image, stage_.height);
}

/// All of a frame that OpenGL does, in one turn.
void GlRenderer::draw_pixels(const std::vector<Placement>& placements, const Camera& camera) {
  const GlTurn turn;
  context_.make_current(turn);
  if (camera_ != camera) {
    look_through(camera);
    draw_still(placements);
  }
  std::vector<std::array<Vec3, 8>> moving;
  for (const std::size_t part : stage_.moving)
    if (placements[part].visible) moving.push_back(corners_as_placed(stage_.boxes[part], placements[part]));
  lamps_.draw_frame(parts_, placements, moving);
  surfaces_.start_frame(area_of(moving, view_matrix_, stage_.width, stage_.height));
  surfaces_.draw_frame();
  parts_.draw(surface_program_, in_view(placements), placements, camera.eye);
  picture_.start_frame();
  picture_.draw_frame();
  if (stage_.camera_stands) {
    mark_floor(moving);
  } else {
    mark_floor();
  }
  light();
  picture_.draw_frame();
  glReadPixels(0, 0, stage_.width, stage_.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("pictures: OpenGL failed to draw a frame");
}

/// Tells the programs where the camera is, and draws the hall as it sees it.
void GlRenderer::look_through(const Camera& camera) {
  camera_ = camera;
  view_matrix_ = view_projection(camera, static_cast<double>(stage_.width) / stage_.height, stage_.extent);
  const Eigen::Matrix3d look = look_at(camera.eye, camera.target).topLeftCorner<3, 3>();
  const double tangent = std::tan(camera.field_of_view_deg * std::numbers::pi / 360);
  for (const GlProgram* program : {&surface_program_, &hall_program_, &parts_program_, &floor_program_}) {
    program->set("eye", camera.eye);
    program->set("forward", Vec3(-look.row(2)));
    program->set("right", Vec3(tangent * stage_.width / stage_.height * look.row(0)));
    program->set("up", Vec3(tangent * look.row(1)));
  }
  surface_program_.set("matrix", view_matrix_);

  hall_.draw_frame();
  glDepthFunc(GL_ALWAYS);
  hall_program_.use();
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
}

/// What the parts that stand still are and do to the light; the floor as it is without the others.
void GlRenderer::draw_still(const std::vector<Placement>& placements) {
  lamps_.draw_still(parts_, placements);
  surfaces_.draw_still();
  parts_.draw(surface_program_, stage_.still, placements, camera_->eye);
  if (!stage_.camera_stands) return;  // every frame is lit as a whole
  surfaces_.start_frame();
  picture_.draw_still();
  mark_floor();
  light();
}

/// The moving parts but for those that are wholly beyond one edge of the picture.
std::vector<std::size_t> GlRenderer::in_view(const std::vector<Placement>& placements) const {
  std::vector<std::size_t> parts;
  for (const std::size_t part : stage_.moving) {
    if (!placements[part].visible) continue;
    std::array<int, 4> beyond = {};  // of the corners: left, right, below, above
    for (const Vec3& corner : corners_as_placed(stage_.boxes[part], placements[part])) {
      const Vec4 at = view_matrix_ * corner.homogeneous();
      beyond[0] += at.x() < -at.w() ? 1 : 0;
      beyond[1] += at.x() > at.w() ? 1 : 0;
      beyond[2] += at.y() < -at.w() ? 1 : 0;
      beyond[3] += at.y() > at.w() ? 1 : 0;
    }
    if (*std::max_element(beyond.begin(), beyond.end()) < 8) parts.push_back(part);
  }
  return parts;
}

/// Marks, in the stencil, where the floor is to be lit anew: everywhere, or where moving parts change its
/// light.
void GlRenderer::mark_floor() const {
  glClearStencil(1);
  glClear(GL_STENCIL_BUFFER_BIT);
}
void GlRenderer::mark_floor(const std::vector<std::array<Vec3, 8>>& moving) const {
  glClearStencil(0);
  glClear(GL_STENCIL_BUFFER_BIT);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 1, 1);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_CLAMP);  // also what is near the eye
  glBindVertexArray(empty_array_);
  for (const Patch& patch : lamps_.shade_on_floor(moving)) {
    mark_program_.set("patch_matrix", Matrix4(view_matrix_ * patch_matrix(patch)));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glDisable(GL_DEPTH_CLAMP);
  glEnable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_STENCIL_TEST);
}

/// Lights all parts, and the floor where it is marked.
void GlRenderer::light() const {
  glDepthMask(GL_FALSE);
  glBindVertexArray(empty_array_);
  glDepthFunc(GL_GREATER);
  parts_program_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_EQUAL, 1, 1);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  floor_program_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_STENCIL_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
}

void GlRenderer::put_into(Image& image) const {
  for (int y = 0; y < stage_.height; ++y) {
    // GL counts rows from the bottom.
    const std::uint8_t* from =
        pixels_.data() + static_cast<std::ptrdiff_t>(stage_.height - 1 - y) * stage_.width * 4;
    std::uint8_t* to = image.row(y);
    // Four bytes at a time, the fourth of which the next pixel takes; the last pixel has no next one.
    for (int x = 0; x + 1 < stage_.width; ++x, from += 4, to += 3) std::memcpy(to, from, 4);
    std::copy_n(from, 3, to);
  }
}

}  // namespace drycut::renders
