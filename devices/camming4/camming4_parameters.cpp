#include <fmt/format.h>

#include "devices/axis/limits.hpp"
#include "devices/axis/speed.hpp"
#include "devices/camming4/camming4.hpp"
#include "devices/camming4/rows.hpp"

namespace drycut::devices::camming4 {
namespace {

Column column_of(int variable) {
  switch (variable) {
    case v_codeG:
      return Column::codeG;
    case v_codeQm:
      return Column::codeQm;
    case v_codeQs:
      return Column::codeQs;
    case v_codeQma:
      return Column::codeQma;
    case v_codeQsa:
      return Column::codeQsa;
    default:
      return Column::codeM;
  }
}

bool is_table(int variable) { return variable >= v_codeG && variable <= v_codeM; }

}  // namespace

bool Camming4::may_write(Symbol symbol, std::int32_t) {
  if (!is_table(symbol.index) || !cam_.refuses(symbol.row + 1, column_of(symbol.index))) return true;
  fail(5, symbol.row + 1);
  return false;
}

void Camming4::written(Symbol symbol, std::int32_t new_value) {
  const int variable = symbol.index;
  recalculation_.written(variable, symbol.row);
  if (is_table(variable)) {
    write_row(symbol, new_value);
    return;
  }
  const bool changed = value(variable) != new_value;
  if (variable == v_mtype && changed) {
    value(variable) = new_value;
    master_.rebase(master_raw());
    return;
  }
  value(variable) = new_value;
  check_dependent_range(variable);
  if (variable == v_posit || variable == v_encoder || variable == v_positm || variable == v_encoderm) {
    write_position(variable, new_value);
    return;
  }
  if (!changed) return;
  rescale();
  recompute();
  if (state(st_init)) {
    write_motion(variable);
  } else {
    // The counts of a new resolution, for INIT to go on from.
    value(v_encoder) = static_cast<std::int32_t>(axis_.quota.bits(axis_.settings.resolution));
    value(v_encoderm) = static_cast<std::int32_t>(master_quota_.bits(master_resolution_));
  }
}

void Camming4::write_row(Symbol symbol, std::int32_t new_value) {
  // A byte of a data group holds G codes above 127 as negative numbers (D10).
  if (symbol.index == v_codeG && new_value < 0) new_value += 256;
  value(symbol.index, symbol.row) = new_value;
  cam_.write(symbol.row + 1, column_of(symbol.index), new_value);
}

void Camming4::load_table() {
  for (int variable = v_codeG; variable <= v_codeM; ++variable)
    for (int row = 0; row < cam_rows; ++row) cam_.write(row + 1, column_of(variable), value(variable, row));
}

void Camming4::write_position(int variable, std::int32_t new_value) {
  if (variable == v_posit) axis_.quota.set_um(new_value, axis_.settings.resolution);
  if (variable == v_encoder) axis_.quota.set_bits(new_value, axis_.settings.resolution);
  if (variable == v_positm) master_quota_.set_um(new_value, master_resolution_);
  if (variable == v_encoderm) master_quota_.set_bits(new_value, master_resolution_);
  if (variable == v_posit || variable == v_encoder) requota(type().variables[variable].name);
}

/// The slave's count was changed by `cause`.
void Camming4::requota(std::string_view cause) {
  if (axis_.requota()) return;
  report({Diagnostic::Kind::note, std::string(cause),
          "the running movement cannot reach its quota any more and stops"});
}

void Camming4::write_motion(int variable) {
  if (!axis_.profile().moving() || search_.searching()) return;
  bool taken = true;
  if (variable == v_setpos && axis_.placing()) taken = axis_.retarget(clamped(value(v_setpos)));
  if (variable == v_setvel || variable == v_tacc || variable == v_tdec || variable == v_rtype)
    taken = axis_.change(value(v_setvel));
  if (!taken) report(axis::kept_for_the_next(type().variables[variable].name));
}

void Camming4::rescale() {
  const axis::Resolution slave = axis::usable(value(v_measure), value(v_pulse));
  if (slave != axis_.settings.resolution) {
    axis_.quota.rescale(axis_.settings.resolution, slave);
    axis_.settings.resolution = slave;
  }
  const axis::Resolution master = axis::usable(value(v_measurem), value(v_pulsem));
  if (master != master_resolution_) {
    master_quota_.rescale(master_resolution_, master);
    master_resolution_ = master;
  }
}

void Camming4::recompute() {
  axis::AxisSettings& settings = axis_.settings;
  const double um_per_speed = axis::um_per_second(value(v_decpt), value(v_unitvel));
  settings.bits_per_speed = um_per_speed * axis::bits_per_um(settings.resolution);
  settings.max_speed = value(v_maxvel) * settings.bits_per_speed;
  settings.ramps.seconds_per_speed_up = axis::seconds_per_speed(value(v_tacc), settings.max_speed);
  settings.ramps.seconds_per_speed_down = axis::seconds_per_speed(value(v_tdec), settings.max_speed);
  settings.ramps.shape =
      value(v_ramptype) == 1 ? axis::RampShape::epicycloidal : axis::RampShape::trapezoidal;
  settings.ramps.keep_gradient = value(v_rtype) == 1;
  settings.finish_ramp = value(v_stopt) == 0;
  settings.gains = {value(v_pgain), value(v_feedfw), value(v_integt), value(v_derivt)};
  settings.offset = value(v_offset);
  settings.period_ms = period_ms_;
  settings.max_following_error = value(v_maxfollerr);
  settings.frequency_window_ms = axis::frequency_window_ms(value(v_tbf));
  master_window_ms_ = axis::frequency_window_ms(value(v_tbfm));

  CamLimits limits;
  const double max_um = value(v_maxvel) * um_per_speed;
  if (value(v_taccmax) > 0) limits.acceleration = max_um * 100.0 / value(v_taccmax);
  if (value(v_tdecmax) > 0) limits.deceleration = max_um * 100.0 / value(v_tdecmax);
  cam_.set(limits);
}

void Camming4::check_dependent_range(int variable) {
  if (variable == v_setvel || variable == v_prsvel) report_outside(variable, 0, v_maxvel);
  if (variable == v_sprsvel) report_outside(variable, 0, v_prsvel);
  if (variable >= v_measure && variable <= v_pulsem) tell_acts(variable);
  if (variable == v_setpos || variable == v_prspos) report_outside(variable, value(v_minpos), v_maxpos);
}

/// What a part of a resolution acts as, if not as itself.
void Camming4::tell_acts(int variable) {
  const std::int64_t acts = axis::usable(value(variable), 1).measure;
  if (acts != value(variable)) report(axis::acts_as(type().variables[variable].name, value(variable), acts));
}

void Camming4::check_resolution(int measure, int pulse, axis::Resolution resolution) {
  const std::string_view name = type().variables[measure].name;
  tell_acts(measure);
  tell_acts(pulse);
  // The limits are 0.00374..4 of measure*4/pulse, rounded; 000 1.10 itself uses 934/999999.
  const double ratio = static_cast<double>(resolution.measure) * 4 / static_cast<double>(resolution.pulse);
  if (ratio > 0.003735 && ratio <= 4) return;
  report(
      {Diagnostic::Kind::out_of_range, std::string(name),
       fmt::format("{} * 4 / {} is outside 0.00374..4, taken anyway", resolution.measure, resolution.pulse)});
}

}  // namespace drycut::devices::camming4
