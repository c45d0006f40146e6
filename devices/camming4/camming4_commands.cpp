#include <fmt/format.h>

#include <algorithm>

#include "devices/camming4/camming4.hpp"
#include "devices/camming4/messages.hpp"

namespace drycut::devices::camming4 {

bool Camming4::may_execute(int command) {
  switch (command) {
    case CommandRow("STOPCAM"):
      return inhibit_stop_ms_ <= 0;
    case CommandRow("INTDSBL"):
      return value("intcapt") > 0;
    default:
      return AnaloguePositioner::may_execute(command);
  }
}

void Camming4::refused(int) { warn(11, value("rowex")); }

void Camming4::execute(int command) {
  switch (command) {
    case CommandRow("EMRG"):
      emergency();
      break;
    case CommandRow("PRESETM"):
      if (value("prsmodem") == 2) break;  // no search: the enable loads
      set_state("st_prsonm", true);
      set_state("st_prsokm", false);
      master_released_ = false;
      break;
    case CommandRow("RSPRSM"):
      set_state(state("st_prsonm") ? StateRow("st_prsonm") : StateRow("st_prsokm"), false);
      break;
    case CommandRow("RSERR"):
      value("errcode") = value("errvalue") = 0;
      break;
    case CommandRow("RSWRN"):
      value("wrncode") = value("wrnvalue") = 0;
      break;
    case CommandRow("DELCNT"):
      axis_.quota.add_um(value("delta1"), axis_.settings.resolution);
      break;
    case CommandRow("DELCNTM"):
      master_quota_.add_um(value("delta2"), master_resolution_);
      break;
    case CommandRow("LOOPON"):
      // In a cam the table goes on from where the axis is; else the axis would jump after it.
      slip_due_ = state("st_camex");
      if (!slip_due_) AnaloguePositioner::execute(command);
      break;
    case CommandRow("CALON"):
      rest();
      value("vout") = 0;  // it showed the running output: calibration begins at 0 V
      break;
    case CommandRow("INTDSBL"):
      capture_.reset();
      break;
    case CommandRow("STARTCAM"):
      start_cam(master_.total());
      break;
    case CommandRow("STOPCAM"):
      stop_cam();
      break;
    default:
      AnaloguePositioner::execute(command);
      break;
  }
}

void Camming4::start_cam(std::int64_t master) {
  rest();
  axis_.settle_if_open();
  tell_maxvel();
  cam_.set(
      CamSettings{{value("measurem"), value("pulsem")}, {value("measure"), value("pulse")}, value("decpt")});
  axis::Theoretical slave = axis_.theoretical();
  if (slave.part < 0) {
    --slave.whole;
    slave.part = std::min(slave.part + 1, 1 - 1e-12);
  }
  cam_start_ = {master, slave.whole, slave.part};
  ++cam_starts_;
  cam_.start(cam_start_);
  for (int row = 0; row < cam_rows; ++row) value("codeQma", row) = cam_.row(row + 1).codeQma;
  set_state("st_camex", true);
}

void Camming4::stop_cam() {
  const double speed = cam_speed();
  leave_cam();
  set_state("st_still", false);
  axis_.brake(speed, straight_demand());
}

void Camming4::leave_cam() {
  cam_.stop();
  reset_recovery();
  slip_ = 0;
  slip_due_ = false;
  set_state("st_camex", false);
  value("rowex") = value("codeMex") = 0;
}

void Camming4::reset_recovery() {
  recovery_.abort();
  recovery_due_ = recovery_running_ = recovery_done_ = 0;
  recovery_way_ = 0;
}

void Camming4::rest() {
  if (state("st_camex")) leave_cam();
  AnaloguePositioner::rest();
}

void Camming4::emergency() {
  rest();
  cut_output();
  set_state("st_emrg", true);
  value("vout") = 0;  // a calibration does not come back with its voltage
}

void Camming4::fail(int code, int row) {
  set_state("st_error", true);
  value("errcode") = code;
  value("errvalue") = row;
  report({Diagnostic::Kind::warning, "st_error",
          fmt::format("error {} in row {}: {}", code, row, error_text(code))});
  emergency();
}

void Camming4::warn(int code, int row) {
  if (state("st_warning")) {
    if (code == value("wrncode") && row == value("wrnvalue")) return;
    if (warning_priority(code) > warning_priority(value("wrncode"))) return;
  }
  set_state("st_warning", true);
  value("wrncode") = code;
  value("wrnvalue") = row;
  report({Diagnostic::Kind::warning, "st_warning",
          fmt::format("warning {} in row {}: {}", code, row, warning_text(code))});
}

}  // namespace drycut::devices::camming4
