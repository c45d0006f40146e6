#pragma once
#include <array>
#include <cstdint>

#include "devices/camming4/cam.hpp"
#include "devices/camming4/table.hpp"

namespace drycut::devices::camming4 {

/// The calculations that follow writes of parameters, spread over samples as the manual's table says (000
/// 1.4); an event of the interrupt input waits for those that were asked for before it.
///
/// Of several writes the manual says nothing. Reading: one calculation comes after the other, so their
/// samples add up; what belongs to one calculation is done once, however much of it was written: a row of the
/// cam table, a ratio (measure and pulse, measurem and pulsem), the scale of speeds (decpt and unitvel). A
/// write of what is being calculated begins that one anew.
class Recalculation {
 public:
  /// A write of `variable`, for a cam table's variable of `row` (0-based).
  void written(int variable, int row);
  /// One sample of calculating.
  void sample();
  /// Samples until all is done.
  [[nodiscard]] int left() const { return left_; }

 private:
  std::array<std::uint8_t, table::variables.size() + cam_rows> of_each_{};  ///< samples left, by calculation
  int left_ = 0;                                                            ///< their sum
};

}  // namespace drycut::devices::camming4
