#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "devices/camming4/messages.hpp"
#include "sim/cams/camming4/judge.hpp"

namespace drycut::sim::cams {

namespace {

namespace camming4 = devices::camming4;
using camming4::Row;

/// The columns of the sector's two-phase law: spaces and the speeds that it joins.
struct TwoPhase {
  const char* column = "codeQs";
  double master = 0;  ///< [Um]
  double v0 = 0, v1 = 0;
  double sense = 0;       ///< of the speed whose sign the middle should keep
  double slave_unit = 1;  ///< of `column` in one Um
};

/// Only a sector that starts from rest has the sign of its end.
TwoPhase with_sense(TwoPhase law) {
  law.sense = camming4::is_standstill(law.v0) ? law.v1 : law.v0;
  return law;
}

TwoPhase two_phase_of(const Row& row, const CamVisit& visit, const CammingTable& table) {
  TwoPhase law{"codeQs", static_cast<double>(row.codeQm), visit.entry_speed(), visit.exit_speed()};
  const auto* code = camming4::find_code(row.codeG);
  if (code == nullptr || code->qma != camming4::Use::master_space) return with_sense(law);
  law.column = "codeQsa";
  law.master = row.codeQma;
  const auto& slave = table.settings.slave;
  law.slave_unit = static_cast<double>(slave.pulse) / static_cast<double>(slave.measure);
  if (row.codeG == 151)  // the stop after the first ramp
    law.v0 = visit.sector.law.ramps[1].v0;
  return with_sense(law);
}

/// "codeQs at least 23" or, where the speed is below 0, "codeQs at most -23": the first whole number from
/// `bound` on with which the engine does not give the warning.
CamRemedy slave_space(const CamVisit& visit, const CammingTable& table, int warning, const TwoPhase& law,
                      double bound) {
  constexpr int tries = 16;
  constexpr double widest = 999'999;  // that the columns take (000 1.9.4)
  const auto* code = camming4::find_code(visit.sector.row.codeG);
  const auto gives = [&](double space) {
    Row row = visit.sector.row;
    (law.column == std::string_view("codeQs") ? row.codeQs : row.codeQsa) = static_cast<std::int32_t>(space);
    const auto made = make_sector(*code, row, visit.row, table.settings, {visit.entry_speed(), {}, nullptr});
    return std::find(made.warnings.begin(), made.warnings.begin() + made.warning_count, warning) !=
           made.warnings.begin() + made.warning_count;
  };
  const double step = law.sense < 0 ? -1 : 1;
  double space = step * std::ceil(step * bound - 1e-9);
  for (int i = 0; i < tries && std::abs(space) <= widest && gives(space); ++i) space += step;
  if (std::abs(space) > widest || gives(space)) return {};
  return {fmt::format("{} {} {}", law.column, law.sense < 0 ? "at most" : "at least", whole(space)),
          {{visit.row, law.column, space}}};
}

CamAdvice too_small(const Row& row, int number_of_row, const CammingTable& table, const CamDuty& duty) {
  const auto* code = camming4::find_code(row.codeG);
  const bool gearing = (row.codeG == 154 || row.codeG == 254) && row.codeQsa == 2;
  const double least = least_master_space(table, duty, gearing);
  const auto at_least = [&](const char* column) {
    return CamRemedy(fmt::format("give {} at least {}", column, whole(least)),
                     {{number_of_row, column, least}});
  };
  if (row.codeQm <= 0)
    return {fmt::format("codeQm is {}: a movement needs master space", row.codeQm), at_least("codeQm")};
  if (code != nullptr && code->qma == camming4::Use::master_space && row.codeQma <= 0)
    return {fmt::format("codeQma is {}: the ramp needs master space", row.codeQma), at_least("codeQma")};
  const auto& master = table.settings.master;
  const double count = static_cast<double>(master.measure) / static_cast<double>(master.pulse);
  const auto column = master_column(row);
  CamAdvice advice{fmt::format("it is over within one count of the master ({} Um)", number(count)),
                   fmt::format("give it at least {} Um of master space", whole(least))};
  if (column.name != nullptr) advice.remedy.cures = {{number_of_row, column.name, least - column.other}};
  return advice;
}

/// Both radii that just join the two points.
CamRemedy radius_remedy(const Row& row, int number_of_row) {
  const double radius = std::ceil(std::hypot(row.codeQs, row.codeQsa) / 2);
  return {
      fmt::format("give codeQm at least {}, or at most -{} for the long way", whole(radius), whole(radius)),
      {{number_of_row, "codeQm", radius}, {number_of_row, "codeQm", -radius}}};
}

CamAdvice on_error(const CamEngineEvent& event, const CammingTable& table, const CamDuty& duty) {
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
      return too_small(row, event.row, table, duty);
    case 6:
      if (row.codeG == 137 || row.codeG == 190)
        return {fmt::format("jump to row {}", row.codeQm), "give a row from 1 to 128 in codeQm"};
      return {"the table runs on over row 128", "end it with 136 END or 138 LOOP"};
    case 7:
      return {plain, "put 160 before every movement, and let jumps go to the row after it"};
    case 50:
      return {fmt::format("{}: {} for a chord of {}", plain, row.codeQm,
                          number(std::hypot(row.codeQs, row.codeQsa))),
              radius_remedy(row, event.row)};
    case 51:
      return {plain, "give a displacement in codeQs or codeQsa, or 0 in codeQm for no movement"};
    default:
      return {plain, ""};
  }
}

CamAdvice too_steep(bool acceleration, const CamVisit& visit, const CammingTable& table,
                    const CamDuty& duty) {
  const double speed = duty.master_speed.value_or(0) * um_per_second(table);
  const double gradient = acceleration ? peak_acceleration(visit.sector) : peak_deceleration(visit.sector);
  const int hundredths = acceleration ? table.taccmax : table.tdecmax;
  const double most = table.maxvel * um_per_second(table) * 100 / hundredths;
  const double peak = gradient * speed * speed;
  return {fmt::format("{} above {}: {} Um/s2 at its peak, {} allowed",
                      acceleration ? "acceleration" : "deceleration", acceleration ? "taccmax" : "tdecmax",
                      number(peak), number(most)),
          gradient_remedy(visit, table, gradient, most)};
}

CamAdvice turned_back(const CamVisit& visit, const CammingTable& table) {
  const Row& row = visit.sector.row;
  const double v0 = visit.entry_speed();
  CamAdvice advice{fmt::format("{}: enters at ratio {}, leaves at {}", camming4::warning_text(5), number(v0),
                               number(visit.exit_speed())),
                   "give the slave's space the sign of the speed it enters with, or stop it before (135)"};
  if (row.codeG != 133 && row.codeG != 233 && row.codeG != 151) return advice;
  // Its one ramp ends at rest.
  auto space = slave_space(visit, table, 5, {.v0 = v0, .sense = v0}, v0 * row.codeQm / 2);
  if (!space.text.empty())
    advice.remedy = {"give " + space.text + ", or stop the slave before (135)", space.cures};
  return advice;
}

CamAdvice reverses_inside(const CamVisit& visit, const CammingTable& table) {
  const auto law = two_phase_of(visit.sector.row, visit, table);
  const double least = law.master * (law.v0 + law.v1) / 4 * law.slave_unit;
  auto space = slave_space(visit, table, 7, law, least);
  CamAdvice advice{fmt::format("{}: ratio {} between {} and {}", camming4::warning_text(7),
                               number(visit.sector.law.mid_speed), number(law.v0), number(law.v1)),
                   "let the slave come to it slower"};
  if (!space.text.empty())
    advice.remedy = {fmt::format("give {}{}", space.text, law.slave_unit == 1 ? "" : " bits"), space.cures};
  return advice;
}

CamAdvice on_warning(const CamEngineEvent& event, const CamVisit& visit, int row_before,
                     const CammingTable& table, const CamDuty& duty) {
  const std::string plain(camming4::warning_text(event.number));
  switch (event.number) {
    case 1:
    case 2:
      return too_steep(event.number == 1, visit, table, duty);
    case 5:
      return turned_back(visit, table);
    case 6:
      return {fmt::format("{} (ratio {})", plain, number(event.speed)),
              "end the sector before it at standstill (135), or use 133, which takes the speed over"};
    case 7:
      return reverses_inside(visit, table);
    case 9:
      return {fmt::format("{}: it waits until the master has come back below it", plain),
              "give codeQm above the master's count at the start"};
    case 10:
      return {plain,
              {fmt::format("put the two 154 or 254 rows next to each other, or give codeQma 0 in sector {}",
                           row_before),
               {{row_before, "codeQma", 0}}}};
    default:
      return {plain, ""};
  }
}

}  // namespace

