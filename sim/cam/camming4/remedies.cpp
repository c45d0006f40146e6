#include "sim/cam/camming4/remedies.hpp"

#include <fmt/format.h>

#include <cmath>

#include "devices/camming4/messages.hpp"
#include "sim/cam/findings.hpp"

namespace drycut::sim {

namespace {

namespace camming4 = devices::camming4;
using camming4::Row;

/// The columns of the sector's two-phase law: spaces and the speeds that it joins.
struct TwoPhase {
  const char* column = "codeQs";
  double master = 0;  ///< [Um]
  double v0 = 0, v1 = 0;
  double slave_unit = 1;  ///< of `column` in one Um
};

TwoPhase two_phase_of(const Row& row, const CamVisit& visit, const CamTable& table) {
  TwoPhase law{"codeQs", static_cast<double>(row.codeQm), visit.entry_speed(), visit.exit_speed()};
  const auto* code = camming4::find_code(row.codeG);
  if (code == nullptr || code->qma != camming4::Use::master_space) return law;
  law.column = "codeQsa";
  law.master = row.codeQma;
  const auto& slave = table.settings.slave;
  law.slave_unit = static_cast<double>(slave.pulse) / static_cast<double>(slave.measure);
  if (row.codeG == 151)  // the stop after the first ramp
    law.v0 = visit.sector.law.ramps[1].v0;
  return law;
}

/// "at least 22.5" or, with a negative bound, "at most -22.5".
std::string bound(double value) {
  return fmt::format("{} {}", value < 0 ? "at most" : "at least", number(value));
}

CamAdvice too_small(const Row& row, const CamTable& table) {
  const auto* code = camming4::find_code(row.codeG);
  if (row.codeQm <= 0)
    return {fmt::format("codeQm is {}: a movement needs master space", row.codeQm), "give codeQm above 0"};
  if (code != nullptr && code->qma == camming4::Use::master_space && row.codeQma <= 0)
    return {"codeQma is 0: the ramp needs master space", "give codeQma above 0"};
  const auto& master = table.settings.master;
  const double count = static_cast<double>(master.measure) / static_cast<double>(master.pulse);
  return {fmt::format("it is over within one count of the master ({} Um)", number(count)),
          fmt::format("give it more than {} Um of master space", number(2 * count))};
}

CamAdvice on_error(const CamEngineEvent& event, const CamTable& table) {
  const Row& row = table.sector(event.row).row;
  const std::string plain(camming4::error_text(event.number));
  switch (event.number) {
    case 1:
      return {plain, "at most 9 such rows and 4 count updates may follow each other: put a movement between"};
    case 2:
      return {fmt::format("{} (ratio {})", plain, number(event.speed)),
              "end the sector before the jump at standstill (135), or begin here with 133, 134 or 154"};
    case 3:
      return {"the table has no such sector",
              fmt::format("give sector {}, or end the cam before it with 136 END or 138 LOOP", event.row)};
    case 4:
      return too_small(row, table);
    case 6:
      if (row.codeG == 137 || row.codeG == 190)
        return {fmt::format("jump to row {}", row.codeQm), "give a row from 1 to 128 in codeQm"};
      return {"the table runs on over row 128", "end it with 136 END or 138 LOOP"};
    case 7:
      return {plain, "put 160 before every movement, and let jumps go to the row after it"};
    case 50:
      return {fmt::format("{}: {} for a chord of {}", plain, row.codeQm,
                          number(std::hypot(row.codeQs, row.codeQsa))),
              fmt::format("give codeQm at least {:.0f}, or at most -{:.0f} for the long way",
                          std::ceil(std::hypot(row.codeQs, row.codeQsa) / 2),
                          std::ceil(std::hypot(row.codeQs, row.codeQsa) / 2))};
    case 51:
      return {plain, "give a displacement in codeQs or codeQsa, or 0 in codeQm for no movement"};
    default:
      return {plain, ""};
  }
}

CamAdvice too_steep(bool acceleration, const CamVisit& visit, const CamTable& table, const CamDuty& duty) {
  const double speed = duty.master_speed.value_or(0) * um_per_second(table);
  const double gradient = acceleration ? peak_acceleration(visit.sector) : peak_deceleration(visit.sector);
  const int hundredths = acceleration ? table.taccmax : table.tdecmax;
  const double most = table.maxvel * um_per_second(table) * 100 / hundredths;
  const double peak = gradient * speed * speed;
  return {fmt::format("{} above {}: {} Um/s2 at its peak, {} allowed",
                      acceleration ? "acceleration" : "deceleration", acceleration ? "taccmax" : "tdecmax",
                      number(peak), number(most)),
          fmt::format("give it more master space, or run the master at {} {} at most",
                      number_below(std::sqrt(most / gradient) / um_per_second(table)), speed_unit(table))};
}

CamAdvice turned_back(const CamVisit& visit) {
  const Row& row = visit.sector.row;
  const double v0 = visit.entry_speed();
  CamAdvice advice{fmt::format("{}: enters at ratio {}, leaves at {}", camming4::warning_text(5), number(v0),
                               number(visit.exit_speed())),
                   "give the slave's space the sign of the speed it enters with, or stop it before (135)"};
  if (row.codeG == 133 || row.codeG == 233)
    advice.remedy = fmt::format("give codeQs {}, or stop the slave before (135)", bound(v0 * row.codeQm / 2));
  return advice;
}

CamAdvice reverses_inside(const CamVisit& visit, const CamTable& table) {
  const auto law = two_phase_of(visit.sector.row, visit, table);
  const double least = law.master * (law.v0 + law.v1) / 4 * law.slave_unit;
  return {fmt::format("{}: ratio {} between {} and {}", camming4::warning_text(7),
                      number(visit.sector.law.mid_speed), number(law.v0), number(law.v1)),
          fmt::format("give {} {}{}, or the master less space", law.column, bound(least),
                      law.slave_unit == 1 ? "" : " bits")};
}

CamAdvice on_warning(const CamEngineEvent& event, const CamVisit& visit, const CamTable& table,
                     const CamDuty& duty) {
  const std::string plain(camming4::warning_text(event.number));
  switch (event.number) {
    case 1:
    case 2:
      return too_steep(event.number == 1, visit, table, duty);
    case 5:
      return turned_back(visit);
    case 6:
      return {fmt::format("{} (ratio {})", plain, number(event.speed)),
              "end the sector before it at standstill (135), or use 133, which takes the speed over"};
    case 7:
      return reverses_inside(visit, table);
    case 9:
      return {fmt::format("{}: it waits until the master has come back below it", plain),
              "give codeQm above the master's count at the start"};
    case 10:
      return {plain, "put the two 154 or 254 rows next to each other, or give codeQma 0"};
    default:
      return {plain, ""};
  }
}

}  // namespace

CamAdvice advice_on(const CamEngineEvent& event, const CamVisit* visit, const CamTable& table,
                    const CamDuty& duty) {
  if (event.error) return on_error(event, table);
  if (visit == nullptr) return {std::string(camming4::warning_text(event.number)), "see the error below"};
  return on_warning(event, *visit, table, duty);
}

}  // namespace drycut::sim
