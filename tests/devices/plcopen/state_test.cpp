#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

using enum AxisState;

/// A slave brought into each state, and the blocks that act on it, made and bound by name as a program does.
struct Walk : Bench {
  McStop stopper;
  McMoveAbsolute mover;
  McMoveVelocity turner;
  McHome homer;

  explicit Walk(AxisState state) {
    table({0, 100'000});
    stopper.Axis = mover.Axis = turner.Axis = homer.Axis = slave;
    mover.Velocity = turner.Velocity = 1'000;
    mover.Position = 1'500'000;
    switch (state) {
      case disabled:
        power_slave.Enable = false;
        power_slave.call(kernel);
        break;
      case standstill:
        break;
      case homing:
        execute(homer);
        break;
      case stopping:
        execute(turner);
        kernel.cycle();
        execute(stopper);
        break;
      case discrete_motion:
        execute(mover);
        kernel.cycle();
        break;
      case continuous_motion:
        execute(turner);
        kernel.cycle();
        break;
      case synchronized_motion:
        cam.StartMode = hli_ci_f_periodic;
        execute(cam);
        while (!s().coupling()->engaged()) kernel.cycle();
        break;
      case errorstop:
        s().fault(ErrorId::drive_error);
        break;
    }
    EXPECT_EQ(s().state(), state);
  }

  template <typename Block>
  void execute(Block& block) {
    block.Execute = true;
    block.call(kernel);
  }

  /// The block of this name, its pins set as an order for the slave needs them.
  std::unique_ptr<FunctionBlock> named(const std::string& name) {
    const BlockType& type = *find_block_type(name);
    std::unique_ptr<FunctionBlock> block = type.make();
    const auto set = [&](const char* pin, auto value) {
      if (auto* target = pin_of<decltype(value)>(type, *block, pin)) *target = value;
    };
    set("Axis", slave);
    set("Slave", slave);
    set("Master", master);
    set("Execute", true);
    set("Velocity", 1'000.0);
    set("VelocityDiff", 1'000.0);
    set("ParameterNumber", std::int16_t{9});
    set("Value", 900'000.0);
    set("Position", 700'000.0);
    set("Distance", 700'000.0);
    set("PhaseShift", 10'000.0);
    set("CamTableID", std::uint16_t{1});
    set("StartMode", std::uint32_t{hli_ci_f_periodic});
    return block;
  }
  template <typename T>
  T value(const std::string& name, FunctionBlock& block, const char* pin) {
    return *pin_of<T>(*find_block_type(name), block, pin);
  }
};

struct Row {
  std::vector<std::string> blocks;
  /// By state, in the order of axis_states: the state that follows, or the error's number.
  std::array<std::variant<AxisState, ErrorId>, 8> to;
};

constexpr auto e_disabled = ErrorId::in_disabled;
constexpr auto e_standstill = ErrorId::in_standstill;
constexpr auto e_homing = ErrorId::in_homing;
constexpr auto e_stopping = ErrorId::in_stopping;
constexpr auto e_discrete = ErrorId::in_discrete_motion;
constexpr auto e_continuous = ErrorId::in_continuous_motion;
constexpr auto e_synchronized = ErrorId::in_synchronized_motion;
constexpr auto e_errorstop = ErrorId::in_errorstop;

// The state diagram once more, as the specification has it (spec ecam.md B7 and PLCopen's diagram).
const std::vector<Row> walk{
    {{"MC_Home"},
     {e_disabled, homing, ErrorId::home_again, e_stopping, e_discrete, e_continuous, e_synchronized,
      e_errorstop}},
    {{"MC_MoveAbsolute", "MC_MoveRelative", "MC_MoveAdditive"},
     {e_disabled, discrete_motion, e_homing, discrete_motion, discrete_motion, discrete_motion,
      discrete_motion, e_errorstop}},
    {{"MC_MoveSuperImposed"},
     {e_disabled, discrete_motion, e_homing, e_stopping, discrete_motion, continuous_motion,
      synchronized_motion, e_errorstop}},
    {{"MC_WriteParameter", "MC_SetPosition"},
     {disabled, standstill, e_homing, e_stopping, e_discrete, e_continuous, e_synchronized, e_errorstop}},
    {{"MC_MoveVelocity"},
     {e_disabled, continuous_motion, e_homing, continuous_motion, continuous_motion, continuous_motion,
      continuous_motion, e_errorstop}},
    {{"MC_Halt"},
     {e_disabled, discrete_motion, e_homing, e_stopping, discrete_motion, discrete_motion, discrete_motion,
      e_errorstop}},
    {{"MC_Stop"},
     {e_disabled, stopping, stopping, ErrorId::stop_again, stopping, stopping, stopping, e_errorstop}},
    {{"MC_CamIn", "MC_GearIn"},
     {e_disabled, synchronized_motion, e_homing, e_stopping, synchronized_motion, synchronized_motion,
      synchronized_motion, e_errorstop}},
    {{"MC_CamOut"},
     {e_disabled, e_standstill, e_homing, e_stopping, e_discrete, e_continuous, continuous_motion,
      e_errorstop}},
    {{"MC_GearOut"},
     {e_disabled, e_standstill, e_homing, e_stopping, e_discrete, e_continuous, e_synchronized, e_errorstop}},
    {{"MC_Phasing"},
     {e_disabled, e_standstill, e_homing, e_stopping, e_discrete, e_continuous, synchronized_motion,
      e_errorstop}},
    {{"MC_Reset"},
     {e_disabled, e_standstill, e_homing, e_stopping, e_discrete, e_continuous, e_synchronized, errorstop}}};

TEST(PlcopenStates, EveryBlockInEveryStateDoesWhatTheDiagramSays) {
  const auto shows = [](const std::string& name, const Row& row) {
    const BlockType& type = *find_block_type(name);
    for (std::size_t i = 0; i < axis_states.size(); ++i) {
      SCOPED_TRACE(name + " in " + std::string(name_of(axis_states[i])));
      Walk b(axis_states[i]);
      const std::uint64_t ticket = b.s().ticket();
      const std::unique_ptr<FunctionBlock> block = b.named(name);
      block->call(b.kernel);
      const ErrorId* error = std::get_if<ErrorId>(&row.to[i]);
      EXPECT_EQ(b.value<bool>(name, *block, "Error"), error != nullptr);
      EXPECT_EQ(b.value<std::uint32_t>(name, *block, "ErrorID"), error != nullptr ? id(*error) : 0);
      EXPECT_EQ(b.s().state(), error != nullptr ? axis_states[i] : std::get<AxisState>(row.to[i]));
      if (error != nullptr) {
        EXPECT_EQ(b.s().ticket(), ticket);
      }
      // Error goes with Execute.
      *pin_of<bool>(type, *block, "Execute") = false;
      block->call(b.kernel);
      EXPECT_FALSE(b.value<bool>(name, *block, "Error"));
      EXPECT_EQ(b.value<std::uint32_t>(name, *block, "ErrorID"), 0u);
    }
    covers(name, {"Execute", "Error", "ErrorID", find_pin(type, "Axis") >= 0 ? "Axis" : "Slave"});
  };
  for (const Row& row : walk)
    for (const std::string& name : row.blocks) shows(name, row);
  covers({"44007", "44008", "44014", "44015", "44016", "44017", "44018", "44019", "44020", "44028"});
}

TEST(PlcopenStates, ResetLeadsToStandstillOrWithoutPowerToDisabled) {
  for (const bool powered : {true, false}) {
    Walk b(errorstop);
    b.power_slave.Enable = powered;
    b.power_slave.call(b.kernel);
    EXPECT_EQ(b.s().state(), errorstop);
    EXPECT_TRUE(b.power_slave.Error);
    EXPECT_EQ(b.power_slave.ErrorID, id(ErrorId::drive_error));
    auto reset = b.make<McReset>();
    b.execute(reset);
    b.kernel.cycle();
    reset.call(b.kernel);
    EXPECT_TRUE(reset.Done);
    EXPECT_EQ(b.s().state(), powered ? standstill : disabled);
    EXPECT_EQ(b.s().error(), ErrorId::none);
  }
  covers({"MC_Reset.Done", "MC_Power.Error", "MC_Power.ErrorID"});
}

TEST(PlcopenStates, PowerOffDisablesFromEveryStateButErrorstop) {
  for (const AxisState state : axis_states) {
    Walk b(state);
    b.power_slave.Enable = true;
    b.power_slave.call(b.kernel);
    EXPECT_EQ(b.s().state(), state == disabled ? standstill : state);
    EXPECT_TRUE(b.power_slave.Status);
    b.power_slave.Enable = false;
    b.power_slave.call(b.kernel);
    EXPECT_FALSE(b.power_slave.Status);
    EXPECT_EQ(b.s().state(), state == errorstop ? errorstop : disabled);
  }
  McPower lost;
  MotionKernel kernel;
  lost.call(kernel);
  EXPECT_EQ(lost.ErrorID, id(ErrorId::no_such_axis));
  covers("MC_Power", {"Axis", "Enable", "Status"});
  covers({"65011"});
}

TEST(PlcopenStates, AFaultLeadsFromEveryStateToErrorstopButFromDisabled) {
  for (const AxisState state : axis_states) {
    Walk b(state);
    b.s().fault(ErrorId::following_error);
    EXPECT_EQ(b.s().state(), state == disabled ? disabled : errorstop);
    EXPECT_EQ(b.s().error(), state == disabled
                                 ? ErrorId::none
                                 : (state == errorstop ? ErrorId::drive_error : ErrorId::following_error));
  }
}

TEST(PlcopenStates, WhatIsDoneEndsItsState) {
  const std::map<AxisState, AxisState> ends{{homing, standstill},
                                            {discrete_motion, standstill},
                                            {stopping, stopping},
                                            {continuous_motion, continuous_motion},
                                            {synchronized_motion, synchronized_motion}};
  for (const auto& [state, end] : ends) {
    Walk b(state);
    for (int i = 0; i < 1'000'000 && b.s().state() == state && !(b.s().done() && i > 10); ++i)
      b.kernel.cycle();
    EXPECT_EQ(b.s().state(), end) << name_of(state);
    EXPECT_TRUE(b.s().done());
  }
}

TEST(PlcopenStates, StopHoldsTheAxisWhileExecuteIsTrue) {
  Walk b(stopping);
  for (int i = 0; i < 1'000; ++i) {
    b.stopper.call(b.kernel);
    b.kernel.cycle();
  }
  b.stopper.call(b.kernel);
  EXPECT_TRUE(b.stopper.Done);
  EXPECT_EQ(b.s().state(), stopping);
  EXPECT_EQ(b.s().set().velocity, 0);
  b.stopper.Execute = false;
  b.stopper.call(b.kernel);
  EXPECT_EQ(b.s().state(), standstill);
  EXPECT_FALSE(b.stopper.Done);
  // Released on the way it ends by itself.
  Walk c(stopping);
  c.stopper.Execute = false;
  c.stopper.call(c.kernel);
  EXPECT_EQ(c.s().state(), stopping);
  c.cycles(1'000);
  EXPECT_EQ(c.s().state(), standstill);
  covers({"MC_Stop.Done", "MC_Stop.Execute"});
}

TEST(PlcopenStates, AnotherCommandAbortsEveryOneUnderWay) {
  for (const std::string name : {"MC_MoveAbsolute", "MC_MoveRelative", "MC_MoveVelocity", "MC_Halt",
                                 "MC_CamIn", "MC_GearIn", "MC_Home"}) {
    Walk b(name == "MC_Halt" ? continuous_motion : standstill);
    const std::unique_ptr<FunctionBlock> block = b.named(name);
    block->call(b.kernel);
    if (name != "MC_Home") b.kernel.cycle();
    block->call(b.kernel);
    EXPECT_FALSE(b.value<bool>(name, *block, "CommandAborted")) << name;
    b.stopper.Execute = true;
    b.stopper.call(b.kernel);
    block->call(b.kernel);
    EXPECT_TRUE(b.value<bool>(name, *block, "CommandAborted")) << name;
    covers({name + ".CommandAborted"});
  }
}

TEST(PlcopenStates, EachBlockUncouplesItsOwnKindOnly) {
  Walk b(synchronized_motion);
  EXPECT_EQ(b.s().uncouple(Command::gear_out).error, ErrorId::in_synchronized_motion);
  EXPECT_TRUE(b.s().coupling()->engaged());
  const std::unique_ptr<FunctionBlock> gear = b.named("MC_GearIn");
  gear->call(b.kernel);
  EXPECT_EQ(b.s().uncouple(Command::cam_out).error, ErrorId::in_synchronized_motion);
  EXPECT_EQ(b.s().uncouple(Command::gear_out).error, ErrorId::none);
}

TEST(PlcopenStates, AnAxisUnpluggedFromARunningBlockDoesNoHarm) {
  for (const BlockType& type : block_types()) {
    const std::string name(type.name);
    if (name == "CAM_TABLE_WRITE") continue;  // it has no axis
    for (const AxisState state : {standstill, synchronized_motion, errorstop}) {
      Walk b(state);
      const std::unique_ptr<FunctionBlock> block = b.named(name);
      block->call(b.kernel);
      b.cycles(400);
      block->call(b.kernel);
      *pin_of<AxisRef>(type, *block, find_pin(type, "Axis") >= 0 ? "Axis" : "Slave") = {};
      block->call(b.kernel);
      if (name == "MC_CamIn") {
        EXPECT_FALSE(b.value<bool>(name, *block, "InSync"));
      }
    }
  }
}

TEST(PlcopenStates, ANameIsFoundWhateverItsCase) {
  EXPECT_EQ(find_block_type("mc_camin")->name, "MC_CamIn");
  EXPECT_EQ(find_block_type("MC_Nothing"), nullptr);
  EXPECT_EQ(find_pin(*find_block_type("MC_CamIn"), "masteroffset"), 3);
  EXPECT_EQ(find_pin(*find_block_type("MC_CamIn"), "Nothing"), -1);
}

TEST(PlcopenStates, ThePinsTypesAreThoseOfTheirValues) {
  const std::map<std::string_view, std::size_t> index{{"BOOL", 0},  {"INT", 1},      {"UINT", 2},
                                                      {"DINT", 3},  {"DWORD", 4},    {"UDINT", 4},
                                                      {"LREAL", 5}, {"AXIS_REF", 6}, {"MC_CAM_REF", 7}};
  for (const BlockType& type : block_types()) {
    const std::unique_ptr<FunctionBlock> block = type.make();
    for (std::size_t i = 0; i < type.pins.size(); ++i) {
      EXPECT_EQ(type.pin(*block, i).index(), index.at(type.pins[i].type))
          << type.name << "." << type.pins[i].name;
      EXPECT_FALSE(type.pins[i].meaning.empty());
      EXPECT_EQ(find_pin(type, type.pins[i].name), static_cast<int>(i));
    }
  }
}

}  // namespace
}  // namespace drycut::devices::plcopen
