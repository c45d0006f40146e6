#pragma once
#include <drycut/check.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "plants/plant.hpp"
#include "sim/time.hpp"

namespace drycut::sim::record {

// What came of a run. Each type names its members once, to any archive (visit.hpp).

using CheckResult = Check;
using Tolerance = Check::Tolerance;

/// One number of a drive beside what it may be.
struct DriveFigure {
  std::string name;   ///< "rms torque"
  double value = 0;   ///< in `unit`
  double rating = 0;  ///< in `unit`
  std::string unit;
  double share = 0;  ///< of what it may be, 1 = all; fails above, warns above 0.9
  /// How it goes with the machine's speed.
  enum class Goes { not_with_it, as_the_speed, as_the_torque, as_its_square, as_the_braking };
  Goes goes = Goes::as_the_speed;
  bool judged = true;       ///< else it is only told
  std::string window = {};  ///< when that was: "steady cycle", "from the first cut on"
  std::string remark = {};  ///< what a reader must know: why it is not judged, what its rating is

  bool operator==(const DriveFigure&) const = default;
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("name", self.name);
    archive("value", self.value);
    archive("rating", self.rating);
    archive("unit", self.unit);
    archive("share", self.share);
    archive("goes", self.goes);
    archive("judged", self.judged);
    archive("window", self.window);
    archive("remark", self.remark);
  }
};

inline constexpr std::array<std::string_view, 5> words_of(DriveFigure::Goes) {
  return {"not_with_it", "as_the_speed", "as_the_torque", "as_its_square", "as_the_braking"};
}

/// What came of a drive over its machine cycles.
struct DriveVerdict {
  std::string drive;   ///< "knife.servo"
  std::string cycles;  ///< "24 cycles from cut to cut"
  plants::DriveRatings ratings;
  std::vector<DriveFigure> figures;
  double inertia_ratio = 0;  ///< load over rotor
  double efficiency = 1;     ///< of all between motor and load; 1: no losses are counted
  double cogging = 0;        ///< amplitude of the motor's torque without current; 0: none is counted [N m]
  double torque_ripple = 0;  ///< amplitude over its torque; 0: none is counted
  int alike = 1;             ///< drives that do the same: all figures are those of one
  double energy = 0;         ///< from the mains, mean of a cycle; where none is known, of the run [J]
  int energy_cycles = 0;     ///< of so many cycles; 0: none is known
  bool steady = false;       ///< a steady cycle was found: what the drive bears for ever is known
  std::vector<std::string> trips;  ///< "tripped by overload at 3.2 s", "pulled out at 3.2 s"
  /// When the torque limit acted outside of what is judged: "twice, 0.12 s in all, first at 0.8 s"; "" =
  /// never.
  std::string limit_elsewhere;
  std::vector<std::string> notes;     ///< heat that is not judged, no steady cycle
  std::vector<std::string> warnings;  ///< heat over its rating that is not judged, mains that were missing
  /// At this share of the machine's speed all would be within 90 % of their ratings, by a cautious estimate
  /// from one run: friction and load stay, the rest of the torque goes with the speed. 1 where all are; 0
  /// where friction and load alone are too much.
  double advised = 1;
  /// Begin and end of the last ten of the cycles, or fewer; of the stretch that is judged where there are
  /// none [s].
  std::vector<std::pair<double, double>> last_cycles;
  // Of every record instant or cycle, for pictures and for sizing.
  std::vector<std::pair<double, double>> cycle_points;  ///< mean size of speed [rad/s], rms torque [N m]
  std::vector<std::pair<double, double>> points;        ///< speed [rad/s] and torque [N m] at record instants

  [[nodiscard]] bool holds() const;
  /// The figure with the largest share.
  [[nodiscard]] const DriveFigure& tightest() const;

  bool operator==(const DriveVerdict&) const = default;
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("name", self.drive);
    archive("holds", self.holds());
    archive("cycles", self.cycles);
    archive("figures", self.figures);
    archive("inertia_ratio", self.inertia_ratio);
    archive("efficiency", self.efficiency);
    archive("cogging", self.cogging);
    archive("torque_ripple", self.torque_ripple);
    archive("alike", self.alike);
    archive("energy", self.energy);
    archive("energy_cycles", self.energy_cycles);
    archive("steady", self.steady);
    archive("trips", self.trips);
    archive("limit_elsewhere", self.limit_elsewhere);
    archive("notes", self.notes);
    archive("warnings", self.warnings);
    archive("advised", self.advised);
    archive("ratings", self.ratings);
    archive("last_cycles", self.last_cycles);
    archive("cycle_points", self.cycle_points);
    archive("points", self.points);
  }
};

/// "knife.servo, each of 2: rms torque 6.1 of 9.5 N m (64 %, steady cycle)".
std::string text_of(const DriveVerdict& verdict);

/// What a controller or a machine told of that is not as it should be.
struct Alarm {
  double at = 0;  ///< [s]
  std::string source;
  Prose text;

  bool operator==(const Alarm&) const = default;
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("at", self.at);
    archive("source", self.source);
    archive("text", self.text);
  }
};

/// "Axis at 6.49 s: warning 12"
std::string text_of(const Alarm& alarm);

/// What the checks came to at half the step.
struct HalfStep {
  Time step = 0;
  std::string failure;
  std::vector<CheckResult> checks;  ///< the run's own, in its order

  bool operator==(const HalfStep&) const = default;
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("step", self.step);
    archive("failure", self.failure);
    archive("checks", self.checks);
  }
};

/// The sentences alone; each with its code behind it.
std::vector<std::string> texts_of(const std::vector<Finding>& findings);
std::vector<std::string> lines_of(const std::vector<Finding>& findings);

/// How a run ended.
struct Outcome {
  Time end = 0;         ///< simulated until
  std::string failure;  ///< why the simulation itself stopped before its time, "" if it did not
  std::vector<CheckResult> checks;
  std::optional<HalfStep> half_step = {};  ///< where it was asked for
  std::vector<DriveVerdict> drives = {};   ///< what the drives came to beside their ratings
  /// Why checks failed, as the end of a sentence, and what may be a slip, a phrase each.
  std::vector<Finding> findings = {};
  std::vector<Alarm> alarms = {};  ///< of controller and machine, the first of each kind
  [[nodiscard]] bool passed() const;
  /// "because ..."; "" = the run does not tell why checks failed.
  [[nodiscard]] std::string cause() const;
  [[nodiscard]] std::string cause_code() const;
  /// What may be a slip though the checks cannot tell: wires, heat that nobody judged.
  [[nodiscard]] std::vector<Finding> warnings() const;
  void add(const std::vector<Finding>& found, Finding::Role role);

  bool operator==(const Outcome&) const = default;
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("passed", self.passed());
    archive("end", self.end);
    archive("failure", self.failure);
    archive("cause", self.cause());
    archive("warnings", texts_of(self.warnings()));
    archive("findings", self.findings);
    archive("half_step", self.half_step);
    archive("checks", self.checks);
    archive("alarms", self.alarms);
    archive("drives", self.drives);
  }
};

}  // namespace drycut::sim::record
