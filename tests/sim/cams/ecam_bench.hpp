#pragma once
// Cam tables of LX3VP for tests, written as CSV text.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/cams/lx3vp/judge.hpp"
#include "tests/sim/cams/told.hpp"

namespace drycut::sim::cams::ecams {

/// Reads a table that has no fault.
inline EcamTable table(const std::string& text) { return sound(text, read_lx3vp); }

/// The faults of a text, as they are printed, without the file's name.
inline std::vector<std::string> faults(const std::string& text) { return faults_of(text, read_lx3vp); }
inline void expect_faults(const std::vector<cams::Told<>>& cases) {
  cams::expect_told(cases, [](const auto& one) { return faults(one.cam); });
}

/// The findings on a table, as they are printed; without the remarks unless they are asked for.
inline std::vector<std::string> findings(const EcamTable& read, const CamDuty& duty = {},
                                         bool remarks = false) {
  return printed(judge_ecam(read, duty, run_ecam(read, duty, 1)), remarks);
}

inline void expect_findings(const std::vector<cams::Told<EcamTable>>& cases) {
  cams::expect_told(cases, [](const auto& one) { return findings(one.cam, one.duty, one.remarks); });
}

/// The manual's rotary saw; what is given again behind replaces nothing.
inline std::string rotary(const std::string& P5 = "50/3", const std::string& P6 = "1",
                          const std::string& P3 = "333") {
  return "# ecamtbx: K100\nparameter,value\nP1,3183\nP2,1000\nP3," + P3 + "\nP4,5/3\nP5," + P5 + "\nP6," +
         P6 + "\n";
}
inline std::string s_curve(const std::string& P1 = "10000") {
  return "# ecamtbx: K0\nparameter,value\nP1," + P1 + "\nP2,50000\nP4,100\nP5,100\nP6,200\n";
}

}  // namespace drycut::sim::cams::ecams
