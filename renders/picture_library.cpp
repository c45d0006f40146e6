#include "renders/picture_library.hpp"

#include "base/built_in_library.hpp"

extern "C" const char drycut_pictures_begin[];
extern "C" const char drycut_pictures_end[];

namespace drycut::renders {

const PictureLibrary& picture_library() {
  static const auto& library = *static_cast<const PictureLibrary*>(load_built_in_library(
      "drycut_pictures",
      {drycut_pictures_begin, static_cast<std::size_t>(drycut_pictures_end - drycut_pictures_begin)}));
  return library;
}

}  // namespace drycut::renders
