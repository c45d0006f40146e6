#define GL_GLEXT_PROTOTYPES 1
#include "renders/gl_renderer.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "renders/antialias.hpp"
#include "renders/gl_shaders.hpp"

namespace drycut::renders {
namespace {

constexpr int kShadowSize = 1024;
constexpr double kFloorReach = 8;  ///< from the middle, in radii of the mechanism; it fades on the way
constexpr Vec3 kToLight = {-0.35, 1.0, 0.62};  ///< upstream, above, operator's side

std::array<float, 16> to_floats(const Matrix4& m) {
  std::array<float, 16> floats{};
  std::transform(m.begin(), m.end(), floats.begin(), [](double v) { return static_cast<float>(v); });
  return floats;
}

GLuint compile(GLenum kind, const std::string& source) {
  const std::string whole = "#version 330 core\n" + source;
  const char* text = whole.c_str();
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::string log(2000, '\0');
  GLsizei size = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &size, log.data());
  log.resize(static_cast<std::size_t>(size));
  throw std::runtime_error("pictures: a shader does not compile: " + log);
}

GLuint link(const std::string& vertex, const std::string& fragment) {
  const GLuint program = glCreateProgram();
  for (const GLuint shader : {compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)}) {
    glAttachShader(program, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good != GL_TRUE) throw std::runtime_error("pictures: the shaders do not fit together");
  return program;
}

void set(GLuint program, const char* name, const Matrix4& m) {
  glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, to_floats(m).data());
}
void set(GLuint program, const char* name, const Vec3& v) {
  glUniform3f(glGetUniformLocation(program, name), static_cast<float>(v[0]), static_cast<float>(v[1]),
              static_cast<float>(v[2]));
}
void set(GLuint program, const char* name, double value) {
  glUniform1f(glGetUniformLocation(program, name), static_cast<float>(value));
}

void renderbuffer(GLenum attachment, GLenum format, int width, int height) {
  GLuint buffer = 0;
  glGenRenderbuffers(1, &buffer);
  glBindRenderbuffer(GL_RENDERBUFFER, buffer);
  glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
}

void require_complete(const char* what) {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(std::string("pictures: OpenGL refuses the framebuffer for the ") + what);
  }
}

/// Floor squares of 1, 2 or 5 times a power of ten metres, about twelve over the mechanism.
double floor_spacing(double radius) {
  const double wanted = radius / 6;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * decade >= wanted) return step * decade;
  }
  return 10 * decade;
}

}  // namespace

GlRenderer::GlRenderer(const Stage& stage, const std::vector<SolidPart>& parts)
    : stage_(stage), parts_(parts) {
  radius_ = std::max(1e-3, length(stage.extent.high - stage.extent.low) / 2);
  centre_ = 0.5 * (stage.extent.low + stage.extent.high);
  to_light_ = normalised(kToLight);

  // Parts may be far from the mechanism (a coil stand), so the lamp sees some way around it.
  const double seen = 2.0 * radius_;
  const double far = 6 * seen;
  light_matrix_ = multiplied(orthographic(seen, 0, far), look_at(centre_ + (far / 2) * to_light_, centre_));

  make_programs();
  make_targets();
  make_backdrop();
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("pictures: OpenGL could not be set up");
}

/// The backdrop is drawn anew only for another camera.
void GlRenderer::look_through(const Camera& camera) {
  if (camera_ == camera) return;
  camera_ = camera;
  view_matrix_ = view_projection(camera, static_cast<double>(stage_.width) / stage_.height, stage_.extent);
  for (const Name program : {solids_program_, shadowed_program_, backdrop_program_}) set_stage(program);
  draw_backdrop();
}

/// What every program that looks from the camera wants to know.
void GlRenderer::set_stage(Name program) const {
  const Vec3 forward = normalised(camera_->target - camera_->eye);
  const Matrix4 look = look_at(camera_->eye, camera_->target);
  const double tangent = std::tan(camera_->field_of_view_deg * std::numbers::pi / 360);
  glUseProgram(program);
  set(program, "matrix", view_matrix_);
  set(program, "light_matrix", light_matrix_);
  set(program, "eye", camera_->eye);
  set(program, "to_light", to_light_);
  set(program, "centre", Vec3{centre_[0], stage_.floor_level, centre_[2]});
  set(program, "reach", kFloorReach * radius_);
  set(program, "spacing", floor_spacing(radius_));
  set(program, "picture_height", stage_.height);
  set(program, "forward", forward);
  set(program, "right", (tangent * stage_.width / stage_.height) * Vec3{look[0], look[4], look[8]});
  set(program, "up", tangent * Vec3{look[1], look[5], look[9]});
}

