#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "devices/lx3vp/cam_law.hpp"
#include "sim/cams/lx3vp/judge.hpp"

namespace drycut::sim::cams {

using devices::lx3vp::EcamError;
using devices::lx3vp::EcamType;

std::string wrong_words(const EcamTable& table) {
  const auto curve = table.saw.curve & ~devices::lx3vp::return_square;
  const bool no_law = table.saw.acceleration > 2;
  const bool no_curve = table.type == EcamType::rotary_saw && (curve > 5 || curve == 4);
  std::string told;
  if (no_law) told = fmt::format("P6L {}", table.saw.acceleration);
  if (no_curve) told += fmt::format("{}P6H {}", no_law ? ", " : "", table.saw.curve);
  return told;
}

namespace {

/// What ECAMTBX says with one of the numbers changed.
template <typename Number>
EcamError error_with(Number devices::lx3vp::SawParameters::*parameter, double value, const EcamTable& table) {
  auto saw = table.saw;
  saw.*parameter = static_cast<Number>(value);
  return make_table(*table.type, saw, table.s_curve).error;
}

CamRemedy give(const char* parameter, double value, const std::string& words) {
  return {fmt::format("give {} {} {}", parameter, whole(value), words), {{0, parameter, value}}};
}

/// The last whole number on the way from one that makes a table to one that makes none.
template <typename Makes>
double last_that_makes(double made, double refused, const Makes& makes) {
  while (std::abs(made - refused) > 1) {
    const double middle = std::floor((made + refused) / 2);
    (makes(middle) ? made : refused) = middle;
  }
  return made;
}

/// The P3 or, if P2 has room for it, the P1 with which ECAMTBX makes a table.
CamRemedy sync_zone_remedy(const EcamTable& table) {
  using devices::lx3vp::SawParameters;
  const auto& p = table.saw;
  const double k = static_cast<double>(p.sync_ratio);
  const double slave = std::abs(static_cast<double>(p.slave_length));
  const bool rotary = table.type == EcamType::rotary_saw;
  if (p.sync_length > slave) {
    const auto makes = [&](double sync) {
      return error_with(&SawParameters::sync_length, sync, table) == EcamError::none;
    };
    if (makes(slave)) return give("P3", slave, "at most");
    if (rotary && makes(0)) return give("P3", last_that_makes(0, slave, makes), "at most");
    return "give P3 less than P2, and a longer P1";
  }
  const auto makes = [&](double length) {
    return error_with(&SawParameters::master_length, length, table) == EcamError::none;
  };
  constexpr double longest = INT32_MAX / 4;
  double length = std::clamp(std::ceil(2 * slave / k), 1.0, longest);
  while (length < longest && !makes(length)) length = std::min(2 * length, longest);
  const std::string other = rotary ? "a shorter P3" : "a larger P4";
  if (!makes(length)) return "give a longer P1, or " + other;
  return give("P1", last_that_makes(length, 0, makes), "at least, or " + other);
}

/// The least P5 that ECAMTBX makes a table with; it is looked for, for the curves have laws of their own.
CamRemedy largest_ratio_remedy(const EcamTable& table) {
  const auto& p = table.saw;
  const double k = static_cast<double>(p.sync_ratio);
  const auto makes = [&](double ratio) {
    return error_with(&devices::lx3vp::SawParameters::max_ratio, ratio, table) == EcamError::none;
  };
  constexpr double fastest = 1e9;
  const double sync = p.sync_length / k;
  const double mean =
      (std::abs(static_cast<double>(p.slave_length)) - p.sync_length) / (p.master_length - sync);
  const char* longer = mean > k / 2 ? ", or a longer P1" : "";
  double refused = static_cast<double>(p.max_ratio);
  double made = k;
  while (!makes(made) && made < fastest) {
    refused = std::max(refused, made);
    made *= 2;
  }
  constexpr int halvings = 40;
  for (int i = 0; i < halvings && made > k; ++i) {
    const double middle = std::max((refused + made) / 2, k);
    (makes(middle) ? made : refused) = middle;
  }
  const auto text = number_above(made);
  if (!makes(std::stod(text))) return std::string("give P5 well above P4") + longer;
  return {fmt::format("give P5 {} at least{}", text, longer), {{0, "P5", std::stod(text)}}};
}

}  // namespace

CamRemedy ratio_limit_remedy(const EcamTable& table, double limit) {
  const auto text = number_below(limit);
  if (error_with(&devices::lx3vp::SawParameters::max_ratio, std::stod(text), table) == EcamError::none)
    return {fmt::format("give P5 {} at most, which ECAMTBX keeps to", text), {{0, "P5", std::stod(text)}}};
  return "no P5 does that: this cycle and its synchronous zone (P1 to P4) need the ratio";
}

CamRemedy remedy_of(EcamError error, const EcamTable& table) {
  switch (error) {
    case EcamError::type:
      if (table.saw.acceleration <= 2) return "give P6H 0, 1, 2, 3 or 5, with 4096 (H1000) added to return";
      if (wrong_words(table).find("P6H") == std::string::npos) return "give P6L 0, 1 or 2";
      return "give P6L 0, 1 or 2 and P6H 0, 1, 2, 3 or 5, with 4096 (H1000) added to return";
    case EcamError::length:
      return table.is_s_curve() ? "give P1 other than 0 and short enough for its speed"
                                : "give P1 above 0, P2 other than 0 and P3 from 0 on";
    case EcamError::sync_zone:
      return sync_zone_remedy(table);
    case EcamError::ratio:
      return largest_ratio_remedy(table);
    case EcamError::resolution:
      return table.is_s_curve() ? "give P6 from 51 to 512, and the ramps more time"
                                : "give P7 0 (automatic) or 10 to 512, and the ramps more than a pulse each";
    case EcamError::speed:
      return "give P2 from 1 to 150000 Hz, P4 and P5 from 0 to 32767 ms";
    case EcamError::number:
      return "give P4 and P5 above 0";
    default:
      return "choose fewer rows";
  }
}

CamRemedy top_speed_remedy(const EcamTable& table, double master_speed, double limit) {
  constexpr int most_turns = 2000;  // rounding may ask for many small steps
  auto parameters = table.s_curve;
  for (int turn = 0; turn < most_turns && parameters.top_speed > 0; ++turn) {
    const auto made = make_table(*table.type, table.saw, parameters);
    if (!made.ok()) break;
    double most = std::max(peak_of(straight_law(made.rows).pieces, devices::CamOrder::velocity),
                           peak_of(made.profile.pieces, devices::CamOrder::velocity));
    most *= master_speed;
    if (most <= limit * within)
      return {fmt::format("give P2 {} Hz at most", parameters.top_speed),
              {{0, "P2", static_cast<double>(parameters.top_speed)}}};
    // Looked for downwards: rows round anew.
    parameters.top_speed =
        std::min(parameters.top_speed - 1, static_cast<std::int32_t>(parameters.top_speed * limit / most));
  }
  return "give P2 less";
}

}  // namespace drycut::sim::cams
