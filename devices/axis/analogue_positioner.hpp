#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/state_archive.hpp"
#include "devices/axis/analogue_axis.hpp"
#include "devices/axis/limits.hpp"
#include "devices/axis/position.hpp"
#include "devices/device.hpp"

namespace drycut::devices::axis {

/// The device around an AnalogueAxis as the manuals of CAMMING4 (000 1.1, 1.9) and EPICPOS (002) both have
/// it: placements, manual movements and the preset search with their limits, regulation, what the axis shows.
/// A device adds what only its manual says, and calls these parts in its own initialise(), written() and
/// step().
///
/// On purpose not here, because the manuals differ: resolution (000 1.9.2 measure and pulse, 002 1.4.3
/// cntratio); ramp times and shapes (000 1.9.2 tacc, tdec, ramptype; 002 1.4.3 rampmode, taccdec, tinvt);
/// writes in mid-move (002 1.4.3 refuses a setpos or posit out of reach); CNTLOCK, which keeps from
/// presetting (002 1.4.2 alone); follerr (000 1.9.3 its magnitude); the integral action's name and limit;
/// st_toll's delay (002 1.4.3 toldly); vout, which shows the output too (000 1.9.3).
template <const DeviceType& table>
class AnaloguePositioner : public TableDevice<table> {
  using Base = TableDevice<table>;

 public:
  [[nodiscard]] int period_ms() const override { return period_ms_; }
  [[nodiscard]] double bits_at_10v() const override { return axis_.settings.max_speed; }

  void interrupt(int line, bool rising) override {
    if (state("st_init") && rising && line == zero_line_ && !zero_) zero_ = latched_total();
  }

  void power_up() override {
    Device::power_up();
    const AxisSettings settings = axis_.settings;
    const Quota quota = axis_.quota;
    axis_ = {};
    axis_.settings = settings;
    axis_.quota = quota;
    if (!dac_) return;
    dac_->word = 0;
    dac_turn_.release(*dac_);
  }

  void visit(StateArchive& archive) override {
    Device::visit(archive);
    STATE(archive, axis_, search_, dac_turn_, search_settings_, zero_, enable_released_);
  }

 protected:
  using Base::name_of, Base::report, Base::report_outside, Base::set_state, Base::state, Base::value;
  using typename Base::CommandRow, typename Base::FieldRow, typename Base::VariableRow;

  /// `counter` and `dac` are the fields of the axis' transducer and of its speed reference.
  AnaloguePositioner(const DeviceType& type, const Resources& resources, Cards& cards, FieldRow counter,
                     FieldRow dac)
      : Base(type),
        period_ms_(std::max(resources[FieldRow("TCamp")].number, 1)),
        counter_(connect(cards.counters, resources[counter])),
        enable_(connect(cards.inputs, resources[FieldRow("IAZero")])),
        dac_(connect(cards.analogue_outputs, resources[dac])),
        dac_name_(table.fields[dac].name),
        zero_line_(resources[FieldRow("IntL")].number) {}

  // INIT and parameters.

  /// INIT: the axis begins where its counter stands, at rest.
  void begin() {
    axis_.rebase(count_of(counter_));
    axis_.abort();
    axis_.settle();
    search_.abort();
    zero_.reset();
    enable_released_ = false;
  }

  /// Speeds, ramps of these times [1/100 s] and regulation as the parameters say.
  void recompute(std::int32_t acceleration, std::int32_t deceleration) {
    AxisSettings& settings = axis_.settings;
    settings.bits_per_speed =
        um_per_second(value("decpt"), value("unitvel")) * bits_per_um(settings.resolution);
    settings.max_speed = value("maxvel") * settings.bits_per_speed;
    settings.ramps.seconds_per_speed_up = seconds_per_speed(acceleration, settings.max_speed);
    settings.ramps.seconds_per_speed_down = seconds_per_speed(deceleration, settings.max_speed);
    settings.gains = {value("pgain"), value("feedfw"), value("integt"), value("derivt")};
    settings.offset = value("offset");
    settings.period_ms = period_ms_;
    settings.max_following_error = value("maxfollerr");
  }

