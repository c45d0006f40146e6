#define GL_GLEXT_PROTOTYPES 1
#include "renders/gl_parts.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace drycut::renders {
namespace {

template <typename Item>
void upload(GLenum target, const std::vector<Item>& items) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(items.size() * sizeof(Item)), items.data(), GL_STATIC_DRAW);
}

/// The part's axes in the world, as columns.
std::array<Vec3, 3> axes_of(const Placement& placement) {
  return {rotated(placement.rotation, {1, 0, 0}), rotated(placement.rotation, {0, 1, 0}),
          rotated(placement.rotation, {0, 0, 1})};
}

std::array<float, 16> model_of(const Placement& placement, const std::array<Vec3, 3>& axes) {
  std::array<float, 16> m{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t row = 0; row < 3; ++row)
      m[4 * i + row] = static_cast<float>(placement.scale[i] * axes[i][row]);
    m[12 + i] = static_cast<float>(placement.position[i]);
  }
  m[15] = 1;
  return m;
}

/// For normals, which a stretched part leans the other way.
std::array<float, 9> turn_of(const Placement& placement, const std::array<Vec3, 3>& axes) {
  std::array<float, 9> m{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t row = 0; row < 3; ++row)
      m[3 * i + row] = static_cast<float>(axes[i][row] / placement.scale[i]);
  return m;
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
    if (placements[part].visible) order.push_back({length(placements[part].position - eye), part});
  std::stable_sort(order.begin(), order.end(),
                   [](const Visible& a, const Visible& b) { return a.distance < b.distance; });

  program.use();
  glBindVertexArray(array_);
  const GLint model = program.place("model");
  const GLint turn = program.place("turn");
  for (const Visible& visible : order) {
    const Placement& placement = placements[visible.part];
    const Surfaces::Range& range = ranges_[visible.part];
    const auto axes = axes_of(placement);
    glUniformMatrix4fv(model, 1, GL_FALSE, model_of(placement, axes).data());
    if (turn >= 0) glUniformMatrix3fv(turn, 1, GL_FALSE, turn_of(placement, axes).data());
    glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(range.indices), GL_UNSIGNED_INT,
                             reinterpret_cast<const void*>(range.first_index * sizeof(std::uint32_t)),
                             static_cast<GLint>(range.first_vertex));
  }
}

}  // namespace drycut::renders
