#pragma once
// What is told of cams, for tests: texts that are read, and many cams, each with all that is told of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/cams/course.hpp"
#include "sim/cams/report.hpp"

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

/// A table or its text, all that is told of it in order, and for findings what it is judged at.
template <typename Cam = std::string>
struct Told {
  Cam cam;
  std::vector<testing::Matcher<std::string>> told;
  CamDuty duty = {};
  bool remarks = false;
};
template <typename Cam, typename Tell>
void expect_told(const std::vector<Told<Cam>>& cases, const Tell& tell) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    EXPECT_THAT(tell(cases[i]), testing::ElementsAreArray(cases[i].told));
  }
}

/// Samples go on and are numbers, findings have words, and all but remarks a remedy. The last master
/// position.
inline double expect_sane(const std::vector<CamPoint>& points, const std::vector<CamFinding>& findings,
                          const std::string& text) {
  double last = -1e300;
  for (const auto& point : points) {
    EXPECT_GE(point.master, last) << text;
    EXPECT_TRUE(std::isfinite(point.position + point.velocity + point.acceleration + point.jerk)) << text;
    last = point.master;
  }
  for (const auto& finding : findings) {
    EXPECT_FALSE(finding.text.empty()) << text;
    const bool told = finding.grade == CamFinding::Grade::remark || !finding.remedy.text.empty();
    EXPECT_TRUE(told) << to_string(finding);
  }
  return last;
}

}  // namespace drycut::sim::cams
