#include <fmt/format.h>

#include "devices/camming4/camming4.hpp"

namespace drycut::devices::camming4 {
namespace {

// The table has the columns in their order.
Column column_of(int variable) { return static_cast<Column>(variable - VariableRow("codeG")); }

bool is_table(int variable) { return variable >= VariableRow("codeG") && variable <= VariableRow("codeM"); }

}  // namespace

bool Camming4::may_write(Symbol symbol, std::int32_t) {
  if (!is_table(symbol.index) || !cam_.refuses(symbol.row + 1, column_of(symbol.index))) return true;
  fail(5, symbol.row + 1);
  return false;
}

void Camming4::written(Symbol symbol, std::int32_t new_value) {
  const VariableRow variable{symbol.index};
  recalculation_.written(variable, symbol.row);
  if (is_table(variable)) {
    write_row(symbol, new_value);
    return;
  }
  const bool changed = value(variable) != new_value;
  const axis::Demand before = demanded();
  if (variable == "mtype" && changed) {
    value(variable) = new_value;
    master_.rebase(master_raw());
    return;
  }
  value(variable) = new_value;
  check_dependent_range(variable);
  if (variable == "measure" || variable == "pulse" || variable == "measurem" || variable == "pulsem")
    tell_acts(variable);
  if (variable == "posit" || variable == "encoder" || variable == "positm" || variable == "encoderm") {
    write_position(variable, new_value);
    return;
  }
  if (!changed) return;
  recompute();
  if (state("st_init")) {
    write_motion(variable, before);
  } else {
    // The counts of a new resolution, for INIT to go on from.
    value("encoder") = static_cast<std::int32_t>(axis_.quota.bits(axis_.settings.resolution));
    value("encoderm") = static_cast<std::int32_t>(master_quota_.bits(master_resolution_));
  }
}

void Camming4::write_row(Symbol symbol, std::int32_t new_value) {
  const VariableRow variable{symbol.index};
  // A byte of a data group holds G codes above 127 as negative numbers (D10).
  if (variable == "codeG" && new_value < 0) new_value += 256;
  value(variable, symbol.row) = new_value;
  cam_.write(symbol.row + 1, column_of(variable), new_value);
}

void Camming4::load_table() {
  for (int variable = VariableRow("codeG"); is_table(variable); ++variable)
    for (int row = 0; row < cam_rows; ++row)
      cam_.write(row + 1, column_of(variable), value(VariableRow{variable}, row));
}

void Camming4::write_position(VariableRow variable, std::int32_t new_value) {
  if (variable == "posit") axis_.quota.set_um(new_value, axis_.settings.resolution);
  if (variable == "encoder") axis_.quota.set_bits(new_value, axis_.settings.resolution);
  if (variable == "positm") master_quota_.set_um(new_value, master_resolution_);
  if (variable == "encoderm") master_quota_.set_bits(new_value, master_resolution_);
  if (variable == "posit" || variable == "encoder") requota(name_of(variable));
}

void Camming4::recompute() {
  axis::AxisSettings& settings = axis_.settings;
  axis_.quota.rescale(settings.resolution, axis::usable(value("measure"), value("pulse")));
  master_quota_.rescale(master_resolution_, axis::usable(value("measurem"), value("pulsem")));
  AnaloguePositioner::recompute(value("tacc"), value("tdec"));
  settings.ramps.shape =
      value("ramptype") == 1 ? axis::RampShape::epicycloidal : axis::RampShape::trapezoidal;
  settings.ramps.keep_gradient = value("rtype") == 1;
  settings.finish_ramp = value("stopt") == 0;
  settings.frequency_window_ms = axis::frequency_window_ms(value("tbf"));
  master_window_ms_ = axis::frequency_window_ms(value("tbfm"));

  CamLimits limits;
  const double max_um = value("maxvel") * axis::um_per_second(value("decpt"), value("unitvel"));
  if (value("taccmax") > 0) limits.acceleration = max_um * 100.0 / value("taccmax");
  if (value("tdecmax") > 0) limits.deceleration = max_um * 100.0 / value("tdecmax");
  cam_.set(limits);
}

void Camming4::check_resolution(VariableRow measure, VariableRow pulse, axis::Resolution resolution) {
  tell_acts(measure);
  tell_acts(pulse);
  // The limits are 0.00374..4 of measure*4/pulse, rounded; 000 1.10 itself uses 934/999999.
  const double ratio = static_cast<double>(resolution.measure) * 4 / static_cast<double>(resolution.pulse);
  if (ratio > 0.003735 && ratio <= 4) return;
  report(
      {Diagnostic::Kind::out_of_range, std::string(name_of(measure)),
       fmt::format("{} * 4 / {} is outside 0.00374..4, taken anyway", resolution.measure, resolution.pulse)});
}

}  // namespace drycut::devices::camming4
