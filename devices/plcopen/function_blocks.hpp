#pragma once
#include <cstdint>

#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/pins.hpp"

// The function blocks, each with PLCopen's own pin names. Times are those of the caller's task: outputs
// change in call(). Units: positions 0.1 um or 0.0001 deg, speeds um/s or 0.001 deg/s, accelerations mm/s2 or
// deg/s2, jerks mm/s3 or deg/s3.
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

/// What all blocks with Execute share: ticket, error, abortion.
struct ExecutedBlock : FunctionBlock {
  bool Execute = false;
  bool Error = false;
  std::uint32_t ErrorID = 0;

 protected:
  enum class Watch : std::uint8_t { idle, busy, done, aborted, failed };
  /// Takes an order given at an edge: the outputs of the last one are gone.
  void taken(const Order& order);
  void refused(ErrorId error);
  /// Looks after the order given to `axis`. A command that `goes_on` once done, a speed or a coupling, is
  /// still aborted or ended by an error; another one keeps its Done.
  Watch watch(const Axis* axis, bool goes_on = false);
  /// Execute is FALSE: outputs go FALSE too, the command goes on.
  void released();

  Edge edge_;
  std::uint64_t ticket_ = 0;
  Watch watch_ = Watch::idle;
};

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

struct McHome final : ExecutedBlock {
  AxisRef Axis;
  double Position = 0;
  bool Done = false;
  bool CommandAborted = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McReset final : ExecutedBlock {
  AxisRef Axis;
  bool Done = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McStop final : ExecutedBlock {
  AxisRef Axis;
  double Deceleration = 0;
  double Jerk = 0;
  bool Done = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McHalt final : ExecutedBlock {
  AxisRef Axis;
  double Deceleration = 0;
  double Jerk = 0;
  bool Done = false;
  bool CommandAborted = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McMoveAbsolute final : ExecutedBlock {
  AxisRef Axis;
  double Position = 0;
  double Velocity = 0;
  double Acceleration = 0;
  double Deceleration = 0;
  double Jerk = 0;
  std::int16_t Direction = static_cast<std::int16_t>(plcopen::Direction::shortest_way);
  bool Done = false;
  bool CommandAborted = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McMoveVelocity final : ExecutedBlock {
  AxisRef Axis;
  double Velocity = 0;
  double Acceleration = 0;
  double Deceleration = 0;
  double Jerk = 0;
  std::int16_t Direction = static_cast<std::int16_t>(plcopen::Direction::positive);
  bool InVelocity = false;
  bool CommandAborted = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McCamTableSelect final : ExecutedBlock {
  AxisRef Master;
  AxisRef Slave;
  CamRef CamTable;
  bool Done = false;
  std::uint16_t CamTableID = 0;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McCamIn final : ExecutedBlock {
  AxisRef Master;
  AxisRef Slave;
  double MasterOffset = 0;
  double SlaveOffset = 0;
  double MasterScaling = 1;
  double SlaveScaling = 1;
  std::uint32_t StartMode = 0;
  std::uint16_t CamTableID = 0;
  std::uint32_t TableFctType = static_cast<std::uint32_t>(Interpolation::table_defined);
  bool InSync = false;
  bool CommandAborted = false;
  bool EndOfProfile = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;

 private:
  std::int64_t ends_seen_ = 0;
};

struct McCamOut final : ExecutedBlock {
  AxisRef Slave;
  bool Done = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McGearIn final : ExecutedBlock {
  AxisRef Master;
  AxisRef Slave;
  std::int32_t RatioNumerator = 1;
  std::uint32_t RatioDenominator = 1;
  double Acceleration = 0;
  double Deceleration = 0;
  double Jerk = 0;
  std::uint32_t Mode = 0;
  bool InGear = false;
  bool CommandAborted = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McGearOut final : ExecutedBlock {
  AxisRef Slave;
  bool Done = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;
};

struct McPhasing final : ExecutedBlock {
  AxisRef Master;
  AxisRef Slave;
  double PhaseShift = 0;
  double Velocity = 0;
  double Acceleration = 0;
  double Deceleration = 0;
  double Jerk = 0;
  bool Done = false;
  bool CommandAborted = false;
  void call(MotionKernel& kernel) override;
  PinValue pin(std::size_t number) override;

 private:
  std::uint64_t shift_ = 0;  ///< number of this block's shift
};

}  // namespace drycut::devices::plcopen
