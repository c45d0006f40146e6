#pragma once
#include <vector>

#include "renders/geometry.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

/// The surfaces of a film's parts, put into buffers of the current OpenGL context once; a frame only sends
/// where they are. The context frees the buffers.
class GlParts {
 public:
  explicit GlParts(const std::vector<SolidPart>& parts);

  /// Draws the visible parts, those near the eye first, so that what they hide is not shaded. `program` is in
  /// use; it gets `model` and, if it asks for it, `turn`.
  void draw(unsigned int program, const std::vector<Placement>& placements, const Vec3& eye) const;

 private:
  /// Where a part's triangles are in the buffers.
  struct Range {
    int first_index = 0;
    int indices = 0;
    int first_vertex = 0;
  };
  std::vector<Range> ranges_;
  unsigned int array_ = 0;
};

}  // namespace drycut::renders
