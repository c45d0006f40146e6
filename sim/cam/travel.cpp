#include "sim/cam/travel.hpp"

#include <fmt/format.h>

#include "sim/cam/findings.hpp"

namespace drycut::sim {

namespace {

constexpr double same = 1e-6;  // what rounding may add to a limit that is just met [units]

std::string number(double value) { return number_text(value, 9); }

std::string remedy_of(const CamTravel& travel, double low, double high, bool above,
                      const TravelWords& words) {
  const double stroke = high - low;
  const bool both = travel.least && travel.most;
  if (both && stroke > *travel.most - *travel.least + same)
    return fmt::format("{} {} {} at most; it is {}",
                       words.stroke.empty() ? std::string("shorten the stroke to")
                                            : fmt::format("shorten the stroke ({}) to", words.stroke),
                       number(*travel.most - *travel.least), words.unit, number(stroke));
  return above ? fmt::format("shorten the stroke, or let the cam begin {} {} further back",
                             number(high - *travel.most), words.unit)
               : fmt::format("shorten the stroke, or let the cam begin {} {} further on",
                             number(*travel.least - low), words.unit);
}

}  // namespace

std::vector<TravelFault> travel_faults(const CamTravel& travel, double low, double high,
                                       const TravelWords& words) {
  std::vector<TravelFault> faults;
  const auto tell = [&](bool above, double reached, double limit) {
    faults.push_back(
        {above,
         fmt::format("the stroke does not fit the travel: slave at {} {}, {} is {}", number(reached),
                     words.unit, above ? words.most : words.least, number(limit)),
         remedy_of(travel, low, high, above, words)});
  };
  if (travel.most && high > *travel.most + same) tell(true, high, *travel.most);
  if (travel.least && low < *travel.least - same) tell(false, low, *travel.least);
  return faults;
}

}  // namespace drycut::sim
