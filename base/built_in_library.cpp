#include "base/built_in_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace drycut {

namespace {

[[noreturn]] void fail(std::string_view name, std::string_view why) {
  throw std::runtime_error(fmt::format("the library {} cannot be loaded: {}", name, why));
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(file, bytes.data(), bytes.size());
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

const void* load_built_in_library(std::string_view name, std::string_view bytes) {
  // The file in memory stays open: dlopen() takes two libraries of one path for the same.
  const int file = memfd_create(std::string(name).c_str(), MFD_CLOEXEC);
  if (file < 0 || !write_all(file, bytes)) fail(name, std::strerror(errno));
  void* const library = dlopen(fmt::format("/proc/self/fd/{}", file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) fail(name, dlerror());
  const void* const face = dlsym(library, "drycut_library");
  if (face == nullptr) fail(name, dlerror());
  return face;
}

}  // namespace drycut
