#pragma once
#include <vector>

#include "renders/gl_program.hpp"
#include "renders/scene3d.hpp"
#include "renders/stage.hpp"

namespace drycut::renders {

/// The surfaces of a film's parts, put into buffers of the current OpenGL context once; a frame only sends
/// where they are. The context frees the buffers.
class GlParts {
 public:
  explicit GlParts(const Surfaces& surfaces);

  /// Draws those of `parts` that are visible, the ones near the eye first, so that what they hide is not
  /// drawn twice. The program gets `model` and, if it asks for it, `turn`.
  void draw(const GlProgram& program, const std::vector<std::size_t>& parts,
            const std::vector<Placement>& placements, const Vec3& eye) const;

 private:
  std::vector<Surfaces::Range> ranges_;
  unsigned int array_ = 0;
};

}  // namespace drycut::renders