void GlRenderer::make_programs() {
  using namespace shaders;
  const std::string shown = kShown;
  solids_program_ = link(kSolidVertex, shown + kShadow + kSolidFragment);
  shadowed_program_ = link(kBackdropVertex, std::string(kShadow) + kFloorPoint + kShadowedFragment);
  depth_program_ = link(kDepthVertex, kDepthFragment);
  backdrop_program_ = link(kBackdropVertex, shown + kFloorPoint + kBackdropFragment);
  glUseProgram(shadowed_program_);
  glUniform1i(glGetUniformLocation(shadowed_program_, "backdrop"), 1);
  glUseProgram(depth_program_);
  set(depth_program_, "matrix", light_matrix_);
}

void GlRenderer::make_targets() {
  glGenTextures(1, &shadow_map_);
  glBindTexture(GL_TEXTURE_2D, shadow_map_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kShadowSize, kShadowSize, 0, GL_DEPTH_COMPONENT,
               GL_FLOAT, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);

  glGenFramebuffers(1, &shadow_target_);
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_target_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_map_, 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  require_complete("shadows");

  glGenFramebuffers(1, &picture_target_);
  glBindFramebuffer(GL_FRAMEBUFFER, picture_target_);
  renderbuffer(GL_COLOR_ATTACHMENT0, GL_RGBA8, stage_.width, stage_.height);
  renderbuffer(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, stage_.width, stage_.height);
  require_complete("picture");
  pixels_.resize(static_cast<std::size_t>(stage_.width) * static_cast<std::size_t>(stage_.height) * 4);
}

void GlRenderer::make_backdrop() {
  glActiveTexture(GL_TEXTURE1);
  glGenTextures(1, &backdrop_);
  glBindTexture(GL_TEXTURE_2D, backdrop_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, stage_.width, stage_.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glActiveTexture(GL_TEXTURE0);

  glGenFramebuffers(1, &backdrop_target_);
  glBindFramebuffer(GL_FRAMEBUFFER, backdrop_target_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, backdrop_, 0);
  require_complete("backdrop");
  glGenVertexArrays(1, &empty_array_);
}

void GlRenderer::draw_backdrop() {
  glBindFramebuffer(GL_FRAMEBUFFER, backdrop_target_);
  glViewport(0, 0, stage_.width, stage_.height);
  glDisable(GL_DEPTH_TEST);
  glUseProgram(backdrop_program_);
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void GlRenderer::draw(const std::vector<Placement>& placements, const Camera& camera, Image& image) {
  look_through(camera);
  draw_shadows(placements);
  draw_picture(placements);
  read_into(image);
  antialias(image, stage_.height);
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("pictures: OpenGL failed to draw a frame");
}

void GlRenderer::draw_shadows(const std::vector<Placement>& placements) {
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_target_);
  glViewport(0, 0, kShadowSize, kShadowSize);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glUseProgram(depth_program_);
  parts_.draw(depth_program_, placements, centre_ + (10 * radius_) * to_light_);
}

void GlRenderer::draw_picture(const std::vector<Placement>& placements) {
  glBindFramebuffer(GL_FRAMEBUFFER, picture_target_);
  glViewport(0, 0, stage_.width, stage_.height);
  glClear(GL_DEPTH_BUFFER_BIT);
  glBindTexture(GL_TEXTURE_2D, shadow_map_);
  glUseProgram(solids_program_);
  parts_.draw(solids_program_, placements, camera_->eye);

  // Last, so that only what is still empty gets shaded. No part is below the floor, so it needs no depth.
  glDepthFunc(GL_LEQUAL);
  glUseProgram(shadowed_program_);
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
}

void GlRenderer::read_into(Image& image) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_target_);
  glReadPixels(0, 0, stage_.width, stage_.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
  for (int y = 0; y < stage_.height; ++y) {
    // GL counts rows from the bottom.
    const std::uint8_t* from =
        pixels_.data() + static_cast<std::ptrdiff_t>(stage_.height - 1 - y) * stage_.width * 4;
    std::uint8_t* to = image.row(y);
    for (int x = 0; x < stage_.width; ++x, from += 4, to += 3) std::copy_n(from, 3, to);
  }
}

}  // namespace drycut::renders
