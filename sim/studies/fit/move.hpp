#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/studies/fit/question.hpp"

namespace drycut::sim::studies {

// The move to record before a fit: drycut fit --plan. It is a list of segments; all else are printers of it.

inline constexpr double minute_s = 60;  ///< for speeds in rpm [s]

/// Of an axis what its move is planned by. Places are those of the load, in mm of a carriage and in degrees
/// of what turns.
struct MoveAxis {
  std::string plant;
  std::string web;  ///< that it works on, where it has a place along one
  bool linear = false;
  std::string unit;                       ///< mm, deg
  double per_turn = 0;                    ///< of the load, for a turn of the motor [unit]
  double start = 0;                       ///< where the move begins, for a carriage its middle [unit]
  double low = 0;                         ///< of a carriage, where it may go [unit]
  double high = 0;                        ///< the same
  double counts = 0;                      ///< of the encoder for a turn of the motor, x4
  bool reversed = false;                  ///< it counts down
  std::string drive;                      ///< "servo", "pulses"
  std::optional<double> pulses_per_turn;  ///< of the motor, where its servo can take pulses
  double pulse_resolution = 0;            ///< counts of that servo for a turn of the motor
  double speed_at_10v = 0;                ///< [rpm]
  double top_speed = 0;                   ///< that a plan may use [rpm]
  double rated_torque = 0;                ///< [N m]
  double peak_torque = 0;                 ///< [N m]
  double inertia = 0;                     ///< of all at the motor, as the scenario has it [kg m2]
  double drag = 0;                        ///< torque of dry friction and weight, forwards [N m]
  double stribeck_speed = 0;              ///< of what is looked for, the lowest at the motor [rpm]; 0: none
  double antiresonance = 0;               ///< [Hz], 0: not known
  double resonance = 0;                   ///< [Hz], the same
};

/// What a part of the move is for.
enum class MovePart { approach, constant_speeds, ramps, slow, whole, chirp };

/// The motor goes from a speed to another in a straight line.
struct MoveSegment {
  MovePart part = MovePart::approach;
  double from = 0;  ///< [rpm]
  double to = 0;    ///< [rpm]
  double seconds = 0;

  /// Of the motor [turns].
  [[nodiscard]] double turns() const;
};

/// From rest to a speed, along, and to rest again: what a controller is told. Three segments, then a rest.
struct MoveStroke {
  MovePart part = MovePart::approach;
  double begin = 0;  ///< [s]
  double speed = 0;  ///< [rpm], below 0 backwards
  double ramp = 0;   ///< [s]
  double along = 0;  ///< at that speed [s]
  double turns = 0;  ///< of the motor from rest to rest, below 0 backwards
};

/// Torque that the drive's generator adds along each stroke of the part `chirp`.
struct MoveChirp {
  double from = 0;       ///< [Hz]
  double to = 0;         ///< [Hz]
  double amplitude = 0;  ///< [N m]
};

struct FitMove {
  MoveAxis axis;
  std::vector<FitPath> vary;
  std::vector<MoveSegment> segments;
  std::optional<MoveChirp> chirp;
  double sampling = 0;  ///< of the recording, at least [Hz]

  [[nodiscard]] double seconds() const;
};

/// The strokes that the segments are made of.
std::vector<MoveStroke> strokes_of(const FitMove& move);
/// Which part tells most about a value.
MovePart part_for(const FitPath& path);

/// Plans the move by the scenario and what is looked for. What is wrong goes to `problems`; there is no move
/// then.
std::optional<FitMove> plan_move(FitPlan& plan, Problems& problems);

}  // namespace drycut::sim::studies
