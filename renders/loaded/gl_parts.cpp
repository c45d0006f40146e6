#include "renders/loaded/gl_parts.hpp"

#include <GL/gl.h>
#include <GL/glext.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace drycut::renders {

namespace {

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

}  // namespace

GlProgram::GlProgram(const std::string& vertex, const std::string& fragment) : program_(glCreateProgram()) {
  for (const GLuint shader : {compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)}) {
    glAttachShader(program_, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program_);
  GLint good = GL_FALSE;
  glGetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good != GL_TRUE) throw std::runtime_error("pictures: the shaders do not fit together");
}

void GlProgram::use() const { glUseProgram(program_); }

int GlProgram::place(const char* name) const { return glGetUniformLocation(program_, name); }

void GlProgram::set(const char* name, const Matrix4& matrix) const {
  use();
  glUniformMatrix4fv(place(name), 1, GL_FALSE, Eigen::Matrix4f(matrix.cast<float>()).data());
}
void GlProgram::set(const char* name, const Vec3& vector) const {
  use();
  glUniform3fv(place(name), 1, as_floats(vector).data());
}
void GlProgram::set(const char* name, double value) const {
  use();
  glUniform1f(place(name), static_cast<float>(value));
}
void GlProgram::set(const char* name, double x, double y) const {
  use();
  glUniform2f(place(name), static_cast<float>(x), static_cast<float>(y));
}
void GlProgram::set_texture(const char* name, int unit) const {
  use();
  glUniform1i(place(name), unit);
}

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

namespace {

template <typename Item>
void upload(GLenum target, const std::vector<Item>& items) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(items.size() * sizeof(Item)), items.data(), GL_STATIC_DRAW);
}

}  // namespace

GlParts::GlParts(const Surfaces& surfaces) : ranges_(surfaces.parts) {
  glGenVertexArrays(1, &array_);
  glBindVertexArray(array_);
  upload(GL_ARRAY_BUFFER, surfaces.vertices);
  upload(GL_ELEMENT_ARRAY_BUFFER, surfaces.indices);
  const auto attribute = [](GLuint index, GLint size, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                          reinterpret_cast<const void*>(offset));
  };
  attribute(0, 3, offsetof(Vertex, position));
  attribute(1, 3, offsetof(Vertex, normal));
  attribute(2, 3, offsetof(Vertex, colour));
  attribute(3, 2, offsetof(Vertex, surface));
}

void GlParts::draw(const GlProgram& program, const std::vector<std::size_t>& parts,
                   const std::vector<Placement>& placements, const Vec3& eye) const {
  struct Visible {
    double distance;
    std::size_t part;
  };
  std::vector<Visible> order;
  for (const std::size_t part : parts)
    if (placements[part].visible) order.push_back({(placements[part].position - eye).norm(), part});
  std::stable_sort(order.begin(), order.end(),
                   [](const Visible& a, const Visible& b) { return a.distance < b.distance; });

  program.use();
  glBindVertexArray(array_);
  const GLint model = program.place("model");
  const GLint turn = program.place("turn");
  for (const Visible& visible : order) {
    const Placement& placement = placements[visible.part];
    const Surfaces::Range& range = ranges_[visible.part];
    const Eigen::Affine3d where = Eigen::Translation3d(placement.position) * rotation_of(placement.rotation);
    const Eigen::Affine3f stretched = (where * Eigen::Scaling(placement.scale)).cast<float>();
    glUniformMatrix4fv(model, 1, GL_FALSE, stretched.data());
    // For normals, which a stretched part leans the other way.
    const Eigen::Matrix3d leaned = where.linear() * placement.scale.cwiseInverse().asDiagonal();
    if (turn >= 0) glUniformMatrix3fv(turn, 1, GL_FALSE, Eigen::Matrix3f(leaned.cast<float>()).data());
    glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(range.indices), GL_UNSIGNED_INT,
                             reinterpret_cast<const void*>(range.first_index * sizeof(std::uint32_t)),
                             static_cast<GLint>(range.first_vertex));
  }
}

}  // namespace drycut::renders
