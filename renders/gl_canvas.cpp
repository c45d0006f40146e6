#include "renders/gl_canvas.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace drycut::renders {
namespace {

GLuint make_texture(GLenum format, int width, int height) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

PixelArea area_of(const std::vector<std::array<Vec3, 8>>& things, const Matrix4& to_clip, int width,
                  int height) {
  const PixelArea whole = {0, 0, width, height};
  Eigen::AlignedBox2d seen;
  for (const auto& corners : things) {
    for (const Vec3& corner : corners) {
      const Vec4 at = to_clip * corner.homogeneous();
      if (at.w() <= 0) return whole;
      seen.extend(Eigen::Vector2d(at.x() / at.w(), at.y() / at.w()));
    }
  }
  if (seen.isEmpty()) return {};
  // A pixel more around, for what rounding does.
  const auto pixel = [](double clip, int size, int more) {
    return std::clamp(static_cast<int>(std::floor((std::clamp(clip, -2.0, 2.0) + 1) / 2 * size)) + more, 0,
                      size);
  };
  const int left = pixel(seen.min().x(), width, -1);
  const int bottom = pixel(seen.min().y(), height, -1);
  return {left, bottom, pixel(seen.max().x(), width, 2) - left, pixel(seen.max().y(), height, 2) - bottom};
}

GlCanvas::GlCanvas(int width, int height, const std::vector<Name>& colours, Name depth)
    : width_(width), height_(height) {
  still_ = make(colours, make_texture(depth, width, height));
  frame_ = make(colours, make_texture(depth, width, height));
}

GlCanvas::GlCanvas(const GlCanvas& tested, const std::vector<Name>& colours)
    : width_(tested.width_), height_(tested.height_), own_depth_(false) {
  still_ = make(colours, tested.depth());
  frame_ = make(colours, tested.depth());
}

GlCanvas::Copy GlCanvas::make(const std::vector<Name>& colours, Name depth) const {
  Copy copy;
  for (const Name format : colours) copy.colours.push_back(make_texture(format, width_, height_));
  copy.depth = depth;

  glGenFramebuffers(1, &copy.target);
  glBindFramebuffer(GL_FRAMEBUFFER, copy.target);
  std::vector<GLenum> outputs;
  for (const Name colour : copy.colours) {
    outputs.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(outputs.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, outputs.back(), GL_TEXTURE_2D, colour, 0);
  }
  GLint stencil = 0;
  glBindTexture(GL_TEXTURE_2D, copy.depth);
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_STENCIL_SIZE, &stencil);
  glFramebufferTexture2D(GL_FRAMEBUFFER, stencil > 0 ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                         GL_TEXTURE_2D, copy.depth, 0);
  if (outputs.empty()) {
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  } else {
    glDrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("pictures: OpenGL refuses a framebuffer");
  return copy;
}

void GlCanvas::draw_into(const Copy& copy) const {
  glBindFramebuffer(GL_FRAMEBUFFER, copy.target);
  glViewport(0, 0, width_, height_);
}

void GlCanvas::draw_still() {
  draw_into(still_);
  touched_ = whole();
  if (own_depth_) glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void GlCanvas::start_frame(const PixelArea& touched) {
  const PixelArea area = std::exchange(touched_, touched);
  if (area.width == 0 || area.height == 0) return;
  const auto copy = [&area](Name from, Name to) {
    glCopyImageSubData(from, GL_TEXTURE_2D, 0, area.left, area.bottom, 0, to, GL_TEXTURE_2D, 0, area.left,
                       area.bottom, 0, area.width, area.height, 1);
  };
  for (std::size_t i = 0; i < still_.colours.size(); ++i) copy(still_.colours[i], frame_.colours[i]);
  if (own_depth_) copy(still_.depth, frame_.depth);
}

void GlCanvas::draw_frame() const { draw_into(frame_); }

}  // namespace drycut::renders
