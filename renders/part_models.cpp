#include "renders/part_models.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "renders/mesh_file.hpp"

/// One embedded file; the table comes from the build (CMakeLists.txt) and ends with a name that is null.
struct DrycutPartModel {
  const char* name;
  const char* begin;
  const char* end;
};
extern "C" const DrycutPartModel drycut_part_models[];

namespace drycut::renders {

std::vector<std::string_view> part_model_names() {
  std::vector<std::string_view> names;
  for (const auto* model = drycut_part_models; model->name != nullptr; ++model)
    names.emplace_back(model->name);
  return names;
}

std::string_view part_model_file(std::string_view name) {
  for (const auto* model = drycut_part_models; model->name != nullptr; ++model) {
    if (name == model->name) return {model->begin, static_cast<std::size_t>(model->end - model->begin)};
  }
  return {};
}

Mesh part_model(std::string_view name) {
  auto read = read_stl(part_model_file(name));
  if (auto* mesh = std::get_if<Mesh>(&read)) return std::move(*mesh);
  throw std::logic_error(fmt::format("part model '{}': {}", name, std::get<MeshProblem>(read).what));
}

}  // namespace drycut::renders
