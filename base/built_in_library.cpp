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

/// A file in memory.
struct MemoryFile {
  explicit MemoryFile(const std::string& name) : number(memfd_create(name.c_str(), MFD_CLOEXEC)) {}
  ~MemoryFile() { close(number); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  bool write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const auto written = ::write(number, bytes.data(), bytes.size());
      if (written <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }

  int number;
};

}  // namespace

const void* load_built_in_library(std::string_view name, std::string_view bytes) {
  const MemoryFile file{std::string(name)};
  if (file.number < 0 || !file.write(bytes)) fail(name, std::strerror(errno));
  void* const library = dlopen(fmt::format("/proc/self/fd/{}", file.number).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) fail(name, dlerror());
  const void* const face = dlsym(library, "drycut_library");
  if (face == nullptr) fail(name, dlerror());
  return face;
}

}  // namespace drycut
