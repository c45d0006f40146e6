#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace drycut::devices::plcopen {

/// What an ErrorID output or an axis reports. 0 = no error. Numbers up to 64999 and from 240000 on are those
/// of the ISG kernel; those of 65xxx are ours, for refusals to which its documents give no number.
enum class ErrorId : std::uint32_t {
  none = 0,
  no_such_table = 42003,
  too_few_columns = 42004,
  unknown_interpolation = 42006,
  too_few_lines = 42007,
  too_many_waiting = 44000,
  position_range = 44003,
  velocity_range = 44004,
  acceleration_range = 44005,
  deceleration_range = 44006,
  home_again = 44007,
  stop_again = 44008,
  in_standstill = 44014,
  in_homing = 44015,
  in_stopping = 44016,
  in_errorstop = 44017,
  in_discrete_motion = 44018,
  in_continuous_motion = 44019,
  in_synchronized_motion = 44020,
  in_disabled = 44028,
  gear_mode = 44062,
  table_type_mismatch = 60172,
  phasing_not_synchronous = 60173,
  phasing_slave_not_reached = 60175,
  not_modulo = 60181,
  not_homed = 60251,
  feed_enable_missing = 60252,
  table_master_order = 60260,
  table_line_count = 60261,
  selected_table_missing = 60265,
  table_busy = 60266,
  start_mode = 65001,
  master_scaling = 65002,
  slave_scaling = 65003,
  window_timeout = 65004,
  software_limit = 65005,
  feed_enable_dropped = 65006,
  drive_error = 65007,
  following_error = 65008,
  gear_ratio = 65009,
  not_a_master = 65010,
  no_such_axis = 65011,
  jerk_range = 65012,
  own_master = 65013,
  direction_range = 65014,
  emergency_stop = 65015,
  offset_range = 65016,
  override_range = 65017,
  no_such_probe = 65018,
  buffer_mode = 65019,
  no_such_parameter = 65020,
  parameter_range = 65021,
  table_locked = 240010,
  table_type_unknown = 240011,
  table_id = 240013,
};

struct ErrorRow {
  ErrorId id;
  std::string_view meaning;
};

