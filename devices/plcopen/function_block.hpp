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

/// What all blocks with Execute share: ticket, end, error, abortion. A block whose table has no pin for one
/// of these outputs does not show it.
struct ExecutedBlock : FunctionBlock {
  bool Execute = false;
  bool Done = false;
  bool CommandAborted = false;
  bool Error = false;
  std::uint32_t ErrorID = 0;

 protected:
  enum class Watch : std::uint8_t { idle, busy, done, aborted, failed };
  /// Takes an order given at an edge: the outputs of the last one are gone.
  void taken(const Order& order);
  /// Takes what is done at the edge itself, or refused.
  void answered(ErrorId error);
  void refused(ErrorId error);
  /// Looks after the order given to `axis`. A command that `goes_on` once done, a speed or a coupling, is
  /// still aborted or ended by an error; another one keeps its Done.
  void watch(const Axis* axis, bool goes_on = false);
  /// Writes the outputs. When Execute is FALSE they are FALSE too; the command goes on.
  void show();

  Edge edge_;
  std::uint64_t ticket_ = 0;
  Watch watch_ = Watch::idle;
};

/// A block that gives its axis one command and looks after it until it is done.
struct AxisCommand : ExecutedBlock {
  AxisRef Axis;
  void call(MotionKernel& kernel) override;

 protected:
  virtual Order give(plcopen::Axis& axis) = 0;
};

/// A block with Enable that reads from its axis in every call.
struct AxisReading : FunctionBlock {
  AxisRef Axis;
  bool Enable = false;
  bool Valid = false;
  bool Error = false;
  std::uint32_t ErrorID = 0;
  void call(MotionKernel& kernel) override;

 protected:
  /// nullptr: there is nothing to read, the outputs go to 0.
  virtual void read(const plcopen::Axis* axis) = 0;
};

}  // namespace drycut::devices::plcopen
