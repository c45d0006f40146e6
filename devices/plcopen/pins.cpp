#include "devices/plcopen/pins.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <tuple>

#include "base/text.hpp"
#include "devices/plcopen/function_blocks.hpp"

namespace drycut::devices::plcopen {
namespace {

/// A pin of block B beside the member that holds it.
template <typename B, typename T>
struct Bound {
  Pin pin;
  T B::*member;
};

template <typename B, typename C, typename T>
constexpr Bound<B, T> bind(std::string_view name, std::string_view type, PinDirection direction, T C::*member,
                           std::string_view meaning) {
  return {{name, type, direction, meaning}, static_cast<T B::*>(member)};
}

constexpr PinDirection io = PinDirection::in_out;
constexpr PinDirection in = PinDirection::input;
constexpr PinDirection out = PinDirection::output;

#define PIN(block, type, direction, name, meaning) bind<block>(#name, type, direction, &block::name, meaning)
#define EXECUTE(block) PIN(block, "BOOL", in, Execute, "the rising edge gives the command")
#define BUSY(block) PIN(block, "BOOL", out, Busy, "the block is not finished")
#define ACTIVE(block) BUSY(block), PIN(block, "BOOL", out, Active, "it has control of the axis")
#define DONE(block, meaning) PIN(block, "BOOL", out, Done, meaning)
#define BUFFER(block)               \
  PIN(block, "INT", in, BufferMode, \
      "0 mcAborting, 1 mcBuffered, 2 Low, 3 Previous, 4 Next, 5 mcBlendingHigh: when its turn comes")
#define ABORTED(block) PIN(block, "BOOL", out, CommandAborted, "another command has taken over")
#define ERRORS(block)                                                          \
  PIN(block, "BOOL", out, Error, "refused, or ended by an error of the axis"), \
      PIN(block, "UDINT", out, ErrorID, "which; see the table of errors")
#define AXIS(block) PIN(block, "AXIS_REF", io, Axis, "the axis")
#define SLOPES(block)                                                              \
  PIN(block, "LREAL", in, Acceleration, "mm/s2 or deg/s2; 0 = half of a_max"),     \
      PIN(block, "LREAL", in, Deceleration, "mm/s2 or deg/s2; 0 = half of a_max"), \
      PIN(block, "LREAL", in, Jerk, "mm/s3 or deg/s3; 0 = half of a_max in tr_min")
#define MASTER_SLAVE(block)                                        \
  PIN(block, "AXIS_REF", io, Master, "the axis that is followed"), \
      PIN(block, "AXIS_REF", io, Slave, "the axis that follows")

constexpr std::tuple power{AXIS(McPower), PIN(McPower, "BOOL", in, Enable, "TRUE switches the drive on"),
                           PIN(McPower, "BOOL", out, Status, "the drive is on"), ERRORS(McPower)};
constexpr std::tuple home{
    AXIS(McHome),
    EXECUTE(McHome),
    PIN(McHome, "LREAL", in, Position, "the present position's new value [0.1 um or 0.0001 deg]"),
    DONE(McHome, "homed"),
    ACTIVE(McHome),
    ABORTED(McHome),
    ERRORS(McHome)};
constexpr std::tuple reset{AXIS(McReset), EXECUTE(McReset), DONE(McReset, "out of Errorstop"), BUSY(McReset),
                           ERRORS(McReset)};
constexpr std::tuple stop{
    AXIS(McStop),
    PIN(McStop, "BOOL", in, Execute, "the rising edge stops; the axis stays in Stopping while it is TRUE"),
    PIN(McStop, "LREAL", in, Deceleration, "mm/s2 or deg/s2; 0 = half of a_max"),
    PIN(McStop, "LREAL", in, Jerk, "mm/s3 or deg/s3; 0 = half of a_max in tr_min"),
    DONE(McStop, "the axis stands"),
    ACTIVE(McStop),
    ABORTED(McStop),
    ERRORS(McStop)};
constexpr std::tuple halt{AXIS(McHalt),
                          EXECUTE(McHalt),
                          PIN(McHalt, "LREAL", in, Deceleration, "mm/s2 or deg/s2; 0 = half of a_max"),
                          PIN(McHalt, "LREAL", in, Jerk, "mm/s3 or deg/s3; 0 = half of a_max in tr_min"),
                          DONE(McHalt, "the axis stands"),
                          ACTIVE(McHalt),
                          ABORTED(McHalt),
                          ERRORS(McHalt)};
constexpr std::tuple move_absolute{
    AXIS(McMoveAbsolute),
    EXECUTE(McMoveAbsolute),
    PIN(McMoveAbsolute, "LREAL", in, Position, "target [0.1 um or 0.0001 deg]"),
    PIN(McMoveAbsolute, "LREAL", in, Velocity, "um/s or 0.001 deg/s, 1 or more"),
    SLOPES(McMoveAbsolute),
    PIN(McMoveAbsolute, "INT", in, Direction,
        "of a modulo axis: 1 positive, 2 shortest way, 3 negative, 4 current"),
    BUFFER(McMoveAbsolute),
    DONE(McMoveAbsolute, "at the target, the actual position within the window"),
    ACTIVE(McMoveAbsolute),
    ABORTED(McMoveAbsolute),
    ERRORS(McMoveAbsolute)};
constexpr std::tuple move_relative{
    AXIS(McMoveRelative),
    EXECUTE(McMoveRelative),
    PIN(McMoveRelative, "LREAL", in, Distance, "from the commanded position [0.1 um or 0.0001 deg]"),
    PIN(McMoveRelative, "LREAL", in, Velocity, "um/s or 0.001 deg/s, 1 or more"),
    SLOPES(McMoveRelative),
    BUFFER(McMoveRelative),
    DONE(McMoveRelative, "at the target, the actual position within the window"),
    ACTIVE(McMoveRelative),
    ABORTED(McMoveRelative),
    ERRORS(McMoveRelative)};
constexpr std::tuple move_additive{
    AXIS(McMoveAdditive),
    EXECUTE(McMoveAdditive),
    PIN(McMoveAdditive, "LREAL", in, Distance,
        "from the target of the movement under way, else from the commanded position [0.1 um or 0.0001 deg]"),
    PIN(McMoveAdditive, "LREAL", in, Velocity, "um/s or 0.001 deg/s, 1 or more"),
    SLOPES(McMoveAdditive),
    BUFFER(McMoveAdditive),
    DONE(McMoveAdditive, "at the target, the actual position within the window"),
    ACTIVE(McMoveAdditive),
    ABORTED(McMoveAdditive),
    ERRORS(McMoveAdditive)};
constexpr std::tuple move_superimposed{
    AXIS(McMoveSuperImposed),
    EXECUTE(McMoveSuperImposed),
    PIN(McMoveSuperImposed, "LREAL", in, Distance,
        "on top of what is under way; in Standstill as MC_MoveRelative [0.1 um or 0.0001 deg]"),
    PIN(McMoveSuperImposed, "LREAL", in, VelocityDiff,
        "largest difference to the speed under way, um/s or 0.001 deg/s, 1 or more"),
    SLOPES(McMoveSuperImposed),
    DONE(McMoveSuperImposed, "the distance has been added"),
    BUSY(McMoveSuperImposed),
    ABORTED(McMoveSuperImposed),
    ERRORS(McMoveSuperImposed)};
constexpr std::tuple move_velocity{
    AXIS(McMoveVelocity),
    EXECUTE(McMoveVelocity),
    PIN(McMoveVelocity, "LREAL", in, Velocity, "um/s or 0.001 deg/s, 1 or more"),
    SLOPES(McMoveVelocity),
    PIN(McMoveVelocity, "INT", in, Direction, "1 positive, 3 negative, 4 current"),
    BUFFER(McMoveVelocity),
    PIN(McMoveVelocity, "BOOL", out, InVelocity, "the speed is reached"),
    ACTIVE(McMoveVelocity),
    ABORTED(McMoveVelocity),
    ERRORS(McMoveVelocity)};
constexpr std::tuple set_position{
    AXIS(McSetPosition),
    EXECUTE(McSetPosition),
    PIN(McSetPosition, "LREAL", in, Position, "the actual position's new value [0.1 um or 0.0001 deg]"),
    PIN(McSetPosition, "BOOL", in, Relative, "TRUE: Position is added to the present one"),
    DONE(McSetPosition, "the position has its new value"),
    BUSY(McSetPosition),
    ERRORS(McSetPosition)};
constexpr std::tuple set_override{
    AXIS(McSetOverride),
    PIN(McSetOverride, "BOOL", in, Enable, "TRUE takes the factor; it stays when FALSE"),
    PIN(McSetOverride, "LREAL", in, VelFactor, "share of the speed of movements, 0..1"),
    PIN(McSetOverride, "BOOL", out, Enabled, "the factor is in force"),
    PIN(McSetOverride, "BOOL", out, Busy, "the factor is taken in every call"),
    PIN(McSetOverride, "BOOL", out, Error, "refused"),
    PIN(McSetOverride, "UDINT", out, ErrorID, "which; see the table of errors")};
constexpr std::tuple cam_table_select{
    MASTER_SLAVE(McCamTableSelect),
    EXECUTE(McCamTableSelect),
    PIN(McCamTableSelect, "MC_CAM_REF", in, CamTable, "the table by its file's name, which wins, or its id"),
    DONE(McCamTableSelect, "the table is there"),
    BUSY(McCamTableSelect),
    ERRORS(McCamTableSelect),
    PIN(McCamTableSelect, "UINT", out, CamTableID, "for MC_CamIn")};
constexpr std::tuple cam_in{
    MASTER_SLAVE(McCamIn),
    EXECUTE(McCamIn),
    PIN(McCamIn, "LREAL", in, MasterOffset, "added to the scaled master, +-2^31"),
    PIN(McCamIn, "LREAL", in, SlaveOffset, "added to the scaled cam, +-2^31"),
    PIN(McCamIn, "LREAL", in, MasterScaling, "the master is multiplied by it: a whole number, not 0"),
    PIN(McCamIn, "LREAL", in, SlaveScaling, "the cam is multiplied by it"),
    PIN(McCamIn, "DWORD", in, StartMode, "HLI_CI_ bits"),
    PIN(McCamIn, "UINT", in, CamTableID, "the table"),
    PIN(McCamIn, "UDINT", in, TableFctType, "0 STEP_DIRECT .. 5 POLY5_LINE, 6 as the table says"),
    BUFFER(McCamIn),
    PIN(McCamIn, "BOOL", out, InSync, "engaged; FALSE while the cam asks for more than the slave's speed"),
    ACTIVE(McCamIn),
    ABORTED(McCamIn),
    ERRORS(McCamIn),
    PIN(McCamIn, "BOOL", out, EndOfProfile, "for one call: the cam has come to its end")};
constexpr std::tuple cam_out{PIN(McCamOut, "AXIS_REF", io, Slave, "the axis that follows"), EXECUTE(McCamOut),
                             DONE(McCamOut, "uncoupled, the slave keeps its speed"), BUSY(McCamOut),
                             ERRORS(McCamOut)};
constexpr std::tuple gear_in{
    MASTER_SLAVE(McGearIn),
    EXECUTE(McGearIn),
    PIN(McGearIn, "DINT", in, RatioNumerator, "slave, not 0; negative turns the other way"),
    PIN(McGearIn, "UDINT", in, RatioDenominator, "master, above 0"),
    SLOPES(McGearIn),
    PIN(McGearIn, "DWORD", in, Mode, "0 setpoints of the master, 16#80 its actual values"),
    BUFFER(McGearIn),
    PIN(McGearIn, "BOOL", out, InGear, "engaged; FALSE while the slave's limits hold it back"),
    ACTIVE(McGearIn),
    ABORTED(McGearIn),
    ERRORS(McGearIn)};
constexpr std::tuple gear_out{PIN(McGearOut, "AXIS_REF", io, Slave, "the axis that follows"),
                              EXECUTE(McGearOut), DONE(McGearOut, "uncoupled, the slave keeps its speed"),
                              BUSY(McGearOut), ERRORS(McGearOut)};
constexpr std::tuple phasing{MASTER_SLAVE(McPhasing),
                             EXECUTE(McPhasing),
                             PIN(McPhasing, "LREAL", in, PhaseShift,
                                 "by how much more the master seems to have moved [0.1 um or 0.0001 deg]"),
                             PIN(McPhasing, "LREAL", in, Velocity, "um/s or 0.001 deg/s, 1 or more"),
                             SLOPES(McPhasing),
                             DONE(McPhasing, "shifted"),
                             ACTIVE(McPhasing),
                             ABORTED(McPhasing),
                             ERRORS(McPhasing)};

constexpr std::tuple cam_table_write{
    PIN(CamTableWrite, "UINT", in, CamTableID, "the table"),
    EXECUTE(CamTableWrite),
    PIN(CamTableWrite, "BOOL", in, Change, "TRUE: a longer change, until its end MC_CamIn refuses the table"),
    PIN(CamTableWrite, "UDINT", in, Line, "of the element, from 1"),
    PIN(CamTableWrite, "UINT", in, Column, "of the element, from 1"),
    PIN(CamTableWrite, "LREAL", in, Value, "the element's new value"),
    DONE(CamTableWrite, "written"),
    BUSY(CamTableWrite),
    PIN(CamTableWrite, "BOOL", out, Changing, "the change has begun"),
    PIN(CamTableWrite, "BOOL", out, Error, "not written, or the change has not begun"),
    PIN(CamTableWrite, "UDINT", out, ErrorID, "which; see the table of errors")};

#define READING(block)                                                 \
  AXIS(block), PIN(block, "BOOL", in, Enable, "TRUE reads"),           \
      PIN(block, "BOOL", out, Valid, "the outputs are of this call"),  \
      PIN(block, "BOOL", out, Busy, "it reads in every call"),         \
      PIN(block, "BOOL", out, Error, "there is nothing such to read"), \
      PIN(block, "UDINT", out, ErrorID, "which; see the table of errors")
#define STATE(name, meaning) PIN(McReadStatus, "BOOL", out, name, meaning)

constexpr std::tuple read_position{
    READING(McReadActualPosition),
    PIN(McReadActualPosition, "LREAL", out, Position, "of the encoder [0.1 um or 0.0001 deg]")};
constexpr std::tuple read_velocity{
    READING(McReadActualVelocity),
    PIN(McReadActualVelocity, "LREAL", out, Velocity, "of the encoder, with sign [um/s or 0.001 deg/s]")};
constexpr std::tuple read_status{READING(McReadStatus),
                                 STATE(Errorstop, "stopped by an error, until MC_Reset"),
                                 STATE(Disabled, "without power"),
                                 STATE(Stopping, "MC_Stop is in force"),
                                 STATE(Homing, "MC_Home is at work"),
                                 STATE(Standstill, "ready"),
                                 STATE(DiscreteMotion, "on the way to an end"),
                                 STATE(ContinuousMotion, "moves without end"),
                                 STATE(SynchronizedMotion, "coupled, even while it stands")};
constexpr std::tuple read_error{
    READING(McReadAxisError),
    PIN(McReadAxisError, "UDINT", out, AxisErrorID, "of the axis, 0 = none; see the table of errors")};
constexpr std::tuple read_info{
    READING(McReadAxisInfo),
    PIN(McReadAxisInfo, "BOOL", out, Simulation, "a virtual axis"),
    PIN(McReadAxisInfo, "BOOL", out, CommunicationReady, "the axis can be spoken to"),
    PIN(McReadAxisInfo, "BOOL", out, ReadyForPowerOn, "its drive is ready"),
    PIN(McReadAxisInfo, "BOOL", out, PowerOn, "MC_Power has switched it on"),
    PIN(McReadAxisInfo, "BOOL", out, IsHomed, "its zero is known"),
    PIN(McReadAxisInfo, "BOOL", out, AxisWarning,
        "the command in force asks for more speed than the axis has")};
constexpr std::tuple read_motion{
    READING(McReadMotionState),
    PIN(McReadMotionState, "BOOL", out, ConstantVelocity, "the commanded speed does not change; it may be 0"),
    PIN(McReadMotionState, "BOOL", out, Accelerating, "it grows, whatever the direction"),
    PIN(McReadMotionState, "BOOL", out, Decelerating, "it falls"),
    PIN(McReadMotionState, "BOOL", out, DirectionPositive, "the commanded position grows"),
    PIN(McReadMotionState, "BOOL", out, DirectionNegative, "it falls"),
    PIN(McReadMotionState, "BOOL", out, RevZero, "the actual speed is 0"),
    PIN(McReadMotionState, "BOOL", out, InWindow, "the actual position is within the window of the target"),
    PIN(McReadMotionState, "BOOL", out, InPosition, "likewise, and the commanded speed is 0"),
    PIN(McReadMotionState, "BOOL", out, IsMoving, "the commanded speed is not 0"),
    PIN(McReadMotionState, "LREAL", out, LrCommandedPos, "the target [0.1 um or 0.0001 deg]"),
    PIN(McReadMotionState, "LREAL", out, LrActualPos, "of the encoder [0.1 um or 0.0001 deg]"),
    PIN(McReadMotionState, "LREAL", out, LrSetPos, "the commanded position [0.1 um or 0.0001 deg]"),
    PIN(McReadMotionState, "LREAL", out, LrActualRev, "of the encoder [um/s or 0.001 deg/s]"),
    PIN(McReadMotionState, "LREAL", out, LrSetRev, "the commanded speed [um/s or 0.001 deg/s]"),
    PIN(McReadMotionState, "LREAL", out, LrSetAccel, "the commanded acceleration [mm/s2 or deg/s2]")};
constexpr std::tuple read_parameter{
    READING(McReadParameter),
    PIN(McReadParameter, "INT", in, ParameterNumber, "PLCopen's number; see the table of parameters"),
    PIN(McReadParameter, "LREAL", out, Value, "in the kernel's unit")};
constexpr std::tuple write_parameter{
    AXIS(McWriteParameter),
    EXECUTE(McWriteParameter),
    PIN(McWriteParameter, "INT", in, ParameterNumber, "PLCopen's number; see the table of parameters"),
    PIN(McWriteParameter, "LREAL", in, Value, "in the kernel's unit"),
    DONE(McWriteParameter, "in force, and kept over power cycles"),
    BUSY(McWriteParameter),
    ERRORS(McWriteParameter)};
constexpr std::tuple touch_probe{
    AXIS(McTouchProbe),
    PIN(McTouchProbe, "UINT", in, TriggerInput, "0, the axis' own probe"),
    EXECUTE(McTouchProbe),
    PIN(McTouchProbe, "BOOL", in, WindowOnly, "TRUE: edges outside the window do not count"),
    PIN(McTouchProbe, "LREAL", in, FirstPosition, "where the window begins [0.1 um or 0.0001 deg]"),
    PIN(McTouchProbe, "LREAL", in, LastPosition,
        "where it ends; of a modulo axis it may lie before FirstPosition, over the end of the turn"),
    DONE(McTouchProbe, "recorded"),
    BUSY(McTouchProbe),
    ABORTED(McTouchProbe),
    ERRORS(McTouchProbe),
    PIN(McTouchProbe, "LREAL", out, RecordedPosition, "where the axis was at the edge itself")};
constexpr std::tuple abort_trigger{
    AXIS(McAbortTrigger),    PIN(McAbortTrigger, "UINT", in, TriggerInput, "0, the axis' own probe"),
    EXECUTE(McAbortTrigger), DONE(McAbortTrigger, "no block waits any more"),
    BUSY(McAbortTrigger),    ERRORS(McAbortTrigger)};

#undef READING
#undef STATE
#undef PIN
#undef EXECUTE
#undef DONE
#undef BUSY
#undef ACTIVE
#undef BUFFER
#undef ABORTED
#undef ERRORS
#undef AXIS
#undef SLOPES
#undef MASTER_SLAVE

template <typename... Bounds>
constexpr std::array<Pin, sizeof...(Bounds)> pins_of(const std::tuple<Bounds...>& bounds) {
  return std::apply([](const auto&... bound) { return std::array{bound.pin...}; }, bounds);
}

template <typename B, typename... Bounds>
PinValue value_of(B& block, const std::tuple<Bounds...>& bounds, std::size_t number) {
  return std::apply(
      [&](const auto&... bound) {
        const std::array<PinValue, sizeof...(Bounds)> values{&(block.*bound.member)...};
        return values.at(number);
      },
      bounds);
}

template <const auto& bounds>
constexpr auto pins = pins_of(bounds);

template <typename B>
std::unique_ptr<FunctionBlock> make() {
  return std::make_unique<B>();
}

const std::array types{
    BlockType{"MC_Power", "switches an axis on", pins<power>, &make<McPower>},
    BlockType{"MC_Home", "gives the present position its value", pins<home>, &make<McHome>},
    BlockType{"MC_Reset", "leads out of Errorstop", pins<reset>, &make<McReset>},
    BlockType{"MC_Stop", "stops and keeps the axis from moving", pins<stop>, &make<McStop>},
    BlockType{"MC_Halt", "stops", pins<halt>, &make<McHalt>},
    BlockType{"MC_MoveAbsolute", "moves to a position", pins<move_absolute>, &make<McMoveAbsolute>},
    BlockType{"MC_MoveRelative", "moves by a distance", pins<move_relative>, &make<McMoveRelative>},
    BlockType{"MC_MoveAdditive", "moves by a distance beyond the last target", pins<move_additive>,
              &make<McMoveAdditive>},
    BlockType{"MC_MoveSuperImposed", "moves by a distance on top of what is under way",
              pins<move_superimposed>, &make<McMoveSuperImposed>},
    BlockType{"MC_MoveVelocity", "moves at a speed", pins<move_velocity>, &make<McMoveVelocity>},
    BlockType{"MC_CamTableSelect", "finds a cam table", pins<cam_table_select>, &make<McCamTableSelect>},
    BlockType{"MC_CamIn", "couples by a cam", pins<cam_in>, &make<McCamIn>},
    BlockType{"MC_CamOut", "uncouples from a cam", pins<cam_out>, &make<McCamOut>},
    BlockType{"MC_GearIn", "couples by a ratio of speeds", pins<gear_in>, &make<McGearIn>},
    BlockType{"MC_GearOut", "uncouples from a gear", pins<gear_out>, &make<McGearOut>},
    BlockType{"MC_Phasing", "shifts the master as the slave sees it", pins<phasing>, &make<McPhasing>},
    BlockType{"MC_SetPosition", "gives the actual position another value, without homing", pins<set_position>,
              &make<McSetPosition>},
    BlockType{"MC_SetOverride", "makes movements slower", pins<set_override>, &make<McSetOverride>},
    BlockType{"MC_ReadActualPosition", "reads the encoder's position", pins<read_position>,
              &make<McReadActualPosition>},
    BlockType{"MC_ReadActualVelocity", "reads the encoder's speed", pins<read_velocity>,
              &make<McReadActualVelocity>},
    BlockType{"MC_ReadStatus", "reads the state", pins<read_status>, &make<McReadStatus>},
    BlockType{"MC_ReadAxisError", "reads the error of an axis", pins<read_error>, &make<McReadAxisError>},
    BlockType{"MC_ReadAxisInfo", "reads what the axis is ready for", pins<read_info>, &make<McReadAxisInfo>},
    BlockType{"MC_ReadMotionState", "reads how the axis moves", pins<read_motion>, &make<McReadMotionState>},
    BlockType{"MC_ReadParameter", "reads a parameter by PLCopen's number", pins<read_parameter>,
              &make<McReadParameter>},
    BlockType{"MC_WriteParameter", "writes a parameter by PLCopen's number", pins<write_parameter>,
              &make<McWriteParameter>},
    BlockType{"MC_TouchProbe", "records the position at an edge of the probe", pins<touch_probe>,
              &make<McTouchProbe>},
    BlockType{"MC_AbortTrigger", "ends a waiting MC_TouchProbe", pins<abort_trigger>, &make<McAbortTrigger>},
    BlockType{"CAM_TABLE_WRITE", "writes into a cam table while the controller runs (not of ISG)",
              pins<cam_table_write>, &make<CamTableWrite>},
};

}  // namespace

PinValue McPower::pin(std::size_t number) { return value_of(*this, power, number); }
PinValue McHome::pin(std::size_t number) { return value_of(*this, home, number); }
PinValue McReset::pin(std::size_t number) { return value_of(*this, reset, number); }
PinValue McStop::pin(std::size_t number) { return value_of(*this, stop, number); }
PinValue McHalt::pin(std::size_t number) { return value_of(*this, halt, number); }
PinValue McMoveAbsolute::pin(std::size_t number) { return value_of(*this, move_absolute, number); }
template <>
PinValue McMoveRelative::pin(std::size_t number) {
  return value_of(*this, move_relative, number);
}
template <>
PinValue McMoveAdditive::pin(std::size_t number) {
  return value_of(*this, move_additive, number);
}
PinValue McMoveSuperImposed::pin(std::size_t number) { return value_of(*this, move_superimposed, number); }
PinValue McReadAxisInfo::pin(std::size_t number) { return value_of(*this, read_info, number); }
PinValue McReadMotionState::pin(std::size_t number) { return value_of(*this, read_motion, number); }
PinValue McReadParameter::pin(std::size_t number) { return value_of(*this, read_parameter, number); }
PinValue McWriteParameter::pin(std::size_t number) { return value_of(*this, write_parameter, number); }
PinValue McMoveVelocity::pin(std::size_t number) { return value_of(*this, move_velocity, number); }
PinValue McCamTableSelect::pin(std::size_t number) { return value_of(*this, cam_table_select, number); }
PinValue McCamIn::pin(std::size_t number) { return value_of(*this, cam_in, number); }
PinValue McCamOut::pin(std::size_t number) { return value_of(*this, cam_out, number); }
PinValue McGearIn::pin(std::size_t number) { return value_of(*this, gear_in, number); }
PinValue McGearOut::pin(std::size_t number) { return value_of(*this, gear_out, number); }
PinValue McPhasing::pin(std::size_t number) { return value_of(*this, phasing, number); }
PinValue McSetPosition::pin(std::size_t number) { return value_of(*this, set_position, number); }
PinValue McSetOverride::pin(std::size_t number) { return value_of(*this, set_override, number); }
PinValue McReadActualPosition::pin(std::size_t number) { return value_of(*this, read_position, number); }
PinValue McReadActualVelocity::pin(std::size_t number) { return value_of(*this, read_velocity, number); }
PinValue McReadStatus::pin(std::size_t number) { return value_of(*this, read_status, number); }
PinValue McReadAxisError::pin(std::size_t number) { return value_of(*this, read_error, number); }
PinValue McTouchProbe::pin(std::size_t number) { return value_of(*this, touch_probe, number); }
PinValue McAbortTrigger::pin(std::size_t number) { return value_of(*this, abort_trigger, number); }
PinValue CamTableWrite::pin(std::size_t number) { return value_of(*this, cam_table_write, number); }

std::span<const BlockType> block_types() { return types; }

const BlockType* find_block_type(std::string_view name) {
  for (const BlockType& type : types)
    if (same_word(type.name, name)) return &type;
  return nullptr;
}

int find_pin(const BlockType& type, std::string_view name) {
  for (std::size_t i = 0; i < type.pins.size(); ++i)
    if (same_word(type.pins[i].name, name)) return static_cast<int>(i);
  return -1;
}

}  // namespace drycut::devices::plcopen
