#pragma once
#include <array>
#include <string>
#include <vector>

#include "renders/geometry.hpp"
#include "renders/scene3d.hpp"
#include "renders/stage.hpp"

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

/// A rectangle of pixels, from the lower left corner.
struct PixelArea {
  int left = 0, bottom = 0;
  int width = 0, height = 0;
};
/// Where things with these corners [m, world] may be in a picture of that size; all of it if one of them
/// reaches behind the eye.
PixelArea area_of(const std::vector<std::array<Vec3, 8>>& things, const Matrix4& to_clip, int width,
                  int height);

/// Textures of one size that are drawn into together, in two copies: one with what stands still over the
/// whole film, and one of the frame, which starts from it and gets what moves on top. The current OpenGL
/// context frees them.
class GlCanvas {
 public:
  using Name = unsigned int;  ///< of a GL object

  /// `colours` are the formats of the colour textures (GL_RGBA8 ...), which may be none, `depth` that of the
  /// depth texture. Throws std::runtime_error if OpenGL refuses.
  GlCanvas(int width, int height, const std::vector<Name>& colours, Name depth);
  /// Both copies are tested against the depth of the other canvas's frame.
  GlCanvas(const GlCanvas& tested, const std::vector<Name>& colours);

  /// What is drawn from now on stands still in all frames; starts empty.
  void draw_still();
  /// The frame starts as what stands still. Nothing outside `touched` is drawn before the next one starts.
  void start_frame(const PixelArea& touched);
  void start_frame() { start_frame(whole()); }
  /// What is drawn from now on is in this frame only.
  void draw_frame() const;

  /// A texture of the frame.
  Name colour(std::size_t number) const { return frame_.colours[number]; }
  Name depth() const { return frame_.depth; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  struct Copy {
    std::vector<Name> colours;
    Name depth = 0;
    Name target = 0;
  };
  Copy make(const std::vector<Name>& colours, Name depth) const;
  void draw_into(const Copy& copy) const;
  PixelArea whole() const { return {0, 0, width_, height_}; }

  int width_;
  int height_;
  bool own_depth_ = true;
  Copy still_, frame_;
  PixelArea touched_;  ///< where the frame may differ from what stands still
};

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
