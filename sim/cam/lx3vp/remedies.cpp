#include "sim/cam/lx3vp/remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/cam/findings.hpp"

namespace drycut::sim {

using devices::lx3vp::EcamError;
using devices::lx3vp::EcamType;

double steepness(const std::vector<devices::lx3vp::CamTableRow>& rows, std::size_t row) {
  return std::abs(static_cast<double>(rows[row].slave) - rows[row - 1].slave) /
         (static_cast<double>(rows[row].master) - rows[row - 1].master);
}

std::size_t steepest_row(const std::vector<devices::lx3vp::CamTableRow>& rows) {
  std::size_t worst = 1;
  for (std::size_t i = 2; i < rows.size(); ++i)
    if (steepness(rows, i) > steepness(rows, worst)) worst = i;
  return worst;
}

std::string wrong_words(const EcamTable& table) {
  const auto curve = table.saw.curve & ~devices::lx3vp::return_square;
  const bool no_law = table.saw.acceleration > 2;
  const bool no_curve = table.type == EcamType::rotary_saw && (curve > 5 || curve == 4);
  std::string told;
  if (no_law) told = fmt::format("P6L {}", table.saw.acceleration);
  if (no_curve) told += fmt::format("{}P6H {}", no_law ? ", " : "", table.saw.curve);
  return told;
}

std::string remedy_of(EcamError error, const EcamTable& table) {
  const auto& p = table.saw;
  const double k = static_cast<double>(p.sync_ratio);
  const double slave = std::abs(static_cast<double>(p.slave_length));
  const double sync = p.sync_length;
  switch (error) {
    case EcamError::type:
      if (table.saw.acceleration <= 2) return "give P6H 0, 1, 2, 3 or 5, with 4096 (H1000) added to return";
      if (wrong_words(table).find("P6H") == std::string::npos) return "give P6L 0, 1 or 2";
      return "give P6L 0, 1 or 2 and P6H 0, 1, 2, 3 or 5, with 4096 (H1000) added to return";
    case EcamError::length:
      return table.is_s_curve() ? "give P1 other than 0 and short enough for its speed"
                                : "give P1 above 0, P2 other than 0 and P3 from 0 on";
    case EcamError::sync_zone:
      if (sync > slave) return fmt::format("give P3 {} at most", number(slave));
      if (table.type == EcamType::fly_saw)
        return fmt::format("give P1 {} at least, or a larger P4", std::ceil((2 * slave - sync) / k));
      return fmt::format("give P1 above {}, or a shorter P3", number(sync / k));
    case EcamError::ratio:
      if (p.max_ratio < p.sync_ratio) return fmt::format("give P5 {} at least", number(k));
      return fmt::format(
          "outside the synchronous zone the mean ratio is {}; give P5 well above it, or a longer P1",
          number((slave - sync) / (p.master_length - sync / k)));
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

std::string top_speed_remedy(const EcamTable& table, double master_speed, double limit) {
  constexpr int most_turns = 2000;  // rounding may ask for many small steps
  auto parameters = table.s_curve;
  for (int turn = 0; turn < most_turns && parameters.top_speed > 0; ++turn) {
    const auto made = make_s_curve(*table.type, parameters);
    if (!made.ok()) break;
    double most = steepness(made.rows, steepest_row(made.rows));
    for (const auto& piece : made.profile.pieces) most = std::max(most, peak_ratio(piece));
    most *= master_speed;
    if (most <= limit * within) return fmt::format("give P2 {} Hz at most", parameters.top_speed);
    // Looked for downwards: rows round anew.
    parameters.top_speed =
        std::min(parameters.top_speed - 1, static_cast<std::int32_t>(parameters.top_speed * limit / most));
  }
  return "give P2 less";
}

}  // namespace drycut::sim
