#pragma once
#include <filesystem>

#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

/// drycut index: writes index.html over the results below a folder. 0 written, 2 bad input, 3 cannot be
/// written
int index_folder(const std::filesystem::path& folder);

}  // namespace drycut::sim::cli
