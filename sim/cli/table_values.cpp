#include "sim/cli/table_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "base/text.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/variables.hpp"

namespace drycut::sim::cli {

namespace {

namespace fs = std::filesystem;

bool names(const scenario::Scenario& scene, const fs::path& table) {
  if (!scene.controller) return false;
  const auto files = scene.controller->files();
  return std::any_of(files.begin(), files.end(), [&](const scenario::Text& file) {
    std::error_code ignored;
    return fs::equivalent(scene.file.parent_path() / file.text, table, ignored);
  });
}

/// The scenarios of a folder, by name.
std::vector<fs::path> scenarios_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    const auto ending = lower(entry->path().extension().string());
    if (ending == ".yaml" || ending == ".yml") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Nothing if the scenario does not name the table, or cannot give it its values.
std::optional<TableText> values_of(const fs::path& file, const std::string& text, const fs::path& table) {
  Problems ignored;  // whoever runs it is told
  const auto scene = scenario::read_scenario(file, {}, ignored);
  if (!ignored.empty() || !names(scene, table)) return {};
  auto made = scenario::with_variables(text, scene.variables, table.string(), ignored);
  if (!ignored.empty()) return {};
  return TableText{std::move(made), file};
}

}  // namespace

TableText with_values(std::string text, const fs::path& table, const fs::path& scene, Problems& problems) {
  if (text.find("${") == std::string::npos) return {std::move(text), {}};
  if (!scene.empty()) {
    const auto before = problems.size();
    const auto read = scenario::read_scenario(scene, {}, problems);
    if (problems.size() != before) return {std::move(text), {}};
    auto made = scenario::with_variables(text, read.variables, table.string(), problems);
    return {problems.size() == before ? std::move(made) : std::move(text), scene};
  }
  const auto beside = table.parent_path();
  for (const auto& folder : {beside.empty() ? fs::path(".") : beside, beside / ".."}) {
    std::optional<TableText> found;
    for (const auto& file : scenarios_in(folder)) {
      auto values = values_of(file.lexically_normal(), text, table);
      if (!values) continue;
      if (found && found->text != values->text) {
        problems.push_back({"cam.table-form"_code, table.string(), 1, 1,
                            fmt::format("it has values from a scenario; {} and {} give it different ones",
                                        found->scenario.string(), values->scenario.string()),
                            fmt::format("name one: drycut cam --scene '{}'", found->scenario.string())});
        return {std::move(text), {}};
      }
      if (!found) found = std::move(values);
    }
    if (found) return *found;
  }
  return {std::move(text), {}};
}

}  // namespace drycut::sim::cli
