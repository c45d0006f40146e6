#include "renders/loaded/gl_context.hpp"

#include <GL/osmesa.h>

#include <array>
#include <stdexcept>

namespace drycut::renders {

namespace {

std::recursive_mutex& turns() {
  static std::recursive_mutex of_the_process;
  return of_the_process;
}

}  // namespace

GlTurn::GlTurn() : lock_(turns()) {}

void GlContext::Release::operator()(void* context) const {
  OSMesaDestroyContext(static_cast<OSMesaContext>(context));
}

// The rasteriser's own threads, one a core unless LP_NUM_THREADS says otherwise, share the work of whoever
// has the turn. The pixels are the same for any number.
GlContext::GlContext(const GlTurn& turn) : buffer_(16 * 16 * 4) {
  const std::array<int, 13> attributes = {OSMESA_FORMAT,
                                          OSMESA_RGBA,
                                          OSMESA_DEPTH_BITS,
                                          0,
                                          OSMESA_PROFILE,
                                          OSMESA_CORE_PROFILE,
                                          OSMESA_CONTEXT_MAJOR_VERSION,
                                          4,
                                          OSMESA_CONTEXT_MINOR_VERSION,
                                          3,
                                          0,
                                          0,
                                          0};
  context_.reset(OSMesaCreateContextAttribs(attributes.data(), nullptr));
  if (context_ == nullptr) {
    throw std::runtime_error(
        "pictures: OSMesa gives no OpenGL 4.3 core context; install libosmesa6 with llvmpipe");
  }
  make_current(turn);
}

void GlContext::make_current(const GlTurn& /*turn*/) {
  if (OSMesaMakeCurrent(static_cast<OSMesaContext>(context_.get()), buffer_.data(), GL_UNSIGNED_BYTE, 16,
                        16) == GL_FALSE) {
    throw std::runtime_error("pictures: OSMesa could not make its context current");
  }
}

GlContext::~GlContext() {
  const GlTurn turn;
  OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  context_.reset();
}

}  // namespace drycut::renders
