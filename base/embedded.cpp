#include "base/embedded.hpp"

#include <cstddef>

/// One embedded file; the table comes from the build (CMakeLists.txt) and ends with a name that is null.
struct DrycutEmbeddedFile {
  const char* name;
  const char* begin;
  const char* end;
};
extern "C" const DrycutEmbeddedFile drycut_embedded_files[];

namespace drycut {

std::vector<std::string_view> embedded_names() {
  std::vector<std::string_view> names;
  for (const auto* file = drycut_embedded_files; file->name != nullptr; ++file)
    names.emplace_back(file->name);
  return names;
}

std::string_view embedded_file(std::string_view name) {
  for (const auto* file = drycut_embedded_files; file->name != nullptr; ++file) {
    if (name == file->name) return {file->begin, static_cast<std::size_t>(file->end - file->begin)};
  }
  return {};
}

}  // namespace drycut
