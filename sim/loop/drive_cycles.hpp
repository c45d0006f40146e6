#pragma once
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include "base/state_archive.hpp"
#include "plants/power_stage.hpp"

namespace drycut::sim::loop {

/// Cuts the run of a drive into the cycles of its machine. A cycle goes from cut to cut; it counts if it
/// lasts as long as the one before, to a fifth. Or it lasts as long as the scenario says: then it begins with
/// a motion: the first, that in which the cycle before has ended, or the next where the motor stood. It ends
/// up to 5 % early where the next motion begins, for who names it rounds. A motion begins with the torque
/// that a motor without any is given before it turns, against a brake that opens.
class DriveCycles {
 public:
  using Totals = plants::DriveTotals;
  enum class Ended { nothing, counts, does_not_count };

  /// `named`: how long a cycle lasts [s]; 0 = from cut to cut.
  explicit DriveCycles(double named) : named_(named) {}

  /// At each record instant: what the drive has done, and whether its motor turns.
  Ended sample(const Totals& now, bool turns) {
    const bool pulls = now.torque_squared > seen_.torque_squared;
    if (!pulls)
      woken_.reset();
    else if (!turns && !pulled_)
      woken_ = seen_;
    pulled_ = pulls;
    const bool starts = turns && !moves_;
    if (starts) motion_ = woken_ && seen_.time - woken_->time <= longest_start ? *woken_ : seen_;
    if (turns) woken_.reset();
    if (starts && !first_) first_ = motion_;
    if (turns) turned_ = now.time;
    moves_ = turns || (moves_ && now.time - turned_ <= pause * named_);
    const double period = now.time - seen_.time;
    seen_ = now;
    if (named_ <= 0) return Ended::nothing;
    if (!begin_ && moves_) begin_ = motion_;
    if (!begin_) return Ended::nothing;
    const Totals& end = starts ? motion_ : now;
    if (end.time - begin_->time < (starts ? rounded : 1) * named_ - period / 2) return Ended::nothing;
    last_ = end - *begin_;
    from_ = begin_->time;
    if (!moves_)
      begin_.reset();
    else
      begin_ = motion_.time > begin_->time ? motion_ : now;
    return Ended::counts;
  }

  /// At each cut.
  Ended cut(const Totals& now) {
    if (named_ > 0) return Ended::nothing;
    const auto begin = std::exchange(begin_, now);
    if (!begin || now.time <= begin->time) return Ended::nothing;
    last_ = now - *begin;
    from_ = begin->time;
    const double before = std::exchange(length_, last_.time);
    return std::abs(length_ - before) > unsteady * before ? Ended::does_not_count : Ended::counts;
  }

  void visit(StateArchive& archive) {
    STATE(archive, begin_, last_, length_, seen_, first_, motion_, woken_, pulled_, turned_, moves_, from_);
  }

  /// One runs.
  [[nodiscard]] bool running() const { return begin_.has_value(); }
  /// What was done in the cycle that ended last.
  [[nodiscard]] const Totals& last() const { return last_; }
  /// When it began [s]; it ended so much later as it lasted.
  [[nodiscard]] double began() const { return from_; }
  /// What was done before the first motion.
  [[nodiscard]] Totals before_motion() const { return first_.value_or(Totals{}); }

 private:
  static constexpr double unsteady = 0.2;
  static constexpr double pause = 0.02;  // of a cycle: what is shorter ends no motion
  static constexpr double rounded = 0.95;
  static constexpr double longest_start = 1;  // of a motor against its brake [s]

  double named_;
  std::optional<Totals> begin_;  // of the cycle that runs
  Totals last_;
  double from_ = 0;    // [s], it began
  double length_ = 0;  // of the last from cut to cut [s]
  Totals seen_;        // at the last record instant
  std::optional<Totals> first_;
  Totals motion_;                // where the last motion began
  std::optional<Totals> woken_;  // where the motor that stands got its torque
  bool pulled_ = true;           // it had torque between the last two record instants
  double turned_ = 0;            // [s] at the last record instant at which the motor turned
  bool moves_ = false;           // it turns, or stands for a pause only
};

}  // namespace drycut::sim::loop
