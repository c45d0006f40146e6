#pragma once
#include "devices/plcopen/function_block.hpp"

// The blocks that read an axis, and its touch probe, in the units of the movement blocks.
namespace drycut::devices::plcopen {

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

}  // namespace drycut::devices::plcopen
