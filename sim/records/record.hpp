#pragma once
#include <string>
#include <utility>
#include <vector>

#include "sim/loop/checks.hpp"
#include "sim/loop/recorder.hpp"

namespace drycut::sim::records {

/// What is known of a run beside its numbers, name and text: drycut (the version), step, set (overrides, a
/// line each), scenario.
using About = std::vector<std::pair<std::string, std::string>>;

/// A run as its files tell it.
struct Record {
  loop::Recording recording;
  About about;
  std::vector<loop::CheckResult> checks;  ///< none in a run that did not come to its end
  std::string failure = {};               ///< why it did not, as far as its folder says; "" = it did
};

}  // namespace drycut::sim::records
