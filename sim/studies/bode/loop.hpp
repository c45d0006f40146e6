#pragma once
#include <functional>
#include <optional>
#include <string>

#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/bode/sweep.hpp"

namespace drycut::sim::studies {

// Play and stiction let a loop rest that hunts for ever once something has moved it. No single sine finds
// that: one that is too small never leaves the play, a larger one hides it. So the loop is pushed, at the
// gain in force and then at more of it, until an oscillation keeps itself up; from there the gain goes down
// again, under way, until the oscillation dies.

/// From which gain on a loop hunts.
struct HuntingPoint {
  std::optional<double> from;  ///< times the gain in force: from there on an oscillation keeps itself up
  double tried = 0;            ///< the largest factor at which every push died out; 0 = none
  double frequency = 0;        ///< of the oscillation at `from` [Hz]
  double amplitude = 0;        ///< of the oscillation at `from`, at the wire [V]
  std::string failure;  ///< why nothing can be told: the axis moves, the simulation stopped; "" if it can

  [[nodiscard]] bool hunts_now() const { return from && *from <= 1; }
};

/// The pushes [V], each for a quarter of a period.
inline constexpr double least_push = 0.1;
inline constexpr double largest_push = 1.6;

/// Pushes the loop at `wire` of Bus::analogue_wires() from time `at` on. `excited` and `still` are the same
/// scenario twice; `period` is about that of an oscillation [s], 0 = not known.
HuntingPoint find_hunting(loop::Simulation& excited, loop::Simulation& still, std::size_t wire, Time at,
                          Time sampling, double period);

/// Play and stiction of the plant that a plug belongs to: "axis.gap 0.4 mm"; "" if it has none.
std::string play_of(const scenario::Scenario& scenario, const std::string& plug);

/// Where and how a loop is to be measured, as a user says it.
struct LoopRequest {
  std::string wire;               ///< plug of the analogue reference, "" = the only one
  std::string speed;              ///< channel of the motor's speed, "" = motor.speed or speed of the plant
  std::optional<std::string> at;  ///< "6 s", "6" = 6 s; absent = the end of the scenario
  std::optional<double> from;  ///< [Hz], absent = 1 (a hundredth of `to` if less), and lower to the crossover
  std::optional<double> to;    ///< [Hz], absent = half the sampling frequency
  std::optional<int> points;   ///< absent = usual_points
  std::optional<double> amplitude;  ///< [V], absent = usual_amplitude
  std::optional<double> settle;     ///< [s], absent = usual_settle
  bool pushes = true;               ///< where there is play or stiction: whether it hunts after a push

  static constexpr int usual_points = 40;
  static constexpr double usual_amplitude = 0.1;
  static constexpr double usual_settle = 0.5;

  [[nodiscard]] double sine() const { return amplitude.value_or(usual_amplitude); }  ///< [V]

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("wire", self.wire);
    archive("speed", self.speed);
    archive("at", self.at);
    archive("from", self.from);
    archive("to", self.to);
    archive("points", self.points);
    archive("amplitude", self.amplitude);
    archive("settle", self.settle);
  }
};

/// A measurement with what its text needs.
struct LoopResult {
  std::string scenario;  ///< name of the file without extension
  std::string file;      ///< with it
  std::string wire;      ///< "knife.servo.reference"
  std::string terminal;  ///< "2.AN01"
  std::string speed;     ///< channel, "" = none
  std::string speed_unit;
  SweepPlan plan;
  Sweep sweep;
  Margins margins;
  std::optional<Margins> without_computing;  ///< the same with compute_time 0, where the scenario has one
  std::string play;                          ///< of the plant at the wire: "axis.gap 0.4 mm", "" = none
  std::optional<HuntingPoint> hunting;       ///< where there is play, if it was asked for
  std::string gains;  ///< of the controller's axes, in force: "AxisX.pgain 50, AxisX.feedfw 1000"; "" = none

  /// The phase margin, if it is known: the loop is sound, and up to twice the crossover all answers are to be
  /// trusted. What does not answer above that is another matter.
  [[nodiscard]] std::optional<AtFrequency> known_phase() const;
  /// The gain margin of this sine likewise.
  [[nodiscard]] std::optional<AtFrequency> known_gain() const;
  /// The least gain margin over all amplitudes, if it is known: with play an oscillation may keep itself up
  /// at less gain than one sine shows.
  [[nodiscard]] std::optional<AtFrequency> least_gain() const;
};

/// Doubt of a point (BodePoint::doubt) above which it is not to be trusted.
inline constexpr double bode_error_limit = 0.05;
/// Error of a point above which it is noise.
inline constexpr double bode_lost = 0.5;

/// Numbers of the request that no scenario allows, by the names of the options.
void check_request(const LoopRequest& request, Problems& problems);
/// A measurement lasts as long as it must: no drive of `simulation` trips by it.
void disarm(loop::Simulation& simulation);
/// When the measurement begins: --at, else the end of the scenario.
Time start_of(const scenario::Scenario& scenario, const LoopRequest& request);
/// A range that is none, or above half the frequency of the `sampling` of the loop that is measured.
void check_range(double from, double to, Time sampling, Problems& problems);
/// What of the request does not fit the scenario.
void check_loop(const scenario::Scenario& scenario, const LoopRequest& request, Problems& problems);
/// The same with the controller's compute_time set to 0 besides, where the scenario has one.
std::optional<LoopResult> measure_both(scenario::Scenario& scenario, const LoopRequest& request,
                                       Problems& problems, const std::function<void(double)>& progress = {});
/// Pushes the loop of `scenario`: from which gain on it hunts. `period` is about that of an oscillation [s],
/// 0 = not known. nullopt and problems if the request does not fit.
std::optional<HuntingPoint> push_loop(const scenario::Scenario& scenario, const LoopRequest& request,
                                      double period, Problems& problems);
/// The plug at which `request` measures, nullopt if it is not clear which.
std::optional<std::string> wire_of(const scenario::Scenario& scenario, const LoopRequest& request);
/// Runs `scenario` twice, and twice more where play asks for pushes, and measures; nullopt and problems if
/// the request does not fit it.
std::optional<LoopResult> measure_loop(const scenario::Scenario& scenario, const LoopRequest& request,
                                       Problems& problems, const std::function<void(double)>& progress = {});
/// "12.34 Hz".
std::string hertz_text(double frequency);
/// What keeps the measurement from being trusted, a line each; empty if nothing does.
std::vector<Finding> loop_doubts(const LoopResult& result);

}  // namespace drycut::sim::studies
