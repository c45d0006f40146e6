#pragma once
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/table.hpp"
#include "sim/loop/drive_judge.hpp"

namespace drycut::sim::studies {

// What the row of a point says of one drive: every rating, and where the motor has worked.

/// The judged figures of a drive (sim/loop/drive_judge.hpp) and their units.
struct RatingName {
  std::string_view name;
  std::string_view unit;
  bool mean = false;  ///< over machine cycles
};
inline constexpr std::array<RatingName, 10> ratings = {{{"rms torque", "N m", true},
                                                        {"peak torque", "N m"},
                                                        {"largest speed", "rpm"},
                                                        {"rms current, for the winding", "A", true},
                                                        {"winding temperature rise, so far", "K"},
                                                        {"rms current, for the amplifier", "A", true},
                                                        {"amplifier's I2t, so far", "%"},
                                                        {"DC link above rectified mains", "V"},
                                                        {"brake resistor", "W", true},
                                                        {"time at the torque limit", "%", true}}};
/// The place of a rating in that list. Throws std::logic_error if there is none of that name.
std::size_t rating_index(std::string_view name);

/// The check that judges them.
inline constexpr std::string_view ratings_check = "drive within its ratings";
/// What of the drives fails it most: "brake resistor: 110 of 100 W", "trip: overload at 3.2 s"; of several
/// drives with the name of the one in front. "" if all hold.
std::string failed_rating(const std::vector<record::DriveVerdict>& drives);

struct RatedDrive {
  struct Figure {
    double value = 0;  ///< in the rating's unit; NaN = there is none
    double share = 0;  ///< of what it may be, 1 = all; NaN = not judged
  };
  std::array<Figure, ratings.size()> figures = {};
  double inertia_ratio = 0;  ///< load over rotor
  double energy = 0;         ///< from the mains, mean of a cycle [J]
  double trips = 0;          ///< how often it has tripped, or its motor was pulled out
  double cycles = 0;         ///< machine cycles that were judged, as far as they are kept; 0: none ended
  double steady = 0;  ///< 1: a steady cycle was found; 0: none, so what it must bear for ever is not known
  std::pair<double, double> rms = {};  ///< of the hardest cycle: mean speed [rad/s], rms torque [N m]
  /// Operating points [rad/s, N m]: the highest and the lowest torque in each of so many parts of its range
  /// of speeds. NaN: no point there.
  static constexpr std::size_t speeds = 24;
  std::array<std::pair<double, double>, 2 * speeds> outline = {};
};

/// Headings of a row's numbers.
std::vector<Column> rated_columns(const std::string& drive);
/// The numbers, and read back from the last of a row.
std::vector<double> rated_numbers(const record::DriveVerdict& verdict);
RatedDrive rated_drive(const std::vector<double>& row);

}  // namespace drycut::sim::studies
