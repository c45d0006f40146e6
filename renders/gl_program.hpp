#pragma once
#include <string>

#include "renders/geometry.hpp"

namespace drycut::renders {

/// A vertex and a fragment shader in the current OpenGL context, which frees them.
class GlProgram {
 public:
  /// `vertex` and `fragment` are GLSL without the #version line. Throws std::runtime_error with the
  /// compiler's words.
  GlProgram(const std::string& vertex, const std::string& fragment);

  void use() const;
  /// The place of a uniform, -1 if the program does not ask for it.
  int place(const char* name) const;

  // Sets a uniform; nothing happens if the program does not ask for it.
  void set(const char* name, const Matrix4& matrix) const;
  void set(const char* name, const Vec3& vector) const;
  void set(const char* name, double value) const;
  void set(const char* name, double x, double y) const;
  void set_texture(const char* name, int unit) const;

 private:
  unsigned int program_ = 0;
};

}  // namespace drycut::renders
