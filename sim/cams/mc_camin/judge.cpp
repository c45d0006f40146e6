#include "sim/cams/mc_camin/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/cams/judge.hpp"

namespace drycut::sim::cams {

namespace {

using devices::CamExtremes;
using devices::CamOrder;
using devices::CamPiece;
using devices::plcopen::CamFileLimits;
using devices::plcopen::Endless;
using Grade = CamFinding::Grade;

class CamInJudge {
 public:
  CamInJudge(const CamInRun& run, const CamDuty& duty)
      : run_(run),
        cam_(run.cam),
        limits_(limits_of(run, duty)),
        motion_(motion_of(run, duty)),
        unit_(run.cam.slave_unit) {}

  std::vector<CamFinding> findings() {
    for (const auto& refusal : run_.refused)
      add("cam.device"_code, Grade::error, refusal.row == 0 ? "" : where(static_cast<int>(refusal.row)),
          std::string(meaning_of(refusal.error)), refusal.remedy, static_cast<int>(refusal.error));
    if (!run_.runs()) return std::move(found_);
    judge_limits();
    judge_travel();
    judge_jumps();
    judge_rest();
    judge_closing();
    judge_overshoot();
    judge_return();
    judge_range();
    remarks();
    return std::move(found_);
  }

 private:
  void add(Code kind, Grade grade, std::string where, std::string text, CamRemedy remedy = {}, int id = 0) {
    found_.push_back({kind, grade, id, std::move(where), std::move(text), std::move(remedy)});
  }
  /// Where it is worst, if there are such places at all, and how many there are.
  void add(Code kind, Grade grade, const CamWorst& worst, const std::string& text, CamRemedy remedy = {}) {
    if (worst.count == 0) return;
    const auto others = worst.count < 2 ? "" : fmt::format("; so at {} rows", worst.count);
    add(kind, grade, where(worst.row), text + others, std::move(remedy));
  }
  [[nodiscard]] std::string where(int row) const {
    const auto index = static_cast<std::size_t>(row) - 1;
    const auto& places = cam_.table.places;
    if (index >= places.size()) return fmt::format("row {}", row);
    return fmt::format("row {} (line {})", row, places[index]);
  }
  [[nodiscard]] std::string per(int order) const {
    return unit_ + (order == 1 ? "/s" : fmt::format("/s{}", order));
  }

  void judge_limits() {
    judge_limit(CamOrder::velocity, "velocity", motion_.velocity);
    judge_limit(CamOrder::acceleration, "acceleration", motion_.acceleration);
    judge_limit(CamOrder::jerk, "jerk", motion_.jerk);
  }

  /// The peak of the polynomials; where they jump there is no limit to the next derivative.
  void judge_limit(CamOrder order, const char* name, const CamQuantity& quantity) {
    if (quantity.limits.empty()) return;
    CamWorst worst;
    for (const CamPiece& piece : run_.law.pieces) {
      const double peak = piece.peak(order);
      if (!passed_limits(motion_, order, peak).empty()) worst.take(peak, piece.row);
    }
    for (auto& limit : passed_limits(motion_, order, worst.value))
      add("cam.limit"_code, limit.grade, worst, limit.text, std::move(limit.remedy));
    judge_steps(static_cast<int>(order), name);
  }

  void judge_steps(int power, const char* name) {
    CamWorst worst;
    for (const CamKnot& knot : run_.knots)
      if (knot.smooth < power - 1)
        worst.take(knot.jumps[static_cast<std::size_t>(knot.smooth) + 1], knot.row);
    add("cam.limit"_code, Grade::limit, worst,
        fmt::format("{} without end: what it is the derivative of jumps there", name),
        "see the table of knots");
  }

  void judge_travel() {
    const devices::CamTravel travel{limits_.least, limits_.most};
    if (!travel.is_given()) return;
    const auto [low, high] = reach_of(run_.law.pieces);
    const std::string unit = increments_of(unit_);
    const bool beyond = std::any_of(run_.law.pieces.begin(), run_.law.pieces.end(),
                                    [](const CamPiece& piece) { return std::abs(overshoot_of(piece)) > 1; });
    for (const TravelFault& fault : travel_faults(travel, low, high, {"minpos", "maxpos", unit, "", beyond}))
      add("cam.travel"_code, Grade::limit, "", fault.text, fault.remedy);
  }

