#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace drycut::renders {

/// The right to call OpenGL, which one thread of the process has at a time: all contexts share one
/// rasteriser, and Mesa before 25 walks the scenes of all of them, unlocked, where one is copied or read.
/// Held from making a context current to the end of reading a frame, and while one is made or destroyed. A
/// thread that has it may take it again.
class GlTurn {
 public:
  GlTurn();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

/// An OpenGL 4.3 core context without a window, current in the thread that made it last. The only place that
/// knows OSMesa, so that EGL can take its place. Draw into framebuffer objects: it has no picture of its own.
class GlContext {
 public:
  /// Current in this thread. Throws std::runtime_error if the library gives no such context.
  explicit GlContext(const GlTurn& turn);
  ~GlContext();
  /// From now on what this thread draws goes here. Throws std::runtime_error.
  void make_current(const GlTurn& turn);
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

 private:
  struct Release {
    void operator()(void* context) const;
  };
  std::unique_ptr<void, Release> context_;
  std::vector<std::uint8_t> buffer_;  ///< OSMesa wants one to make a context current
};

}  // namespace drycut::renders
