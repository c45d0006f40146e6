#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace drycut::devices::plcopen {

// Every error once: its name, its number, its meaning. Numbers up to 64999 and from 240000 on are those of
// the ISG kernel; those of 65xxx are ours, for refusals to which its documents give no number.
#define DRYCUT_PLCOPEN_ERRORS                                                                             \
  ERROR(no_such_table, 42003, "there is no table with this CamTableID")                                   \
  ERROR(too_few_columns, 42004, "the table has fewer columns than its type needs")                        \
  ERROR(unknown_interpolation, 42006, "the interpolation is not one of 0..6, or the table names none")    \
  ERROR(too_few_lines, 42007, "the table has no lines")                                                   \
  ERROR(too_many_waiting, 44000, "BufferMode: too many commands wait already")                            \
  ERROR(position_range, 44003, "Position outside its range")                                              \
  ERROR(velocity_range, 44004, "Velocity outside its range")                                              \
  ERROR(acceleration_range, 44005, "Acceleration outside its range")                                      \
  ERROR(deceleration_range, 44006, "Deceleration outside its range")                                      \
  ERROR(home_again, 44007, "MC_Home: the axis is being homed already")                                    \
  ERROR(stop_again, 44008, "MC_Stop: the axis is being stopped already")                                  \
  ERROR(in_standstill, 44014, "not allowed in Standstill")                                                \
  ERROR(in_homing, 44015, "not allowed in Homing")                                                        \
  ERROR(in_stopping, 44016, "not allowed in Stopping")                                                    \
  ERROR(in_errorstop, 44017, "not allowed in Errorstop")                                                  \
  ERROR(in_discrete_motion, 44018, "not allowed in DiscreteMotion")                                       \
  ERROR(in_continuous_motion, 44019, "not allowed in ContinuousMotion")                                   \
  ERROR(in_synchronized_motion, 44020, "not allowed in SynchronizedMotion")                               \
  ERROR(in_disabled, 44028, "not allowed in Disabled")                                                    \
  ERROR(gear_mode, 44062, "Mode of MC_GearIn is neither 0 nor 16#80")                                     \
  ERROR(table_type_mismatch, 60172, "the interpolation does not go with the type of the table")           \
  ERROR(phasing_not_synchronous, 60173, "phasing: the slave does not follow this master")                 \
  ERROR(phasing_slave_not_reached, 60175, "phasing: the slave is not InGear or InSync yet")               \
  ERROR(not_modulo, 60181, "this cam needs modulo axes")                                                  \
  ERROR(not_homed, 60251, "the slave of a cam must be homed")                                             \
  ERROR(feed_enable_missing, 60252, "the slave's feed enable is off")                                     \
  ERROR(table_master_order, 60260, "masters must ascend by 0.1 deg (1000) at least, over the wrap too")   \
  ERROR(table_line_count, 60261, "LINE/POLY5 needs an even number of lines, 2..360")                      \
  ERROR(selected_table_missing, 60265, "MC_CamTableSelect: no table of this file name or id")             \
  ERROR(table_busy, 60266, "the table is being changed")                                                  \
  ERROR(start_mode, 65001, "StartMode has a bit that is not defined, or both ENDLESS bits")               \
  ERROR(master_scaling, 65002, "MasterScaling must be a whole number other than 0")                       \
  ERROR(slave_scaling, 65003, "SlaveScaling leaves the endless cam open: its turns must be whole")        \
  ERROR(window_timeout, 65004, "velocity synchronisation: time_out_in_window has passed")                 \
  ERROR(software_limit, 65005, "a software limit switch would be passed")                                 \
  ERROR(feed_enable_dropped, 65006, "feed enable dropped while coupled")                                  \
  ERROR(drive_error, 65007, "the drive is not ready")                                                     \
  ERROR(following_error, 65008, "following error above its limit")                                        \
  ERROR(gear_ratio, 65009, "RatioDenominator must be above 0, RatioNumerator not 0")                      \
  ERROR(not_a_master, 65010, "the master's parameter cam_gear.is_master is 0")                            \
  ERROR(no_such_axis, 65011, "there is no such axis")                                                     \
  ERROR(jerk_range, 65012, "Jerk outside its range")                                                      \
  ERROR(own_master, 65013, "an axis cannot follow itself, directly or over others")                       \
  ERROR(direction_range, 65014, "Direction outside its range")                                            \
  ERROR(emergency_stop, 65015, "emergency stop")                                                          \
  ERROR(offset_range, 65016, "MasterOffset, SlaveOffset or PhaseShift outside +-2^31")                    \
  ERROR(override_range, 65017, "VelFactor outside 0..1")                                                  \
  ERROR(no_such_probe, 65018, "the axis has no such probe: TriggerInput is 0, and it needs an encoder")   \
  ERROR(buffer_mode, 65019, "BufferMode outside 0..5")                                                    \
  ERROR(no_such_parameter, 65020, "there is no numeric parameter of this number, or it can only be read") \
  ERROR(parameter_range, 65021, "Value outside the parameter's range")                                    \
  ERROR(table_locked, 240010, "the table is locked by a coupling")                                        \
  ERROR(table_type_unknown, 240011, "the type of the table is not one of 1..7")                           \
  ERROR(table_id, 240013, "the id of a table is 1..65535 and belongs to one table")

#define ERROR(name, number, meaning) name = (number),
/// What an ErrorID output or an axis reports. 0 = no error.
enum class ErrorId : std::uint32_t { none = 0, DRYCUT_PLCOPEN_ERRORS };
#undef ERROR

struct ErrorRow {
  ErrorId id;
  std::string_view meaning;
};

#define ERROR(name, number, meaning) ErrorRow{ErrorId::name, meaning},
inline constexpr std::array error_table{DRYCUT_PLCOPEN_ERRORS};
#undef ERROR
#undef DRYCUT_PLCOPEN_ERRORS

/// What the error says; "" if `id` is none of the table.
constexpr std::string_view meaning_of(ErrorId id) {
  const auto* row = std::find_if(error_table.begin(), error_table.end(),
                                 [id](const ErrorRow& candidate) { return candidate.id == id; });
  return row == error_table.end() ? std::string_view{} : row->meaning;
}

}  // namespace drycut::devices::plcopen
