#pragma once
// What is told of cams, for tests: many cams, each with all that is told of it.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/cams/course.hpp"
#include "sim/cams/findings.hpp"
#include "tests/sim/cams/texts.hpp"

namespace drycut::sim::cams {

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
