#include "sim/cams/lx3vp/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "devices/lx3vp/cam_law.hpp"
#include "sim/cams/judge.hpp"

namespace drycut::sim::cams {

namespace {

using devices::CamOrder;
using devices::lx3vp::EcamError;
using devices::lx3vp::EcamType;
using Grade = CamFinding::Grade;

constexpr int table_error = 6782;  // of DECAM: the table is out of range
constexpr std::size_t most_rows = 512;

class EcamJudge {
 public:
  EcamJudge(const EcamTable& table, const CamDuty& duty, const CamCourse& run)
      : table_(table), run_(run), motion_(motion_of(table, duty, run)) {}

  std::vector<CamFinding> findings() {
    if (table_.is_made() && !table_.made.ok()) {
      const auto error = table_.made.error;
      const auto words = error == EcamError::type ? wrong_words(table_) : std::string();
      add("cam.device"_code, Grade::error, "",
          words.empty() ? fmt::format("ECAMTBX makes no table: {}", error_text(error))
                        : fmt::format("ECAMTBX makes no table: there is no {}", words),
          remedy_of(error, table_), static_cast<int>(error));
      return std::move(found_);
    }
    judge_rows();
    if (!run_.runs()) return std::move(found_);
    judge_ratio();
    judge_speed();
    judge_acceleration();
    judge_travel();
    if (table_.is_made())
      judge_law();
    else
      judge_steps();
    remarks();
    return std::move(found_);
  }

 private:
  void add(Code kind, Grade grade, std::string where, std::string text, CamRemedy remedy = {}, int code = 0) {
    found_.push_back({kind, grade, code, std::move(where), std::move(text), std::move(remedy)});
  }

  [[nodiscard]] std::string where(std::size_t row) const {
    if (row >= table_.lines.size()) return fmt::format("row {}", row);
    return fmt::format("row {} (line {})", row, table_.lines[row]);
  }

  void judge_rows() {
    const auto& rows = table_.rows;
    const auto refuse = [&](std::size_t row, std::string text, std::string remedy) {
      add("cam.device"_code, Grade::error, where(row), std::move(text), std::move(remedy), table_error);
    };
    if (rows.size() < 2) refuse(0, "a cam of one row has no length", "give at least two rows");
    if (rows.size() > most_rows)
      refuse(most_rows, fmt::format("{} rows", rows.size()), fmt::format("a block takes {} rows", most_rows));
    if (!rows.empty() && rows.front().master < 0)
      refuse(0, fmt::format("the cam begins at master {}", rows.front().master), "begin at 0");
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (rows[i].master <= rows[i - 1].master)
        refuse(i, fmt::format("master {} does not come after {}", rows[i].master, rows[i - 1].master),
               "give the rows in ascending order of the master, each position once");
  }

  // What the device plays: straight pieces from row to row.

  [[nodiscard]] double length(std::size_t row) const { return played_.pieces[row - 1].length; }
  [[nodiscard]] double ratio(std::size_t row) const { return ratio_of(played_.pieces[row - 1]).r0; }
  [[nodiscard]] double rise(std::size_t row) const {
    return static_cast<double>(table_.rows[row].slave) - table_.rows[row - 1].slave;
  }

  /// The row that ends the steepest piece.
  [[nodiscard]] std::size_t steepest() const {
    CamWorst worst;
    for (const auto& piece : played_.pieces) worst.take(ratio_of(piece).r0, piece.row);
    return static_cast<std::size_t>(std::max(worst.row, 1));
  }

  void judge_ratio() {
    if (!table_.max_ratio) return;
    CamWorst worst;
    for (std::size_t i = 1; i < table_.rows.size(); ++i) {
      // Both ends are rounded to a pulse.
      const double surplus = std::abs(rise(i)) - 1 - *table_.max_ratio * length(i) * within;
      if (surplus > 0) worst.take(surplus / length(i), static_cast<int>(i));
    }
    if (worst.count == 0) return judge_ratio_of_law();
    const auto row = static_cast<std::size_t>(worst.row);
    add("cam.limit"_code, Grade::limit, where(row),
        fmt::format("ratio {} above {}{}", number(ratio(row)), number(*table_.max_ratio),
                    others(worst.count)),
        table_.is_made() ? ratio_remedy() : longer_piece(row));
  }

  [[nodiscard]] CamRemedy longer_piece(std::size_t row) const {
    const double least = std::ceil(std::abs(rise(row)) / *table_.max_ratio);
    return {fmt::format("give the piece before it {} master pulses at least", whole(least)),
            {{static_cast<int>(row), "length", least}}};
  }

  /// Rounding to pulses may hide in short pieces what the law does.
  void judge_ratio_of_law() {
    constexpr double of_a_float = 1 + 1e-6;
    if (!table_.is_made()) return;
    const auto most = peak_of_law(CamOrder::velocity);
    if (most.value <= *table_.max_ratio * of_a_float) return;
    add("cam.limit"_code, Grade::limit, most.where,
        fmt::format("ratio {} above {}", number(most.value), number(*table_.max_ratio)), ratio_remedy());
  }

