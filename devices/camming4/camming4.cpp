#include "devices/camming4/camming4.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace drycut::devices::camming4 {

std::unique_ptr<Device> make_camming4(const Resources& resources, Cards& cards) {
  return std::make_unique<Camming4>(resources, cards);
}

namespace {

/// Makes a quota fit what retentive memory shows of it: the count, as far as it agrees with the position.
void resume_quota(axis::Quota& quota, axis::Resolution resolution, std::int32_t um, std::int32_t bits) {
  if (quota.um(resolution) == um && static_cast<std::int32_t>(quota.bits(resolution)) == bits) return;
  quota.set_bits(bits, resolution);
  if (quota.um(resolution) != um) quota.set_um(um, resolution);
}

}  // namespace

Camming4::Camming4(const Resources& resources, Cards& cards)
    : AnaloguePositioner(camming4_type, resources, cards, "CountS", "IoutA") {
  terminals_.master = {connect(cards.counters, resources[FieldRow("CountMA")]),
                       connect(cards.counters, resources[FieldRow("CountMB")])};
  terminals_.enable_master = connect(cards.inputs, resources[FieldRow("IAZeroM")]);
  terminals_.input = connect(cards.inputs, resources[FieldRow("InG")]);
  terminals_.output = connect(cards.outputs, resources[FieldRow("Out")]);
  terminals_.zero_line_master = resources[FieldRow("IntLM")].number;
  terminals_.function_line = resources[FieldRow("InGInt")].number;
  if (terminals_.function_line != 0)
    terminals_.interrupt_level = &cards.interrupt_lines[terminals_.function_line];
  recompute();
}

void Camming4::power_up() {
  AnaloguePositioner::power_up();
  cam_.stop();
}

void Camming4::initialise() {
  recompute();
  load_table();
  // Kept positions go on with their remainder, unless memory was restored from elsewhere.
  resume_quota(axis_.quota, axis_.settings.resolution, value("posit"), value("encoder"));
  resume_quota(master_quota_, master_resolution_, value("positm"), value("encoderm"));
  if (counter_) check_resolution("measure", "pulse", axis_.settings.resolution);
  if (terminals_.master[0] || terminals_.master[1])
    check_resolution("measurem", "pulsem", master_resolution_);

  begin();
  master_.rebase(master_raw());
  master_frequency_ = {};
  master_history_.fill(master_.total());
  master_way_ = master_moved_ = 0;
  reset_recovery();
  slip_ = 0;
  slip_due_ = false;
  master_rate_ = 0;
  enable_master_was_ = true;
  master_released_ = false;
  zero_master_.reset();
  input_was_ = terminals_.input && terminals_.input->level;
  capture_.reset();
  recalculation_ = {};
  inhibit_stop_ms_ = 0;
}

std::int64_t Camming4::master_raw() const { return count_of(terminals_.master[value("mtype") == 1 ? 1 : 0]); }

void Camming4::latch() {
  if (!state("st_init")) return;
  AnaloguePositioner::latch();
  const std::int64_t moved = master_.follow(master_raw(), state("st_cntlockm"), state("st_cntrevm"));
  master_moved_ = moved;
  master_quota_.count(moved, master_resolution_);
  if (master_frequency_.sample(moved, period_ms_, master_window_ms_))
    value("frqm") = axis::to_long(master_frequency_.bits_per_second() / 4);

  std::int64_t& oldest = master_history_[master_history_next_];
  master_way_ = axis::difference(master_.total(), oldest);
  oldest = master_.total();
  master_history_next_ = (master_history_next_ + 1) % master_history_.size();
}

void Camming4::step() {
  sample_inputs();
  sample_preset(false);
  sample_master_preset();
  if (state("st_camex"))
    step_cam();
  else
    step_motion();
  regulate();
  publish();
  drive_output();

  recalculation_.sample();
  if (inhibit_stop_ms_ > 0) inhibit_stop_ms_ -= period_ms_;
}

