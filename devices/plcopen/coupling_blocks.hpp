#pragma once
#include "devices/plcopen/function_block.hpp"

// The blocks of cams and gears (004), in the units of the movement blocks.
namespace drycut::devices::plcopen {

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

 private:
  void change(MotionKernel& kernel);
  Edge change_edge_;
  ErrorId change_error_ = ErrorId::none;
  std::uint16_t changed_ = 0;  ///< table whose change this block has begun, 0 = none
};

}  // namespace drycut::devices::plcopen
