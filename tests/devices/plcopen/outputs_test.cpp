// Outputs by PLCopen's rules (part 1, "Input / output behaviour"), numbers out of range, names for programs.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>

#include "devices/plcopen/axis.hpp"
#include "tests/devices/plcopen/bench.hpp"
#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

/// An order for the slave of `b` that is in range.
void fill(const BlockType& type, FunctionBlock& block, Bench& b) {
  const auto set = [&](const char* name, auto value) {
    if (auto* pin = pin_of<decltype(value)>(type, block, name)) *pin = value;
  };
  set("Axis", b.slave);
  set("Slave", b.slave);
  set("Master", b.master);
  set("Velocity", 50'000.0);
  set("VelocityDiff", 50'000.0);
  set("Position", 200'000.0);
  set("Distance", 200'000.0);
  set("PhaseShift", 10'000.0);
  set("CamTableID", std::uint16_t{1});
  set("StartMode", std::uint32_t{hli_ci_f_periodic | hli_ci_endless_positive});
  set("ParameterNumber", std::int16_t{9});
  set("CamTable", CamRef{"", 1});
  if (type.name == "MC_WriteParameter") set("Value", 900'000.0);
}

TEST(PlcopenOutputs, OneOfBusyDoneAbortedAndErrorIsTrueAndDoneIsShownOnceWithoutExecute) {
  for (const BlockType& type : block_types()) {
    SCOPED_TRACE(type.name);
    AxisParameters slave = Bench::virtual_axis();
    const bool probe = type.name == "MC_TouchProbe" || type.name == "MC_AbortTrigger";
    if (probe) slave.kind = AxisKind::encoder;
    Bench b(slave);
    b.table(one_to_one());
    const std::unique_ptr<FunctionBlock> block = type.make();
    auto* execute_pin = pin_of<bool>(type, *block, "Execute");
    auto* busy = pin_of<bool>(type, *block, "Busy");
    if (execute_pin == nullptr || busy == nullptr) continue;
    fill(type, *block, b);
    if (type.name == "MC_Reset") b.s().fault(ErrorId::drive_error);
    if (type.name.ends_with("Out") || type.name == "MC_Phasing") {
      b.kernel.give(
          b.slave,
          type.name == "MC_GearOut"
              ? Request{GearInRequest{b.master, b.slave, 1, 1, {}, 0}}
              : Request{CamInRequest{
                    .master = b.master, .slave = b.slave, .start_mode = hli_ci_f_periodic, .table = 1}});
      b.cycles(100);
    }
    const auto is = [&](const char* name) {
      const auto* pin = pin_of<bool>(type, *block, name);
      return pin != nullptr && *pin;
    };
    *execute_pin = true;
    block->call(b.kernel);
    const bool took_time = *busy;
    if (pin_of<bool>(type, *block, "Active") != nullptr && took_time) {
      EXPECT_TRUE(is("Active"));
    }
    // Execute falls: the command goes on, and its end is shown for one call.
    *execute_pin = false;
    int done = is("Done") ? 1 : 0;
    for (int i = 0; i < 3'000; ++i) {
      b.kernel.cycle();
      block->call(b.kernel);
      const bool reached = is("Done") || is("InVelocity") || is("InGear") || is("InSync");
      EXPECT_LE((is("Busy") ? 1 : 0) + (is("Done") ? 1 : 0) + (is("CommandAborted") ? 1 : 0) +
                    (is("Error") ? 1 : 0),
                1);
      EXPECT_FALSE(is("Active") && !is("Busy"));
      done += reached ? 1 : 0;
    }
    EXPECT_EQ(done, type.name == "MC_TouchProbe" ? 0 : 1) << "took time: " << took_time;
    EXPECT_FALSE(is("Error"));
    covers({std::string(type.name) + ".Busy"});
    if (pin_of<bool>(type, *block, "Active") != nullptr) covers({std::string(type.name) + ".Active"});
  }
  for (const BlockType& type : block_types()) {
    const std::unique_ptr<FunctionBlock> block = type.make();
    auto* enable = pin_of<bool>(type, *block, "Enable");
    auto* busy = pin_of<bool>(type, *block, "Busy");
    if (enable == nullptr || busy == nullptr) continue;
    Bench b;
    fill(type, *block, b);
    *enable = true;
    block->call(b.kernel);
    EXPECT_TRUE(*busy) << type.name;
    *enable = false;
    block->call(b.kernel);
    EXPECT_FALSE(*busy) << type.name;
    covers({std::string(type.name) + ".Busy"});
  }
}

TEST(PlcopenOutputs, StopIsBusyWhileItHoldsTheAxisAndAbortedByAMovement) {
  Bench b;
  auto stop = b.make<McStop>();
  auto on = b.make<McMoveVelocity>(50'000);
  execute(on, b.kernel);
  b.cycles(200);
  execute(stop, b.kernel);
  b.cycles(1'000, stop);
  EXPECT_TRUE(stop.Done && stop.Busy && stop.Active) << "PLCopen's exception";
  execute(on, b.kernel);  // of ISG alone
  stop.call(b.kernel);
  EXPECT_TRUE(stop.Done) << "it was, and Execute is still TRUE";
  EXPECT_FALSE(stop.Busy || stop.Active || stop.CommandAborted);
  Bench c;
  stop = {};
  stop.Axis = on.Axis = c.slave;
  execute(on, c.kernel);
  c.cycles(200);
  execute(stop, c.kernel);
  c.kernel.cycle();
  c.power_slave.Enable = false;
  c.power_slave.call(c.kernel);
  stop.call(c.kernel);
  EXPECT_TRUE(stop.CommandAborted);
  covers({"MC_Stop.CommandAborted"});
}

TEST(PlcopenOutputs, ACommandThatWasDoneBeforeTheNextOneIsDoneAndNotAborted) {
  Bench b;
  auto first = b.make<McMoveRelative>(100'000);
  auto second = b.make<McMoveRelative>(100'000);
  first.Distance = 50'000;
  execute(first, b.kernel);
  while (b.s().state() != AxisState::standstill) b.kernel.cycle();
  execute(second, b.kernel);  // called before the first block in this scan
  first.call(b.kernel);
  EXPECT_TRUE(first.Done);
  EXPECT_FALSE(first.CommandAborted);
}

// Every LREAL input of every block with numbers that no controller can take: refused, or, where the vendor's
// range has them, run without harm.
TEST(PlcopenRanges, NoNumberOnAPinDoesHarm) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::array<double, 13> numbers{std::nan(""), inf,  -inf, 1e308,  -1e308, 1e19,        -1e19,
                                       2147483649.0, -1.0, 0.5,  1e-300, -0.0,   4294967296.0};
  for (const BlockType& type : block_types()) {
    for (std::size_t number = 0; number < type.pins.size(); ++number) {
      const Pin& pin = type.pins[number];
      if (pin.direction != PinDirection::input || pin.type != "LREAL") continue;
      for (const double value : numbers) {
        SCOPED_TRACE(std::string(type.name) + "." + std::string(pin.name) + " = " + std::to_string(value));
        Bench b;
        b.table(swing());
        b.run.Execute = true;
        b.step(20);
        if (type.name == "MC_Phasing") {
          b.engage(hli_ci_f_periodic);
        }
        if (type.name == "MC_MoveSuperImposed") {
          b.s().move({Command::move_velocity, 0, {.velocity = 1'000}, Direction::positive});
          b.step();
        }
        const std::unique_ptr<FunctionBlock> block = type.make();
        fill(type, *block, b);
        if (auto* window = pin_of<bool>(type, *block, "WindowOnly")) *window = true;
        *std::get<double*>(type.pin(*block, number)) = value;
        for (const char* go : {"Execute", "Enable"})
          if (auto* level = pin_of<bool>(type, *block, go)) *level = true;
        block->call(b.kernel);
        const bool refused = *pin_of<bool>(type, *block, "Error");
        const bool not_a_number = std::isnan(value) || std::abs(value) > 1e18;
        // A table of REAL64 holds whatever is finite; MC_CamIn judges it.
        if (not_a_number && !(type.name == "CAM_TABLE_WRITE" && std::isfinite(value))) {
          EXPECT_TRUE(refused);
        }
        const bool slope = pin.name == "Acceleration" || pin.name == "Deceleration" || pin.name == "Jerk";
        if (slope || pin.name == "Velocity" || pin.name == "VelocityDiff") {
          const bool in_range = (slope && value == 0) || (value >= 1 && value <= 2147483647);
          EXPECT_EQ(refused, !in_range);
          const std::uint32_t told = *pin_of<std::uint32_t>(type, *block, "ErrorID");
          if (refused) {
            EXPECT_EQ(told, id(pin.name == "Acceleration"   ? ErrorId::acceleration_range
                               : pin.name == "Deceleration" ? ErrorId::deceleration_range
                               : pin.name == "Jerk"         ? ErrorId::jerk_range
                                                            : ErrorId::velocity_range));
          }
        }
        for (int i = 0; i < 60; ++i) {
          b.step();
          block->call(b.kernel);
          for (const Axis* axis : {&b.m(), &b.s()}) {
            ASSERT_TRUE(std::isfinite(axis->set().position.part) && std::isfinite(axis->set().velocity) &&
                        std::isfinite(axis->set().acceleration));
            ASSERT_GE(axis->set().position.part, 0);
            ASSERT_LT(axis->set().position.part, turn);
          }
        }
      }
    }
  }
}

TEST(PlcopenRanges, TheLargestGearAndTheLargestCamDoNoHarm) {
  AxisParameters wide = Bench::virtual_axis();
  wide.modulo = 2'147'483'647;
  wide.vb_max = 2'147'483'647;
  Bench b(wide);
  b.run.Velocity = 1'000'000;
  b.start_master();
  auto gear = b.make<McGearIn>();
  gear.RatioNumerator = std::numeric_limits<std::int32_t>::max();
  gear.RatioDenominator = 1;
  execute(gear, b.kernel);
  for (int i = 0; i < 20'000; ++i) b.step();
  EXPECT_TRUE(std::isfinite(b.s().set().position.part));
  EXPECT_FALSE(gear.InGear);
  // A cam of 100 km times 2e9 is none.
  Bench c;
  c.table({0, 1e12});
  c.cam.SlaveScaling = 2e9;
  c.couple(hli_ci_f_periodic);
  EXPECT_EQ(c.cam.ErrorID, id(ErrorId::slave_scaling));
  c.table({0, 100}, 3, Interpolation::linear);
  c.couple(hli_ci_f_periodic);
  EXPECT_FALSE(c.cam.Error);
  // Written beyond it while the cam runs, the cam goes on as it was.
  EXPECT_EQ(c.kernel.write_table(1, 1, 0, 1e12), ErrorId::none);
  c.step(100);
  EXPECT_TRUE(std::isfinite(c.s().set().position.part));
}

TEST(PlcopenLimits, ASpeedBeyondTheAxisIsToldAndTheAxisWarns) {
  Bench b;
  b.set("dynamik.vb_max", 300'000);
  auto info = b.make<McReadAxisInfo>();
  auto on = b.make<McMoveVelocity>();
  info.Enable = true;
  on.Velocity = 300'000;
  execute(on, b.kernel);
  info.call(b.kernel);
  EXPECT_FALSE(info.AxisWarning || b.s().has_remarks());
  on.Velocity = 300'001;
  execute(on, b.kernel);
  info.call(b.kernel);
  EXPECT_TRUE(info.AxisWarning);
  const std::vector<AxisRemark> remarks = b.s().take_remarks();
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].event, "warning");
  EXPECT_EQ(remarks[0].text, "Velocity 300001 is above dynamik.vb_max: it goes at 300000");
  b.cycles(1'000);
  EXPECT_DOUBLE_EQ(b.s().set().velocity, 3'000'000);
  covers({"MC_ReadAxisInfo.AxisWarning"});
}

TEST(PlcopenLimits, ASlaveThatCannotFollowIsNotInSync) {
  for (const bool cam : {true, false}) {
    Bench b;
    b.table(one_to_one());
    auto gear = b.make<McGearIn>();
    b.run.Velocity = 100'000;
    b.start_master();
    if (cam)
      b.couple(hli_ci_f_periodic | hli_ci_endless_positive);
    else
      execute(gear, b.kernel);
    const auto in_sync = [&] {
      gear.call(b.kernel);
      return cam ? b.cam.InSync : gear.InGear;
    };
    ASSERT_GE(b.until(in_sync), 0);
    b.set("cam_gear.v_max_slave", 150'000);
    b.run.Velocity = 200'000;
    b.run.Execute = false;
    b.step();
    b.run.Execute = true;
    // It falls in the first cycle in which the slave lags, not before.
    ASSERT_GE(b.until([&] { return !in_sync(); }), 0);
    EXPECT_NEAR(b.s().set().velocity, 1'500'000, 5'000);
    EXPECT_TRUE(cam ? b.cam.Active : gear.Active) << "the coupling itself goes on";
    b.step(100);
    EXPECT_FALSE(in_sync());
    const auto remarks = b.s().take_remarks();
    ASSERT_EQ(remarks.size(), 1u) << "told once";
    EXPECT_EQ(remarks[0].text, std::string(cam ? "the cam" : "the gear") +
                                   " asks for more than cam_gear.v_max_slave 150000 allows: the slave lags");
    // The master slows down, the slave catches up.
    b.run.Velocity = 50'000;
    b.run.Execute = false;
    b.step();
    b.run.Execute = true;
    ASSERT_GE(b.until(in_sync), 0);
    EXPECT_NEAR(std::remainder(b.at(b.s()) - b.at(b.m()), turn), 0, cam ? 1e-3 : turn);
  }
}

TEST(PlcopenParameters, AreReadByPlcopensNumbers) {
  AxisParameters linear = Bench::linear_axis(-5'000'000, 6'000'000);
  linear.following_error_max = 1'234;
  Bench b(linear);
  auto on = b.make<McMoveVelocity>();
  auto read = b.make<McReadParameter>();
  on.Velocity = 40'000;
  on.Direction = 3;
  execute(on, b.kernel);
  b.cycles(500);
  read.Enable = true;
  const std::map<int, double> expected{{1, b.s().set().position.part},
                                       {2, 6'000'000},
                                       {3, -5'000'000},
                                       {7, 1'234},
                                       {8, 1'000'000},
                                       {9, 1'000'000},
                                       {10, -40'000},
                                       {11, -40'000},
                                       {12, 10'000},
                                       {13, 10'000},
                                       {14, 10'000},
                                       {15, 10'000},
                                       {16, 100'000}};
  EXPECT_EQ(numbered_parameters().size(), expected.size());
  for (std::int16_t number = -2; number < 20; ++number) {
    read.ParameterNumber = number;
    read.call(b.kernel);
    const auto row = expected.find(number);
    EXPECT_EQ(read.Valid, row != expected.end()) << number;
    EXPECT_EQ(read.ErrorID, row == expected.end() ? id(ErrorId::no_such_parameter) : 0) << number;
    EXPECT_NEAR(read.Value, row == expected.end() ? 0 : row->second, 1e-9) << number;
  }
  read.Axis = {};
  read.call(b.kernel);
  EXPECT_EQ(read.ErrorID, id(ErrorId::no_such_axis));
  covers("MC_ReadParameter", {"Axis", "Enable", "ParameterNumber", "Valid", "Error", "ErrorID", "Value"});
  covers({"65020"});
}

TEST(PlcopenParameters, AreWrittenInStandstillAndInTheirRange) {
  Bench b;
  auto write = b.make<McWriteParameter>();
  const auto error_of = [&](std::int16_t number, double value) {
    write.ParameterNumber = number;
    write.Value = value;
    execute(write, b.kernel);
    EXPECT_EQ(write.Done, !write.Error);
    return write.ErrorID;
  };
  EXPECT_EQ(error_of(9, 250'000), 0u);
  EXPECT_EQ(b.s().parameters().vb_max, 250'000);
  EXPECT_EQ(error_of(13, 3'000), 0u);
  EXPECT_EQ(b.s().parameters().a_max, 3'000);
  EXPECT_EQ(error_of(2, 77), 0u);
  EXPECT_EQ(error_of(3, -77), 0u);
  EXPECT_EQ(error_of(7, 5), 0u);
  for (const double value : {std::nan(""), 1e308, -1.0, 0.0})
    EXPECT_EQ(error_of(9, value), id(ErrorId::parameter_range));
  EXPECT_EQ(error_of(3, 78), id(ErrorId::parameter_range)) << "the limits would cross";
  for (const int number : {1, 4, 8, 10, 12, 17, -1})
    EXPECT_EQ(error_of(static_cast<std::int16_t>(number), 1), id(ErrorId::no_such_parameter)) << number;
  b.s().move({Command::move_velocity, 0, {.velocity = 1'000}, Direction::positive});
  EXPECT_EQ(error_of(9, 1), id(ErrorId::in_continuous_motion)) << "ISG: only in standstill";
  EXPECT_EQ(b.s().parameters().vb_max, 250'000);
  write.Axis = {};
  EXPECT_EQ(error_of(9, 1), id(ErrorId::no_such_axis));
  covers("MC_WriteParameter", {"Axis", "Execute", "ParameterNumber", "Value", "Done", "Error", "ErrorID"});
  covers({"65021"});
}

TEST(PlcopenReadings, MotionStateSaysHowTheAxisMoves) {
  Bench b;
  auto read = b.make<McReadMotionState>();
  auto to = b.make<McMoveAbsolute>();
  read.Enable = true;
  to.Position = 3'000'000;
  to.Direction = 3;  // down to it, over 0
  to.Velocity = 100'000;
  read.call(b.kernel);
  EXPECT_TRUE(read.Valid && read.ConstantVelocity && read.InWindow && read.InPosition && read.RevZero);
  EXPECT_FALSE(read.IsMoving || read.Accelerating || read.Decelerating);
  execute(to, b.kernel);
  int accelerating = 0;
  int constant = 0;
  int decelerating = 0;
  while (!to.Done) {
    b.kernel.cycle();
    to.call(b.kernel);
    read.call(b.kernel);
    const AxisMotion& set = b.s().set();
    EXPECT_EQ(read.LrSetPos, set.position.part);
    EXPECT_EQ(read.LrActualPos, b.s().actual().part);
    EXPECT_EQ(read.LrCommandedPos, 3'000'000);
    EXPECT_DOUBLE_EQ(read.LrSetRev, set.velocity / 10);
    EXPECT_DOUBLE_EQ(read.LrActualRev, set.velocity / 10);
    EXPECT_DOUBLE_EQ(read.LrSetAccel, set.acceleration / 10'000);
    EXPECT_EQ(read.IsMoving, set.velocity != 0);
    EXPECT_EQ(read.DirectionNegative, set.velocity < 0);
    EXPECT_FALSE(read.DirectionPositive);
    EXPECT_EQ(static_cast<int>(read.Accelerating) + static_cast<int>(read.Decelerating) +
                  static_cast<int>(read.ConstantVelocity),
              1);
    accelerating += read.Accelerating && constant == 0 ? 1 : 0;
    constant += read.ConstantVelocity && read.IsMoving ? 1 : 0;
    decelerating += read.Decelerating && constant > 0 ? 1 : 0;
  }
  // 100 mm/s with 5 m/s2 in 0.05 s: 0.07 s up, as long down, the rest even.
  EXPECT_GT(accelerating, 30);
  EXPECT_GT(constant, 200);
  EXPECT_GT(decelerating, 30);
  EXPECT_TRUE(read.InPosition && read.InWindow);
  covers("MC_ReadMotionState",
         {"Axis", "Enable", "Valid", "ConstantVelocity", "Accelerating", "Decelerating", "DirectionPositive",
          "DirectionNegative", "RevZero", "InWindow", "InPosition", "IsMoving", "LrCommandedPos",
          "LrActualPos", "LrSetPos", "LrActualRev", "LrSetRev", "LrSetAccel"});
}

TEST(PlcopenReadings, AxisInfoSaysWhatTheAxisIsReadyFor) {
  AxisParameters drive;
  Bench b(drive);
  McReadAxisInfo read;
  McReadMotionState motion;
  read.Axis = b.slave;
  read.Enable = true;
  read.call(b.kernel);
  EXPECT_TRUE(read.Valid && read.CommunicationReady && read.ReadyForPowerOn && read.PowerOn);
  EXPECT_FALSE(read.Simulation || read.IsHomed || read.AxisWarning);
  b.s().drive.ready = false;
  b.power_slave.Enable = false;
  b.power_slave.call(b.kernel);
  read.call(b.kernel);
  EXPECT_FALSE(read.ReadyForPowerOn || read.PowerOn);
  read.Axis = b.master;
  read.call(b.kernel);
  EXPECT_TRUE(read.Simulation && read.IsHomed && read.ReadyForPowerOn);
  read.Axis = {};
  motion.Enable = true;
  read.call(b.kernel);
  motion.call(b.kernel);
  EXPECT_EQ(read.ErrorID, id(ErrorId::no_such_axis));
  EXPECT_EQ(motion.ErrorID, id(ErrorId::no_such_axis));
  EXPECT_FALSE(read.CommunicationReady || read.Valid);
  covers("MC_ReadAxisInfo", {"Axis", "Enable", "Valid", "Error", "ErrorID", "Simulation",
                             "CommunicationReady", "ReadyForPowerOn", "PowerOn", "IsHomed"});
  covers({"MC_ReadMotionState.Error", "MC_ReadMotionState.ErrorID"});
}

TEST(PlcopenReadings, AVirtualAxisThatIsNotHomedAtStartWaitsForMcHome) {
  AxisParameters virtual_axis = Bench::virtual_axis();
  virtual_axis.homed_at_start = false;
  Bench b(virtual_axis);
  b.table(one_to_one());
  b.couple();
  EXPECT_EQ(b.cam.ErrorID, id(ErrorId::not_homed));
  auto home = b.make<McHome>();
  execute(home, b.kernel);
  b.kernel.cycle();
  home.call(b.kernel);
  EXPECT_TRUE(home.Done);
  b.couple();
  EXPECT_FALSE(b.cam.Error);
}

// 004 l.3-33: the names as the manual prints them, in a program written from it.
TEST(PlcopenNames, AProgramWrittenWithTheManualsNamesCompilesAndRuns) {
  Bench b;
  b.table({0, 900'000, 1'800'000, 2'700'000}, 3, Interpolation::table_defined);
  Problems problems;
  const st::Program program = st::compile(R"(PROGRAM main
VAR_EXTERNAL Master : AXIS_REF; Slave : AXIS_REF; END_VAR
VAR
  startmode : HLI_UNS32;
  table_fkt_type : HLI_UNS32 := HLI_POLYNOM_3;
  way : MC_BUFFER_MODE := mcAborting;
  go : BOOL;
  CamIn : MC_CamIn;
END_VAR
startmode := HLI_CI_F_PERIODIC OR HLI_CI_ENDLESS_POSITIVE;
IF table_fkt_type = HLI_STEP_DIRECT OR table_fkt_type = HLI_POLYNOM_3_KOEFF OR table_fkt_type = TABLE_DEFINED THEN
  table_fkt_type := LINE_POLY5;
END_IF
IF go THEN table_fkt_type := HLI_LINEAR; END_IF
CamIn(Master := Master, Slave := Slave, Execute := NOT go, StartMode := startmode, CamTableID := 1,
      TableFctType := table_fkt_type, BufferMode := way);
END_PROGRAM
)",
                                          "cam.st", problems);
  for (const Problem& problem : problems) ADD_FAILURE() << to_string(problem);
  st::Runtime runtime(program, b.kernel);
  const auto read = [&](const std::string& name) {
    const auto symbols = runtime.symbols();
    for (std::size_t i = 0; i < symbols.size(); ++i)
      if (symbols[i].name == name) return runtime.read(i);
    ADD_FAILURE() << name;
    return -1.0;
  };
  b.run.Execute = true;
  int scans = 0;
  for (; scans < 5'000 && read("CamIn.InSync") == 0; ++scans) {
    b.run.call(b.kernel);
    runtime.scan(scans * 2'000'000LL);
    b.kernel.cycle();
    ASSERT_EQ(read("CamIn.ErrorID"), 0);
  }
  EXPECT_EQ(read("CamIn.InSync"), 1);
  EXPECT_EQ(b.s().link().interpolation, Interpolation::polynom_3);
  EXPECT_EQ(b.s().link().endless, Endless::positive);
}

TEST(PlcopenNames, TheManualsOwnDeclarationsMayStandInTheProgram) {
  EXPECT_THAT(st::problems_of(R"(VAR_GLOBAL CONSTANT
HLI_CI_RAMP_IN : HLI_UNS32:= 16#00000001;
HLI_CI_F_PERIODIC : HLI_UNS32:= 16#00000010;
HLI_STEP_DIRECT : HLI_UNS32 := 0;
HLI_LINEAR : HLI_UNS32 := 1;
HLI_POLYNOM_3 : HLI_UNS32 := 2;
HLI_POLYNOM_3_KOEFF : HLI_UNS32 := 3;
LINE_POLY5 : HLI_UNS32 := 4;
POLY5_LINE : HLI_UNS32 := 5;
TABLE_DEFINED : HLI_UNS32 := 6;
END_VAR
PROGRAM main
VAR_EXTERNAL Web : AXIS_REF; Knife : AXIS_REF; END_VAR
VAR CamIn : MC_CamIn; END_VAR
CamIn(Master := Web, Slave := Knife, StartMode := HLI_CI_RAMP_IN OR HLI_CI_F_PERIODIC,
      TableFctType := HLI_POLYNOM_3);
END_PROGRAM
)"),
              testing::IsEmpty());
}

}  // namespace
}  // namespace drycut::devices::plcopen