/// The speed of `bits` over the history [Um/s].
double Camming4::master_speed(std::int64_t bits) const {
  const double seconds = static_cast<double>(master_history_.size()) * period_ms_ / 1000.0;
  return static_cast<double>(bits) / axis::bits_per_um(master_resolution_) / seconds;
}

/// The mean of the last samples [bits x4 a sample]. A master that has just changed its speed by more than
/// its own bit counts as it is now.
double Camming4::master_rate() const {
  const double mean = static_cast<double>(master_way_) / static_cast<double>(master_history_.size());
  const auto now = static_cast<double>(master_moved_);
  return std::abs(now - mean) > 1 ? now : mean;
}

/// The master's way in a sampling, either direction, without what the last bit of the history makes of it: a
/// sector of just a sampling time is no error in any phase of the counts [bits x4].
double Camming4::proven_way() const {
  const auto samples = static_cast<double>(master_history_.size());
  const auto now = static_cast<double>(master_moved_);
  if (std::abs(now - static_cast<double>(master_way_) / samples) > 1) return std::abs(now);
  return std::max(std::abs(static_cast<double>(master_way_)) - 1, 0.0) / samples;
}

/// The slave's speed in a cam [bits x4/s], as smooth as the master's: the law's ratio times the master's
/// rate.
double Camming4::cam_speed() const {
  const double master_um = master_rate_ * 1000.0 / period_ms_ / axis::bits_per_um(master_resolution_);
  return cam_.step().ratio * master_um * axis::bits_per_um(axis_.settings.resolution) + recovery_.speed();
}

/// The ramps of setvel beside a cam and out of it: ramptype is of placements alone (000 1.9.2).
axis::Demand Camming4::straight_demand() const {
  axis::Demand demand = axis_.demand(value("setvel"));
  demand.shape = axis::RampShape::trapezoidal;
  return demand;
}

void Camming4::step_cam() {
  const axis::Resolution slave = axis_.settings.resolution;
  CamSample sample;
  sample.master_count = master_.total();
  sample.master_grains = master_quota_.numerator();
  sample.slave_count = axis_.transducer().total();
  // The cam knows nothing of the recovery beside it, nor of the slip: its counts are those of an axis
  // without them.
  sample.slave_grains = axis::multiply_add(axis_.quota.numerator(), recovery_done_, slave.pulse);
  const std::int64_t running = axis::whole_bits(recovery_way_ * static_cast<double>(slave.measure));
  sample.slave_grains = axis::multiply_add(sample.slave_grains, running, 1);
  sample.slave_grains = axis::multiply_add(sample.slave_grains, slip_, slave.measure);
  sample.master_speed = master_speed(master_way_);
  sample.proven_speed = master_speed(std::max<std::int64_t>(std::abs(master_way_) - 1, 0));
  sample.master_way = proven_way();
  master_rate_ = master_rate();
  const CamStep& cam = cam_.advance(sample);

  master_quota_.shift(-cam.master_shift);
  axis_.quota.shift(-cam.slave_shift);
  for (int i = 0; i < cam.read_out_count; ++i) {
    const CamStep::ReadOut& read = cam.read_outs[static_cast<std::size_t>(i)];
    value("codeQma", read.row - 1) = read.codeQma;
  }
  for (int i = 0; i < cam.warning_count; ++i) {
    const CamEvent& warning = cam.warnings[static_cast<std::size_t>(i)];
    warn(warning.code, warning.row);
  }
  if (cam.error.code != 0) {
    fail(cam.error.code, cam.error.row);
    return;
  }
  value("rowex") = cam.row;
  value("codeMex") = cam.codeM;

  recovery_due_ += cam.recovery;
  step_recovery();
  axis::Theoretical theoretical{axis::multiply_add(cam.slave_bits, slip_, 1), cam.slave_fraction};
  if (recovery_done_ != 0 || recovery_running_ != 0) {
    const std::int64_t numerator = axis::multiply_add(0, recovery_done_, slave.pulse);
    theoretical.whole = axis::multiply_add(theoretical.whole, numerator / slave.measure, 1);
    theoretical.add(static_cast<double>(numerator % slave.measure) / static_cast<double>(slave.measure) +
                    recovery_way_);
  }
  const double way = theoretical.minus(axis_.theoretical());
  axis_.set_theoretical(theoretical, way * 1000.0 / period_ms_);
  if (std::exchange(slip_due_, false)) slip_ += axis_.settle_by_bits();
  if (cam.running) return;
  if (recovery_.moving() || recovery_due_ != 0)
    report(
        {Diagnostic::Kind::warning, "st_camex", "the cam ended before the recovery of sector 180 was done"});
  leave_cam();
}