  void judge_jumps() {
    CamWorst position;
    CamWorst velocity;
    CamWorst acceleration;
    for (const CamKnot& knot : run_.knots) {
      if (knot.smooth == -1) position.take(knot.jumps[0], knot.row);
      if (knot.smooth == 0) velocity.take(knot.jumps[1], knot.row);
      if (knot.smooth == 1) acceleration.take(knot.jumps[2], knot.row);
    }
    const bool steps = cam_.interpolation == devices::plcopen::Interpolation::step_direct;
    add("cam.jump"_code, Grade::caution, position,
        fmt::format("the position jumps by {} {}", number_text(position.value / increments_per_unit), unit_),
        turns_on(position.value) ? "it is a turn of the slave: write # endless: positive or negative"
        : steps                  ? "STEP_DIRECT is for switching; LINEAR and POLYNOM_3 have no such jumps"
                                 : "let each row end where the next one begins");
    add("cam.jump"_code, Grade::caution, velocity,
        fmt::format("the velocity jumps by {}{}", in_time(velocity.value, 1), velocity_unit()),
        "POLYNOM_3, or POLY5 between lines, has no such jumps");
    add("cam.jump"_code, Grade::remark, acceleration,
        fmt::format("the acceleration jumps by {} {}", in_time(acceleration.value, 2), acceleration_unit()));
  }

  [[nodiscard]] bool turns_on(double jump) const {
    return cam_.slave_modulo > 0 && cam_.endless == Endless::no &&
           std::abs(std::abs(jump) - cam_.slave_modulo) < 1;
  }
  /// A derivative in deg or mm: in time if the master's speed is known.
  [[nodiscard]] std::string in_time(double derivative, int order) const {
    if (run_.master_speed)
      return number(derivative * std::pow(*run_.master_speed, order) / increments_per_unit);
    return number(derivative * std::pow(increments_per_unit, order - 1));
  }
  [[nodiscard]] std::string velocity_unit() const {
    return run_.master_speed ? " " + per(1) : " (slave/master)";
  }
  [[nodiscard]] std::string acceleration_unit() const {
    return run_.master_speed ? per(2) : fmt::format("{}/{}2", unit_, cam_.master_unit);
  }

  /// A single pass ends with a stop without ramp (004 "periodic").
  void judge_rest() {
    if (cam_.periodic) return;
    const auto& last = run_.law.pieces.back();
    const double begin = at(run_.law, 0).velocity;
    const double end =
        last.master + last.length > run_.law.master_length * within ? begin : last.end().velocity;
    const auto tell = [&](double velocity, const char* place) {
      if (std::abs(velocity) <= 1e-6 * run_.peak(CamOrder::velocity)) return;
      add("cam.no-ramp"_code, Grade::caution, "",
          fmt::format("not periodic, and {} velocity {}{}: the slave {} without a ramp", place,
                      in_time(velocity, 1), velocity_unit(), *place == 'b' ? "starts" : "is stopped"),
          "let the cam begin and end at rest, at master 0");
    };
    tell(begin, "begins at");
    tell(end, "ends at");
  }

  void judge_closing() {
    if (cam_.endless != Endless::no || cam_.slave_modulo <= 0) return;
    if (cam_.table.columns() == 4) return;  // its jumps are told
    if (cam_.interpolation == devices::plcopen::Interpolation::step_direct) return;
    CamWorst worst;
    for (const CamPiece& piece : run_.law.pieces) {
      const double way = piece.end().position - piece.begin().position;
      if (piece.master >= 0 && std::abs(way) > cam_.slave_modulo / 2) worst.take(way, piece.row);
    }
    add("cam.half-turn"_code, Grade::caution, worst,
        fmt::format("goes {} by {} {}, more than half a turn", worst.value < 0 ? "back" : "on",
                    number_text(std::abs(worst.value) / increments_per_unit), unit_),
        "if the slave is to turn on instead, write # endless: positive or negative");
  }

  /// How far a piece leaves the range between its two ends, negative below it.
  static double overshoot_of(const CamPiece& piece) {
    const CamExtremes reached = piece.extremes(CamOrder::position);
    const double begin = piece.begin().position;
    const double end = piece.end().position;
    const double above = reached.high - std::max(begin, end);
    const double below = std::min(begin, end) - reached.low;
    return above > below ? above : -below;
  }

