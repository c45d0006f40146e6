#include "renders/gl_parts.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
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
