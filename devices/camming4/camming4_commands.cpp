#include <fmt/format.h>

#include <algorithm>

#include "devices/axis/limits.hpp"
#include "devices/camming4/camming4.hpp"
#include "devices/camming4/messages.hpp"
#include "devices/camming4/rows.hpp"

namespace drycut::devices::camming4 {

bool Camming4::may_execute(int command) {
  switch (command) {
    case c_PRESET:
      return state(st_still) || state(st_prson);
    case c_STOPCAM:
      return inhibit_stop_ms_ <= 0;
    case c_INTDSBL:
      return value(v_intcapt) > 0;
    default:
      return true;
  }
}

void Camming4::refused(int) { warn(11, value(v_rowex)); }

void Camming4::execute(int command) {
  switch (command) {
    case c_EMRG:
      emergency();
      break;
    case c_RESUME:
    case c_CALOFF:
    case c_REGON:
      axis_.settle();
      break;
    case c_PRESETM:
      if (value(v_prsmodem) == 2) break;  // no search: the enable loads
      set_state(st_prsonm, true);
      set_state(st_prsokm, false);
      master_released_ = false;
      break;
    case c_RSPRSM:
      set_state(state(st_prsonm) ? st_prsonm : st_prsokm, false);
      break;
    case c_RSERR:
      value(v_errcode) = value(v_errvalue) = 0;
      break;
    case c_RSWRN:
      value(v_wrncode) = value(v_wrnvalue) = 0;
      break;
    case c_DELCNT:
      axis_.quota.add_um(value(v_delta1), axis_.settings.resolution);
      break;
    case c_DELCNTM:
      master_quota_.add_um(value(v_delta2), master_resolution_);
      break;
    case c_LOOPON:
      // In a cam the table goes on from where the axis is; else the axis would jump after it.
      slip_due_ = state(st_camex);
      if (!slip_due_) axis_.settle();
      break;
    case c_CALON:
      rest();
      value(v_vout) = 0;  // it showed the running output: calibration begins at 0 V
      break;
    case c_INTDSBL:
      capture_.reset();
      break;
    default:
      execute_motion(command);
      break;
  }
}

void Camming4::execute_motion(int command) {
  switch (command) {
    case c_STOP:
      search_.abort();
      set_state(st_prson, false);
      axis_.stop();
      break;
    case c_START:
      start_placement();
      break;
    case c_PRESET:
      preset();
      break;
    case c_MANFW:
      start_manual(false);
      break;
    case c_MANBW:
      start_manual(true);
      break;
    case c_STARTCAM:
      start_cam(master_.total());
      break;
    case c_STOPCAM:
      stop_cam();
      break;
    default:
      break;
  }
}

std::int32_t Camming4::clamped(std::int32_t quota) const {
  return axis::held(quota, value(v_minpos), value(v_maxpos));
}

void Camming4::tell_maxvel() {
  if (value(v_maxvel) <= 0) report(axis::without_maxvel(value(v_maxvel)));
}

void Camming4::start_placement() {
  const std::int32_t wanted = value(v_setpos);
  const std::int32_t target = clamped(wanted);
  if (target != wanted) report(axis::outside_limits(wanted, target));
  tell_maxvel();
  set_state(st_still, false);
  axis_.place(target, value(v_setvel));
}

void Camming4::start_manual(bool backward) {
  const std::int32_t limit = value(backward ? v_minpos : v_maxpos);
  if (axis::at_limit(backward, value(v_posit), limit)) {
    report(axis::no_way_left(backward, value(v_posit), limit));
    return;
  }
  tell_maxvel();
  set_state(st_still, false);
  axis_.run(backward, limit, value(v_setvel));
}

void Camming4::start_cam(std::int64_t master) {
  rest();
  axis_.settle_if_open();
  tell_maxvel();
  cam_.set(
      CamSettings{{value(v_measurem), value(v_pulsem)}, {value(v_measure), value(v_pulse)}, value(v_decpt)});
  axis::Theoretical slave = axis_.theoretical();
  if (slave.part < 0) {
    --slave.whole;
    slave.part = std::min(slave.part + 1, 1 - 1e-12);
  }
  cam_start_ = {master, slave.whole, slave.part};
  ++cam_starts_;
  cam_.start(cam_start_);
  for (int row = 0; row < cam_rows; ++row) value(v_codeQma, row) = cam_.row(row + 1).codeQma;
  set_state(st_camex, true);
}

void Camming4::stop_cam() {
  const double speed = cam_speed();
  leave_cam();
  set_state(st_still, false);
  axis_.brake(speed);
}

void Camming4::leave_cam() {
  cam_.stop();
  reset_recovery();
  slip_ = 0;
  slip_due_ = false;
  set_state(st_camex, false);
  value(v_rowex) = value(v_codeMex) = 0;
}

void Camming4::reset_recovery() {
  recovery_.abort();
  recovery_due_ = recovery_running_ = recovery_done_ = 0;
  recovery_way_ = 0;
}

void Camming4::rest() {
  if (state(st_camex)) leave_cam();
  search_.abort();
  axis_.abort();
  set_state(st_prson, false);
  set_state(st_still, true);
}

void Camming4::emergency() {
  rest();
  set_state(st_emrg, true);
  value(v_vout) = 0;  // a calibration does not come back with its voltage
}

void Camming4::fail(int code, int row) {
  set_state(st_error, true);
  value(v_errcode) = code;
  value(v_errvalue) = row;
  report({Diagnostic::Kind::note, "st_error",
          fmt::format("error {} in row {}: {}", code, row, error_text(code))});
  emergency();
}

void Camming4::warn(int code, int row) {
  if (state(st_warning)) {
    if (code == value(v_wrncode) && row == value(v_wrnvalue)) return;
    if (warning_priority(code) > warning_priority(value(v_wrncode))) return;
  }
  set_state(st_warning, true);
  value(v_wrncode) = code;
  value(v_wrnvalue) = row;
  report({Diagnostic::Kind::note, "st_warning",
          fmt::format("warning {} in row {}: {}", code, row, warning_text(code))});
}

}  // namespace drycut::devices::camming4
