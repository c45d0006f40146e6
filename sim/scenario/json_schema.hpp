#pragma once
#include <string>

namespace drycut::sim::scenario {

/// What editors know of scenarios, and of scenes that compare some: JSON Schema (draft 2020-12), with the
/// parameters of every plant, their units and meanings. What it allows may still be wrong in meaning: names
/// that lead nowhere, units of another dimension, ranges.
std::string json_schema();

}  // namespace drycut::sim::scenario
