#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cam/findings.hpp"

namespace drycut::sim {

/// From where to where the slave's machine lets it go, in its unit, from the place where the cam counts 0.
/// No device watches it in a cam; `drycut cam` does, before a carriage meets its end stop.
struct CamTravel {
  std::optional<double> least = {};
  std::optional<double> most = {};

  [[nodiscard]] bool is_given() const { return least || most; }
};

/// How a table calls the travel.
struct TravelWords {
  std::string_view least;   ///< setting's name
  std::string_view most;    ///< setting's name
  std::string_view unit;    ///< "pulses", "Um"
  std::string_view stroke;  ///< what sets the stroke's length: "P2"; "" = many numbers do
};

/// A stroke that leaves the travel on one side.
struct TravelFault {
  bool above = false;  ///< beyond `most`, else below `least`
  std::string text;
  CamRemedy remedy;
};

/// What is wrong with a stroke that reaches from `low` to `high`: nothing, one side or both.
std::vector<TravelFault> travel_faults(const CamTravel& travel, double low, double high,
                                       const TravelWords& words);

}  // namespace drycut::sim
