// What of a CAMMING4 is state.
#include "base/state_archive.hpp"
#include "devices/camming4/camming4.hpp"

namespace drycut::devices::camming4 {

void Law::visit(StateArchive& archive) { STATE(archive, ramps, count, length, mid_speed, exit_speed); }
void Softening::visit(StateArchive& archive) { STATE(archive, half_width, change, shape); }

void GrainResolution::visit(StateArchive& archive) { STATE(archive, measure, pulse); }
void Space::visit(StateArchive& archive) { STATE(archive, grains, fraction); }
void Point::visit(StateArchive& archive) { STATE(archive, bits, part, fraction); }
void Row::visit(StateArchive& archive) { archive.plain("codes", *this); }
void CamSettings::visit(StateArchive& archive) { STATE(archive, master, slave, decpt); }
void CamEvent::visit(StateArchive& archive) { STATE(archive, code, row); }
void Sector::visit(StateArchive& archive) {
  const bool was_entered = number != 0;
  STATE(archive, number);
  if (number == 0) {  // never entered, as most of the 128
    if (was_entered) *this = {};
    return;
  }
  STATE(archive, kind, row, reads_out, entered_ahead, law, arc, master, slave, entry_speed, exit_speed, exit);
}

void CamStart::visit(StateArchive& archive) { STATE(archive, master_count, slave_bits, slave_fraction); }
void CamLimits::visit(StateArchive& archive) { STATE(archive, acceleration, deceleration); }
void CamStep::ReadOut::visit(StateArchive& archive) { STATE(archive, row, codeQma); }
void CamStep::visit(StateArchive& archive) {
  STATE(archive, running, ended, waiting, row, codeM, slave_bits, slave_fraction, ratio, error, warnings,
        warning_count, master_shift, slave_shift, recovery, recovery_row, read_outs, read_out_count);
}
void Cam::visit(StateArchive& archive) {
  STATE(archive, settings_, limits_, table_, sectors_, step_, state_, current_, next_, next_row_,
        master_origin_, slave_origin_, loop_master_, loop_slave_, speed_, softening_, softening_due_,
        beginning_, jumped_, adjacent_, armed_, quota_, zero_rows_, update_rows_, last_master_, inside_,
        came_back_, told_gain_, told_loss_, laps_, regeared_);
}

void Recalculation::visit(StateArchive& archive) { STATE(archive, of_each_, left_); }
void Capture::visit(StateArchive& archive) { STATE(archive, slave, master, start, delay, late); }
void Camming4::visit(StateArchive& archive) {
  AnaloguePositioner::visit(archive);
  STATE(archive, master_, master_quota_, master_resolution_, master_frequency_, master_window_ms_,
        master_history_, master_history_next_, master_way_, master_moved_, master_rate_);
  STATE(archive, cam_, cam_start_, cam_starts_, slip_, slip_due_, recovery_, recovery_due_, recovery_running_,
        recovery_done_, recovery_way_);
  STATE(archive, enable_master_was_, master_released_, zero_master_, input_was_, capture_, recalculation_,
        inhibit_stop_ms_);
}

}  // namespace drycut::devices::camming4
