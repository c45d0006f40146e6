#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "devices/plcopen/cam_table.hpp"
#include "devices/plcopen/errors.hpp"

namespace drycut::devices::plcopen {

/// State of an axis by PLCopen's diagram. A coupled slave is in SynchronizedMotion even while it stands.
enum class AxisState : std::uint8_t {
  disabled,
  standstill,
  homing,
  stopping,
  discrete_motion,
  continuous_motion,
  synchronized_motion,
  errorstop,
};
inline constexpr std::array axis_states{AxisState::disabled,
                                        AxisState::standstill,
                                        AxisState::homing,
                                        AxisState::stopping,
                                        AxisState::discrete_motion,
                                        AxisState::continuous_motion,
                                        AxisState::synchronized_motion,
                                        AxisState::errorstop};
/// "SynchronizedMotion", as PLCopen spells it.
std::string_view name_of(AxisState state);

/// What a function block asks of an axis.
enum class Command : std::uint8_t {
  power_on,
  power_off,
  home,
  set_position,
  move_absolute,
  move_relative,
  move_additive,
  move_superimposed,
  move_velocity,
  halt,
  stop,
  cam_in,
  cam_out,
  gear_in,
  gear_out,
  phasing,
  write_parameter,
  reset,
};

/// The state that the command leads to, or why it is refused: then nothing changes.
struct CommandVerdict {
  AxisState to = AxisState::disabled;
  ErrorId error = ErrorId::none;
};

/// The whole state diagram for commands. A new movement interrupts Stopping, unlike PLCopen's own diagram, as
/// the ISG kernel does; couplings do not. Reset and MC_Power on an axis in Errorstop look at the other of the
/// two besides: the axis does that.
CommandVerdict judge(AxisState from, Command command);

// What function blocks ask of axes, as plain values: a command that waits for its turn is kept as one.

/// Positions, ways and limits of a command go to here, either way.
inline constexpr double pin_max = 2147483647;

/// AXIS_REF: the number of an axis in its kernel; -1 = not connected.
struct AxisRef {
  int number = -1;
  bool operator==(const AxisRef&) const = default;
  void visit(StateArchive& archive);
};

/// Speed and slopes of a command in the units of the blocks' pins: um/s or 0.001 deg/s, mm/s2, mm/s3 or
/// deg/s2, deg/s3. An acceleration, deceleration or jerk of 0 means the axis' own; else they are 1 or more.
struct Dynamics {
  double velocity = 0;
  double acceleration = 0;
  double deceleration = 0;
  double jerk = 0;

  void visit(StateArchive& archive);
};

/// What becomes of a command: taken, with the ticket by which its block asks on, or refused.
struct Order {
  ErrorId error = ErrorId::none;
  std::uint64_t ticket = 0;
  AxisRef about = {};  ///< the axis that the error is about where it is not the one that was to move
};

/// Direction pin of the movements.
enum class Direction : std::int16_t { positive = 1, shortest_way = 2, negative = 3, current = 4 };

/// BufferMode pin (PLCopen part 1): when a command takes effect on an axis that is at work. Aborting: at
/// once. Buffered: when the last command before it is done, from standstill after a movement to a target.
/// Blending: likewise, but the axis passes that target at the lower speed of both commands, at the speed of
/// the one before, of this one, or at the higher of both.
enum class BufferMode : std::int16_t {
  aborting = 0,
  buffered = 1,
  blending_low = 2,
  blending_previous = 3,
  blending_next = 4,
  blending_high = 5,
};

/// Inputs of the blocks that move one axis.
struct MoveRequest {
  Command command = Command::move_absolute;  ///< or move_relative, move_additive, move_velocity
  double way = 0;                            ///< Position, or Distance
  Dynamics dynamics;
  Direction direction = Direction::shortest_way;

  void visit(StateArchive& archive);
};

/// Inputs of MC_CamIn, without its edge.
struct CamInRequest {
  AxisRef master;
  AxisRef slave;
  double master_offset = 0;
  double slave_offset = 0;
  double master_scaling = 1;
  double slave_scaling = 1;
  std::uint32_t start_mode = 0;
  std::uint16_t table = 0;
  std::uint32_t interpolation = static_cast<std::uint32_t>(Interpolation::table_defined);

