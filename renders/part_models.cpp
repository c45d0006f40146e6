#include "renders/part_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "base/embedded.hpp"
#include "renders/mesh_file.hpp"

namespace drycut::renders {
namespace {

constexpr std::string_view kExtension = ".stl";

}  // namespace

std::vector<std::string_view> part_model_names() {
  auto names = embedded_names();
  std::erase_if(names, [](std::string_view name) { return !name.ends_with(kExtension); });
  for (auto& name : names) name.remove_suffix(kExtension.size());
  std::sort(names.begin(), names.end());
  return names;
}

std::string_view part_model_file(std::string_view name) {
  return embedded_file(std::string(name).append(kExtension));
}

Mesh part_model(std::string_view name) {
  auto read = read_stl(part_model_file(name));
  if (auto* mesh = std::get_if<Mesh>(&read)) return std::move(*mesh);
  throw std::logic_error(fmt::format("part model '{}': {}", name, std::get<MeshProblem>(read).what));
}

}  // namespace drycut::renders