  /// A quintic leaves its range because the lines beside it want more way than it has: the shorter it is, the
  /// less. Looked for is the first whole master from which on the row's piece does not; a tenth of its length
  /// is left to it.
  [[nodiscard]] std::optional<double> later_begin(int row) const {
    auto table = cam_.table;
    const auto index = static_cast<std::size_t>(row) - 1;
    const bool is_last = index + 1 == table.lines();
    const double begin = table.value(index, 0);
    const double end = is_last ? cam_.master_modulo : table.value(index + 1, 0);
    const auto stays_inside = [&](double master) {
      table.values[2 * index] = master;
      if (check(table, cam_.interpolation, cam_.master_modulo) != devices::plcopen::ErrorId::none)
        return false;
      const auto curve =
          curve_of(table, cam_.interpolation, cam_.master_modulo, cam_.slave_modulo, cam_.endless);
      return std::abs(overshoot_of(curve.pieces[curve.pieces.size() - table.lines() + index])) <= 1;
    };
    double outside = std::floor(begin);
    double inside = std::floor(begin + 0.9 * (end - begin));
    if (!stays_inside(inside)) return {};
    while (inside - outside > 1) {
      const double middle = std::floor((inside + outside) / 2);
      (stays_inside(middle) ? inside : outside) = middle;
    }
    return inside;
  }

  [[nodiscard]] CamRemedy overshoot_remedy(int row) const {
    if (cam_.table.columns() == 1)
      return "let the rows before and after it rise and fall less, or take LINEAR, which has no overshoot";
    const std::string lines = "make the lines before and after it less steep";
    const auto begin = later_begin(row);
    if (!begin) return lines;
    return {fmt::format("let it begin at master {} or later, or {}", whole(*begin), lines),
            {{row, "master", *begin}}};
  }

  /// Pieces that leave the range between their two ends.
  void judge_overshoot() {
    if (cam_.table.columns() == 4) return;
    CamWorst worst;
    for (const CamPiece& piece : run_.law.pieces) {
      if (piece.master < 0) continue;
      const double overshoot = overshoot_of(piece);
      if (std::abs(overshoot) > 1) worst.take(overshoot, piece.row);
    }
    if (worst.count > 0)
      add("cam.overshoot"_code, Grade::caution, worst,
          fmt::format("overshoots its two rows by {} {}", number(std::abs(worst.value) / increments_per_unit),
                      unit_),
          overshoot_remedy(worst.row));
  }

  /// An endless cam that runs against its direction.
  void judge_return() {
    if (cam_.endless == Endless::no) return;
    const double direction = cam_.endless == Endless::positive ? 1 : -1;
    const double rounding = 1e-6 * run_.peak(CamOrder::velocity);
    CamWorst worst;
    for (const CamPiece& piece : run_.law.pieces) {
      const CamExtremes v = piece.extremes(CamOrder::velocity);
      const double back = direction > 0 ? v.low : v.high;
      if (direction * back < -rounding) worst.take(back, piece.row);
    }
    add("cam.turns-back"_code, Grade::caution, worst,
        fmt::format("runs against its direction, at {}{} at most", in_time(worst.value, 1), velocity_unit()),
        "if it must not turn back, bring its rows nearer to a steady rise");
  }

  void judge_range() {
    if (cam_.slave_modulo <= 0 || cam_.endless != Endless::no) return;
    const auto [low, high] = reach_of(run_.law.pieces);
    if (low >= -1 && high < cam_.slave_modulo + 1) return;
    add("cam.leaves-range"_code, Grade::caution, "",
        fmt::format("the slave leaves its turn: {} to {} of 0 to {} {}", number_text(low), number_text(high),
                    number_text(cam_.slave_modulo), increments_of(unit_)),
        "keep positions inside the turn, or write # endless: positive or negative");
  }

  void remarks() {
    const auto remark = [&](std::string text) { add("cam.remark"_code, Grade::remark, "", std::move(text)); };
    int smooth = 3;
    for (const CamKnot& knot : run_.knots) smooth = std::min(smooth, knot.smooth);
    if (smooth >= 0) remark(fmt::format("C{} at every knot and where the table closes", smooth));
    if (!run_.law.even && run_.cam.table.value(0, 0) > 0)
      remark(fmt::format("the first point is at master {}: before it the last piece goes on",
                         number_text(run_.cam.table.value(0, 0))));
    if ((limits_.velocity || limits_.acceleration || limits_.jerk) && !run_.master_speed)
      remark("maxvel, maxacc and maxjerk are judged with --master-speed only");
  }

  const CamInRun& run_;
  const devices::plcopen::CamFile& cam_;
  CamFileLimits limits_;
  CamMotionWords motion_;
  const std::string& unit_;
  std::vector<CamFinding> found_;
};

}  // namespace

devices::plcopen::CamFileLimits limits_of(const CamInRun& run, const CamDuty& duty) {
  CamFileLimits limits = run.cam.table.limits;
  if (duty.max_velocity) limits.velocity = duty.max_velocity;
  if (duty.max_acceleration) limits.acceleration = duty.max_acceleration;
  return limits;
}

std::vector<CamFinding> judge_cam_in(const CamInRun& run, const CamDuty& duty) {
  return CamInJudge(run, duty).findings();
}

}  // namespace drycut::sim::cams
