#include "devices/plcopen/function_blocks.hpp"

#include <cmath>

#include "base/state_archive.hpp"
#include "devices/plcopen/axis.hpp"

namespace drycut::devices::plcopen {
namespace {

/// Each axis with an encoder has one probe, number 0.
ErrorId check_probe(const Axis* axis, std::uint16_t number) {
  if (axis == nullptr) return ErrorId::no_such_axis;
  const bool has_encoder = axis->parameters().kind != AxisKind::virtual_axis;
  return has_encoder && number == 0 ? ErrorId::none : ErrorId::no_such_probe;
}

double within_turn(double position, double modulo) {
  return position - modulo * std::floor(position / modulo);
}

}  // namespace

void McReadStatus::read(const plcopen::Axis* axis) {
  const auto is = [&](AxisState state) { return axis != nullptr && axis->state() == state; };
  Errorstop = is(AxisState::errorstop);
  Disabled = is(AxisState::disabled);
  Stopping = is(AxisState::stopping);
  Homing = is(AxisState::homing);
  Standstill = is(AxisState::standstill);
  DiscreteMotion = is(AxisState::discrete_motion);
  ContinuousMotion = is(AxisState::continuous_motion);
  SynchronizedMotion = is(AxisState::synchronized_motion);
}

void McReadAxisInfo::read(const plcopen::Axis* axis) {
  const AxisKind kind = axis == nullptr ? AxisKind::drive : axis->parameters().kind;
  Simulation = axis != nullptr && kind == AxisKind::virtual_axis;
  CommunicationReady = axis != nullptr;
  ReadyForPowerOn = axis != nullptr && (kind != AxisKind::drive || axis->drive.ready);
  PowerOn = axis != nullptr && axis->powered();
  IsHomed = axis != nullptr && axis->homed();
  AxisWarning = axis != nullptr && axis->warning();
}

void McReadMotionState::read(const plcopen::Axis* axis) {
  const AxisMotion set = axis == nullptr ? AxisMotion{} : axis->set();
  const double grows = set.acceleration * (set.velocity < 0 ? -1 : 1);
  ConstantVelocity = axis != nullptr && set.acceleration == 0;
  Accelerating = set.velocity != 0 ? grows > 0 : set.acceleration != 0;
  Decelerating = set.velocity != 0 && grows < 0;
  DirectionPositive = set.velocity > 0;
  DirectionNegative = set.velocity < 0;
  IsMoving = set.velocity != 0;
  LrCommandedPos = axis == nullptr ? 0 : axis->target().part;
  LrActualPos = axis == nullptr ? 0 : axis->actual().part;
  LrSetPos = set.position.part;
  LrActualRev = axis == nullptr ? 0 : axis->actual_velocity() / increments_per_speed;
  LrSetRev = set.velocity / increments_per_speed;
  LrSetAccel = set.acceleration / increments_per_acceleration;
  RevZero = axis != nullptr && axis->actual_velocity() == 0;
  InWindow = axis != nullptr && std::abs(difference(axis->target(), axis->actual(), axis->modulo())) <=
                                    axis->parameters().window;
  InPosition = InWindow && !IsMoving;
}

ErrorId McReadParameter::check() const {
  return find_numbered_parameter(ParameterNumber) == nullptr ? ErrorId::no_such_parameter : ErrorId::none;
}

void McReadParameter::read(const plcopen::Axis* axis) {
  Value = axis == nullptr ? 0 : find_numbered_parameter(ParameterNumber)->read(*axis);
}

ErrorId McWriteParameter::answer(MotionKernel& /*kernel*/, plcopen::Axis* axis) {
  return axis == nullptr ? ErrorId::no_such_axis : write_numbered_parameter(*axis, ParameterNumber, Value);
}

ErrorId McTouchProbe::check(const plcopen::Axis* axis) const {
  constexpr double most = 2147483648.0;
  if (const ErrorId error = check_probe(axis, TriggerInput); error != ErrorId::none) return error;
  if (!WindowOnly) return ErrorId::none;
  const bool in_range = std::abs(FirstPosition) <= most && std::abs(LastPosition) <= most;
  return in_range && (axis->modulo() > 0 || FirstPosition <= LastPosition) ? ErrorId::none
                                                                           : ErrorId::position_range;
}

bool McTouchProbe::wanted(double position, double modulo) const {
  if (!WindowOnly) return true;
  if (modulo <= 0) return position >= FirstPosition && position <= LastPosition;
  return within_turn(position - FirstPosition, modulo) <= within_turn(LastPosition - FirstPosition, modulo);
}

void McTouchProbe::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  about = Axis;
  if (edge_.rising(Execute)) {
    const ErrorId error = check(axis);
    taken(error != ErrorId::none ? Order{error} : Order{ErrorId::none, axis->take_probe()});
    if (error == ErrorId::none) edges_ = axis->drive.probe_edges;
  }
  if (progress_ == Progress::active && axis != nullptr) {
    if (axis->probe_ticket() != ticket_) {
      progress_ = Progress::aborted;
    } else if (axis->drive.probe_edges != edges_) {
      edges_ = axis->drive.probe_edges;
      const double position = axis->probe_position().part;
      if (wanted(position, axis->modulo())) {
        RecordedPosition = position;
        progress_ = Progress::done;
      }
    }
  }
  show();
}

ErrorId McAbortTrigger::answer(MotionKernel& /*kernel*/, plcopen::Axis* axis) {
  const ErrorId error = check_probe(axis, TriggerInput);
  if (error == ErrorId::none) axis->take_probe();
  return error;
}

void McTouchProbe::visit(StateArchive& archive) {
  ExecutedBlock::visit(archive);
  STATE(archive, edges_);
}

}  // namespace drycut::devices::plcopen
