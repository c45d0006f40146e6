#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/recordings/recording.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/fit/machine.hpp"

namespace drycut::sim::studies {

// A recording is replayed in the simulated machine: the recorded torque drives its motor, and a controller of
// ours adds what it takes to follow the recorded motion. That addition is what the model's values leave
// unexplained. Model and recording go through the same filter, the one that the controller is, so that it
// bends no value; a zero-phase low pass comes after it.
//
// A closed loop is replayed as it is: the scenario runs, with what its inputs take of the recording, and what
// its motor's torque and its motion differ by is unexplained.

/// Speeds in rpm add up to minutes' worth of turns.
inline constexpr double seconds_a_minute = 60;

/// What of a recording tells about one plant.
struct ReplaySeries {
  enum class Kind { position, wrapped, speed };

  std::filesystem::path file;  ///< the recording's YAML
  std::string plant;
  recordings::Series torque;  ///< of the motor
  /// The motion that is followed, and the channel that it is of. Speeds are followed by what they add up to.
  recordings::Series motion;
  std::string channel;
  Kind kind = Kind::position;
  Kind load_kind = Kind::position;
  std::optional<recordings::Series> load;       ///< position of the load besides, in its channel's unit
  std::vector<recordings::Series> inputs = {};  ///< what acts on the machine besides: web speed, a force
  std::optional<double> start = {};             ///< of the plant, where the recording says it [SI]
  std::vector<std::string> unused = {};         ///< channels that a replay has no use for

  double from = 0;  ///< where all of it is recorded [s]
  double until = 0;
  bool one_way = false;  ///< it never moves back, or never forwards
  double sampling = 0;   ///< the slowest of torque and motion [s]

  /// Whether an input is a force or a torque: it may be in the recorded torque already.
  [[nodiscard]] bool is_effort(std::size_t input) const;
  /// For people.
  [[nodiscard]] std::string name() const { return file.filename().string(); }
};

/// Sorts the series of a recording by what they are of the question's plant, in a scenario that is stripped
/// and a source of torque, of a closed loop in the whole one. What is missing is told by the recording's name
/// `file`.
std::optional<ReplaySeries> replay_series(const recordings::Recording& recording,
                                          const std::filesystem::path& file, const FitQuestion& question,
                                          scenario::Scenario& scenario, Problems& problems);

/// How a machine answers to its motor's torque, about: measured on the simulated one.
struct Plausible {
  double inertia = 0;  ///< at the motor [kg m2]
  double scale = 0;    ///< of the followed channel over the motor's angle [unit/rad]
  double drag = 0;     ///< torque that dry friction and weight take, forwards [N m]
};

struct ReplaySetup {
  double cutoff = 0;  ///< [Hz]
  Plausible about;
  /// What happens near standstill counts too. Without play, stiffness or stiction to find it does not: there
  /// friction is not as any model has it.
  bool standstill = false;
  bool closed = false;
};

/// What is wrong with a recording, and put right in its replay.
struct ReplayErrors {
  double torque_offset = 0;  ///< what the recorded torque has too much [N m]
  double torque_scale = 1;   ///< true torque over the recorded one
  double torque_delay = 0;   ///< how late it is, against the motion, of a closed loop against its input [s]
  double load_delay = 0;
  std::vector<double> shares = {};  ///< of each input that acts; empty: all of it
};

struct Replayed {
  double step = 0;                  ///< between two values [s]
  std::vector<double> times;        ///< in the recording [s]
  std::vector<double> torque_left;  ///< torque that is missing in the model [N m]
  std::vector<double> load_left;    ///< load's position, simulated less recorded, without its mean
  // Of the same instants, through the same filters.
  std::vector<double> torque;    ///< recorded [N m]
  std::vector<double> speed;     ///< of the motor [rpm]
  std::vector<double> position;  ///< what is followed
  std::string position_unit;
};

Plausible measure_answer(const scenario::Scenario& scenario, const ReplaySeries& series);
/// Replays the recording in `scenario`, which is as replay_series() had it. nullopt if it diverges.
std::optional<Replayed> replay(const scenario::Scenario& scenario, const ReplaySeries& series,
                               const ReplaySetup& setup, const ReplayErrors& errors);

}  // namespace drycut::sim::studies
