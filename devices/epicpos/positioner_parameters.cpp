#include "devices/axis/limits.hpp"
#include "devices/axis/speed.hpp"
#include "devices/epicpos/positioner.hpp"
#include "devices/epicpos/rows.hpp"

namespace drycut::devices::epicpos {
namespace {

constexpr std::int64_t ratio_bits = 400000;  // cntratio counts 1/100000 Um a pulse, a pulse is 4 bits

bool same_ramps(const axis::Demand& a, const axis::Demand& b) {
  return a.seconds_per_speed_up == b.seconds_per_speed_up &&
         a.seconds_per_speed_down == b.seconds_per_speed_down;
}

}  // namespace

bool Positioner::may_write(Symbol symbol, std::int32_t new_value) {
  if (symbol.index == v_setpos && axis_.placing() && !search_.searching()) {
    axis::AnalogueAxis trial = axis_;
    return trial.retarget(clamped(new_value));
  }
  if (symbol.index == v_posit && axis_.profile().moving()) {
    axis::AnalogueAxis trial = axis_;
    trial.quota.set_um(new_value, trial.settings.resolution);
    return trial.requota();
  }
  return true;
}

void Positioner::written(Symbol symbol, std::int32_t new_value) {
  const int variable = symbol.index;
  const bool changed = value(variable) != new_value;
  value(variable) = new_value;
  check_dependent_range(variable);
  if (variable == v_posit) {
    axis_.quota.set_um(new_value, axis_.settings.resolution);
    axis_.requota();
    return;
  }
  if (!changed) return;
  const axis::Demand ramps = axis_.settings.ramps;
  rescale();
  recompute();
  if (variable == v_cntratio) check_ratio();
  write_motion(variable, !same_ramps(ramps, axis_.settings.ramps));
}

void Positioner::write_motion(int variable, bool ramps_changed) {
  if (!axis_.profile().moving() || search_.searching()) return;
  if (variable == v_setpos && axis_.placing()) axis_.retarget(clamped(value(v_setpos)));
  if ((variable == v_setvel || ramps_changed) && !axis_.change(value(v_setvel)))
    report(axis::kept_for_the_next(type().variables[variable].name));
}

void Positioner::rescale() {
  const axis::Resolution resolution = axis::usable(value(v_cntratio), ratio_bits);
  if (resolution == axis_.settings.resolution) return;
  axis_.quota.rescale(axis_.settings.resolution, resolution);
  axis_.settings.resolution = resolution;
}

/// What the ratio acts as, if not as itself.
void Positioner::check_ratio() {
  const std::int64_t acts = axis_.settings.resolution.measure;
  if (terminals_.counter && acts != value(v_cntratio))
    report(axis::acts_as("cntratio", value(v_cntratio), acts));
}

void Positioner::recompute() {
  axis::AxisSettings& settings = axis_.settings;
  settings.bits_per_speed =
      axis::um_per_second(value(v_decpt), value(v_unitvel)) * axis::bits_per_um(settings.resolution);
  settings.max_speed = value(v_maxvel) * settings.bits_per_speed;

  const bool two_times = value(v_rampmode) == 1;
  axis::Demand& ramps = settings.ramps;
  ramps.seconds_per_speed_up =
      axis::seconds_per_speed(value(two_times ? v_tacc : v_taccdec), settings.max_speed);
  ramps.seconds_per_speed_down =
      axis::seconds_per_speed(value(two_times ? v_tdec : v_taccdec), settings.max_speed);
  if (model_ == Model::epicpos) {
    ramps.shape = axis::RampShape::epicycloidal;
    ramps.keep_gradient = value(v_rtype) == 1;
    settings.finish_ramp = value(v_stopt) == 0;
  } else {
    ramps.shape = value(v_ramptype) == 1 ? axis::RampShape::epicycloidal : axis::RampShape::trapezoidal;
    ramps.keep_gradient = true;
    settings.finish_ramp = false;
  }

  settings.gains = {value(v_pgain), value(v_feedfw), value(v_integt), value(v_derivt)};
  settings.term_limit = type().variables[v_integ].max;
  settings.offset = value(v_offset);
  settings.period_ms = period_ms_;
  settings.reversal_pause_ms = value(v_tinvt) * 10;
  settings.max_following_error = value(v_maxfollerr);
}

void Positioner::check_dependent_range(int variable) {
  if (variable == v_setvel || variable == v_prsvel) report_outside(variable, 0, v_maxvel);
  if (variable == v_sprsvel) report_outside(variable, 0, v_prsvel);
  if (variable == v_setpos || variable == v_prspos) report_outside(variable, value(v_minpos), v_maxpos);
}

}  // namespace drycut::devices::epicpos
