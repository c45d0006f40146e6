#pragma once
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "plants/power_stage.hpp"
#include "sim/loop/checks.hpp"
#include "sim/loop/drive_cycles.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/observer.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

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
};

/// What came of a drive over its machine cycles.
struct DriveVerdict {
  std::string drive;   ///< "knife.servo"
  std::string cycles;  ///< "24 cycles from cut to cut"
  plants::DriveRatings ratings;
  std::vector<DriveFigure> figures;
  double inertia_ratio = 0;        ///< load over rotor
  int alike = 1;                   ///< drives that do the same: all figures are those of one
  double energy = 0;               ///< from the mains, mean of a cycle [J]
  bool steady = false;             ///< a steady cycle was found: what the drive bears for ever is known
  std::vector<std::string> trips;  ///< "tripped by overload at 3.2 s", "pulled out at 3.2 s"
  /// When the torque limit acted outside of what is judged: "twice, 0.12 s in all, first at 0.8 s"; "" =
  /// never.
  std::string limit_elsewhere;
  std::vector<std::string> notes;     ///< heat that is not judged, no steady cycle
  std::vector<std::string> warnings;  ///< of heat that is not judged and would be over its rating
  /// At this share of the machine's speed all would be within 90 % of their ratings, by a cautious estimate
  /// from one run: friction and load stay, the rest of the torque goes with the speed. 1 where all are; 0
  /// where friction and load alone are too much.
  double advised = 1;
  std::vector<std::pair<double, double>> cycle_points;  ///< mean size of speed [rad/s], rms torque [N m]
  std::vector<std::pair<double, double>> points;        ///< speed [rad/s] and torque [N m] at record instants

  [[nodiscard]] bool holds() const;
  /// The figure with the largest share.
  [[nodiscard]] const DriveFigure& tightest() const;
};

/// Points of a plane, at most so many: every second one goes when there are more.
class Thinned {
 public:
  void add(double x, double y);
  [[nodiscard]] const std::vector<std::pair<double, double>>& points() const { return points_; }

 private:
  std::vector<std::pair<double, double>> points_;
  std::size_t stride_ = 1;
  std::size_t seen_ = 0;
};

/// Judges the drives of all plants by their ratings: torque, current, heat and voltages over the worst ten
/// machine cycles in a row as if they went on for ever (DriveCycles); where there are not ten, over the
/// steady cycle: the last whose rms torque is within 1 % of that of the one before, or a heavier one that
/// came since; where there is none, over all. Without any cycle, means from the first motion on are told and
/// not judged: who knows whether it goes on like that. Homing, the start and a change of order are not the
/// machine's work: of machines that cut only the peaks from the first cut on are judged, and trips.
class DriveJudge : public Observer {
 public:
  DriveJudge(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants);

  void sample(Time now) override;
  void happened(const RecordedEvent& event) override;
  /// Length of the machine cycle of a plant at `now`, for what is told as a share of it: as the scenario
  /// names it, else the last from cut to cut, else the run so far [s].
  [[nodiscard]] double cycle_of(const std::string& plant, Time now) const;
  /// The verdicts as they stand, a drive each.
  [[nodiscard]] std::vector<DriveVerdict> verdicts() const;
  /// The check "drive within its ratings" is among the checks.
  [[nodiscard]] bool judges() const { return judged_; }
  /// The check "drive within its ratings"; none without drives, or where the scenario switches it off;
  /// from verdicts().
  [[nodiscard]] std::vector<CheckResult> results(const std::vector<DriveVerdict>& verdicts) const;

 private:
  /// What stretches of cycles came to, the worst of each.
  struct Worst {
    double torque = 0;  ///< rms [N m], where it is the largest share of S1
    double speed = 0;   ///< mean size then [rad/s]
    double share = 0;
    double constant = 0;         ///< share of its square that friction and load have
    double current_squared = 0;  ///< mean [A2]
    double rotor_loss = 0;       ///< mean, then [W]
    double fed_squared = 0;      ///< mean of the amplifier's current [A2]
    double resistor = 0;         ///< mean power [W]
    double saturated = 0;        ///< share of the time
    double saturated_once = 0;   ///< of a single cycle

    void take(const plants::DriveTotals& stretch, const plants::DriveRatings& ratings);
  };
  /// Stretches in which the torque limit acted.
  struct AtLimit {
    int times = 0;
    double seconds = 0;
    double first = 0;  ///< [s]

    void add(const AtLimit& more);
  };
  struct Drive {
    std::string plant;
    std::string name;
    plants::PowerStage* stage = nullptr;
    double load_inertia = 0;
    int alike = 1;
    DriveCycles cycles;
    int counted = 0;                           ///< cycles
    double energy = 0;                         ///< from the mains in them [J]
    std::deque<plants::DriveTotals> row = {};  ///< the last of them in a row, up to ten
    std::size_t judged = 0;                    ///< most of them in a row that were judged
    std::optional<plants::DriveTotals> steady = {};
    std::optional<plants::DriveTotals> heavier = {};  ///< the heaviest cycle since the steady one
    bool even = false;  ///< five cycles in a row came to the same as the five before
    Worst worst = {};
    AtLimit in_cycle = {};   ///< since the last one ended
    AtLimit elsewhere = {};  ///< in none that counts
    std::vector<std::string> trips = {};
    Thinned cycle_points = {};
    Thinned points = {};
  };

  static void end_cycle(Drive& drive, DriveCycles::Ended ended);
  static void judge_row(Drive& drive);
  static std::string judge_rest(Drive& drive);
  void remark(DriveVerdict& verdict, bool whole) const;
  [[nodiscard]] DriveVerdict verdict(Drive drive) const;

  bool judged_;
  Time cycle_;
  std::vector<Drive> drives_;
};

/// "knife.servo, each of 2: rms torque 6.1 of 9.5 N m (64 %, steady cycle)".
std::string text_of(const DriveVerdict& verdict);

}  // namespace drycut::sim::loop
