#pragma once
#include <cstdint>

#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/pins.hpp"

// What function blocks have in common.
namespace drycut::devices::plcopen {

/// A rising edge of Execute.
class Edge {
 public:
  bool rising(bool level) {
    const bool edge = level && !last_;
    last_ = level;
    return edge;
  }
  void visit(StateArchive& archive);

 private:
  bool last_ = false;
};

/// Pins of blocks that slow down: deceleration in mm/s2 or deg/s2, jerk in mm/s3 or deg/s3; 0 takes the axis'
/// own.
struct BrakingPins {
  double Deceleration = 0;
  double Jerk = 0;
};
/// And of those that speed up too.
struct SlopePins : BrakingPins {
  double Acceleration = 0;

  [[nodiscard]] Dynamics dynamics(double velocity) const {
    return {velocity, Acceleration, Deceleration, Jerk};
  }
};

/// What all blocks with Execute share: ticket, end, error, abortion. A block whose table has no pin for one
/// of these outputs does not show it. By PLCopen's rules one of Busy, Done, CommandAborted and Error is TRUE
/// once the command is given (MC_Stop: Done and Busy, for it holds the axis), and how a command ended is
/// shown for one call even if Execute has become FALSE before.
struct ExecutedBlock : FunctionBlock {
  bool Execute = false;
  bool Done = false;
  bool Busy = false;    ///< it waits for its turn, or is at work
  bool Active = false;  ///< it has control of the axis
  bool CommandAborted = false;
  bool Error = false;
  std::uint32_t ErrorID = 0;

  void visit(StateArchive& archive) override;

 protected:
  /// Takes an order given at an edge: the outputs of the last one are gone.
  void taken(const Order& order);
  /// Takes what is done at the edge itself, or refused.
  void answered(const Order& order);
  void refused(ErrorId error);
  /// Looks after the order given to `axis`. A command that `goes_on` once done, a speed or a coupling, is
  /// still aborted or ended by an error; another one keeps its Done.
  void watch(const Axis* axis, bool goes_on = false);
  /// Writes the outputs.
  void show();

  Edge edge_;
  std::uint64_t ticket_ = 0;
  Progress progress_ = Progress::none;

 private:
  Progress shown_ = Progress::none;
  bool holds_ = false;  ///< done, and still in control
};

/// A block that gives its axis one command and looks after it until it is done.
struct AxisCommand : ExecutedBlock {
  AxisRef Axis;
  void call(MotionKernel& kernel) override;

 protected:
  virtual Order give(MotionKernel& kernel, plcopen::Axis& axis) = 0;
  /// See watch().
  [[nodiscard]] virtual bool goes_on() const { return false; }
};

/// A block that is done in the call in which it is commanded, or refused.
struct AxisAnswer : ExecutedBlock {
  AxisRef Axis;
  void call(MotionKernel& kernel) override;

 protected:
  /// `axis`: nullptr if there is none.
  virtual ErrorId answer(MotionKernel& kernel, plcopen::Axis* axis) = 0;
};

/// A block that acts while Enable is TRUE.
struct EnabledBlock : FunctionBlock {
  AxisRef Axis;
  bool Enable = false;
  bool Error = false;
  std::uint32_t ErrorID = 0;

 protected:
  void show_error(ErrorId error);
};

/// A block with Enable that reads from its axis in every call.
struct AxisReading : EnabledBlock {
  bool Valid = false;
  bool Busy = false;
  void call(MotionKernel& kernel) override;

 protected:
  /// nullptr: there is nothing to read, the outputs go to 0.
  virtual void read(const plcopen::Axis* axis) = 0;
  /// What cannot be read.
  [[nodiscard]] virtual ErrorId check() const { return ErrorId::none; }
};

// The blocks that move one axis. Positions in 0.1 um or 0.0001 deg, speeds in um/s or 0.001 deg/s,
// accelerations in mm/s2 or deg/s2, jerks in mm/s3 or deg/s3.

struct McPower final : EnabledBlock {
  bool Status = false;
  void call(MotionKernel& kernel) override;
  void visit(StateArchive& archive) override;

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

// The blocks that read an axis, and its touch probe, in the units of the movement blocks.

struct McReadActualPosition final : AxisReading {
  double Position = 0;

 private:
  void read(const plcopen::Axis* axis) override { Position = axis == nullptr ? 0 : axis->actual().part; }
};

struct McReadActualVelocity final : AxisReading {
  double Velocity = 0;

 private:
  void read(const plcopen::Axis* axis) override {
    Velocity = axis == nullptr ? 0 : axis->actual_velocity() / increments_per_speed;
  }
};

/// One output for each state: one of them is TRUE while Valid is.
struct McReadStatus final : AxisReading {
  bool Errorstop = false;
  bool Disabled = false;
  bool Stopping = false;
  bool Homing = false;
  bool Standstill = false;
  bool DiscreteMotion = false;
  bool ContinuousMotion = false;
  bool SynchronizedMotion = false;

 private:
  void read(const plcopen::Axis* axis) override;
};

struct McReadAxisError final : AxisReading {
  std::uint32_t AxisErrorID = 0;

 private:
  void read(const plcopen::Axis* axis) override {
    AxisErrorID = axis == nullptr ? 0 : static_cast<std::uint32_t>(axis->error());
  }
};

/// The axis has no switches of its own at its ends and its zero.
struct McReadAxisInfo final : AxisReading {
  bool Simulation = false;
  bool CommunicationReady = false;
  bool ReadyForPowerOn = false;
  bool PowerOn = false;
  bool IsHomed = false;
  bool AxisWarning = false;

