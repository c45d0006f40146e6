#include "devices/plcopen/function_blocks.hpp"

namespace drycut::devices::plcopen {

void ExecutedBlock::taken(const Order& order) {
  if (order.error != ErrorId::none) return refused(order.error);
  ticket_ = order.ticket;
  watch_ = Watch::busy;
  Error = false;
  ErrorID = 0;
}

void ExecutedBlock::refused(ErrorId error) {
  watch_ = Watch::failed;
  Error = true;
  ErrorID = static_cast<std::uint32_t>(error);
}

ExecutedBlock::Watch ExecutedBlock::watch(const Axis* axis, bool goes_on) {
  if (axis == nullptr || watch_ == Watch::idle || watch_ == Watch::failed || watch_ == Watch::aborted)
    return watch_;
  if (watch_ == Watch::done && !goes_on) return watch_;
  if (axis->ticket() != ticket_) {
    watch_ = Watch::aborted;
  } else if (axis->state() == AxisState::errorstop && axis->error() != ErrorId::none) {
    refused(axis->error());
  } else if (axis->done()) {
    watch_ = Watch::done;
  }
  return watch_;
}

void ExecutedBlock::released() {
  Error = false;
  ErrorID = 0;
}

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

void McHome::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  if (edge_.rising(Execute)) taken(axis == nullptr ? Order{ErrorId::no_such_axis} : axis->home(Position));
  const Watch now = watch(axis);
  Done = Execute && now == Watch::done;
  CommandAborted = Execute && now == Watch::aborted;
  if (!Execute) released();
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
  Done = Execute && watch_ == Watch::done;
  if (!Execute) released();
}

void McStop::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  if (edge_.rising(Execute)) {
    taken(axis == nullptr ? Order{ErrorId::no_such_axis}
                          : axis->stop({.deceleration = Deceleration, .jerk = Jerk}));
  }
  const Watch now = watch(axis);
  Done = Execute && now == Watch::done;
  if (Execute) return;
  if (axis != nullptr && ticket_ != 0) axis->release_stop(ticket_);
  released();
}

void McHalt::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  if (edge_.rising(Execute)) {
    taken(axis == nullptr ? Order{ErrorId::no_such_axis}
                          : axis->halt({.deceleration = Deceleration, .jerk = Jerk}));
  }
  const Watch now = watch(axis);
  Done = Execute && now == Watch::done;
  CommandAborted = Execute && now == Watch::aborted;
  if (!Execute) released();
}

void McMoveAbsolute::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  if (edge_.rising(Execute)) {
    taken(axis == nullptr ? Order{ErrorId::no_such_axis}
                          : axis->move_absolute(Position, {Velocity, Acceleration, Deceleration, Jerk},
                                                static_cast<plcopen::Direction>(Direction)));
  }
  const Watch now = watch(axis);
  Done = Execute && now == Watch::done;
  CommandAborted = Execute && now == Watch::aborted;
  if (!Execute) released();
}

void McMoveVelocity::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  if (edge_.rising(Execute)) {
    taken(axis == nullptr ? Order{ErrorId::no_such_axis}
                          : axis->move_velocity(Velocity, {0, Acceleration, Deceleration, Jerk},
                                                static_cast<plcopen::Direction>(Direction)));
  }
  // At its speed the axis is not done: another command aborts it still.
  const Watch now = watch(axis, true);
  InVelocity = Execute && now == Watch::done;
  CommandAborted = Execute && now == Watch::aborted;
  if (!Execute) released();
}

void McCamTableSelect::call(MotionKernel& kernel) {
  if (edge_.rising(Execute)) {
    const plcopen::CamTable* table =
        CamTable.file.empty() ? kernel.tables().find(CamTable.id) : kernel.tables().find_file(CamTable.file);
    released();
    watch_ = Watch::done;
    if (kernel.axis(Master) == nullptr || kernel.axis(Slave) == nullptr) {
      refused(ErrorId::no_such_axis);
    } else if (table == nullptr) {
      refused(ErrorId::selected_table_missing);
    }
    CamTableID = watch_ == Watch::done ? table->id : std::uint16_t{0};
  }
  Done = Execute && watch_ == Watch::done;
  if (!Execute) released();
}

void McCamIn::call(MotionKernel& kernel) {
  const plcopen::Axis* axis = kernel.axis(Slave);
  EndOfProfile = false;
  if (edge_.rising(Execute)) {
    const std::uint64_t own = axis != nullptr && axis->ticket() == ticket_ ? ticket_ : 0;
    taken(kernel.cam_in({Master, Slave, MasterOffset, SlaveOffset, MasterScaling, SlaveScaling, StartMode,
                         CamTableID, TableFctType},
                        own));
    if (axis != nullptr && own == 0) ends_seen_ = axis->profile_ends();
  }
  const Watch now = watch(axis, true);
  if (axis != nullptr && axis->ticket() == ticket_) {
    EndOfProfile = axis->profile_ends() != ends_seen_;
    ends_seen_ = axis->profile_ends();
  }
  // A pass that has ended leaves its command in force, but nothing follows it any more.
  InSync =
      Execute && now == Watch::done && axis != nullptr && axis->state() == AxisState::synchronized_motion;
  CommandAborted = Execute && now == Watch::aborted;
  if (!Execute) released();
}

void McCamOut::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Slave);
  if (edge_.rising(Execute))
    taken(axis == nullptr ? Order{ErrorId::no_such_axis} : axis->uncouple(Command::cam_out));
  Done = Execute && watch(axis) == Watch::done;
  if (!Execute) released();
}

void McGearIn::call(MotionKernel& kernel) {
  const plcopen::Axis* axis = kernel.axis(Slave);
  if (edge_.rising(Execute)) {
    taken(kernel.gear_in(
        {Master, Slave, RatioNumerator, RatioDenominator, {0, Acceleration, Deceleration, Jerk}, Mode}));
  }
  const Watch now = watch(axis, true);
  InGear = Execute && now == Watch::done;
  CommandAborted = Execute && now == Watch::aborted;
  if (!Execute) released();
}

void McGearOut::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Slave);
  if (edge_.rising(Execute))
    taken(axis == nullptr ? Order{ErrorId::no_such_axis} : axis->uncouple(Command::gear_out));
  Done = Execute && watch(axis) == Watch::done;
  if (!Execute) released();
}

void McPhasing::call(MotionKernel& kernel) {
  const plcopen::Axis* axis = kernel.axis(Slave);
  if (edge_.rising(Execute)) {
    taken({kernel.phase(Master, Slave, PhaseShift, {Velocity, Acceleration, Deceleration, Jerk}),
           axis != nullptr ? axis->ticket() : 0});
    if (watch_ == Watch::busy && axis != nullptr) shift_ = axis->coupling()->shifts();
  }
  if (watch_ == Watch::busy && axis != nullptr) {
    if (axis->ticket() != ticket_ || axis->coupling() == nullptr || axis->coupling()->shifts() != shift_) {
      watch_ = Watch::aborted;
    } else if (axis->coupling()->phase_shifted()) {
      watch_ = Watch::done;
    }
  }
  Done = Execute && watch_ == Watch::done;
  CommandAborted = Execute && watch_ == Watch::aborted;
  if (!Execute) released();
}

}  // namespace drycut::devices::plcopen
