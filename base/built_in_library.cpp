#include "base/built_in_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

#include "base/output_file.hpp"

namespace drycut {

namespace {

[[noreturn]] void fail(std::string_view name, std::string_view why) {
  throw std::runtime_error(fmt::format("the library {} cannot be loaded: {}", name, why));
}

}  // namespace

const void* load_built_in_library(std::string_view name, std::string_view bytes) {
  // The file in memory stays open: dlopen() takes two libraries of one path for the same.
  const int file = memfd_create(std::string(name).c_str(), MFD_CLOEXEC);
  if (file < 0) fail(name, std::strerror(errno));
  write_all(file, std::as_bytes(std::span(bytes)));
  void* const library = dlopen(fmt::format("/proc/self/fd/{}", file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) fail(name, dlerror());
  const void* const face = dlsym(library, "drycut_library");
  if (face == nullptr) fail(name, dlerror());
  return face;
}

}  // namespace drycut