MasterColumn master_column(const Row& row) {
  const auto* code = camming4::find_code(row.codeG);
  if (code == nullptr) return {};
  const bool ramp = code->qma == camming4::Use::master_space;
  if (code->qm == camming4::Use::master_space) return {"codeQm", ramp ? row.codeQma : 0};
  return {ramp ? "codeQma" : nullptr, 0};
}

double least_master_space(const CammingTable& table, const CamDuty& duty, bool gearing) {
  const auto& master = table.settings.master;
  const double count = static_cast<double>(master.measure) / static_cast<double>(master.pulse);
  const double advance = duty.master_speed.value_or(0) * um_per_second(table) * table.TCamp / 1000;
  // A lap of just a count is over at each.
  return std::max(gearing ? std::floor(count) + 1 : std::ceil(count), std::ceil(advance / within));
}

CamRemedy gradient_remedy(const CamVisit& visit, const CammingTable& table, double peak, double most) {
  const auto& row = visit.sector.row;
  // With all of its spaces grown alike a ramp joins the same speeds; master space alone changes them. What is
  // softened hangs on the neighbour's space too.
  const bool grows = master_column(row).name != nullptr && row.codeG != 154 && row.codeG != 254;
  return slower_master(grows ? "give it more master and slave space alike, or " : "",
                       std::sqrt(most / peak) / um_per_second(table), speed_unit(table));
}

CamAdvice advice_on(const CamEngineEvent& event, const CamVisit* visit, int row_before,
                    const CammingTable& table, const CamDuty& duty) {
  if (event.error) return on_error(event, table, duty);
  if (visit == nullptr) return {std::string(camming4::warning_text(event.number)), "see the error below"};
  return on_warning(event, *visit, row_before, table, duty);
}

}  // namespace drycut::sim::cams
