#pragma once
// Cam tables for tests, written as CSV text.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "devices/camming4/cam_table.hpp"
#include "devices/plcopen/tab_file.hpp"
#include "sim/cams/camming4/judge.hpp"
#include "tests/sim/cams/told.hpp"

namespace drycut::sim::cams {

inline const std::string header = "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM\n";

/// Reads a table that has no fault.
inline CammingTable table(const std::string& text) { return sound(text, read_camming4); }
/// The header is put before the rows.
inline CammingTable rows(const std::string& text) { return table(header + text); }

inline CammingTable introduction() {
  return rows("1,132,100,50\n2,133,200,200\n3,134,160,120\n4,133,150,150\n5,135,90,45\n6,136\n");
}

/// The slave m after the visit's start.
inline devices::CamMotion at(const CamVisit& visit, double m) {
  devices::CamLaw law;
  law.pieces = visit.pieces();
  return at(law, visit.master_start + m);
}

/// A table as a controller holds it.
inline std::shared_ptr<const devices::CamTable> held(std::string_view kind, const std::string& text) {
  Problems problems;
  return std::make_shared<const devices::CamTable>(read_cam(kind, text, "", problems));
}

/// The study of a cam in which nothing is wrongly asked.
inline CamStudy study(const devices::CamTable& read, const CamRequest& request = {}) {
  Problems problems;
  auto made = study_cam(read, request, problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  return made;
}

/// The faults of a text, as they are printed, without the file's name.
inline std::vector<std::string> faults(const std::string& text) { return faults_of(text, read_camming4); }
inline void expect_faults(const std::vector<Told<>>& cases) {
  expect_told(cases, [](const auto& one) { return faults(one.cam); });
}

/// The findings on a table, as they are printed.
inline std::vector<std::string> findings(const CammingTable& read, const CamDuty& duty = {}) {
  return printed(judge(read, duty, run_cam(read, duty, 1)), true);
}
inline void expect_findings(const std::vector<Told<CammingTable>>& cases) {
  expect_told(cases, [](const auto& one) { return findings(one.cam, one.duty); });
}

}  // namespace drycut::sim::cams
