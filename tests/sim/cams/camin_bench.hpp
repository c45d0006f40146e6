#pragma once
// Cam tables of MC_CamIn for tests, written as CSV text.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/cams/mc_camin/judge.hpp"
#include "tests/sim/cams/told.hpp"

namespace drycut::sim::cams::camin {

/// Reads a table that has no fault.
inline CamFile table(const std::string& text) {
  return sound(text, devices::plcopen::read_cam).value_or(CamFile{});
}

/// The faults of a text, as they are printed, without the file's name.
inline std::vector<std::string> faults(const std::string& text) {
  return faults_of(text, [](const auto& of, const auto& file, Problems& problems) {
    const bool read = devices::plcopen::read_cam(of, file, problems).has_value();
    EXPECT_EQ(read, problems.empty());
  });
}

/// The findings on a table, as they are printed; without the remarks unless they are asked for.
inline std::vector<std::string> findings(const std::string& text, const CamDuty& duty = {},
                                         bool remarks = false) {
  return printed(judge_cam_in(run_cam_in(table(text), duty, 1), duty), remarks);
}

/// The knots of a table.
inline std::vector<CamKnot> knots(const std::string& text) { return run_cam_in(table(text), {}, 1).knots; }

/// Two rows of a rotary knife: a line of ratio 0.6 over 120 mm of web, a quintic for the rest of 800 mm.
inline std::string knife(const std::string& settings = "# endless: positive\n") {
  return "# interpolation: POLY5_LINE\n# master_modulo: 8000000\n# master_unit: mm\n" + settings +
         "master,slave\n0,0\n1200000,720000\n";
}

}  // namespace drycut::sim::cams::camin
