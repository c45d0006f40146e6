#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "plants/world.hpp"

namespace drycut::sim::scenario {

/// A plant with its defaults, built, to ask it what it offers; plants that it needs are built too.
class Specimen {
 public:
  /// With the choice `drive` of the parameter of that name, "" = the type has none.
  Specimen(const plants::PlantType& type, std::string drive);

  [[nodiscard]] plants::Plant& plant() const { return *plants_.find("it")->second; }
  [[nodiscard]] plants::PlantDefinition& definition() const { return *definitions_.find("it")->second; }
  [[nodiscard]] const std::string& drive() const { return drive_; }

 private:
  void build(const plants::PlantType& type, const std::string& name, const std::string& drive);

  plants::World world_{1};
  std::string drive_;
  std::map<std::string, std::unique_ptr<plants::PlantDefinition>, std::less<>> definitions_;
  std::map<std::string, std::unique_ptr<plants::Plant>, std::less<>> plants_;
};

/// One for every choice of the parameter `drive`, the default one first; one if there is no such choice.
std::vector<std::unique_ptr<Specimen>> specimens_of(const plants::PlantType& type);

}  // namespace drycut::sim::scenario
