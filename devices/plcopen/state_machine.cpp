#include "base/state_archive.hpp"
#include "devices/plcopen/requests.hpp"

namespace drycut::devices::plcopen {
namespace {

/// What each state is called, and the error of a command that it does not allow; in the order of AxisState.
struct StateRow {
  std::string_view name;
  ErrorId refusal;
};
constexpr std::array state_rows{StateRow{"Disabled", ErrorId::in_disabled},
                                StateRow{"Standstill", ErrorId::in_standstill},
                                StateRow{"Homing", ErrorId::in_homing},
                                StateRow{"Stopping", ErrorId::in_stopping},
                                StateRow{"DiscreteMotion", ErrorId::in_discrete_motion},
                                StateRow{"ContinuousMotion", ErrorId::in_continuous_motion},
                                StateRow{"SynchronizedMotion", ErrorId::in_synchronized_motion},
                                StateRow{"Errorstop", ErrorId::in_errorstop}};
const StateRow& row_of(AxisState state) { return state_rows.at(static_cast<std::size_t>(state)); }

bool moves_or_stands(AxisState state) {
  return state == AxisState::standstill || state == AxisState::discrete_motion ||
         state == AxisState::continuous_motion || state == AxisState::synchronized_motion;
}

}  // namespace

std::string_view name_of(AxisState state) { return row_of(state).name; }

CommandVerdict judge(AxisState from, Command command) {
  const CommandVerdict refused{from, row_of(from).refusal};
  const auto if_allowed = [&](bool allowed, AxisState to) { return allowed ? CommandVerdict{to} : refused; };
  const bool synchronized = from == AxisState::synchronized_motion;
  const bool stopping = from == AxisState::stopping;
  switch (command) {
    case Command::power_on:
      return {from == AxisState::disabled ? AxisState::standstill : from};
    case Command::power_off:
      return {from == AxisState::errorstop ? from : AxisState::disabled};
    case Command::home:
      if (from == AxisState::homing) return {from, ErrorId::home_again};
      return if_allowed(from == AxisState::standstill, AxisState::homing);
    case Command::set_position:
    case Command::write_parameter:
      return if_allowed(from == AxisState::standstill || from == AxisState::disabled, from);
    case Command::move_absolute:
    case Command::move_relative:
    case Command::move_additive:
      return if_allowed(moves_or_stands(from) || stopping, AxisState::discrete_motion);
    case Command::move_superimposed:
      return if_allowed(moves_or_stands(from), from);
    case Command::move_velocity:
      return if_allowed(moves_or_stands(from) || stopping, AxisState::continuous_motion);
    case Command::halt:
      return if_allowed(moves_or_stands(from), AxisState::discrete_motion);
    case Command::stop:
      if (stopping) return {from, ErrorId::stop_again};
      return if_allowed(moves_or_stands(from) || from == AxisState::homing, AxisState::stopping);
    case Command::cam_in:
    case Command::gear_in:
      return if_allowed(moves_or_stands(from), AxisState::synchronized_motion);
    case Command::cam_out:
    case Command::gear_out:
      return if_allowed(synchronized, AxisState::continuous_motion);
    case Command::phasing:
      return if_allowed(synchronized, AxisState::synchronized_motion);
    case Command::reset:
      return if_allowed(from == AxisState::errorstop, AxisState::standstill);
  }
  return refused;
}

void AxisRef::visit(StateArchive& archive) { STATE(archive, number); }
void Dynamics::visit(StateArchive& archive) { STATE(archive, velocity, acceleration, deceleration, jerk); }
void MoveRequest::visit(StateArchive& archive) { STATE(archive, command, way, dynamics, direction); }
void CamInRequest::visit(StateArchive& archive) {
  STATE(archive, master, slave, master_offset, slave_offset, master_scaling, slave_scaling, start_mode);
  STATE(archive, table, interpolation);
}
void GearInRequest::visit(StateArchive& archive) {
  STATE(archive, master, slave, numerator, denominator, dynamics, mode);
}

}  // namespace drycut::devices::plcopen