  void visit(StateArchive& archive);
};

/// Inputs of MC_GearIn.
struct GearInRequest {
  AxisRef master;
  AxisRef slave;
  std::int32_t numerator = 1;
  std::uint32_t denominator = 1;
  Dynamics dynamics;
  std::uint32_t mode = 0;

  void visit(StateArchive& archive);
};
inline constexpr std::uint32_t gear_on_actual_values = 0x80;

/// What can wait for its turn.
using Request = std::variant<MoveRequest, CamInRequest, GearInRequest>;

/// Bits of MC_CamIn.StartMode (004 "startmode"). The first three have no effect: ramp-in and absolute are
/// always used.
enum StartMode : std::uint32_t {
  hli_ci_ramp_in = 0x01,
  hli_ci_absolute = 0x02,
  hli_ci_relative = 0x04,
  hli_ci_lock_table = 0x08,
  hli_ci_f_periodic = 0x10,
  hli_ci_endless_positive = 0x20,
  hli_ci_endless_negative = 0x40,
};
struct StartModeRow {
  std::string_view name;
  std::uint32_t bit = 0;
  std::string_view meaning;
};
inline constexpr std::array start_mode_table{
    StartModeRow{"HLI_CI_RAMP_IN", hli_ci_ramp_in, "no effect: always"},
    StartModeRow{"HLI_CI_ABSOLUTE", hli_ci_absolute, "no effect: always"},
    StartModeRow{"HLI_CI_RELATIVE", hli_ci_relative, "no effect"},
    StartModeRow{"HLI_CI_LOCK_TABLE", hli_ci_lock_table, "the table cannot be written while coupled"},
    StartModeRow{"HLI_CI_F_PERIODIC", hli_ci_f_periodic, "endless; without it one pass for each Execute"},
    StartModeRow{"HLI_CI_ENDLESS_POSITIVE", hli_ci_endless_positive,
                 "the cam turns the slave on in positive direction"},
    StartModeRow{"HLI_CI_ENDLESS_NEGATIVE", hli_ci_endless_negative,
                 "the cam turns the slave on in negative direction"},
};

/// A name that programs may use for a number, besides those of start_mode_table.
struct NamedNumber {
  std::string_view name;
  std::int16_t number = 0;
};
/// TableFctType as 004 prints it, some with HLI_, some without, and with both; Direction; BufferMode.
inline constexpr std::array named_numbers{
    NamedNumber{"HLI_STEP_DIRECT", 0},     NamedNumber{"STEP_DIRECT", 0},
    NamedNumber{"HLI_LINEAR", 1},          NamedNumber{"LINEAR", 1},
    NamedNumber{"HLI_POLYNOM_3", 2},       NamedNumber{"POLYNOM_3", 2},
    NamedNumber{"HLI_POLYNOM_3_KOEFF", 3}, NamedNumber{"POLYNOM_3_KOEFF", 3},
    NamedNumber{"HLI_LINE_POLY5", 4},      NamedNumber{"LINE_POLY5", 4},
    NamedNumber{"HLI_POLY5_LINE", 5},      NamedNumber{"POLY5_LINE", 5},
    NamedNumber{"HLI_TABLE_DEFINED", 6},   NamedNumber{"TABLE_DEFINED", 6},
    NamedNumber{"mcPositiveDirection", 1}, NamedNumber{"mcShortestWay", 2},
    NamedNumber{"mcNegativeDirection", 3}, NamedNumber{"mcCurrentDirection", 4},
    NamedNumber{"mcAborting", 0},          NamedNumber{"mcBuffered", 1},
    NamedNumber{"mcBlendingLow", 2},       NamedNumber{"mcBlendingPrevious", 3},
    NamedNumber{"mcBlendingNext", 4},      NamedNumber{"mcBlendingHigh", 5},
};

/// A name that programs may use for an elementary type.
struct NamedType {
  std::string_view name;
  std::string_view type;
};
inline constexpr std::array named_types{
    NamedType{"HLI_UNS32", "UDINT"},
    NamedType{"MC_BUFFER_MODE", "INT"},
    NamedType{"MC_DIRECTION", "INT"},
};

}  // namespace drycut::devices::plcopen
