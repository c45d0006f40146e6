#pragma once
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/cam/table.hpp"
#include "sim/cams/motion_plot.hpp"
#include "sim/cams/report.hpp"

namespace drycut::sim::cams {

// What is judged alike of all cams, in the words of their kinds.

/// The largest of a kind of finding, and how many there are.
struct CamWorst {
  int count = 0;
  double value = 0;
  int row = 0;

  void take(double size, int at) {
    ++count;
    if (std::abs(size) <= std::abs(value)) return;
    value = size;
    row = at;
  }
};

/// The limits that a peak of the law passes, a finding each, which has no place yet. Unless `remedy` says
/// what to do of a limit, a slower master is.
std::vector<CamFinding> passed_limits(const CamMotionWords& motion, devices::CamOrder order, double peak,
                                      const std::function<CamRemedy(double limit)>& remedy = {});

/// How a table calls the travel.
struct TravelWords {
  std::string_view least;   ///< setting's name
  std::string_view most;    ///< setting's name
  std::string_view unit;    ///< "pulses", "Um"
  std::string_view stroke;  ///< what sets the stroke's length: "P2"; "" = many numbers do
  bool shrinks = false;     ///< the ends lie beyond the rows, and come nearer to them as these shrink
};

/// A stroke that leaves the travel on one side.
struct TravelFault {
  bool above = false;  ///< beyond `most`, else below `least`
  std::string text;
  CamRemedy remedy;
};

/// What is wrong with a stroke that reaches from `low` to `high`: nothing, one side or both.
std::vector<TravelFault> travel_faults(const devices::CamTravel& travel, double low, double high,
                                       const TravelWords& words);

}  // namespace drycut::sim::cams
