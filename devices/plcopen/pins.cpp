#include "devices/plcopen/pins.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <tuple>

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
#define DONE(block, meaning) PIN(block, "BOOL", out, Done, meaning)
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
    ABORTED(McHome),
    ERRORS(McHome)};
constexpr std::tuple reset{AXIS(McReset), EXECUTE(McReset), DONE(McReset, "out of Errorstop"),
                           ERRORS(McReset)};
constexpr std::tuple stop{
    AXIS(McStop),
    PIN(McStop, "BOOL", in, Execute, "the rising edge stops; the axis stays in Stopping while it is TRUE"),
    PIN(McStop, "LREAL", in, Deceleration, "mm/s2 or deg/s2; 0 = half of a_max"),
    PIN(McStop, "LREAL", in, Jerk, "mm/s3 or deg/s3; 0 = half of a_max in tr_min"),
    DONE(McStop, "the axis stands"),
    ERRORS(McStop)};
constexpr std::tuple halt{AXIS(McHalt),
                          EXECUTE(McHalt),
                          PIN(McHalt, "LREAL", in, Deceleration, "mm/s2 or deg/s2; 0 = half of a_max"),
                          PIN(McHalt, "LREAL", in, Jerk, "mm/s3 or deg/s3; 0 = half of a_max in tr_min"),
                          DONE(McHalt, "the axis stands"),
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
    DONE(McMoveAbsolute, "at the target, the actual position within the window"),
    ABORTED(McMoveAbsolute),
    ERRORS(McMoveAbsolute)};
constexpr std::tuple move_velocity{
    AXIS(McMoveVelocity),
    EXECUTE(McMoveVelocity),
    PIN(McMoveVelocity, "LREAL", in, Velocity, "um/s or 0.001 deg/s, 1 or more"),
    SLOPES(McMoveVelocity),
    PIN(McMoveVelocity, "INT", in, Direction, "1 positive, 3 negative, 4 current"),
    PIN(McMoveVelocity, "BOOL", out, InVelocity, "the speed is reached"),
    ABORTED(McMoveVelocity),
    ERRORS(McMoveVelocity)};
constexpr std::tuple cam_table_select{
    MASTER_SLAVE(McCamTableSelect),
    EXECUTE(McCamTableSelect),
    PIN(McCamTableSelect, "MC_CAM_REF", in, CamTable, "the table by its file's name, which wins, or its id"),
    DONE(McCamTableSelect, "the table is there"),
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
    PIN(McCamIn, "BOOL", out, InSync, "engaged"),
    ABORTED(McCamIn),
    ERRORS(McCamIn),
    PIN(McCamIn, "BOOL", out, EndOfProfile, "for one call: the cam has come to its end")};
constexpr std::tuple cam_out{PIN(McCamOut, "AXIS_REF", io, Slave, "the axis that follows"), EXECUTE(McCamOut),
                             DONE(McCamOut, "uncoupled, the slave keeps its speed"), ERRORS(McCamOut)};
constexpr std::tuple gear_in{
    MASTER_SLAVE(McGearIn),
    EXECUTE(McGearIn),
    PIN(McGearIn, "DINT", in, RatioNumerator, "slave, not 0; negative turns the other way"),
    PIN(McGearIn, "UDINT", in, RatioDenominator, "master, above 0"),
    SLOPES(McGearIn),
    PIN(McGearIn, "DWORD", in, Mode, "0 setpoints of the master, 16#80 its actual values"),
    PIN(McGearIn, "BOOL", out, InGear, "engaged"),
    ABORTED(McGearIn),
    ERRORS(McGearIn)};
constexpr std::tuple gear_out{PIN(McGearOut, "AXIS_REF", io, Slave, "the axis that follows"),
                              EXECUTE(McGearOut), DONE(McGearOut, "uncoupled, the slave keeps its speed"),
                              ERRORS(McGearOut)};
constexpr std::tuple phasing{MASTER_SLAVE(McPhasing),
                             EXECUTE(McPhasing),
                             PIN(McPhasing, "LREAL", in, PhaseShift,
                                 "by how much more the master seems to have moved [0.1 um or 0.0001 deg]"),
                             PIN(McPhasing, "LREAL", in, Velocity, "um/s or 0.001 deg/s, 1 or more"),
                             SLOPES(McPhasing),
                             DONE(McPhasing, "shifted"),
                             ABORTED(McPhasing),
                             ERRORS(McPhasing)};

#undef PIN
#undef EXECUTE
#undef DONE
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
    BlockType{"MC_MoveVelocity", "moves at a speed", pins<move_velocity>, &make<McMoveVelocity>},
    BlockType{"MC_CamTableSelect", "finds a cam table", pins<cam_table_select>, &make<McCamTableSelect>},
    BlockType{"MC_CamIn", "couples by a cam", pins<cam_in>, &make<McCamIn>},
    BlockType{"MC_CamOut", "uncouples from a cam", pins<cam_out>, &make<McCamOut>},
    BlockType{"MC_GearIn", "couples by a ratio of speeds", pins<gear_in>, &make<McGearIn>},
    BlockType{"MC_GearOut", "uncouples from a gear", pins<gear_out>, &make<McGearOut>},
    BlockType{"MC_Phasing", "shifts the master as the slave sees it", pins<phasing>, &make<McPhasing>},
};

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::toupper(x) == std::toupper(y); });
}

}  // namespace

PinValue McPower::pin(std::size_t number) { return value_of(*this, power, number); }
PinValue McHome::pin(std::size_t number) { return value_of(*this, home, number); }
PinValue McReset::pin(std::size_t number) { return value_of(*this, reset, number); }
PinValue McStop::pin(std::size_t number) { return value_of(*this, stop, number); }
PinValue McHalt::pin(std::size_t number) { return value_of(*this, halt, number); }
PinValue McMoveAbsolute::pin(std::size_t number) { return value_of(*this, move_absolute, number); }
PinValue McMoveVelocity::pin(std::size_t number) { return value_of(*this, move_velocity, number); }
PinValue McCamTableSelect::pin(std::size_t number) { return value_of(*this, cam_table_select, number); }
PinValue McCamIn::pin(std::size_t number) { return value_of(*this, cam_in, number); }
PinValue McCamOut::pin(std::size_t number) { return value_of(*this, cam_out, number); }
PinValue McGearIn::pin(std::size_t number) { return value_of(*this, gear_in, number); }
PinValue McGearOut::pin(std::size_t number) { return value_of(*this, gear_out, number); }
PinValue McPhasing::pin(std::size_t number) { return value_of(*this, phasing, number); }

std::span<const BlockType> block_types() { return types; }

const BlockType* find_block_type(std::string_view name) {
  for (const BlockType& type : types)
    if (same_name(type.name, name)) return &type;
  return nullptr;
}

int find_pin(const BlockType& type, std::string_view name) {
  for (std::size_t i = 0; i < type.pins.size(); ++i)
    if (same_name(type.pins[i].name, name)) return static_cast<int>(i);
  return -1;
}

}  // namespace drycut::devices::plcopen
