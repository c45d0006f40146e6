#pragma once
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "plants/power_stage.hpp"
#include "sim/loop/bus.hpp"
#include "sim/loop/drive_cycles.hpp"
#include "sim/loop/names.hpp"
#include "sim/record/outcome.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Points of a plane, at most so many: every second one goes when there are more.
class Thinned {
 public:
  void add(double x, double y);
  [[nodiscard]] const std::vector<std::pair<double, double>>& points() const { return points_; }
  /// `name` is like no other's.
  void visit(StateArchive& archive, const std::string& name);

 private:
  friend class drycut::StateArchive;
  // A log of the points.
  [[nodiscard]] std::size_t grown() const { return seen_; }
  void shorten(std::size_t seen);
  void entries(StateArchive& archive, std::size_t from, std::size_t to);

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
class DriveJudge : public record::Observer {
 public:
  DriveJudge(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants);

  void sample(Time now) override;
  void happened(const record::RecordedEvent& event) override;
  void visit(StateArchive& archive) override;
  /// Length of the machine cycle of a plant at `now`, for what is told as a share of it: as the scenario
  /// names it, else the last from cut to cut, else the run so far [s].
  [[nodiscard]] double cycle_of(const std::string& plant, Time now) const;
  /// The verdicts as they stand, a drive each.
  [[nodiscard]] std::vector<record::DriveVerdict> verdicts() const;
  /// The check "drive within its ratings" is among the checks.
  [[nodiscard]] bool judges() const { return judged_; }
  /// The check "drive within its ratings"; none without drives, or where the scenario switches it off;
  /// from verdicts().
  [[nodiscard]] std::vector<record::CheckResult> results(
      const std::vector<record::DriveVerdict>& verdicts) const;

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
    double efficiency = 1;
    int alike = 1;
    double cogging = 0;
    double torque_ripple = 0;
    DriveCycles cycles;
    int counted = 0;                                  ///< cycles
    double energy = 0;                                ///< from the mains in them [J]
    std::deque<std::pair<double, double>> last = {};  ///< begin and end of the last of them, up to ten [s]
    std::deque<plants::DriveTotals> row = {};         ///< the last of them in a row, up to ten
    std::size_t judged = 0;                           ///< most of them in a row that were judged
    std::optional<plants::DriveTotals> steady = {};
    std::optional<plants::DriveTotals> heavier = {};  ///< the heaviest cycle since the steady one
    bool even = false;  ///< five cycles in a row came to the same as the five before
    Worst worst = {};
    AtLimit in_cycle = {};   ///< since the last one ended
    AtLimit elsewhere = {};  ///< in none that counts
    std::vector<std::string> trips = {};
    Thinned cycle_points = {};
    Thinned points = {};
    bool tells_mains = false;  ///< its mains_ok is wired: the program knows
  };

  static void end_cycle(Drive& drive, DriveCycles::Ended ended);
  static void judge_row(Drive& drive);
  static std::string judge_rest(Drive& drive);
  void remark(record::DriveVerdict& verdict, bool whole, bool has_heavier) const;
  [[nodiscard]] record::DriveVerdict verdict(Drive drive) const;

  bool judged_;
  Time cycle_;
  std::vector<Drive> drives_;
};

}  // namespace drycut::sim::loop
