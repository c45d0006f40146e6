#pragma once
#include <functional>
#include <string>

namespace drycut::sim::scenario {

class Archive;

/// What editors know of scenarios, and of scenes that compare some: JSON Schema (draft 2020-12), with the
/// parameters of every plant, their units and meanings. What it allows may still be wrong in meaning: names
/// that lead nowhere, units of another dimension, ranges. `comparison` visits a scene that compares.
std::string json_schema(const std::function<void(Archive&)>& comparison);

}  // namespace drycut::sim::scenario
