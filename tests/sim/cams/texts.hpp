#pragma once
// What the cam tables of all devices have in common in tests: texts that are read, and what is said of them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/cams/findings.hpp"

namespace drycut::sim::cams {

/// What `read` makes of a text that has no fault.
template <typename Read>
auto sound(const std::string& text, const Read& read) {
  Problems problems;
  auto made = read(text, "cam.csv", problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  return made;
}

/// The faults that `read` tells of a text, as they are printed, without the file's name.
template <typename Read>
std::vector<std::string> faults_of(const std::string& text, const Read& read) {
  Problems problems;
  read(text, "cam.csv", problems);
  std::vector<std::string> told;
  for (const auto& problem : problems)
    told.push_back(to_string(problem).substr(std::string("cam.csv:").size()));
  return told;
}

/// Findings as they are printed; without the remarks unless they are asked for.
inline std::vector<std::string> printed(const std::vector<CamFinding>& findings, bool remarks) {
  std::vector<std::string> told;
  for (const auto& finding : findings)
    if (remarks || finding.grade != CamFinding::Grade::remark) told.push_back(to_string(finding));
  return told;
}

}  // namespace drycut::sim::cams
