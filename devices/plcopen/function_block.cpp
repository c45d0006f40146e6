#include "base/state_archive.hpp"
#include "devices/plcopen/function_blocks.hpp"

namespace drycut::devices::plcopen {

void ExecutedBlock::taken(const Order& order) {
  if (order.about.number >= 0) about = order.about;
  if (order.error != ErrorId::none) return refused(order.error);
  ticket_ = order.ticket;
  progress_ = Progress::active;
  Error = false;
  ErrorID = 0;
}

void ExecutedBlock::answered(const Order& order) {
  taken(order);
  if (progress_ == Progress::active) progress_ = Progress::done;
}

void ExecutedBlock::refused(ErrorId error) {
  progress_ = Progress::failed;
  Error = true;
  ErrorID = static_cast<std::uint32_t>(error);
}

void ExecutedBlock::watch(const Axis* axis, bool goes_on) {
  const bool under_way = progress_ == Progress::waiting || progress_ == Progress::active ||
                         (progress_ == Progress::done && goes_on);
  if (axis != nullptr && under_way) {
    const CommandState now = axis->state_of(ticket_);
    progress_ = now.progress;
    if (now.progress == Progress::failed) refused(now.error);
  }
  holds_ = axis != nullptr && goes_on && progress_ == Progress::done && axis->ticket() == ticket_ &&
           axis->state() != AxisState::standstill;
}

void ExecutedBlock::show() {
  const bool told = Execute || progress_ != shown_;
  shown_ = progress_;
  Done = told && progress_ == Progress::done;
  CommandAborted = told && progress_ == Progress::aborted;
  Active = progress_ == Progress::active || holds_;
  Busy = Active || progress_ == Progress::waiting;
  if (told) return;
  Error = false;
  ErrorID = 0;
}

void AxisCommand::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Axis);
  about = Axis;
  if (edge_.rising(Execute)) taken(axis == nullptr ? Order{ErrorId::no_such_axis} : give(kernel, *axis));
  watch(axis, goes_on());
  show();
}

void AxisAnswer::call(MotionKernel& kernel) {
  about = Axis;
  if (edge_.rising(Execute)) answered({answer(kernel, kernel.axis(Axis))});
  show();
}

void EnabledBlock::show_error(ErrorId error) {
  Error = error != ErrorId::none;
  ErrorID = static_cast<std::uint32_t>(error);
}

void AxisReading::call(MotionKernel& kernel) {
  const plcopen::Axis* axis = kernel.axis(Axis);
  about = Axis;
  const ErrorId error = axis == nullptr ? ErrorId::no_such_axis : check();
  show_error(Enable ? error : ErrorId::none);
  Valid = Busy = Enable && !Error;
  read(Valid ? axis : nullptr);
}

void FunctionBlock::visit(StateArchive& archive) { STATE(archive, about); }

void Edge::visit(StateArchive& archive) { STATE(archive, last_); }

void ExecutedBlock::visit(StateArchive& archive) {
  FunctionBlock::visit(archive);
  STATE(archive, edge_, ticket_, progress_, shown_, holds_);
}

}  // namespace drycut::devices::plcopen
