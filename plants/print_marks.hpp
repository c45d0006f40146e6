#pragma once
#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "plants/exact_sum.hpp"
#include "plants/plant.hpp"
#include "plants/random.hpp"
#include "plants/transducers.hpp"

namespace drycut::plants {

/// Marks printed on the web and the photocell that reads them. The first mark is a pitch behind the web's
/// start, or `offset` more.
struct PrintMarkData {
  double pitch = 0;          ///< nominal distance of two marks [m]; 0 = nothing is printed
  double offset = 0;         ///< shifts all marks against the direction of travel [m]
  double stretch = 0;        ///< true pitch = pitch * (1 + stretch)
  double scatter = 0;        ///< standard deviation of each mark from its place [m]
  double width = 5e-3;       ///< of a mark along the web [m]
  double photocell = 0.9;    ///< place of the photocell before the cut [m]
  double hysteresis = 2e-4;  ///< the photocell lets go this far behind the edge of a mark [m]
  double delay = 50e-6;      ///< of the photocell [s]
};

/// Rows of the group `marks.`.
Parameters print_mark_parameters(PrintMarkData& data);

class PrintMarks {
 public:
  PrintMarks(const PrintMarkData& data, Random noise);

  [[nodiscard]] bool printed() const { return data_.pitch > 0; }
  [[nodiscard]] PositionSwitch& photocell() { return photocell_; }
  /// Follows the web over the last step of `h` seconds to its travel `now` [m].
  void sense(double now, double h) {
    if (printed()) follow(now, h);
  }
  /// Where on the web the nearest mark is: how far `place` lies behind its middle, against the direction of
  /// travel [m]. A place is the travel at which it passes the cut.
  [[nodiscard]] double behind_mark(double place) const;
  /// Places of the marks from the photocell to some metres behind the cut, in ascending order [m].
  [[nodiscard]] const std::deque<double>& places() const { return places_; }

  /// Keeps the marks until they are that far behind the first cut [m]: a station there still looks at them.
  void keep(double distance) { kept_behind_ = std::max(kept_behind_, distance); }

  /// shift under `marks`, and what the photocell offers under `component`.
  void offer_faults(std::vector<Fault>& faults, const std::string& marks, const std::string& photocell);

  void visit(StateArchive& archive);

 private:
  void follow(double now, double h);
  void print();
  [[nodiscard]] double nearest(double place) const;

  const PrintMarkData data_;
  Random noise_;
  std::deque<double> places_;
  ExactSum next_;           // place of the next mark without its scatter [m]
  double kept_behind_ = 6;  // [m] a travelling cut may still look at them
  double shift_ = 0;        // since the last splice [m]
  PositionSwitch photocell_;
};

}  // namespace drycut::plants
