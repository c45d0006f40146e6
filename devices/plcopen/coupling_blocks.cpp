#include "base/state_archive.hpp"
#include "devices/plcopen/function_blocks.hpp"

namespace drycut::devices::plcopen {

void McCamTableSelect::call(MotionKernel& kernel) {
  about = Slave;
  if (edge_.rising(Execute)) {
    const plcopen::McCamTable* table =
        CamTable.file.empty() ? kernel.tables().find(CamTable.id) : kernel.tables().find_file(CamTable.file);
    const bool axes = kernel.axis(Master) != nullptr && kernel.axis(Slave) != nullptr;
    ErrorId error = table == nullptr ? ErrorId::selected_table_missing : ErrorId::none;
    if (!axes) error = ErrorId::no_such_axis;
    answered({error});
    CamTableID = error == ErrorId::none ? table->id : std::uint16_t{0};
  }
  show();
}

void McCamIn::call(MotionKernel& kernel) {
  const plcopen::Axis* axis = kernel.axis(Slave);
  about = Slave;
  EndOfProfile = false;
  if (edge_.rising(Execute)) {
    const std::uint64_t own = axis != nullptr && axis->ticket() == ticket_ ? ticket_ : 0;
    taken(kernel.give(Slave,
                      CamInRequest{Master, Slave, MasterOffset, SlaveOffset, MasterScaling, SlaveScaling,
                                   StartMode, CamTableID, TableFctType},
                      static_cast<plcopen::BufferMode>(BufferMode), own));
    if (ticket_ != own) ends_seen_ = 0;
  }
  watch(axis, true);
  const bool in_force = axis != nullptr && axis->ticket() == ticket_;
  if (in_force) {
    EndOfProfile = axis->profile_ends() != ends_seen_;
    ends_seen_ = axis->profile_ends();
  }
  show();
  // A pass that has ended leaves its command in force, but nothing follows it any more.
  InSync = Done && in_force && axis->in_place();
}

void McGearIn::call(MotionKernel& kernel) {
  const plcopen::Axis* axis = kernel.axis(Slave);
  about = Slave;
  if (edge_.rising(Execute)) {
    taken(kernel.give(Slave,
                      GearInRequest{Master, Slave, RatioNumerator, RatioDenominator, dynamics(0), Mode},
                      static_cast<plcopen::BufferMode>(BufferMode)));
  }
  watch(axis, true);
  show();
  InGear = Done && axis != nullptr && axis->in_place();
}

template <Command command>
void Uncoupling<command>::call(MotionKernel& kernel) {
  plcopen::Axis* axis = kernel.axis(Slave);
  about = Slave;
  if (edge_.rising(Execute)) taken(axis == nullptr ? Order{ErrorId::no_such_axis} : axis->uncouple(command));
  watch(axis);
  show();
}
template struct Uncoupling<Command::cam_out>;
template struct Uncoupling<Command::gear_out>;

void McPhasing::call(MotionKernel& kernel) {
  const plcopen::Axis* axis = kernel.axis(Slave);
  about = Slave;
  if (edge_.rising(Execute)) {
    taken(kernel.phase(Master, Slave, PhaseShift, dynamics(Velocity)));
    if (progress_ == Progress::active) shift_ = axis->coupling()->shifts();
  }
  if (progress_ == Progress::active && axis != nullptr) {
    if (axis->ticket() != ticket_ || axis->coupling() == nullptr || axis->coupling()->shifts() != shift_) {
      progress_ = Progress::aborted;
    } else if (axis->coupling()->phase_shifted()) {
      progress_ = Progress::done;
    }
  }
  show();
}

void CamTableWrite::change(MotionKernel& kernel) {
  if (change_edge_.rising(Change)) {
    change_error_ = kernel.begin_table_change(CamTableID);
    changed_ = change_error_ == ErrorId::none ? CamTableID : std::uint16_t{0};
  }
  if (Change) return;
  // It ends for the table for which it began, whatever CamTableID says now.
  if (changed_ != 0) kernel.end_table_change(changed_);
  changed_ = 0;
  change_error_ = ErrorId::none;
}

void CamTableWrite::call(MotionKernel& kernel) {
  change(kernel);
  // The program counts from 1; a 0 wraps to a line or column that no table has.
  if (edge_.rising(Execute)) answered({kernel.write_table(CamTableID, Line - 1U, Column - 1, Value)});
  show();
  Changing = changed_ != 0;
  if (Error || change_error_ == ErrorId::none) return;
  Error = true;
  ErrorID = static_cast<std::uint32_t>(change_error_);
}

void McCamIn::visit(StateArchive& archive) {
  ExecutedBlock::visit(archive);
  STATE(archive, ends_seen_);
}

void McPhasing::visit(StateArchive& archive) {
  ExecutedBlock::visit(archive);
  STATE(archive, shift_);
}

void CamTableWrite::visit(StateArchive& archive) {
  ExecutedBlock::visit(archive);
  STATE(archive, change_edge_, change_error_, changed_);
}

}  // namespace drycut::devices::plcopen