  [[nodiscard]] CamRemedy ratio_remedy() const {
    if (table_.is_s_curve())
      return top_speed_remedy(table_, *run_.master_speed, *table_.max_ratio * *run_.master_speed);
    return ratio_limit_remedy(table_, *table_.max_ratio);
  }

  static std::string others(int count) {
    return count == 1 ? "" : fmt::format(", the worst of {} rows", count);
  }

  /// The largest absolute value and where it is.
  struct Peak {
    double value = 0;
    std::string where;
  };
  [[nodiscard]] Peak peak_of_law(CamOrder order) const {
    Peak most;
    for (std::size_t i = 0; i < run_.law.pieces.size(); ++i)
      if (const double peak = run_.law.pieces[i].peak(order); peak > most.value)
        most = {peak, fmt::format("piece {}", i + 1)};
    return most;
  }
  /// Of the rows, which the device plays, and of the law if that is steeper: rounded to pulses, rows may be
  /// steeper than their law.
  [[nodiscard]] Peak peak() const {
    const Peak played = {std::abs(ratio(steepest())), where(steepest())};
    if (!table_.is_made()) return played;
    auto law = peak_of_law(CamOrder::velocity);
    return played.value > law.value * within ? played : law;
  }

  void judge_limits(CamOrder order, const Peak& most, const std::function<CamRemedy(double)>& of_time) {
    const auto given = table_.time_axis > 0 ? of_time : nullptr;
    for (auto& limit : passed_limits(motion_, order, most.value, given))
      add("cam.limit"_code, limit.grade, most.where, std::move(limit.text), std::move(limit.remedy));
  }

  void judge_speed() {
    judge_limits(CamOrder::velocity, peak(), [&](double limit) -> CamRemedy {
      if (table_.is_s_curve()) return top_speed_remedy(table_, *run_.master_speed, limit);
      return "give the same way more time";
    });
  }

  void judge_acceleration() {
    Peak most;
    if (table_.is_made()) most = peak_of_law(CamOrder::acceleration);
    // From the middle of a piece to the middle of the next.
    for (std::size_t i = 2; !table_.is_made() && i < table_.rows.size(); ++i) {
      const double gradient = std::abs(ratio(i) - ratio(i - 1)) * 2 / (length(i) + length(i - 1));
      if (gradient > most.value) most = {gradient, where(i - 1)};
    }
    judge_limits(CamOrder::acceleration, most, [](double) { return "give its ramps more time"; });
  }

  /// The slave is farthest at a row, for the device plays straight pieces.
  void judge_travel() {
    const auto& rows = table_.rows;
    const auto [low, high] = std::minmax_element(
        rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.slave < b.slave; });
    const bool saw = table_.is_made() && !table_.is_s_curve();
    const TravelWords words{"min_position", "max_position", "pulses",
                            saw                ? "P2"
                            : table_.is_made() ? "P1"
                                               : ""};
    const auto faults = travel_faults(table_.travel, low->slave, high->slave, words);
    for (const auto& fault : faults)
      add("cam.travel"_code, Grade::limit,
          where(static_cast<std::size_t>((fault.above ? high : low) - rows.begin())), fault.text,
          fault.remedy);
    if (faults.empty()) judge_wandering(low->slave, high->slave);
  }

  /// A cycle that fits and does not end where it began leaves the travel in a later one.
  void judge_wandering(double low, double high) {
    const double growth = static_cast<double>(table_.rows.back().slave) - table_.rows.front().slave;
    const auto& end = growth > 0 ? table_.travel.most : table_.travel.least;
    if (!table_.cyclic || table_.made.profile.stops || growth == 0 || !end) return;
    const double room = growth > 0 ? *end - high : low - *end;
    add("cam.leaves-range"_code, Grade::limit, "",
        fmt::format("the slave goes on by {} pulses each cycle and passes {} {} in cycle {:.0f}",
                    number(growth), growth > 0 ? "max_position" : "min_position", number(*end),
                    std::floor(room / std::abs(growth)) + 2),
        "end the cycle where it begins, or run it once: # cyclic: 0");
  }

  /// Steps of the ratio, for given rows: more than half of the largest ratio from one piece to the next.
  void judge_steps() {
    const double peak = std::abs(ratio(steepest()));
    CamWorst most;
    const auto look = [&](std::size_t before, std::size_t after, std::size_t row) {
      const double rounding = 1 / length(before) + 1 / length(after);
      const double step = std::abs(ratio(after) - ratio(before)) - rounding;
      if (step > peak / 2) most.take(step, static_cast<int>(row));
    };
    const auto last = table_.rows.size() - 1;
    for (std::size_t i = 1; i < last; ++i) look(i, i + 1, i);
    if (table_.cyclic && last > 1) look(last, 1, last);
    if (most.count == 0) return;
    const auto worst = static_cast<std::size_t>(most.row);
    const auto next = worst == last ? 1 : worst + 1;
    add("cam.jump"_code, Grade::caution, where(worst),
        fmt::format("the ratio jumps from {} to {}{}{}", number(ratio(worst)), number(ratio(next)),
                    worst == last ? " as the cycle begins again" : "", others(most.count)),
        "put rows between, so that the slave can follow");
  }

