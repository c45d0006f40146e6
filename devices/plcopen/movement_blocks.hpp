#pragma once
#include "devices/plcopen/function_block.hpp"

// The blocks that move one axis. Positions in 0.1 um or 0.0001 deg, speeds in um/s or 0.001 deg/s,
// accelerations in mm/s2 or deg/s2, jerks in mm/s3 or deg/s3.
namespace drycut::devices::plcopen {

struct McPower final : FunctionBlock {
  AxisRef Axis;
  bool Enable = false;
  bool Status = false;
  bool Error = false;
  std::uint32_t ErrorID = 0;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;

 private:
  bool last_ = false;
};

struct McHome final : AxisCommand {
  double Position = 0;
  PinValue pin(std::size_t number) override;

 private:
  Order give(plcopen::Axis& axis) override { return axis.home(Position); }
};

struct McReset final : ExecutedBlock {
  AxisRef Axis;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McStop final : AxisCommand {
  double Deceleration = 0;
  double Jerk = 0;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;

 private:
  Order give(plcopen::Axis& axis) override { return axis.stop({.deceleration = Deceleration, .jerk = Jerk}); }
};

struct McHalt final : AxisCommand {
  double Deceleration = 0;
  double Jerk = 0;
  PinValue pin(std::size_t number) override;

 private:
  Order give(plcopen::Axis& axis) override { return axis.halt({.deceleration = Deceleration, .jerk = Jerk}); }
};

struct McMoveAbsolute final : AxisCommand {
  double Position = 0;
  double Velocity = 0;
  double Acceleration = 0;
  double Deceleration = 0;
  double Jerk = 0;
  std::int16_t Direction = static_cast<std::int16_t>(plcopen::Direction::shortest_way);
  PinValue pin(std::size_t number) override;

 private:
  Order give(plcopen::Axis& axis) override {
    return axis.move_absolute(Position, {Velocity, Acceleration, Deceleration, Jerk},
                              static_cast<plcopen::Direction>(Direction));
  }
};

struct McMoveRelative final : AxisCommand {
  double Distance = 0;
  double Velocity = 0;
  double Acceleration = 0;
  double Deceleration = 0;
  double Jerk = 0;
  PinValue pin(std::size_t number) override;

 private:
  Order give(plcopen::Axis& axis) override {
    return axis.move_relative(Distance, {Velocity, Acceleration, Deceleration, Jerk});
  }
};

struct McMoveVelocity final : ExecutedBlock {
  AxisRef Axis;
  double Velocity = 0;
  double Acceleration = 0;
  double Deceleration = 0;
  double Jerk = 0;
  std::int16_t Direction = static_cast<std::int16_t>(plcopen::Direction::positive);
  bool InVelocity = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McSetPosition final : ExecutedBlock {
  AxisRef Axis;
  double Position = 0;
  bool Relative = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

/// Its factor stays in force when Enable goes FALSE. Factors of acceleration and jerk are not simulated.
struct McSetOverride final : FunctionBlock {
  AxisRef Axis;
  bool Enable = false;
  double VelFactor = 1;
  bool Enabled = false;
  bool Error = false;
  std::uint32_t ErrorID = 0;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

}  // namespace drycut::devices::plcopen