void Camming4::step_recovery() {
  if (!recovery_.moving()) {
    if (recovery_due_ == 0) return;
    recovery_running_ = recovery_due_;
    recovery_due_ = 0;
    recovery_way_ = 0;
    recovery_.move(static_cast<double>(recovery_running_) * axis::bits_per_um(axis_.settings.resolution),
                   straight_demand());
  }
  recovery_way_ += recovery_.step(period_ms_ / 1000.0);
  if (recovery_.moving()) return;
  recovery_done_ += recovery_running_;
  recovery_running_ = 0;
  recovery_way_ = 0;
}

void Camming4::regulate() {
  const axis::Drive drive = AnaloguePositioner::regulate();
  if (drive == axis::Drive::calibration) return;
  const axis::DacOutput output = axis_.output();
  if (output.saturated > 0) warn(3, value("rowex"));
  if (output.saturated < 0) warn(4, value("rowex"));
  // A calibration that regulation off has frozen goes on with its voltage.
  if (drive != axis::Drive::frozen || !state("st_cal"))
    value("vout") = axis::to_long(output.word / axis::dac_bits_of_tenths(1));
}

void Camming4::publish() {
  AnaloguePositioner::publish();
  const axis::Resolution resolution = axis_.settings.resolution;
  value("encoder") = static_cast<std::int32_t>(axis_.quota.bits(resolution));
  value("positm") = static_cast<std::int32_t>(master_quota_.um(master_resolution_));
  value("encoderm") = static_cast<std::int32_t>(master_quota_.bits(master_resolution_));
  value("follerr") = axis_.follerr();
  value("intreg") = axis::to_long(axis_.actions().integral);

  const bool in_band =
      axis_.follerr() * resolution.measure <= value("syncrange") * resolution.pulse;  // less than 2^62
  const bool was_sync = state("st_sync");
  set_state("st_sync", state("st_camex") && in_band);
  if (was_sync && state("st_camex") && !in_band) warn(12, value("rowex"));

  const axis::Profile& profile = axis_.profile();
  const axis::Phase phase = profile.phase();
  set_state("st_acc", phase == axis::Phase::accelerating);
  set_state("st_dec", phase == axis::Phase::decelerating);
  set_state("st_vconst", phase == axis::Phase::constant);
  set_state("st_chvel",
            profile.moving() && !profile.stopping() && !profile.in_last_ramp() && !state("st_prson"));
  set_state("st_tpos", within(value("setpos")));
  // A cam that comes back to the quota is no placement (000 1.9.2 toll).
  if (state("st_camex") && !in_place()) axis_.forget_placement();
  set_state("st_toll", in_place());
  set_state("st_int", terminals_.interrupt_level && terminals_.interrupt_level->level);
}

void Camming4::drive_output() {
  if (!terminals_.output) return;
  const std::int32_t code = value("codeMex");
  const bool sync = state("st_sync");
  const std::array levels = {false,       true,         state("st_toll"),     state("st_tpos"),
                             sync,        code == 1000, code == 1000 && sync, code == 1001,
                             code == 1002};  // functions 1 to 9 (000 1.8)
  // Any other leaves the output as it is.
  const std::int64_t function = std::int64_t{value("funOut")} - 1;
  if (function >= 0 && function < std::ssize(levels))
    terminals_.output->level = levels[static_cast<std::size_t>(function)];
}

}  // namespace drycut::devices::camming4