 private:
  void read(const plcopen::Axis* axis) override;
};

/// PLCopen's outputs are of the commanded motion; the others are ISG's.
struct McReadMotionState final : AxisReading {
  bool ConstantVelocity = false;
  bool Accelerating = false;
  bool Decelerating = false;
  bool DirectionPositive = false;
  bool DirectionNegative = false;
  bool RevZero = false;
  bool InWindow = false;
  bool InPosition = false;
  bool IsMoving = false;
  double LrCommandedPos = 0;
  double LrActualPos = 0;
  double LrSetPos = 0;
  double LrActualRev = 0;
  double LrSetRev = 0;
  double LrSetAccel = 0;

 private:
  void read(const plcopen::Axis* axis) override;
};

struct McReadParameter final : AxisReading {
  std::int16_t ParameterNumber = 0;
  double Value = 0;

 private:
  void read(const plcopen::Axis* axis) override;
  [[nodiscard]] ErrorId check() const override;
};

/// The value is in force at once, and the machine data keep it.
struct McWriteParameter final : AxisAnswer {
  std::int16_t ParameterNumber = 0;
  double Value = 0;

 private:
  ErrorId answer(MotionKernel& kernel, plcopen::Axis* axis) override;
};

/// Records where the axis was when its probe's signal rose: the exact count, not the one of the next cycle.
/// The axis' own movement and state do not matter. Of several edges in one cycle the last counts.
struct McTouchProbe final : ExecutedBlock {
  AxisRef Axis;
  std::uint16_t TriggerInput = 0;
  bool WindowOnly = false;
  double FirstPosition = 0;
  double LastPosition = 0;
  double RecordedPosition = 0;
  void call(MotionKernel& kernel) override;
  void visit(StateArchive& archive) override;

 private:
  [[nodiscard]] ErrorId check(const plcopen::Axis* axis) const;
  /// From FirstPosition in positive direction to LastPosition, of a modulo axis over the turn's end too.
  [[nodiscard]] bool wanted(double position, double modulo) const;

  std::uint32_t edges_ = 0;  ///< of the probe seen so far
};

/// Ends the order of an MC_TouchProbe that still waits.
struct McAbortTrigger final : AxisAnswer {
  std::uint16_t TriggerInput = 0;

 private:
  ErrorId answer(MotionKernel& kernel, plcopen::Axis* axis) override;
};

// The blocks of cams and gears (004), in the units of the movement blocks.

/// The axes of a coupling.
struct CoupledPins {
  AxisRef Master;
  AxisRef Slave;
};

struct McCamTableSelect final : ExecutedBlock, CoupledPins {
  CamRef CamTable;
  std::uint16_t CamTableID = 0;
  void call(MotionKernel& kernel) override;
};

struct McCamIn final : ExecutedBlock, CoupledPins {
  double MasterOffset = 0;
  double SlaveOffset = 0;
  double MasterScaling = 1;
  double SlaveScaling = 1;
  std::uint32_t StartMode = 0;
  std::uint16_t CamTableID = 0;
  std::uint32_t TableFctType = static_cast<std::uint32_t>(Interpolation::table_defined);
  std::int16_t BufferMode = static_cast<std::int16_t>(plcopen::BufferMode::aborting);
  bool InSync = false;
  bool EndOfProfile = false;
  void call(MotionKernel& kernel) override;
  void visit(StateArchive& archive) override;

 private:
  std::int64_t ends_seen_ = 0;
};

struct McGearIn final : ExecutedBlock, CoupledPins, SlopePins {
  std::int32_t RatioNumerator = 1;
  std::uint32_t RatioDenominator = 1;
  std::uint32_t Mode = 0;
  std::int16_t BufferMode = static_cast<std::int16_t>(plcopen::BufferMode::aborting);
  bool InGear = false;
  void call(MotionKernel& kernel) override;
};

/// MC_CamOut and MC_GearOut: each lets go of its own kind of coupling.
template <Command command>
struct Uncoupling final : ExecutedBlock {
  AxisRef Slave;
  void call(MotionKernel& kernel) override;
};
using McCamOut = Uncoupling<Command::cam_out>;
using McGearOut = Uncoupling<Command::gear_out>;

struct McPhasing final : ExecutedBlock, CoupledPins, SlopePins {
  double PhaseShift = 0;
  double Velocity = 0;
  void call(MotionKernel& kernel) override;
  void visit(StateArchive& archive) override;

 private:
  std::uint64_t shift_ = 0;  ///< number of this block's shift
};

/// Changes a cam table while the controller runs: one element at each edge of Execute. Ours, not ISG's, whose
/// programs write into the table's memory.
struct CamTableWrite final : ExecutedBlock {
  std::uint16_t CamTableID = 0;
  bool Change = false;
  std::uint32_t Line = 1;
  std::uint16_t Column = 1;
  double Value = 0;
  bool Changing = false;
  void call(MotionKernel& kernel) override;
  void visit(StateArchive& archive) override;

 private:
  void change(MotionKernel& kernel);
  Edge change_edge_;
  ErrorId change_error_ = ErrorId::none;
  std::uint16_t changed_ = 0;  ///< table whose change this block has begun, 0 = none
};

}  // namespace drycut::devices::plcopen

// All function blocks, each with PLCopen's own pin names. Times are those of the caller's task: outputs
// change in call().
