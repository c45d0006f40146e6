#pragma once
#include <string_view>

namespace drycut {

/// A library that is built into the program and loaded when it is first needed, because the packages that it
/// stands on take longer to load than most commands take: `bytes` is the library, its only face the object
/// `drycut_library`. It stays loaded. Throws std::runtime_error if it or a package of it cannot be loaded.
const void* load_built_in_library(std::string_view name, std::string_view bytes);

}  // namespace drycut
