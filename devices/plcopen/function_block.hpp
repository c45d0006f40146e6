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

}  // namespace drycut::devices::plcopen
