#pragma once
#include <cstdint>
#include <memory>
#include <vector>

namespace drycut::renders {

/// An OpenGL 4.3 core context without a window, current in the thread that made it last. The only place that
/// knows OSMesa, so that EGL can take its place. Draw into framebuffer objects: it has no picture of its own.
class GlContext {
 public:
  /// Throws std::runtime_error if the library gives no such context.
  GlContext();
  ~GlContext();
  /// From now on what this thread draws goes here. Throws std::runtime_error.
  void make_current();
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
