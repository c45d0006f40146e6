#include "sim/report/part_meshes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"
#include "renders/mesh_file.hpp"

namespace drycut::sim::report {

namespace {

/// The nearest part, or what the plant that is named has.
std::string remedy_for(const std::string& part, const std::vector<loop::NamedPlant>& plants) {
  constexpr std::size_t most = 60;
  std::vector<std::string> all;
  std::vector<std::string> own;
  for (const auto& [plant, machine] : plants) {
    const bool named = part.starts_with(plant + ".");
    for (const auto& one : machine->parts()) {
      all.push_back(fmt::format("{}.{}", plant, one.name));
      if (named) own.push_back(one.name);
    }
  }
  for (const auto& name : all)
    if (name.starts_with(part + " ")) return fmt::format("did you mean {}?", name);  // one of several
  if (own.empty()) return did_you_mean(part, all, "write PLANT.PART; `drycut plants TYPE` lists the parts");
  const bool cut = own.size() > most;
  if (cut) own.resize(most);
  return did_you_mean(part, all, "parts: " + listed(own) + (cut ? ", ..." : ""));
}

bool is_known(const scenario::Text& part, const std::vector<loop::NamedPlant>& plants) {
  for (const auto& [plant, machine] : plants) {
    for (const auto& one : machine->parts())
      if (part.text == fmt::format("{}.{}", plant, one.name)) return true;
  }
  return false;
}

}  // namespace

PartMeshes load_part_meshes(const scenario::Scenario& scenario, const std::vector<loop::NamedPlant>& plants,
                            Problems& problems) {
  PartMeshes meshes;
  const auto must_exist = [&](const scenario::Text& part) {
    if (is_known(part, plants)) return true;
    problems.push_back(scenario::problem_at("scenario.unknown-name"_code, scenario, part.place,
                                            fmt::format("there is no part '{}'", part.text),
                                            remedy_for(part.text, plants)));
    return false;
  };
  if (const auto& follow = scenario.pictures.follow; !follow.text.empty()) must_exist(follow);
  for (const auto& camera : scenario.pictures.views())
    if (camera.looks_at_part()) must_exist(camera.shows);
  for (const auto& request : scenario.pictures.meshes) {
    if (!must_exist(request.part)) continue;
    const auto file = scenario.file.parent_path() / request.file.text;
    auto loaded =
        renders::load_mesh(file, {request.scale, renders::vec(request.rotate), renders::vec(request.at)});
    if (const auto* problem = std::get_if<renders::MeshProblem>(&loaded)) {
      problems.push_back(scenario::problem_at(problem->code, scenario, request.file.place,
                                              fmt::format("mesh {}: {}", file.string(), problem->what),
                                              problem->remedy));
      continue;
    }
    meshes[request.part.text] =
        std::make_shared<const renders::Mesh>(std::get<renders::Mesh>(std::move(loaded)));
  }
  return meshes;
}

}  // namespace drycut::sim::report
