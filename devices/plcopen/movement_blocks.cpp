#include "devices/plcopen/movement_blocks.hpp"

namespace drycut::devices::plcopen {

void McPower::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  Error = axis == nullptr;
  ErrorID = Error ? static_cast<std::uint32_t>(ErrorId::no_such_axis) : 0;
  Status = false;
  if (axis == nullptr) return;
  if (Enable != last_) axis->power(Enable);
  last_ = Enable;
  Status = axis->powered();
  if (axis->state() == AxisState::errorstop) {
    Error = true;
    ErrorID = static_cast<std::uint32_t>(axis->error());
  }
}

void McReset::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  if (edge_.rising(Execute)) {
    taken(axis == nullptr ? Order{ErrorId::no_such_axis} : axis->reset());
  } else if (axis != nullptr && watch_ == Watch::busy && axis->ticket() == ticket_ &&
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

void McMoveVelocity::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  if (edge_.rising(Execute)) {
    taken(axis == nullptr ? Order{ErrorId::no_such_axis}
                          : axis->move_velocity(Velocity, {0, Acceleration, Deceleration, Jerk},
                                                static_cast<plcopen::Direction>(Direction)));
  }
  // At its speed the axis is not done: another command aborts it still.
  watch(axis, true);
  show();
  InVelocity = Done;
}

void McSetPosition::call(MotionKernel& kernel) {
  if (edge_.rising(Execute)) answered(kernel.set_position(Axis, Position, Relative));
  show();
}

void McSetOverride::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  ErrorId error = ErrorId::none;
  if (Enable) error = axis == nullptr ? ErrorId::no_such_axis : axis->set_override(VelFactor);
  Error = error != ErrorId::none;
  ErrorID = static_cast<std::uint32_t>(error);
  Enabled = Enable && !Error;
}

}  // namespace drycut::devices::plcopen
