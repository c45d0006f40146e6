#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "devices/cam/travel.hpp"
#include "sim/cams/findings.hpp"

namespace drycut::sim::cams {

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
