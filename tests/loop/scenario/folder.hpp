#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::scenario {

/// A test of scenarios with the files that they name.
struct ScenarioFolder : testing::Test {
  void write(const std::string& name, const std::string& text) const { folder.file(name, text); }
  Scenario read(const std::string& text, const std::vector<Override>& overrides = {}) {
    return read_scenario_text(text, folder / "line.yaml", overrides, problems);
  }
  /// Problems, without the folder's name.
  std::vector<std::string> told() const {
    std::vector<std::string> texts;
    for (const auto& problem : problems) {
      auto one = problem;
      one.file = std::filesystem::path(one.file).filename().string();
      texts.push_back(to_string(one));
    }
    return texts;
  }

  TestFolder folder;
  Problems problems;
};

}  // namespace drycut::sim::scenario
