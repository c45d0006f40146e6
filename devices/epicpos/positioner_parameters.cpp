#include "devices/axis/limits.hpp"
#include "devices/axis/speed.hpp"
#include "devices/eanpos/eanpos.hpp"
#include "devices/epicpos/positioner.hpp"

namespace drycut::devices::epicpos {
namespace {

constexpr std::int64_t ratio_bits = 400000;  // cntratio counts 1/100000 Um a pulse, a pulse is 4 bits

bool same_ramps(const axis::Demand& a, const axis::Demand& b) {
  return a.seconds_per_speed_up == b.seconds_per_speed_up &&
         a.seconds_per_speed_down == b.seconds_per_speed_down;
}

}  // namespace

bool Positioner::may_write(Symbol symbol, std::int32_t new_value) {
  const VariableRow variable{symbol.index};
  if (variable == "setpos" && axis_.placing() && !search_.searching()) {
    axis::AnalogueAxis trial = axis_;
    return trial.retarget(clamped(new_value));
  }
  if (variable == "posit" && axis_.profile().moving()) {
    axis::AnalogueAxis trial = axis_;
    trial.quota.set_um(new_value, trial.settings.resolution);
    return trial.requota();
  }
  return true;
}

void Positioner::written(Symbol symbol, std::int32_t new_value) {
  const VariableRow variable{symbol.index};
  const bool changed = value(variable) != new_value;
  value(variable) = new_value;
  check_dependent_range(variable);
  if (variable == "posit") {
    axis_.quota.set_um(new_value, axis_.settings.resolution);
    axis_.requota();
    return;
  }
  if (!changed) return;
  const axis::Demand ramps = axis_.settings.ramps;
  rescale();
  recompute();
  if (variable == "cntratio") check_ratio();
  write_motion(variable, !same_ramps(ramps, axis_.settings.ramps));
}

void Positioner::write_motion(VariableRow variable, bool ramps_changed) {
  if (!axis_.profile().moving() || search_.searching()) return;
  if (variable == "setpos" && axis_.placing()) axis_.retarget(clamped(value("setpos")));
  if ((variable == "setvel" || ramps_changed) && !axis_.change(value("setvel")))
    report(axis::kept_for_the_next(name_of(variable)));
}

void Positioner::rescale() {
  const axis::Resolution resolution = axis::usable(value("cntratio"), ratio_bits);
  if (resolution == axis_.settings.resolution) return;
  axis_.quota.rescale(axis_.settings.resolution, resolution);
  axis_.settings.resolution = resolution;
}

/// What the ratio acts as, if not as itself.
void Positioner::check_ratio() {
  const std::int64_t acts = axis_.settings.resolution.measure;
  if (terminals_.counter && acts != value("cntratio"))
    report(axis::acts_as("cntratio", value("cntratio"), acts));
}

void Positioner::recompute() {
  axis::AxisSettings& settings = axis_.settings;
  settings.bits_per_speed =
      axis::um_per_second(value("decpt"), value("unitvel")) * axis::bits_per_um(settings.resolution);
  settings.max_speed = value("maxvel") * settings.bits_per_speed;

  const bool two_times = value("rampmode") == 1;
  axis::Demand& ramps = settings.ramps;
  ramps.seconds_per_speed_up =
      axis::seconds_per_speed(two_times ? value("tacc") : value("taccdec"), settings.max_speed);
  ramps.seconds_per_speed_down =
      axis::seconds_per_speed(two_times ? value("tdec") : value("taccdec"), settings.max_speed);
  if (&type() == &epicpos_type) {
    ramps.shape = axis::RampShape::epicycloidal;
    ramps.keep_gradient = value("rtype") == 1;
    settings.finish_ramp = value("stopt") == 0;
  } else {
    using EanposRow = NamedRow<eanpos::eanpos_type, &DeviceType::variables>;
    const bool epicycloidal = value(VariableRow{EanposRow("ramptype")}) == 1;
    ramps.shape = epicycloidal ? axis::RampShape::epicycloidal : axis::RampShape::trapezoidal;
    ramps.keep_gradient = true;
    settings.finish_ramp = false;
  }

  settings.gains = {value("pgain"), value("feedfw"), value("integt"), value("derivt")};
  settings.term_limit = type().variables[VariableRow("integ")].max;
  settings.offset = value("offset");
  settings.period_ms = period_ms_;
  settings.reversal_pause_ms = value("tinvt") * 10;
  settings.max_following_error = value("maxfollerr");
}

void Positioner::check_dependent_range(VariableRow variable) {
  if (variable == "setvel" || variable == "prsvel") report_outside(variable, 0, "maxvel");
  if (variable == "sprsvel") report_outside(variable, 0, "prsvel");
  if (variable == "setpos" || variable == "prspos") report_outside(variable, value("minpos"), "maxpos");
}

}  // namespace drycut::devices::epicpos
