#pragma once
#include "base/json.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::scenario {

// An override as JSON: ["plants.web.speed", "80 m/min"].

inline void to_json(Json& json, const Override& override) {
  json = Json::array({override.path, override.value});
}
inline void from_json(const Json& json, Override& override) {
  json.at(0).get_to(override.path);
  json.at(1).get_to(override.value);
}

}  // namespace drycut::sim::scenario
