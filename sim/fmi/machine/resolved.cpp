#include "sim/fmi/machine/resolved.hpp"

#include <fmt/format.h>

#include <span>

#include "base/json.hpp"
#include "base/state_archive.hpp"

namespace drycut::sim::fmi {

std::string machine_text(const ResolvedMachine& machine) {
  Json json = {{"made_by", machine.made_by}, {"step_ns", machine.step}, {"seed", machine.seed}};
  for (const auto& [unit, scale] : machine.units) json["units"][unit] = {scale.factor, scale.offset};
  for (const auto& plant : machine.plants) {
    Json values = Json::object();
    for (const auto& [name, value] : plant.parameters)
      std::visit([&, &key = name](const auto& given) { values[key] = given; }, value);
    json["plants"].push_back({{"name", plant.name}, {"type", plant.type}, {"parameters", std::move(values)}});
  }
  return json_text(json, 1) + "\n";
}

ResolvedMachine read_machine(std::string_view text) {
  const auto json = json_from(text);
  ResolvedMachine machine{json.at("made_by"), json.at("step_ns"), json.at("seed")};
  for (const auto& [unit, scale] : json.at("units").items()) machine.units[unit] = {scale.at(0), scale.at(1)};
  for (const auto& plant : json.at("plants")) {
    auto& values = machine.plants.emplace_back();
    values = {plant.at("name"), plant.at("type"), {}};
    for (const auto& [name, value] : plant.at("parameters").items()) {
      if (value.is_string())
        values.parameters.emplace_back(name, value.get<std::string>());
      else
        values.parameters.emplace_back(name, value.get<double>());
    }
  }
  return machine;
}

std::string token_of(std::string_view machine_text) {
  return fmt::format("{{{:016x}}}", StateArchive::sum_of(std::as_bytes(std::span(machine_text))));
}

}  // namespace drycut::sim::fmi
