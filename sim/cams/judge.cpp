#include "sim/cams/judge.hpp"

#include <fmt/format.h>

#include <cmath>

namespace drycut::sim::cams {

namespace {

constexpr double just_met = 1e-6;  // what rounding may add to a limit that is just met [units]

std::string place_text(double value) { return number_text(value, 9); }

/// A way that a remedy names: within `just_met`, so that a limit that it brings about is met.
std::string way_text(double value) { return number_text(std::round(value * 1e6) / 1e6, 15); }

std::string moved_begin(double shift, const TravelWords& words) {
  return fmt::format("let the cam begin {} {} further {}", way_text(std::abs(shift)), words.unit,
                     shift < 0 ? "back" : "on");
}

CamRemedy travel_remedy(const devices::CamTravel& travel, double low, double high, bool above,
                        const TravelWords& words) {
  const double stroke = high - low;
  const bool both = travel.least && travel.most;
  if (both && stroke > *travel.most - *travel.least + just_met) {
    // The nearer end stays where the cam has it, or where the stroke as shortened has it; a stroke that just
    // fits has no other place than its travel.
    const double room = *travel.most - *travel.least;
    const double shift = words.shrinks                     ? *travel.least - low * room / stroke
                         : std::abs(low) <= std::abs(high) ? *travel.least - low
                                                           : *travel.most - high;
    return {fmt::format("{} {} {} at most{}; it is {}",
                        words.stroke.empty() ? std::string("shorten the stroke to")
                                             : fmt::format("shorten the stroke ({}) to", words.stroke),
                        way_text(room), words.unit,
                        std::abs(shift) <= just_met ? "" : " and " + moved_begin(shift, words),
                        place_text(stroke)),
            {{0, "stroke", room}, {0, "begin", shift}}};
  }
  const double shift = above ? *travel.most - high : *travel.least - low;
  return {"shorten the stroke, or " + moved_begin(shift, words), {{0, "begin", shift}}};
}

}  // namespace

std::vector<CamFinding> passed_limits(const CamMotionWords& motion, devices::CamOrder order, double peak,
                                      const std::function<CamRemedy(double limit)>& remedy) {
  const auto& quantity = order == devices::CamOrder::velocity       ? motion.velocity
                         : order == devices::CamOrder::acceleration ? motion.acceleration
                                                                    : motion.jerk;
  const double value = peak * quantity.scale;
  std::vector<CamFinding> passed;
  for (const auto& limit : quantity.limits) {
    if (limit.found.empty() || value <= limit.value * within) continue;
    const auto slower = [&] {
      const auto instead = fmt::format(fmt::runtime(limit.instead), fmt::arg("is", number(peak)),
                                       fmt::arg("most", number_below(limit.value / quantity.scale)));
      const double share = std::pow(limit.value / value, 1.0 / static_cast<int>(order));
      return slower_master(instead, motion.master_speed * share, motion.speed_unit);
    };
    passed.push_back({"cam.limit"_code, CamFinding::Grade::limit, 0, "",
                      fmt::format(fmt::runtime(limit.found), fmt::arg("is", number(value)),
                                  fmt::arg("unit", quantity.unit), fmt::arg("limit", number(limit.value))),
                      remedy ? remedy(limit.value) : slower()});
  }
  return passed;
}

std::vector<TravelFault> travel_faults(const devices::CamTravel& travel, double low, double high,
                                       const TravelWords& words) {
  std::vector<TravelFault> faults;
  const auto tell = [&](bool above, double reached, double limit) {
    faults.push_back(
        {above,
         fmt::format("the stroke does not fit the travel: slave at {} {}, {} is {}", place_text(reached),
                     words.unit, above ? words.most : words.least, place_text(limit)),
         travel_remedy(travel, low, high, above, words)});
  };
  if (travel.most && high > *travel.most + just_met) tell(true, high, *travel.most);
  if (travel.least && low < *travel.least - just_met) tell(false, low, *travel.least);
  return faults;
}

}  // namespace drycut::sim::cams
