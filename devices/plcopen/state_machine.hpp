#pragma once
#include <array>
#include <cstdint>
#include <string_view>

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
struct Verdict {
  AxisState to = AxisState::disabled;
  ErrorId error = ErrorId::none;
};

/// The whole state diagram for commands. A new movement interrupts Stopping, unlike PLCopen's own diagram, as
/// the ISG kernel does; couplings do not. Reset and MC_Power on an axis in Errorstop look at the other of the
/// two besides: the axis does that.
Verdict judge(AxisState from, Command command);

}  // namespace drycut::devices::plcopen
