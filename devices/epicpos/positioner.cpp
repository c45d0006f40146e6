#include "devices/epicpos/positioner.hpp"

#include <cmath>

#include "devices/epicpos/epicpos.hpp"

namespace drycut::devices::epicpos {
namespace {

constexpr int cpu_slot = 1;                  // its counters have no wires: a device moves them
constexpr std::int64_t ratio_bits = 400000;  // cntratio counts 1/100000 Um a pulse, a pulse is 4 bits

}  // namespace

std::unique_ptr<Device> make_epicpos(const Resources& resources, Cards& cards) {
  return std::make_unique<Positioner>(epicpos_type, resources, cards);
}

Positioner::Positioner(const DeviceType& type, const Resources& resources, Cards& cards)
    : AnaloguePositioner(type, resources, cards, "ICont", "IOutA") {
  axis_.settings.simulated = counter_ && resources[FieldRow("ICont")].address->slot == cpu_slot;
  if (axis_.settings.simulated) ++counter_->movers;
  recompute();
}

void Positioner::power_up() {
  AnaloguePositioner::power_up();
  if (axis_.settings.simulated) counter_->count = counter_->latched = 0;
}

void Positioner::visit(StateArchive& archive) {
  AnaloguePositioner::visit(archive);
  STATE(archive, counter_part_, in_tolerance_ms_);
}

void Positioner::initialise() {
  recompute();
  // A kept position goes on with its remainder, unless memory was restored from elsewhere.
  if (axis_.posit() != value("posit")) axis_.quota.set_um(value("posit"), axis_.settings.resolution);
  begin();
  check_ratio();
  counter_part_ = 0;
  in_tolerance_ms_ = 0;
  if (axis_.settings.simulated && counter_->movers > 1)
    report({Diagnostic::Kind::warning, "ICont", "another device moves the same simulated counter"});
}

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
  const axis::Demand before = demanded();
  value(variable) = new_value;
  check_dependent_range(variable);
  if (variable == "posit") {
    axis_.quota.set_um(new_value, axis_.settings.resolution);
    requota("posit");
    return;
  }
  if (!changed) return;
  recompute();
  if (variable == "cntratio") check_ratio();
  write_motion(variable, before);
}

/// What the ratio acts as, if not as itself.
void Positioner::check_ratio() {
  if (counter_) tell_acts("cntratio");
}

void Positioner::recompute() {
  axis::AxisSettings& settings = axis_.settings;
  axis_.quota.rescale(settings.resolution, axis::usable(value("cntratio"), ratio_bits));
  const bool two_times = value("rampmode") == 1;
  AnaloguePositioner::recompute(two_times ? value("tacc") : value("taccdec"),
                                two_times ? value("tdec") : value("taccdec"));
  axis::Demand& ramps = settings.ramps;
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

  settings.term_limit = type().variables[VariableRow("integ")].max;
  settings.reversal_pause_ms = value("tinvt") * 10;
}

void Positioner::execute(int command) {
  if (command == CommandRow("DELCNT"))
    axis_.quota.add_um(value("delta"), axis_.settings.resolution);
  else
    AnaloguePositioner::execute(command);
}

void Positioner::step() {
  sample_preset(state("st_cntlock"));
  const axis::Theoretical before = axis_.theoretical();
  step_motion();
  if (axis_.settings.simulated) move_counter(axis_.theoretical().minus(before));
  regulate();
  publish();
}

void Positioner::move_counter(double bits) {
  counter_part_ += bits;
  const double whole = std::round(counter_part_);
  counter_part_ -= whole;
  counter_->count = axis::multiply_add(counter_->count, axis::whole_bits(whole), 1);
  // Nothing happens to it between two samples: this is its count at any edge until the next.
  counter_->latched = counter_->count;
}

void Positioner::publish() {
  AnaloguePositioner::publish();
  value("follerr") = axis::to_long(axis_.error());
  value("integ") = axis::to_long(axis_.actions().integral);
  const bool placed = in_place();
  set_state("st_toll", placed && in_tolerance_ms_ >= std::int64_t{value("toldly")} * 10);
  in_tolerance_ms_ = placed ? in_tolerance_ms_ + period_ms_ : 0;
}

}  // namespace drycut::devices::epicpos