  // What ECAMTBX made.

  void judge_law() {
    const auto& pieces = run_.law.pieces;
    const double same =
        1e-5 * std::abs(pieces.empty() ? 0 : std::max(pieces.front().peak(CamOrder::velocity), 1e-9));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const bool wraps = i + 1 == pieces.size();
      if (wraps && (!table_.cyclic || table_.made.profile.stops)) break;
      const auto& next = pieces[wraps ? 0 : i + 1];
      if (std::abs(ratio_of(next).r0 - ratio_of(pieces[i]).r1) <= same) continue;
      add("cam.jump"_code, Grade::caution, fmt::format("piece {}", i + 1),
          fmt::format("the ratio jumps from {} to {}{}", number(ratio_of(pieces[i]).r1),
                      number(ratio_of(next).r0), wraps ? " as the cycle begins again" : ""),
          step_remedy(wraps));
    }
    judge_rest(same);
    if (table_.is_s_curve() && table_.made.speed_reached < table_.s_curve.top_speed)
      add("cam.not-reached"_code, Grade::caution, "",
          fmt::format("reaches {} Hz, not {} Hz: too short for its times", table_.made.speed_reached,
                      table_.s_curve.top_speed),
          "give P4 and P5 less time");
  }

  /// A cam that runs once begins and ends at rest; midCAMbegin and midCAMend go on in another.
  void judge_rest(double same) {
    const auto& pieces = run_.law.pieces;
    if (table_.cyclic && !table_.made.profile.stops) return;
    const auto curve = table_.type == EcamType::rotary_saw ? table_.saw.curve & 0xFFF : 0;
    const auto remedy = [&](std::string_view ramp, std::string_view other) {
      if (table_.is_s_curve()) return fmt::format("give {} some time", ramp);
      return table_.type == EcamType::fly_saw
                 ? std::string("give P6L 1 or 2 for ramps")
                 : fmt::format("use {} for the {}", other, ramp == "P4" ? "first cycle" : "last");
    };
    if (!table_.made.profile.stops && std::abs(ratio_of(pieces.front()).r0) > same)
      add("cam.jump"_code, Grade::caution, "piece 1",
          fmt::format("the ratio jumps from 0 to {} as the cam starts", number(ratio_of(pieces.front()).r0)),
          remedy("P4", "midCAMbegin"));
    if (curve != devices::lx3vp::mid_cam_begin && std::abs(ratio_of(pieces.back()).r1) > same)
      add("cam.jump"_code, Grade::caution, fmt::format("piece {}", pieces.size()),
          fmt::format("the ratio jumps from {} to 0 at the end of the cam",
                      number(ratio_of(pieces.back()).r1)),
          remedy("P5", "midCAMend"));
  }

  [[nodiscard]] std::string step_remedy(bool wraps) const {
    if (table_.is_s_curve()) return "give P4 and P5 some time";
    if (table_.saw.acceleration == 0) return "give P6L 1 or 2 for ramps";
    if (wraps && (table_.saw.curve & 0xFFF) == devices::lx3vp::mid_cam_begin)
      return "use midCAMbegin for the first cycle and midCAMall for those after it";
    return "give P3 less than P2, so that there is way left for ramps";
  }

  void remarks() {
    const auto remark = [&](std::string text) { add("cam.remark"_code, Grade::remark, "", std::move(text)); };
    const auto& law = table_.made.profile;
    if (!table_.is_made() && run_.first_master != 0)
      remark(
          fmt::format("the cycle begins at master {}; the cam runs from there", number(run_.first_master)));
    if (law.sync_end > law.sync_begin && !table_.is_s_curve())
      remark(fmt::format("synchronous zone: master {} to {}", number(law.sync_begin), number(law.sync_end)));
    if (law.stops) remark("midCAMend: the cam stops by itself at the end of the cycle");
    if (table_.cyclic && !law.stops && run_.law.slave_length != 0)
      remark(fmt::format("the slave goes on by {} pulses each cycle", number_text(run_.law.slave_length)));
    if (table_.is_made())
      remark(
          fmt::format("samples are of the laws; the device plays {} straight pieces, ratio {} at most, never "
                      "more than {} pulses from them",
                      table_.rows.size() - 1, number(std::abs(ratio(steepest()))),
                      number_text(largest_deviation(table_.made), 3)));
  }

  const EcamTable& table_;
  const CamCourse& run_;
  const CamMotionWords motion_;
  const devices::CamLaw played_ = straight_law(table_.rows);
  std::vector<CamFinding> found_;
};

}  // namespace

std::vector<CamFinding> judge_ecam(const EcamTable& table, const CamDuty& duty, const CamCourse& run) {
  return EcamJudge(table, duty, run).findings();
}

}  // namespace drycut::sim::cams
