#pragma once
#include <filesystem>
#include <string>

#include "base/problem.hpp"

namespace drycut::sim::cli {

/// A cam table with the values that it takes from a scenario.
struct TableText {
  std::string text;                ///< every cell with ${name} computed
  std::filesystem::path scenario;  ///< whose values they are; "" = it takes none
};

/// Puts the values of a scenario into a table's text, if it asks for any: of `scene`, or if that is "" of the
/// one scenario beside the table, else in the folder above, that names it as a table of its controller.
/// Several that name it and have different values are a problem; where there is none, the table keeps its
/// ${name}.
TableText with_values(std::string text, const std::filesystem::path& table,
                      const std::filesystem::path& scene, Problems& problems);

}  // namespace drycut::sim::cli
