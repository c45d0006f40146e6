#include "base/state_archive.hpp"
#include "devices/plcopen/function_blocks.hpp"

namespace drycut::devices::plcopen {

void McPower::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  about = Axis;
  show_error(axis == nullptr ? ErrorId::no_such_axis : ErrorId::none);
  Status = false;
  if (axis == nullptr) return;
  if (Enable != last_) axis->power(Enable);
  last_ = Enable;
  Status = axis->powered();
  if (axis->state() == AxisState::errorstop) show_error(axis->error());
}

void McReset::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  about = Axis;
  if (edge_.rising(Execute)) {
    taken(axis == nullptr ? Order{ErrorId::no_such_axis} : axis->reset());
  } else if (axis != nullptr && progress_ == Progress::active && axis->ticket() == ticket_ &&
             axis->state() == AxisState::errorstop) {
    // The error that it resets is none of its own.
  } else {
    watch(axis);
  }
  show();
}

void McStop::call(MotionKernel& kernel) {
  AxisCommand::call(kernel);
  plcopen::Axis* axis = kernel.axis(Axis);
  if (!Execute && axis != nullptr && ticket_ != 0) axis->release_stop(ticket_);
}

Order MoveCommand::order(MotionKernel& kernel, Command command, double way, std::int16_t direction) const {
  return kernel.give(Axis, MoveRequest{command, way, dynamics(Velocity), static_cast<Direction>(direction)},
                     static_cast<plcopen::BufferMode>(BufferMode));
}

void McMoveVelocity::call(MotionKernel& kernel) {
  AxisCommand::call(kernel);
  InVelocity = Done;
}

void McSetOverride::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  about = Axis;
  ErrorId error = ErrorId::none;
  if (Enable) error = axis == nullptr ? ErrorId::no_such_axis : axis->set_override(VelFactor);
  show_error(error);
  Enabled = Busy = Enable && !Error;
}

void McPower::visit(StateArchive& archive) {
  EnabledBlock::visit(archive);
  STATE(archive, last_);
}

}  // namespace drycut::devices::plcopen
