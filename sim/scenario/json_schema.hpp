#pragma once
#include <functional>
#include <string>

namespace drycut::sim::scenario {

class Archive;

/// What editors know of scenarios, of scenes that compare some, and of recordings: JSON Schema (draft
/// 2020-12), with the parameters of every plant, their units and meanings. What it allows may still be wrong
/// in meaning: names that lead nowhere, units of another dimension, ranges. `comparison` visits a scene that
/// compares, `recording` a recording of a machine.
std::string json_schema(const std::function<void(Archive&)>& comparison,
                        const std::function<void(Archive&)>& recording);

}  // namespace drycut::sim::scenario
