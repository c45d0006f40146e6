#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "devices/lx3vp/ecamtbx.hpp"
#include "sim/cam/course.hpp"
#include "sim/cam/travel.hpp"

namespace drycut::sim {

/// A cam table of LX3VP as a CSV file gives it (design §6): rows `master,slave` in pulses, or after the
/// comment
/// `# ecamtbx: K100` the parameters of ECAMTBX as `parameter,value`, by the manual's numbers.
struct EcamTable {
  std::string file;  ///< as the user named it
  // The block of the cam.
  std::int32_t max_frequency = 200000;  ///< words 6-7 [Hz]
  std::int32_t time_axis = 0;           ///< S1 = K: the master counts every so many 100 us, 0 = it is an axis
  std::optional<double> max_ratio = {};  ///< slave to master, not to be passed; P5 where there is one
  CamTravel travel = {};                 ///< min_position and max_position [slave pulses]
  bool cyclic = true;                    ///< word 5 = 1: the cycle repeats itself
  // The rows, given or made.
  std::vector<devices::lx3vp::CamTableRow> rows;
  std::vector<int> lines;                             ///< of the file, for each given row
  std::optional<devices::lx3vp::EcamType> type = {};  ///< of ECAMTBX, absent = the rows were given
  devices::lx3vp::EcamResult made = {};               ///< what it made
  devices::lx3vp::SawParameters saw = {};             ///< of K100 and K101
  devices::lx3vp::SCurveParameters s_curve = {};      ///< of K0 and K1

  [[nodiscard]] bool is_made() const { return type.has_value(); }
  [[nodiscard]] bool is_s_curve() const {
    return type == devices::lx3vp::EcamType::s_curve_0 || type == devices::lx3vp::EcamType::s_curve_1;
  }
};

/// Reads the text of a cam table. Every fault becomes a problem with line and column; after 1000 of them the
/// rest is not told. What the device itself would refuse is no problem of the text: see judge_ecam.
EcamTable read_ecam_table(std::string_view text, const std::string& file, Problems& problems);

/// The laws that ECAMTBX rounded to its rows, or the straight pieces between rows that were given. Nothing
/// runs if the table has no two rows in ascending order or ECAMTBX refused it. Of a time axis the master's
/// speed is always known [pulses/s].
CamCourse run_ecam(const EcamTable& table, const CamDuty& duty, int loops);

/// The rows as a table that reads back, with the settings of `table`.
std::string ecam_rows_csv(const EcamTable& table);

}  // namespace drycut::sim