  void check_dependent_range(VariableRow variable) {
    if (variable == "setvel" || variable == "prsvel") report_outside(variable, 0, "maxvel");
    if (variable == "sprsvel") report_outside(variable, 0, "prsvel");
    if (variable == "setpos" || variable == "prspos") report_outside(variable, value("minpos"), "maxpos");
  }

  /// What a part of a resolution acts as, if not as itself.
  void tell_acts(VariableRow variable) {
    const std::int64_t acts = usable(value(variable), 1).measure;
    if (acts != value(variable)) report(acts_as(name_of(variable), value(variable), acts));
  }

  /// The demand that the parameters make; a preset search has a speed of its own.
  [[nodiscard]] Demand demanded() const { return axis_.demand(search_.searching() ? 0 : value("setvel")); }

  /// A parameter was written: the running movement takes it if it can. `before`: what they demanded then.
  void write_motion(VariableRow variable, const Demand& before) {
    if (!axis_.profile().moving()) return;
    bool taken = axis_.change(before, demanded());
    if (variable == "setpos" && axis_.placing() && !search_.searching())
      taken = axis_.retarget(clamped(value("setpos")));
    if (!taken) report(kept_for_the_next(name_of(variable)));
  }

  // Commands.

  bool may_execute(int command) override {
    return command != CommandRow("PRESET") || state("st_still") || state("st_prson");
  }

  void execute(int command) override {
    switch (command) {
      case CommandRow("EMRG"):
        rest();
        cut_output();
        break;
      case CommandRow("CALON"):
        rest();
        break;
      case CommandRow("RESUME"):
      case CommandRow("LOOPON"):
      case CommandRow("CALOFF"):
      case CommandRow("REGON"):
        if (!axis_.settle()) tell_quota_lost(table.commands[command].name);
        break;
      case CommandRow("START"):
        start_placement();
        break;
      case CommandRow("STOP"):
        search_.abort();
        set_state("st_prson", false);
        axis_.stop();
        break;
      case CommandRow("PRESET"):
        preset();
        break;
      case CommandRow("MANFW"):
        start_manual(false);
        break;
      case CommandRow("MANBW"):
        start_manual(true);
        break;
      default:
        break;
    }
  }

  [[nodiscard]] std::int32_t clamped(std::int32_t quota) const {
    return held(quota, value("minpos"), value("maxpos"));
  }

  void tell_maxvel() {
    if (value("maxvel") <= 0) report(without_maxvel(value("maxvel")));
  }

  /// Ends any movement here and now.
  void rest() {
    search_.abort();
    axis_.abort();
    set_state("st_prson", false);
    set_state("st_still", true);
  }

  /// An emergency's 0 V, before anything else of its sample: a REGOFF in it freezes no other voltage.
  void cut_output() {
    if (state("st_regoff") || !dac_) return;
    axis_.cut_output();
    dac_->word = 0;
  }

  // The periodic step.

  void latch() override {
    if (state("st_init")) axis_.follow(count_of(counter_), state("st_cntlock"), state("st_cntrev"));
  }

  /// A sample of the preset: of its search, or in mode 2 a load as long as the enable is on, once it was off
  /// since INIT (002 1.2.5.4). `locked`: nothing loads the count.
  void sample_preset(bool locked) {
    const bool enable = is_on(enable_);
    if (!enable) enable_released_ = true;
    if (sample_search(enable, locked)) return;
    if (value("prsmode") != 2 || !enable || !enable_released_ || locked) return;
    axis_.quota.set_um(value("prspos"), axis_.settings.resolution);
    set_state("st_prsok", true);
    requota("IAZero");
  }

  /// The count was changed by `cause`: a quota out of the running movement's reach is told.
  void requota(std::string_view cause) {
    if (!axis_.requota()) tell_quota_lost(cause);
  }

  void tell_quota_lost(std::string_view cause) {
    report({Diagnostic::Kind::warning, std::string(cause),
            "the running movement cannot reach its quota any more and stops"});
  }

  void step_motion() {
    axis_.step_profile();
    if (search_.finished(axis_)) {
      set_state("st_prson", false);
      set_state("st_prsok", true);
    }
    if (!axis_.profile().moving() && !search_.searching()) set_state("st_still", true);
  }

