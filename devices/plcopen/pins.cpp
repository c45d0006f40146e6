#include "devices/plcopen/pins.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <tuple>
#include <type_traits>

#include "base/text.hpp"
#include "devices/plcopen/function_blocks.hpp"

namespace drycut::devices::plcopen {
namespace {

/// A pin of block B beside the member that holds it.
template <typename B, typename T>
struct BoundPin {
  Pin pin;
  T B::*member;
};

/// Names of the types in the order of PinValue; a DWORD, which has the bits of an UDINT, says so itself.
constexpr std::array<std::string_view, std::variant_size_v<PinValue>> type_names{
    "BOOL", "INT", "UINT", "DINT", "UDINT", "LREAL", "AXIS_REF", "MC_CAM_REF"};

template <typename B, typename C, typename T>
constexpr BoundPin<B, T> bind(
    std::string_view name, PinDirection direction, T C::*member, std::string_view meaning,
    std::string_view type = type_names[PinValue{static_cast<T*>(nullptr)}.index()]) {
  return {{name, type, direction, meaning}, static_cast<T B::*>(member)};
}

template <typename T>
constexpr std::size_t cells_of = std::is_same_v<T, CamRef> ? cam_file_cells + 1 : 1;

template <typename T>
void take(T& pin, const PinCell* cells) {
  if constexpr (std::is_same_v<T, AxisRef>) {
    pin.number = static_cast<int>(*cells);
  } else if constexpr (std::is_same_v<T, CamRef>) {
    const auto* const text = reinterpret_cast<const char*>(cells);
    const std::string_view file(text, strnlen(text, cam_file_length));
    if (pin.file != file) pin.file = file;
    pin.id = static_cast<std::uint16_t>(cells[cam_file_cells]);
  } else if constexpr (std::is_same_v<T, double>) {
    pin = std::bit_cast<double>(*cells);
  } else {
    pin = static_cast<T>(*cells);
  }
}

template <typename T>
void give(const T& pin, PinCell& cell) {
  if constexpr (std::is_same_v<T, double>)
    cell = std::bit_cast<PinCell>(pin);
  else if constexpr (std::is_integral_v<T>)
    cell = static_cast<PinCell>(pin);
}

template <typename B, const auto& bounds>
BlockType block_type(std::string_view name, std::string_view meaning) {
  static constexpr auto pins =
      std::apply([](const auto&... bound) { return std::array{bound.pin...}; }, bounds);
  const auto make = []() -> std::unique_ptr<FunctionBlock> { return std::make_unique<B>(); };
  const auto value = [](FunctionBlock& block, std::size_t number) {
    const auto values = [&](const auto&... bound) {
      return std::array<PinValue, pins.size()>{&(static_cast<B&>(block).*bound.member)...};
    };
    return std::apply(values, bounds).at(number);
  };
  const auto take_inputs = [](FunctionBlock& block, const PinCell* cells) {
    const auto one = [&](const auto& bound) {
      auto& pin = static_cast<B&>(block).*bound.member;
      if (bound.pin.direction != PinDirection::output) take(pin, cells);
      cells += cells_of<std::remove_cvref_t<decltype(pin)>>;
    };
    std::apply([&](const auto&... bound) { (one(bound), ...); }, bounds);
  };
  const auto give_outputs = [](const FunctionBlock& block, PinCell* cells) {
    const auto one = [&](const auto& bound) {
      const auto& pin = static_cast<const B&>(block).*bound.member;
      if (bound.pin.direction == PinDirection::output) give(pin, *cells);
      cells += cells_of<std::remove_cvref_t<decltype(pin)>>;
    };
    std::apply([&](const auto&... bound) { (one(bound), ...); }, bounds);
  };
  return {name, meaning, pins, make, value, take_inputs, give_outputs};
}

}  // namespace

// A block, its name and meaning, its pins in the order of declaration.
#define BLOCK(block, name, meaning, ...)           \
  [] {                                             \
    using B = block;                               \
    static constexpr std::tuple pins{__VA_ARGS__}; \
    return block_type<B, pins>(name, meaning);     \
  }()
#define PIN(direction, name, ...) bind<B>(#name, PinDirection::direction, &B::name, __VA_ARGS__)
#define IN(name, ...) PIN(input, name, __VA_ARGS__)
#define OUT(name, meaning) PIN(output, name, meaning)
#define AXIS PIN(in_out, Axis, "the axis")
#define SLAVE PIN(in_out, Slave, "the axis that follows")
#define MASTER_SLAVE PIN(in_out, Master, "the axis that is followed"), SLAVE
#define EXECUTE IN(Execute, "the rising edge gives the command")
#define VELOCITY IN(Velocity, "um/s or 0.001 deg/s, 1 or more")
#define BRAKING                                           \
  IN(Deceleration, "mm/s2 or deg/s2; 0 = half of a_max"), \
      IN(Jerk, "mm/s3 or deg/s3; 0 = half of a_max in tr_min")
#define SLOPES IN(Acceleration, "mm/s2 or deg/s2; 0 = half of a_max"), BRAKING
#define BUFFER   \
  IN(BufferMode, \
     "0 mcAborting, 1 mcBuffered, 2 Low, 3 Previous, 4 Next, 5 mcBlendingHigh: when its turn comes")
#define DONE(meaning) OUT(Done, meaning)
#define AT_TARGET DONE("at the target, the actual position within the window")
#define BUSY OUT(Busy, "the block is not finished")
#define ACTIVE BUSY, OUT(Active, "it has control of the axis")
#define ABORTED OUT(CommandAborted, "another command has taken over")
#define ERROR_ID OUT(ErrorID, "which; see the table of errors")
#define ERRORS OUT(Error, "refused, or ended by an error of the axis"), ERROR_ID
#define READING                                                               \
  AXIS, IN(Enable, "TRUE reads"), OUT(Valid, "the outputs are of this call"), \
      OUT(Busy, "it reads in every call"), OUT(Error, "there is nothing such to read"), ERROR_ID

std::span<const BlockType> block_types() {
  static const std::array types{
      BLOCK(McPower, "MC_Power", "switches an axis on", AXIS, IN(Enable, "TRUE switches the drive on"),
            OUT(Status, "the drive is on"), ERRORS),
      BLOCK(McHome, "MC_Home", "gives the present position its value", AXIS, EXECUTE,
            IN(Position, "the present position's new value [0.1 um or 0.0001 deg]"), DONE("homed"), ACTIVE,
            ABORTED, ERRORS),
      BLOCK(McReset, "MC_Reset", "leads out of Errorstop", AXIS, EXECUTE, DONE("out of Errorstop"), BUSY,
            ERRORS),
      BLOCK(McStop, "MC_Stop", "stops and keeps the axis from moving", AXIS,
            IN(Execute, "the rising edge stops; the axis stays in Stopping while it is TRUE"), BRAKING,
            DONE("the axis stands"), ACTIVE, ABORTED, ERRORS),
      BLOCK(McHalt, "MC_Halt", "stops", AXIS, EXECUTE, BRAKING, DONE("the axis stands"), ACTIVE, ABORTED,
            ERRORS),
      BLOCK(McMoveAbsolute, "MC_MoveAbsolute", "moves to a position", AXIS, EXECUTE,
            IN(Position, "target [0.1 um or 0.0001 deg]"), VELOCITY, SLOPES,
            IN(Direction, "of a modulo axis: 1 positive, 2 shortest way, 3 negative, 4 current"), BUFFER,
            AT_TARGET, ACTIVE, ABORTED, ERRORS),
      BLOCK(McMoveRelative, "MC_MoveRelative", "moves by a distance", AXIS, EXECUTE,
            IN(Distance, "from the commanded position [0.1 um or 0.0001 deg]"), VELOCITY, SLOPES, BUFFER,
            AT_TARGET, ACTIVE, ABORTED, ERRORS),
      BLOCK(
          McMoveAdditive, "MC_MoveAdditive", "moves by a distance beyond the last target", AXIS, EXECUTE,
          IN(Distance,
             "from the target of the movement under way, else from the commanded position [0.1 um or 0.0001 "
             "deg]"),
          VELOCITY, SLOPES, BUFFER, AT_TARGET, ACTIVE, ABORTED, ERRORS),
      BLOCK(McMoveSuperImposed, "MC_MoveSuperImposed", "moves by a distance on top of what is under way",
            AXIS, EXECUTE,
            IN(Distance,
               "on top of what is under way; in Standstill as MC_MoveRelative [0.1 um or 0.0001 deg]"),
            IN(VelocityDiff, "largest difference to the speed under way, um/s or 0.001 deg/s, 1 or more"),
            SLOPES, DONE("the distance has been added"), BUSY, ABORTED, ERRORS),
      BLOCK(McMoveVelocity, "MC_MoveVelocity", "moves at a speed", AXIS, EXECUTE, VELOCITY, SLOPES,
            IN(Direction, "1 positive, 3 negative, 4 current"), BUFFER,
            OUT(InVelocity, "the speed is reached"), ACTIVE, ABORTED, ERRORS),
      BLOCK(McCamTableSelect, "MC_CamTableSelect", "finds a cam table", MASTER_SLAVE, EXECUTE,
            IN(CamTable, "the table by its file's name, which wins, or its id"), DONE("the table is there"),
            BUSY, ERRORS, OUT(CamTableID, "for MC_CamIn")),
      BLOCK(McCamIn, "MC_CamIn", "couples by a cam", MASTER_SLAVE, EXECUTE,
            IN(MasterOffset, "added to the scaled master, +-2^31"),
            IN(SlaveOffset, "added to the scaled cam, +-2^31"),
            IN(MasterScaling, "the master is multiplied by it: a whole number, not 0"),
            IN(SlaveScaling, "the cam is multiplied by it"), IN(StartMode, "HLI_CI_ bits", "DWORD"),
            IN(CamTableID, "the table"),
            IN(TableFctType, "0 STEP_DIRECT .. 5 POLY5_LINE, 6 as the table says"), BUFFER,
            OUT(InSync, "engaged; FALSE while the cam asks for more than the slave's speed"), ACTIVE, ABORTED,
            ERRORS, OUT(EndOfProfile, "for one call: the cam has come to its end")),
      BLOCK(McCamOut, "MC_CamOut", "uncouples from a cam", SLAVE, EXECUTE,
            DONE("uncoupled, the slave keeps its speed"), BUSY, ERRORS),
      BLOCK(McGearIn, "MC_GearIn", "couples by a ratio of speeds", MASTER_SLAVE, EXECUTE,
            IN(RatioNumerator, "slave, not 0; negative turns the other way"),
            IN(RatioDenominator, "master, above 0"), SLOPES,
            IN(Mode, "0 setpoints of the master, 16#80 its actual values", "DWORD"), BUFFER,
            OUT(InGear, "engaged; FALSE while the slave's limits hold it back"), ACTIVE, ABORTED, ERRORS),
      BLOCK(McGearOut, "MC_GearOut", "uncouples from a gear", SLAVE, EXECUTE,
            DONE("uncoupled, the slave keeps its speed"), BUSY, ERRORS),
      BLOCK(McPhasing, "MC_Phasing", "shifts the master as the slave sees it", MASTER_SLAVE, EXECUTE,
            IN(PhaseShift, "by how much more the master seems to have moved [0.1 um or 0.0001 deg]"),
            VELOCITY, SLOPES, DONE("shifted"), ACTIVE, ABORTED, ERRORS),
      BLOCK(McSetPosition, "MC_SetPosition", "gives the actual position another value, without homing", AXIS,
            EXECUTE, IN(Position, "the actual position's new value [0.1 um or 0.0001 deg]"),
            IN(Relative, "TRUE: Position is added to the present one"),
            DONE("the position has its new value"), BUSY, ERRORS),
      BLOCK(McSetOverride, "MC_SetOverride", "makes movements slower", AXIS,
            IN(Enable, "TRUE takes the factor; it stays when FALSE"),
            IN(VelFactor, "share of the speed of movements, 0..1"), OUT(Enabled, "the factor is in force"),
            OUT(Busy, "the factor is taken in every call"), OUT(Error, "refused"), ERROR_ID),
      BLOCK(McReadActualPosition, "MC_ReadActualPosition", "reads the encoder's position", READING,
            OUT(Position, "of the encoder [0.1 um or 0.0001 deg]")),
      BLOCK(McReadActualVelocity, "MC_ReadActualVelocity", "reads the encoder's speed", READING,
            OUT(Velocity, "of the encoder, with sign [um/s or 0.001 deg/s]")),
      BLOCK(McReadStatus, "MC_ReadStatus", "reads the state", READING,
            OUT(Errorstop, "stopped by an error, until MC_Reset"), OUT(Disabled, "without power"),
            OUT(Stopping, "MC_Stop is in force"), OUT(Homing, "MC_Home is at work"), OUT(Standstill, "ready"),
            OUT(DiscreteMotion, "on the way to an end"), OUT(ContinuousMotion, "moves without end"),
            OUT(SynchronizedMotion, "coupled, even while it stands")),
      BLOCK(McReadAxisError, "MC_ReadAxisError", "reads the error of an axis", READING,
            OUT(AxisErrorID, "of the axis, 0 = none; see the table of errors")),
      BLOCK(McReadAxisInfo, "MC_ReadAxisInfo", "reads what the axis is ready for", READING,
            OUT(Simulation, "a virtual axis"), OUT(CommunicationReady, "the axis can be spoken to"),
            OUT(ReadyForPowerOn, "its drive is ready"), OUT(PowerOn, "MC_Power has switched it on"),
            OUT(IsHomed, "its zero is known"),
            OUT(AxisWarning, "the command in force asks for more speed than the axis has")),
      BLOCK(McReadMotionState, "MC_ReadMotionState", "reads how the axis moves", READING,
            OUT(ConstantVelocity, "the commanded speed does not change; it may be 0"),
            OUT(Accelerating, "it grows, whatever the direction"), OUT(Decelerating, "it falls"),
            OUT(DirectionPositive, "the commanded position grows"), OUT(DirectionNegative, "it falls"),
            OUT(RevZero, "the actual speed is 0"),
            OUT(InWindow, "the actual position is within the window of the target"),
            OUT(InPosition, "likewise, and the commanded speed is 0"),
            OUT(IsMoving, "the commanded speed is not 0"),
            OUT(LrCommandedPos, "the target [0.1 um or 0.0001 deg]"),
            OUT(LrActualPos, "of the encoder [0.1 um or 0.0001 deg]"),
            OUT(LrSetPos, "the commanded position [0.1 um or 0.0001 deg]"),
            OUT(LrActualRev, "of the encoder [um/s or 0.001 deg/s]"),
            OUT(LrSetRev, "the commanded speed [um/s or 0.001 deg/s]"),
            OUT(LrSetAccel, "the commanded acceleration [mm/s2 or deg/s2]")),
      BLOCK(McReadParameter, "MC_ReadParameter", "reads a parameter by PLCopen's number", READING,
            IN(ParameterNumber, "PLCopen's number; see the table of parameters"),
            OUT(Value, "in the kernel's unit")),
      BLOCK(McWriteParameter, "MC_WriteParameter", "writes a parameter by PLCopen's number", AXIS, EXECUTE,
            IN(ParameterNumber, "PLCopen's number; see the table of parameters"),
            IN(Value, "in the kernel's unit"), DONE("in force, and kept over power cycles"), BUSY, ERRORS),
      BLOCK(McTouchProbe, "MC_TouchProbe", "records the position at an edge of the probe", AXIS,
            IN(TriggerInput, "0, the axis' own probe"), EXECUTE,
            IN(WindowOnly, "TRUE: edges outside the window do not count"),
            IN(FirstPosition, "where the window begins [0.1 um or 0.0001 deg]"),
            IN(LastPosition,
               "where it ends; of a modulo axis it may lie before FirstPosition, over the end of the turn"),
            DONE("recorded"), BUSY, ABORTED, ERRORS,
            OUT(RecordedPosition, "where the axis was at the edge itself")),
      BLOCK(McAbortTrigger, "MC_AbortTrigger", "ends a waiting MC_TouchProbe", AXIS,
            IN(TriggerInput, "0, the axis' own probe"), EXECUTE, DONE("no block waits any more"), BUSY,
            ERRORS),
      BLOCK(CamTableWrite, "CAM_TABLE_WRITE",
            "writes into a cam table while the controller runs (not of ISG)", IN(CamTableID, "the table"),
            EXECUTE, IN(Change, "TRUE: a longer change, until its end MC_CamIn refuses the table"),
            IN(Line, "of the element, from 1"), IN(Column, "of the element, from 1"),
            IN(Value, "the element's new value"), DONE("written"), BUSY,
            OUT(Changing, "the change has begun"), OUT(Error, "not written, or the change has not begun"),
            ERROR_ID),
  };
  return types;
}

#undef BLOCK
#undef PIN
#undef IN
#undef OUT
#undef AXIS
#undef SLAVE
#undef MASTER_SLAVE
#undef EXECUTE
#undef VELOCITY
#undef BRAKING
#undef SLOPES
#undef BUFFER
#undef DONE
#undef AT_TARGET
#undef BUSY
#undef ACTIVE
#undef ABORTED
#undef ERROR_ID
#undef ERRORS
#undef READING

const BlockType* find_block_type(std::string_view name) {
  for (const BlockType& type : block_types())
    if (same_word(type.name, name)) return &type;
  return nullptr;
}

int find_pin(const BlockType& type, std::string_view name) {
  for (std::size_t i = 0; i < type.pins.size(); ++i)
    if (same_word(type.pins[i].name, name)) return static_cast<int>(i);
  return -1;
}

}  // namespace drycut::devices::plcopen
