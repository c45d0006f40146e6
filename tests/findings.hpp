#pragma once
#include <string>
#include <vector>

#include "base/problem.hpp"

namespace drycut {

/// What tests look at in findings: their kinds, or what is said.
inline std::vector<std::string> codes(const std::vector<Finding>& findings) {
  std::vector<std::string> all;
  for (const auto& finding : findings) all.push_back(finding.code);
  return all;
}
inline std::vector<std::string> codes(const Problems& problems) {
  std::vector<std::string> all;
  for (const auto& problem : problems) all.emplace_back(problem.code.text());
  return all;
}
inline std::vector<std::string> sentences(const std::vector<Finding>& findings) {
  std::vector<std::string> all;
  for (const auto& finding : findings) all.push_back(finding.text);
  return all;
}

}  // namespace drycut
