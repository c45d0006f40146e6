#pragma once
#include <vector>

namespace drycut::renders {

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
  void draw_still() const;
  /// The frame starts as what stands still.
  void start_frame() const;
  /// What is drawn from now on is in this frame only.
  void draw_frame() const;

  /// A texture of the frame.
  Name colour(std::size_t number) const { return frame_.colours[number]; }
  Name depth() const { return frame_.depth; }

 private:
  struct Copy {
    std::vector<Name> colours;
    Name depth = 0;
    Name target = 0;
  };
  Copy make(const std::vector<Name>& colours, Name depth) const;
  void draw_into(const Copy& copy) const;

  int width_;
  int height_;
  bool own_depth_ = true;
  Copy still_, frame_;
};

}  // namespace drycut::renders
