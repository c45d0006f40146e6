#pragma once
#include <nlohmann/json.hpp>

#include "sim/scenario/scenario.hpp"

namespace drycut::sim::scenario {

// An override as JSON: ["plants.web.speed", "80 m/min"].

inline void to_json(nlohmann::json& json, const Override& override) {
  json = nlohmann::json::array({override.path, override.value});
}
inline void from_json(const nlohmann::json& json, Override& override) {
  json.at(0).get_to(override.path);
  json.at(1).get_to(override.value);
}

}  // namespace drycut::sim::scenario
