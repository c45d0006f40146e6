#pragma once
#include <string>
#include <utility>
#include <vector>

#include "sim/record/outcome.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::record {

/// What is known of a run beside its numbers, name and text: drycut (the version), step, set (overrides, a
/// line each), scenario.
using About = std::vector<std::pair<std::string, std::string>>;

/// A run as its files tell it.
struct Record {
  Recording recording;
  About about;
  Outcome outcome;  ///< empty but for its failure in a run that did not come to its end
};

}  // namespace drycut::sim::record