  /// Computes the output and puts it out; says what drives it.
  Drive regulate() {
    // With regulation off the DAC may be another axis': not even an emergency writes it.
    const Drive drive = state("st_regoff")   ? Drive::frozen
                        : state("st_emrg")   ? Drive::emergency
                        : state("st_cal")    ? Drive::calibration
                        : state("st_loopon") ? Drive::reaction
                                             : Drive::open_loop;
    axis_.regulate(drive, value("vout"));
    if (!dac_) return drive;
    if (drive == Drive::frozen)
      dac_turn_.release(*dac_);
    else if (dac_turn_.put(*dac_, axis_.output().word))
      report({Diagnostic::Kind::warning, std::string(dac_name_), std::string(shared_dac_text)});
    return drive;
  }

  void publish() {
    value("posit") = axis_.posit();
    const Actions& actions = axis_.actions();
    value("ffwdreg") = to_long(actions.feed_forward);
    value("propreg") = to_long(actions.proportional);
    value("derreg") = to_long(actions.derivative);
    if (axis_.following_error() && !state("st_foller") && value("maxfollerr") > 0)
      report(following_error_above(axis_.follerr(), value("maxfollerr")));
    set_state("st_foller", axis_.following_error());
    if (axis_.profile().moving()) set_state("st_movdir", axis_.profile().backward());
    if (!axis_.frequency_new()) return;
    const double rate = axis_.frequency().bits_per_second();
    value("frq") = to_long(rate / 4);
    value("vel") = axis_.settings.bits_per_speed > 0 ? to_long(rate / axis_.settings.bits_per_speed) : 0;
  }

  /// posit is within toll of a quota [Um].
  [[nodiscard]] bool within(std::int32_t quota) const {
    return std::abs(std::int64_t{value("posit")} - quota) <= value("toll");
  }
  /// It is within toll of the last placement's quota.
  [[nodiscard]] bool in_place() const { return axis_.placed() && within(*axis_.placed()); }

  /// Total at the count that the counter latched last; the present one without a counter [bits x4].
  [[nodiscard]] std::int64_t latched_total() const {
    const Transducer& transducer = axis_.transducer();
    return counter_ ? transducer.total_at(counter_->latched, state("st_cntlock"), state("st_cntrev"))
                    : transducer.total();
  }

  const int period_ms_;
  Counter* const counter_;  ///< nullptr or line 0 where the .CNF says X.X or X
  const DigitalInput* const enable_;
  AnalogueOutput* const dac_;
  AnalogueAxis axis_;
  PresetSearch search_;

 private:
  /// False if no search runs.
  bool sample_search(bool enable, bool locked) {
    const auto zero = std::exchange(zero_, std::nullopt);
    if (!search_.searching()) return false;
    search_settings_.locked = locked;
    search_.sample(search_settings_, enable, zero, axis_);
    value("setvel") = search_.speed(search_settings_);
    value("setpos") = search_settings_.quota;
    return true;
  }

  /// What every movement begins with.
  void depart() {
    tell_maxvel();
    set_state("st_still", false);
  }

  void start_placement() {
    const std::int32_t wanted = value("setpos");
    const std::int32_t target = clamped(wanted);
    if (target != wanted) report(outside_limits(wanted, target));
    depart();
    axis_.place(target, value("setvel"));
  }

  void start_manual(bool backward) {
    const std::int32_t limit = backward ? value("minpos") : value("maxpos");
    if (at_limit(backward, value("posit"), limit)) {
      report(no_way_left(backward, value("posit"), limit));
      return;
    }
    depart();
    axis_.run(backward, limit, value("setvel"));
  }

  void preset() {
    if (search_.searching()) {
      search_.reverse(axis_);
      return;
    }
    if (value("prsmode") == 2) return;  // no search: the enable loads
    search_settings_ = {value("prsmode"), value("prsdir") == 1, value("prspos"),
                        value("prsvel"),  value("sprsvel"),     false};
    set_state("st_prson", true);
    set_state("st_prsok", false);
    depart();
    search_.start(search_settings_, is_on(enable_), axis_);
  }

  const std::string_view dac_name_;
  const int zero_line_;
  DacTurn dac_turn_;
  PresetSettings search_settings_;    ///< of the running search
  std::optional<std::int64_t> zero_;  ///< total at a zero pulse since the last sample
  bool enable_released_ = false;      ///< seen since INIT: a preset without search needs it
};

}  // namespace drycut::devices::axis
