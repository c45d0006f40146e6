#include "renders/loaded/gl_lamps.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>

#include "renders/loaded/gl_shaders.hpp"

namespace drycut::renders {
namespace {

constexpr int kKeySize = 1024;
constexpr int kSkySize = 256;
constexpr int kSkyMeans = 64;
const Vec3 kToKey = {-0.35, 1.0, 0.62};  ///< upstream, above, operator's side
const Vec3 kToSky = {0, 1, 0};

}  // namespace

GlLamps::GlLamps(const Stage& stage)
    : stage_(stage),
      key_(lamp_towards(kToKey)),
      sky_(lamp_towards(kToSky)),
      centre_(stage.extent.center()),
      // Parts may be far from the mechanism (a coil stand), so the lamps see some way around it.
      reach_(2 * stage.radius()),
      depth_program_(shaders::kDepthVertex, shaders::kDepthFragment),
      height_program_(shaders::kHeightVertex, shaders::kHeightFragment),
      means_program_(shaders::kWholeVertex, shaders::kMeansFragment),
      key_map_(kKeySize, kKeySize, {}, GL_DEPTH_COMPONENT32F),
      sky_map_(kSkySize, kSkySize, {GL_RG32F}, GL_DEPTH_COMPONENT32F),
      sky_means_(kSkyMeans, kSkyMeans, {GL_RG32F}, GL_DEPTH_COMPONENT16) {
  glGenVertexArrays(1, &empty_array_);
  depth_program_.set("matrix", map_matrix(key_, centre_, reach_));
  height_program_.set("matrix", map_matrix(sky_, centre_, reach_));
  height_program_.set("floor_level", stage.floor_level);
  means_program_.set("shrink", static_cast<double>(kSkySize) / kSkyMeans);

  glBindTexture(GL_TEXTURE_2D, key_map());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  for (const Name map : {key_map(), sky_map(), sky_map_.colour(0)}) {
    glBindTexture(GL_TEXTURE_2D, map);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  }
}

void GlLamps::draw_still(const GlParts& parts, const std::vector<Placement>& placements) {
  key_map_.draw_still();
  draw_into_key(parts, stage_.still, placements);
  sky_map_.draw_still();
  draw_into_sky(parts, stage_.still, placements);
  key_map_.start_frame();
  sky_map_.start_frame();
  blur_sky();
}

void GlLamps::draw_frame(const GlParts& parts, const std::vector<Placement>& placements,
                         const std::vector<std::array<Vec3, 8>>& moving) {
  key_map_.start_frame(area_of(moving, map_matrix(key_, centre_, reach_), kKeySize, kKeySize));
  key_map_.draw_frame();
  draw_into_key(parts, stage_.moving, placements);
  sky_map_.start_frame(area_of(moving, map_matrix(sky_, centre_, reach_), kSkySize, kSkySize));
  sky_map_.draw_frame();
  draw_into_sky(parts, stage_.moving, placements);
  blur_sky();
}

void GlLamps::draw_into_key(const GlParts& parts, const std::vector<std::size_t>& which,
                            const std::vector<Placement>& placements) const {
  parts.draw(depth_program_, which, placements, centre_ + (10 * reach_) * key_.toward);
}

void GlLamps::draw_into_sky(const GlParts& parts, const std::vector<std::size_t>& which,
                            const std::vector<Placement>& placements) const {
  parts.draw(height_program_, which, placements, centre_ + (10 * reach_) * sky_.toward);
}

void GlLamps::blur_sky() const {
  sky_means_.draw_frame();
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, sky_map_.colour(0));
  glDepthFunc(GL_ALWAYS);
  means_program_.use();
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
}

void GlLamps::tell(const GlProgram& program) const {
  program.set("key_matrix", map_matrix(key_, centre_, reach_));
  program.set("to_light", key_.toward);
  program.set("centre", Vec3{centre_[0], stage_.floor_level, centre_[2]});
  program.set("sky_reach", reach_);
  program.set("sky_blur", 2 * reach_ / kSkyMeans);
}

std::vector<Patch> GlLamps::shade_on_floor(const std::vector<std::array<Vec3, 8>>& parts) const {
  // A look at the key's map takes in a neighbour, one at the sky's a mean of texels and its neighbours.
  auto patches = renders::shade_on_floor(key_, parts, stage_.floor_level, 2 * (2 * reach_ / kKeySize));
  const auto below = renders::shade_on_floor(sky_, parts, stage_.floor_level, 2 * (2 * reach_ / kSkyMeans));
  patches.insert(patches.end(), below.begin(), below.end());
  return patches;
}

}  // namespace drycut::renders
