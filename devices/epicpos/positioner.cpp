#include "devices/epicpos/positioner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/axis/speed.hpp"
#include "devices/epicpos/epicpos.hpp"
#include "devices/terminals.hpp"

namespace drycut::devices::epicpos {
namespace {

constexpr int cpu_slot = 1;  // its counters have no wires: a device moves them

}  // namespace

std::unique_ptr<Device> make_epicpos(const Resources& resources, Cards& cards) {
  return std::make_unique<Positioner>(epicpos_type, resources, cards);
}

Positioner::Positioner(const DeviceType& type, const Resources& resources, Cards& cards)
    : TableDevice(type), period_ms_(std::max(resources[FieldRow("TCamp")].number, 1)) {
  Counter* counter = connect(cards.counters, resources[FieldRow("ICont")]);
  terminals_.counter = counter;
  if (counter && resources[FieldRow("ICont")].address->slot == cpu_slot) {
    terminals_.simulated = counter;
    ++counter->movers;
    axis_.settings.simulated = true;
  }
  terminals_.enable = connect(cards.inputs, resources[FieldRow("IAZero")]);
  terminals_.dac = connect(cards.analogue_outputs, resources[FieldRow("IOutA")]);
  terminals_.zero_line = resources[FieldRow("IntL")].number;
  rescale();
  recompute();
}

void Positioner::power_up() {
  Device::power_up();
  const axis::AxisSettings settings = axis_.settings;
  const axis::Quota quota = axis_.quota;
  axis_ = {};
  axis_.settings = settings;
  axis_.quota = quota;
  if (terminals_.simulated) terminals_.simulated->count = terminals_.simulated->latched = 0;
  if (!terminals_.dac) return;
  terminals_.dac->word = 0;
  dac_turn_.release(*terminals_.dac);
}

void Positioner::initialise() {
  rescale();
  recompute();
  // A kept position goes on with its remainder, unless memory was restored from elsewhere.
  if (axis_.posit() != value("posit")) axis_.quota.set_um(value("posit"), axis_.settings.resolution);
  axis_.rebase(count_of(terminals_.counter));
  axis_.abort();
  axis_.settle();
  search_.abort();
  check_ratio();
  enable_released_ = false;
  zero_.reset();
  counter_part_ = 0;
  in_tolerance_ms_ = 0;
  if (terminals_.simulated && terminals_.simulated->movers > 1)
    report({Diagnostic::Kind::note, "ICont", "another device moves the same simulated counter"});
}

void Positioner::latch() {
  if (state("st_init")) axis_.follow(count_of(terminals_.counter), state("st_cntlock"), state("st_cntrev"));
}

void Positioner::interrupt(int line, bool rising) {
  if (!state("st_init") || !rising || line != terminals_.zero_line || zero_) return;
  zero_ = terminals_.counter ? axis_.transducer().total_at(terminals_.counter->latched, state("st_cntlock"),
                                                           state("st_cntrev"))
                             : axis_.transducer().total();
}

void Positioner::step() {
  sample_preset();
  step_motion();
  regulate();
  publish_values();
  publish_states();
}

void Positioner::sample_preset() {
  const bool enable = is_on(terminals_.enable);
  const auto zero = std::exchange(zero_, std::nullopt);
  if (!enable) enable_released_ = true;
  if (search_.searching()) {
    search_settings_.locked = state("st_cntlock");
    search_.sample(search_settings_, enable, zero, axis_);
    value("setvel") = search_.speed(search_settings_);
    value("setpos") = search_settings_.quota;
  } else if (value("prsmode") == 2 && enable && enable_released_ && !state("st_cntlock")) {
    axis_.quota.set_um(value("prspos"), axis_.settings.resolution);
    axis_.requota();
    set_state("st_prsok", true);
  }
}

void Positioner::step_motion() {
  const axis::Theoretical before = axis_.theoretical();
  axis_.step_profile();
  if (terminals_.simulated) move_counter(axis_.theoretical().minus(before));
  if (search_.finished(axis_)) {
    set_state("st_prson", false);
    set_state("st_prsok", true);
  }
  if (!axis_.profile().moving() && !search_.searching()) set_state("st_still", true);
}

void Positioner::move_counter(double bits) {
  counter_part_ += bits;
  const double whole = std::round(counter_part_);
  counter_part_ -= whole;
  std::int64_t& count = terminals_.simulated->count;
  count = axis::multiply_add(count, axis::whole_bits(whole), 1);
  // Nothing happens to it between two samples: this is its count at any edge until the next.
  terminals_.simulated->latched = count;
}

void Positioner::regulate() {
  using axis::Drive;
  const Drive drive = state("st_emrg")     ? Drive::emergency
                      : state("st_regoff") ? Drive::frozen
                      : state("st_cal")    ? Drive::calibration
                      : state("st_loopon") ? Drive::reaction
                                           : Drive::open_loop;
  axis_.regulate(drive, value("vout"));
  if (!terminals_.dac) return;
  if (drive == Drive::frozen)
    dac_turn_.release(*terminals_.dac);
  else if (dac_turn_.put(*terminals_.dac, axis_.output().word))
    report({Diagnostic::Kind::note, "IOutA", std::string(axis::shared_dac_text)});
}

void Positioner::publish_values() {
  value("posit") = axis_.posit();
  value("follerr") = axis::to_long(axis_.error());
  const axis::Actions& actions = axis_.actions();
  value("ffwdreg") = axis::to_long(actions.feed_forward);
  value("propreg") = axis::to_long(actions.proportional);
  value("integ") = axis::to_long(actions.integral);
  value("derreg") = axis::to_long(actions.derivative);
  if (!axis_.frequency_new()) return;
  const double rate = axis_.frequency().bits_per_second();
  value("frq") = axis::to_long(rate / 4);
  value("vel") = axis_.settings.bits_per_speed > 0 ? axis::to_long(rate / axis_.settings.bits_per_speed) : 0;
}

void Positioner::publish_states() {
  const axis::Profile& profile = axis_.profile();
  if (profile.moving()) set_state("st_movdir", profile.backward());
  set_state("st_foller", axis_.following_error());

  const auto placed = axis_.placed();
  const bool in_tolerance =
      placed && std::abs(std::int64_t{value("posit")} - *placed) <= std::int64_t{value("toll")};
  set_state("st_toll", in_tolerance && in_tolerance_ms_ >= std::int64_t{value("toldly")} * 10);
  in_tolerance_ms_ = in_tolerance ? in_tolerance_ms_ + period_ms_ : 0;
}

}  // namespace drycut::devices::epicpos
