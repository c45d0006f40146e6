#include "devices/plcopen/function_block.hpp"

namespace drycut::devices::plcopen {

void ExecutedBlock::taken(const Order& order) {
  if (order.error != ErrorId::none) return refused(order.error);
  ticket_ = order.ticket;
  watch_ = Watch::busy;
  Error = false;
  ErrorID = 0;
}

void ExecutedBlock::answered(ErrorId error) {
  taken({error});
  if (watch_ == Watch::busy) watch_ = Watch::done;
}

void ExecutedBlock::refused(ErrorId error) {
  watch_ = Watch::failed;
  Error = true;
  ErrorID = static_cast<std::uint32_t>(error);
}

void ExecutedBlock::watch(const Axis* axis, bool goes_on) {
  const bool under_way = watch_ == Watch::busy || (watch_ == Watch::done && goes_on);
  if (axis == nullptr || !under_way) return;
  if (axis->ticket() != ticket_) {
    watch_ = Watch::aborted;
  } else if (axis->state() == AxisState::errorstop && axis->error() != ErrorId::none) {
    refused(axis->error());
  } else if (axis->done()) {
    watch_ = Watch::done;
  }
}

void ExecutedBlock::show() {
  Done = Execute && watch_ == Watch::done;
  CommandAborted = Execute && watch_ == Watch::aborted;
  if (Execute) return;
  Error = false;
  ErrorID = 0;
}

void AxisCommand::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  if (edge_.rising(Execute)) taken(axis == nullptr ? Order{ErrorId::no_such_axis} : give(*axis));
  watch(axis);
  show();
}

void AxisReading::call(MotionKernel& kernel) {
  const plcopen::Axis* axis = Enable ? kernel.axis(Axis) : nullptr;
  Valid = axis != nullptr;
  Error = Enable && !Valid;
  ErrorID = Error ? static_cast<std::uint32_t>(ErrorId::no_such_axis) : 0;
  read(axis);
}

}  // namespace drycut::devices::plcopen
