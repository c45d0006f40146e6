#pragma once
// Cam tables for tests, written as CSV text.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/cam/camming4/judge.hpp"
#include "sim/cam/camming4/run.hpp"
#include "sim/cam/camming4/table.hpp"

namespace drycut::sim::cams {

inline const std::string header = "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM\n";

/// Reads a table that has no fault.
inline CamTable table(const std::string& text) {
  Problems problems;
  auto read = read_cam_table(text, "cam.csv", problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  return read;
}
/// The header is put before the rows.
inline CamTable rows(const std::string& text) { return table(header + text); }

inline CamTable introduction() {
  return rows("1,132,100,50\n2,133,200,200\n3,134,160,120\n4,133,150,150\n5,135,90,45\n6,136\n");
}

/// The slave m after the visit's start.
inline devices::CamMotion at(const CamVisit& visit, double m) {
  devices::CamLaw law;
  law.pieces = visit.pieces();
  return at(law, visit.master_start + m);
}

/// The faults of a text, as they are printed, without the file's name.
inline std::vector<std::string> faults(const std::string& text) {
  Problems problems;
  read_cam_table(text, "cam.csv", problems);
  std::vector<std::string> told;
  for (const auto& problem : problems)
    told.push_back(to_string(problem).substr(std::string("cam.csv:").size()));
  return told;
}

/// The findings on a table, as they are printed.
inline std::vector<std::string> findings(const CamTable& read, const CamDuty& duty = {}) {
  std::vector<std::string> told;
  for (const auto& finding : judge(read, duty, run_cam(read, duty, 1))) told.push_back(to_string(finding));
  return told;
}

}  // namespace drycut::sim::cams
