#include "sim/scenario/specimens.hpp"

#include <algorithm>

namespace drycut::sim::scenario {

Specimen::Specimen(const plants::PlantType& type, std::string drive) : drive_(std::move(drive)) {
  build(type, "it", drive_);
}

void Specimen::build(const plants::PlantType& type, const std::string& name, const std::string& drive) {
  auto& definition = *(definitions_[name] = type.define());
  for (auto& parameter : definition.parameters()) {
    if (!drive.empty() && parameter.name == "drive") *std::get<std::string*>(parameter.value) = drive;
    if (parameter.reference.empty() || *std::get<std::string*>(parameter.value) == plants::no_plant) continue;
    const std::string other(parameter.reference);
    *std::get<std::string*>(parameter.value) = other;
    if (!plants_.contains(other))
      build(*std::ranges::find(plants::plant_types(), other, &plants::PlantType::name), other, "");
  }
  plants_[name] = definition.build(world_, [this](std::string_view wanted) -> plants::Plant* {
    const auto found = plants_.find(wanted);
    return found == plants_.end() ? nullptr : found->second.get();
  });
}

std::vector<std::unique_ptr<Specimen>> specimens_of(const plants::PlantType& type) {
  std::vector<std::string> drives;
  const auto definition = type.define();  // its parameters point into it
  for (const auto& p : definition->parameters()) {
    if (p.name != "drive" || p.choices.empty()) continue;
    drives = {*std::get<std::string*>(p.value)};
    for (const auto& choice : p.choices)
      if (choice != drives.front()) drives.push_back(choice);
  }
  if (drives.empty()) drives = {""};
  std::vector<std::unique_ptr<Specimen>> specimens;
  for (const auto& drive : drives) specimens.push_back(std::make_unique<Specimen>(type, drive));
  return specimens;
}

}  // namespace drycut::sim::scenario