inline constexpr std::array error_table{
    ErrorRow{ErrorId::no_such_table, "there is no table with this CamTableID"},
    ErrorRow{ErrorId::too_few_columns, "the table has fewer columns than its type needs"},
    ErrorRow{ErrorId::unknown_interpolation, "the interpolation is not one of 0..6, or the table names none"},
    ErrorRow{ErrorId::too_few_lines, "the table has no lines"},
    ErrorRow{ErrorId::too_many_waiting, "BufferMode: too many commands wait already"},
    ErrorRow{ErrorId::position_range, "Position outside its range"},
    ErrorRow{ErrorId::velocity_range, "Velocity outside its range"},
    ErrorRow{ErrorId::acceleration_range, "Acceleration outside its range"},
    ErrorRow{ErrorId::deceleration_range, "Deceleration outside its range"},
    ErrorRow{ErrorId::home_again, "MC_Home: the axis is being homed already"},
    ErrorRow{ErrorId::stop_again, "MC_Stop: the axis is being stopped already"},
    ErrorRow{ErrorId::in_standstill, "not allowed in Standstill"},
    ErrorRow{ErrorId::in_homing, "not allowed in Homing"},
    ErrorRow{ErrorId::in_stopping, "not allowed in Stopping"},
    ErrorRow{ErrorId::in_errorstop, "not allowed in Errorstop"},
    ErrorRow{ErrorId::in_discrete_motion, "not allowed in DiscreteMotion"},
    ErrorRow{ErrorId::in_continuous_motion, "not allowed in ContinuousMotion"},
    ErrorRow{ErrorId::in_synchronized_motion, "not allowed in SynchronizedMotion"},
    ErrorRow{ErrorId::in_disabled, "not allowed in Disabled"},
    ErrorRow{ErrorId::gear_mode, "Mode of MC_GearIn is neither 0 nor 16#80"},
    ErrorRow{ErrorId::table_type_mismatch, "the interpolation does not go with the type of the table"},
    ErrorRow{ErrorId::phasing_not_synchronous, "phasing: the slave does not follow this master"},
    ErrorRow{ErrorId::phasing_slave_not_reached, "phasing: the slave is not InGear or InSync yet"},
    ErrorRow{ErrorId::not_modulo, "this cam needs modulo axes"},
    ErrorRow{ErrorId::not_homed, "the slave of a cam must be homed"},
    ErrorRow{ErrorId::feed_enable_missing, "the slave's feed enable is off"},
    ErrorRow{ErrorId::table_master_order,
             "masters must ascend by 0.1 deg (1000) at least, over the wrap too"},
    ErrorRow{ErrorId::table_line_count, "LINE/POLY5 needs an even number of lines, 2..360"},
    ErrorRow{ErrorId::selected_table_missing, "MC_CamTableSelect: no table of this file name or id"},
    ErrorRow{ErrorId::table_busy, "the table is being changed"},
    ErrorRow{ErrorId::start_mode, "StartMode has a bit that is not defined, or both ENDLESS bits"},
    ErrorRow{ErrorId::master_scaling, "MasterScaling must be a whole number other than 0"},
    ErrorRow{ErrorId::slave_scaling, "SlaveScaling leaves the endless cam open: its turns must be whole"},
    ErrorRow{ErrorId::window_timeout, "velocity synchronisation: time_out_in_window has passed"},
    ErrorRow{ErrorId::software_limit, "a software limit switch would be passed"},
    ErrorRow{ErrorId::feed_enable_dropped, "feed enable dropped while coupled"},
    ErrorRow{ErrorId::drive_error, "the drive is not ready"},
    ErrorRow{ErrorId::following_error, "following error above its limit"},
    ErrorRow{ErrorId::gear_ratio, "RatioDenominator must be above 0, RatioNumerator not 0"},
    ErrorRow{ErrorId::not_a_master, "the master's parameter cam_gear.is_master is 0"},
    ErrorRow{ErrorId::no_such_axis, "there is no such axis"},
    ErrorRow{ErrorId::jerk_range, "Jerk outside its range"},
    ErrorRow{ErrorId::own_master, "an axis cannot follow itself, directly or over others"},
    ErrorRow{ErrorId::direction_range, "Direction outside its range"},
    ErrorRow{ErrorId::emergency_stop, "emergency stop"},
    ErrorRow{ErrorId::offset_range, "MasterOffset, SlaveOffset or PhaseShift outside +-2^31"},
    ErrorRow{ErrorId::override_range, "VelFactor outside 0..1"},
    ErrorRow{ErrorId::no_such_probe,
             "the axis has no such probe: TriggerInput is 0, and it needs an encoder"},
    ErrorRow{ErrorId::buffer_mode, "BufferMode outside 0..5"},
    ErrorRow{ErrorId::no_such_parameter,
             "there is no numeric parameter of this number, or it can only be read"},
    ErrorRow{ErrorId::parameter_range, "Value outside the parameter's range"},
    ErrorRow{ErrorId::table_locked, "the table is locked by a coupling"},
    ErrorRow{ErrorId::table_type_unknown, "the type of the table is not one of 1..7"},
    ErrorRow{ErrorId::table_id, "the id of a table is 1..65535 and belongs to one table"},
};

/// What the error says; "" if `id` is none of the table.
constexpr std::string_view meaning_of(ErrorId id) {
  const auto* row = std::find_if(error_table.begin(), error_table.end(),
                                 [id](const ErrorRow& candidate) { return candidate.id == id; });
  return row == error_table.end() ? std::string_view{} : row->meaning;
}

}  // namespace drycut::devices::plcopen
