#pragma once
#include "devices/plcopen/function_block.hpp"

// The blocks that move one axis. Positions in 0.1 um or 0.0001 deg, speeds in um/s or 0.001 deg/s,
// accelerations in mm/s2 or deg/s2, jerks in mm/s3 or deg/s3.
namespace drycut::devices::plcopen {

struct McPower final : EnabledBlock {
  bool Status = false;
  void call(MotionKernel& kernel) override;

 private:
  bool last_ = false;
};

struct McHome final : AxisCommand {
  double Position = 0;

 private:
  Order give(MotionKernel&, plcopen::Axis& axis) override { return axis.home(Position); }
};

struct McReset final : ExecutedBlock {
  AxisRef Axis;
  void call(MotionKernel& kernel) override;
};

struct McStop final : AxisCommand, BrakingPins {
  void call(MotionKernel& kernel) override;

 private:
  Order give(MotionKernel&, plcopen::Axis& axis) override {
    return axis.stop({.deceleration = Deceleration, .jerk = Jerk});
  }
  /// It holds the axis while Execute is TRUE.
  [[nodiscard]] bool goes_on() const override { return Execute; }
};

struct McHalt final : AxisCommand, BrakingPins {
 private:
  Order give(MotionKernel&, plcopen::Axis& axis) override {
    return axis.halt({.deceleration = Deceleration, .jerk = Jerk});
  }
};

/// What the blocks share that take the axis to a target or a speed.
struct MoveCommand : AxisCommand, SlopePins {
  double Velocity = 0;
  std::int16_t BufferMode = static_cast<std::int16_t>(plcopen::BufferMode::aborting);

 protected:
  /// Position or Distance, and Direction.
  Order order(MotionKernel& kernel, Command command, double way, std::int16_t direction) const;
};

struct McMoveAbsolute final : MoveCommand {
  double Position = 0;
  std::int16_t Direction = static_cast<std::int16_t>(plcopen::Direction::shortest_way);

 private:
  Order give(MotionKernel& kernel, plcopen::Axis&) override {
    return order(kernel, Command::move_absolute, Position, Direction);
  }
};

/// MC_MoveRelative, from where the axis is commanded to be, and MC_MoveAdditive, from where it is to go.
template <Command command>
struct McMoveBy final : MoveCommand {
  double Distance = 0;

 private:
  Order give(MotionKernel& kernel, plcopen::Axis&) override {
    return order(kernel, command, Distance, static_cast<std::int16_t>(Direction::shortest_way));
  }
};
using McMoveRelative = McMoveBy<Command::move_relative>;
using McMoveAdditive = McMoveBy<Command::move_additive>;

/// On top of the movement or coupling under way, which goes on.
struct McMoveSuperImposed final : AxisCommand, SlopePins {
  double Distance = 0;
  double VelocityDiff = 0;

 private:
  Order give(MotionKernel&, plcopen::Axis& axis) override {
    return axis.superimpose(Distance, dynamics(VelocityDiff));
  }
};

struct McMoveVelocity final : MoveCommand {
  std::int16_t Direction = static_cast<std::int16_t>(plcopen::Direction::positive);
  bool InVelocity = false;
  void call(MotionKernel& kernel) override;

 private:
  Order give(MotionKernel& kernel, plcopen::Axis&) override {
    return order(kernel, Command::move_velocity, 0, Direction);
  }
  /// At its speed the axis is not done: another command aborts it still.
  [[nodiscard]] bool goes_on() const override { return true; }
};

struct McSetPosition final : AxisAnswer {
  double Position = 0;
  bool Relative = false;

 private:
  ErrorId answer(MotionKernel& kernel, plcopen::Axis*) override {
    return kernel.set_position(Axis, Position, Relative);
  }
};

/// Its factor stays in force when Enable goes FALSE. Factors of acceleration and jerk are not simulated.
struct McSetOverride final : EnabledBlock {
  double VelFactor = 1;
  bool Enabled = false;
  bool Busy = false;
  void call(MotionKernel& kernel) override;
};

}  // namespace drycut::devices::plcopen
