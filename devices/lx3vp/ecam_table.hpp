#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/cam/table.hpp"
#include "devices/lx3vp/ecamtbx.hpp"

namespace drycut::devices::lx3vp {

/// A cam of LX3VP with what its law needs of its block, as a file or the controller itself holds it: rows, or
/// the parameters of an ECAMTBX with the rows that it makes of them.
struct EcamTable {
  static constexpr std::string_view kind = "lx3vp";
  std::string file;  ///< as the user named it
  // The block of the cam.
  std::int32_t max_frequency = 0;  ///< words 6-7 [Hz], 0 = not given
  std::int32_t time_axis = 0;      ///< S1 = K: the master counts every so many 100 us, 0 = it is an axis
  std::optional<double> max_ratio = {};  ///< slave to master, not to be passed; P5 where there is one
  CamTravel travel = {};                 ///< min_position and max_position [slave pulses]
  bool cyclic = true;                    ///< word 5 = 1: the cycle repeats itself
  // The rows, given or made.
  std::vector<CamTableRow> rows;
  std::vector<int> lines;             ///< of the file, for each given row
  std::optional<EcamType> type = {};  ///< of ECAMTBX, absent = the rows were given
  SawParameters saw = {};             ///< of K100 and K101
  SCurveParameters s_curve = {};      ///< of K0 and K1
  EcamResult made = {};               ///< what ECAMTBX makes of them

  [[nodiscard]] bool is_made() const { return type.has_value(); }
  [[nodiscard]] bool is_s_curve() const { return is_made() && lx3vp::is_s_curve(*type); }
  /// Fills in what follows from the rest: made and its rows, the largest ratio, the time axis of an S-curve,
  /// the largest frequency.
  void complete();
  void visit(StateArchive& archive);
  /// By what is given.
  friend bool operator==(const EcamTable& a, const EcamTable& b);
};

}  // namespace drycut::devices::lx3vp
