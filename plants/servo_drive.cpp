#include "plants/servo_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/lag.hpp"

namespace drycut::plants {

bool has_currents(const ServoData& data) {
  return data.rated_current > 0 || data.stall_current > 0 || data.peak_current > 0;
}

ServoData electrical(ServoData data) {
  constexpr double saturation = 1.25;
  const bool sheet = has_currents(data);
  const auto estimate = [](double& value, double otherwise) {
    if (value == 0) value = otherwise;
  };
  estimate(data.stall_torque, data.rated_torque);
  if (data.rated_current > 0)
    data.torque_constant = data.rated_torque / data.rated_current;
  else if (data.stall_current > 0)
    data.torque_constant = data.stall_torque / data.stall_current;
  estimate(data.rated_current, data.rated_torque / data.torque_constant);
  estimate(data.stall_current, data.stall_torque / data.torque_constant);
  estimate(data.peak_current, (sheet ? saturation : 1) * data.peak_torque / data.torque_constant);
  estimate(data.winding_resistance,
           0.06 * data.rated_torque * data.rated_speed / (1.5 * data.rated_current * data.rated_current));
  estimate(data.amplifier.current, std::max(data.rated_current, data.stall_current));
  estimate(data.amplifier.peak_current, std::max(data.peak_current, 1.1 * data.amplifier.current));
  return data;
}

DriveRatings ratings(const ServoData& given) {
  const ServoData data = electrical(given);
  const auto current = motor_current(given);
  // An amplifier that is not known gives the motor its torque, to the last digit.
  const double most = given.amplifier.peak_current <= 0 ? data.peak_torque
                      : current.bends()                 ? current.torque_of(given.amplifier.peak_current)
                                                        : data.torque_constant * given.amplifier.peak_current;
  return {.rotor_inertia = data.rotor_inertia,
          .stall_torque = data.stall_torque,
          .rated_torque = data.rated_torque,
          .peak_torque = std::min(data.peak_torque, most),
          .torque_at_max_speed = std::min(data.torque_at_max_speed, most),
          .rated_speed = data.rated_speed,
          .max_speed = data.max_speed};
}

MotorCurrent motor_current(const ServoData& given) {
  const ServoData data = electrical(given);
  MotorCurrent current = {.per_torque_squared = 1 / (data.torque_constant * data.torque_constant),
                          .resistance = 1.5 * data.winding_resistance};
  if (!has_currents(given)) return current;
  current.rated = {data.rated_torque, data.rated_current};
  current.stall = {data.stall_torque, data.stall_current};
  current.peak = {data.peak_torque, data.peak_current};
  return current;
}

ServoDrive::ServoDrive(const ServoData& data, Random noise)
    : data_(electrical(data)),
      power_(motor_current(data), data.heat, ratings(data), data_.amplifier, data.supply),
      random_(noise),
      ripples_(data.cogging > 0 || data.torque_ripple > 0),
      filters_(data.filters) {
  enable.level = true;
}

namespace {

/// That the drive reckons with.
double inertia_of(const ServoData& data) { return (1 + data.inertia_ratio) * data.rotor_inertia; }

double loop_gain(const ServoData& data) { return inertia_of(data) * data.speed_gain; }

// The largest s g for the rotor alone, as it is while a gear's play parts it from its load. A step takes
// torque (as the speed it brings in a step) and speed by the matrix [[1 - s, -s g], [1 - s, 1 - s g]]: s is
// the share of the current lag that a step makes up for, g = gain * step / inertia. The loop swings at the
// angle of its eigenvalues, arccos(trace / (2 root(determinant))) = arccos((2 - s - s g) / (2 root(1 - s))) a
// step. At s g = 0.5 that is within 5 % of the loop in continuous time.
constexpr double most_correction = 0.5;

}  // namespace

std::vector<PlantDefinition::Objection> servo_objections(const ServoData& data, double inertia, double h) {
  std::vector<PlantDefinition::Objection> found;
  if (data.max_speed < data.rated_speed)
    found.push_back({"plant.parameters-contradict"_code, "servo.max_speed", "it is below servo.rated_speed",
                     "at least servo.rated_speed"});
  if (data.peak_torque < data.rated_torque)
    found.push_back({"plant.parameters-contradict"_code, "servo.peak_torque",
                     "it is below servo.rated_torque", "at least servo.rated_torque"});
  if (data.torque_at_max_speed > data.peak_torque)
    found.push_back({"plant.parameters-contradict"_code, "servo.torque_at_max_speed",
                     "it is above servo.peak_torque", "at most servo.peak_torque"});
  if (has_currents(data)) {
    const ServoData known = electrical(data);
    if (known.stall_torque >= data.rated_torque && known.stall_current < known.rated_current * (1 - 1e-9))
      found.push_back({"plant.parameters-contradict"_code, "servo.stall_current",
                       "it is below servo.rated_current, at no less torque", "at least servo.rated_current"});
    constexpr double rounded = 0.98;
    const double least = known.peak_torque / known.torque_constant;
    if (known.peak_current < rounded * least)
      found.push_back({"plant.parameters-contradict"_code, "servo.peak_current",
                       fmt::format("it is below {:.3g} A, what the peak torque takes in proportion", least),
                       "more, for iron saturates; all currents are rms, peak values over root 2"});
  }
  for (auto& objection : power_objections("servo.", data.amplifier, data.supply))
    found.push_back(std::move(objection));
  for (auto& objection : torque_filter_objections("servo.", data.filters, h))
    found.push_back(std::move(objection));
  const double most = most_correction * inertia / (share_of(data.current_lag, h) * h);
  if (loop_gain(data) > most)
    found.push_back({"plant.step-too-long"_code, "servo.speed_gain",
                     fmt::format("the speed loop of {:g} rad/s, set for {:g} rotors, turns the motor's own "
                                 "{:.3g} kg m2 faster than steps of {:g} us can follow",
                                 data.speed_gain, 1 + data.inertia_ratio, inertia, h * 1e6),
                     fmt::format("a shorter scene.step, or at most {:.3g} rad/s",
                                 data.speed_gain * most / loop_gain(data))});
  return found;
}

void ServoDrive::prepare(double h) {
  h_ = h;
  filter_share_ = share_of(data_.filter, h);
  lag_share_ = share_of(data_.current_lag, h);
  speed_per_volt_ = data_.speed_at_10v / 10;
  forward_share_ = share_of(data_.torque_forward_filter, h);
  lsb_ = 20.0 / static_cast<double>(1LL << data_.adc_bits);
  input_ = std::numeric_limits<double>::quiet_NaN();
}

double ServoDrive::convert(double volts) const {
  return lsb_ * std::nearbyint(std::clamp(volts, -10.0, 10.0 - lsb_) / lsb_);
}

double ServoDrive::speed_loop(double speed, double h) {
  const double gain = loop_gain(data_);
  const double error = filtered_ - speed;
  wanted_ = gain * error + integral_ + ahead_;
  if (filters_.any()) wanted_ = filters_.pass(wanted_, h);
  const double wanted = wanted_ + test_torque_;
  // With less voltage the motor has its torque up to less speed. Braking it has it at any.
  const double as_rated = speed / power_.speed_share();
  double limit = std::abs(as_rated) > data_.rated_speed && wanted * speed > 0
                     ? power_.ratings().peak(as_rated)
                     : power_.ratings().peak_torque;
  if (faults_.torque_limit > 0) limit = std::min(limit, faults_.torque_limit);
  const double command = std::clamp(wanted, -limit, limit);
  saturated_ = command != wanted;
  if (saturated_) asked_ = limit > 0 ? std::abs(wanted) / limit : std::abs(wanted) / data_.rated_torque + 1;
  // Anti-windup: the integral stands while the limit acts and the error drives it further in.
  if (!saturated_ || wanted * error < 0) integral_ += gain / data_.integral_time * error * h;
  return command;
}

double ServoDrive::torque_ahead(double commanded, double h) {
  acceleration_ += ((commanded - commanded_) / h - acceleration_) * forward_share_;
  commanded_ = commanded;
  return data_.torque_forward * inertia_of(data_) * acceleration_;
}

void ServoDrive::give(double command, Shaft& rotor) {
  torque_ += (command - torque_) * lag_share_;
  rotor.add_torque(torque_);
  if (ripples_) rotor.add_torque(ripple(rotor));
}

double ServoDrive::ripple(const Shaft& rotor) const {
  return data_.cogging * std::sin(units::turn * data_.cogging_periods * rotor.part) +
         data_.torque_ripple * torque_ * std::sin(units::turn * data_.torque_ripple_periods * rotor.part);
}

// What the last step came to, as in PowerStage::account, and a trip that the enable takes back.
void ServoDrive::begin(const Shaft& turned, double h, const PowerStage* other) {
  if (h != h_) prepare(h);
  power_.account({torque_, 0, saturated_ ? asked_ : 0, energised_}, turned, h, other);
  if (enable.level && !enabled_before_) power_.reset();
  enabled_before_ = enable.level;
  energised_ = enabled();
}

void ServoDrive::drive(Shaft& rotor, double h, const Feed& feed) {
  begin(feed.turned != nullptr ? *feed.turned : rotor, h, feed.other);
  faults_.drifted += faults_.drift * h;
  double input = faults_.stuck ? faults_.stuck_at : reference.volts;
  input += data_.offset + faults_.offset + faults_.drifted;
  if (faults_.noise > 0) input += faults_.noise * random_.gaussian();
  if (input != input_) converted_ = convert(input_ = input);
  if (feed.open) {  // current and loops end with the circuit
    filtered_ = torque_ = 0;
    end_loops(0);
    return;
  }
  if (!energised_) return release(rotor);
  filtered_ += (converted_ * speed_per_volt_ - filtered_) * filter_share_;
  if (data_.torque_forward > 0) ahead_ = torque_ahead(filtered_, h);
  give(speed_loop(rotor.speed, h), rotor);
}

void ServoDrive::follow(double speed_reference, double commanded, Shaft& rotor, double h) {
  begin(rotor, h);
  if (!energised_) return release(rotor);
  filtered_ = speed_reference;
  if (data_.torque_forward > 0) ahead_ = torque_ahead(commanded, h);
  give(speed_loop(rotor.speed, h), rotor);
}

void ServoDrive::coast(Shaft& rotor, double h) {
  begin(rotor, h);
  release(rotor);
}

// They begin afterwards from a motor of `speed` that is asked for nothing.
void ServoDrive::end_loops(double speed) {
  commanded_ = speed;
  integral_ = acceleration_ = ahead_ = wanted_ = 0;
  filters_.clear();
  saturated_ = false;
}

void ServoDrive::release(Shaft& rotor) {
  filtered_ = rotor.speed;
  end_loops(rotor.speed);
  give(0, rotor);
}

void ServoDrive::offer_settings(std::vector<Setting>& settings) {
  settings.push_back({"servo.test_torque",
                      "N m",
                      [this](double v) { test_torque_ = v; },
                      [this] { return test_torque_; },
                      "test signal: torque added to what the speed loop asks for",
                      {-1e5, 1e5, false}});
}

void ServoDrive::offer_faults(std::vector<Fault>& faults, const std::string& component) {
  Faults& f = faults_;
  faults.push_back(
      fault_value(component, "offset", "V", f.offset, "added to the analogue input", {-20, 20, false}));
  faults.push_back({component,
                    "drift",
                    "V/s",
                    [&f](double v) {
                      f.drift = v;
                      if (v == 0) f.drifted = 0;
                    },
                    "the analogue input drifts at this rate; 0 takes the drift away",
                    {-1e3, 1e3, false},
                    {},
                    1});
  faults.push_back(fault_value(component, "noise", "V", f.noise, "white noise on the analogue input, rms",
                               {0, 20, false}));
  faults.push_back({component, "stuck", "",
                    [this](double v) {
                      if (v != 0 && !faults_.stuck) faults_.stuck_at = reference.volts;
                      faults_.stuck = v != 0;
                    },
                    "1: the reference stays as it is now"});
  offer_power_faults(faults, component);
}

void ServoDrive::offer_power_faults(std::vector<Fault>& faults, const std::string& component) {
  Faults& f = faults_;
  faults.push_back(
      fault_state(component, "disabled", f.disabled, "1: the amplifier trips, the motor coasts"));
  faults.push_back(fault_value(component, "torque_limit", "N m", f.torque_limit,
                               "the torque is limited to this; 0 takes the limit away", {0, 1e5, false},
                               0.2));
  power_.offer_faults(faults);
}

void ServoDrive::Faults::visit(StateArchive& archive) {
  STATE(archive, offset, drift, drifted, noise, stuck, stuck_at, disabled, torque_limit);
}

void ServoDrive::visit(StateArchive& archive) {
  STATE(archive, reference, enable, power_, random_, converted_, filtered_, integral_, commanded_,
        acceleration_, ahead_, filters_, wanted_, test_torque_, torque_, saturated_, asked_, energised_,
        enabled_before_, faults_);
  if (archive.restores()) h_ = 0;
}

Parameters servo_parameters(ServoData& data, const ServoSources& from) {
  constexpr std::string_view sheet = "unchecked: data sheet of Mitsubishi HG-SR202";
  Parameters rows = {
      row("rotor_inertia", "kg m2", "inertia of the rotor, a body of its own", data.rotor_inertia, 1e-7, 10,
          sheet),
      row("rated_torque", "N m", "continuous torque; utilisation is measured against it", data.rated_torque,
          1e-3, 1e4, sheet),
      row("peak_torque", "N m", "largest torque up to rated speed", data.peak_torque, 1e-3, 1e5, sheet),
      row("torque_at_max_speed", "N m", "largest driving torque at max_speed", data.torque_at_max_speed, 1e-3,
          1e5, "estimate: typical fall of the class above rated speed"),
      row("rated_speed", "rpm", "speed up to which the peak torque is available", data.rated_speed, 1, 1e5,
          sheet),
      row("max_speed", "rpm", "no driving torque is left 5 % above this speed", data.max_speed, 1, 1e5,
          sheet),
      preset_row("class", "kind of motor, whose cogging and torque_ripple are the defaults", data.motor_class,
                 motor_classes(), "none is named: an even torque"),
      row("cogging", "N m", "amplitude of the torque of magnets against slots", data.cogging, 0, 1e3,
          "servo.class"),
      row("cogging_periods", "its periods a turn: least common multiple of slots and poles",
          data.cogging_periods, 1, 1000, "usual: 12 slots, 10 poles"),
      row("torque_ripple", "%", "amplitude of the torque's ripple, of the torque", data.torque_ripple, 0, 50,
          "servo.class"),
      row("torque_ripple_periods", "its periods a turn: six times the pole pairs", data.torque_ripple_periods,
          1, 1000, "usual: 4 pole pairs"),
      row("speed_at_10v", "rpm", "motor speed at a reference of 10 V", data.speed_at_10v, 1, 1e5,
          from.speed_at_10v),
      row("adc_bits", "resolution of the analogue input over -10 V .. +10 V", data.adc_bits, 8, 24,
          "estimate: 14 bits are usual in the class"),
      row("offset", "V", "offset of the analogue input", data.offset, -1, 1, "ideal: none"),
      row("filter", "ms", "time constant of the reference filter, 0 = none", data.filter, 0, 1000,
          "estimate"),
      row("speed_gain", "rad/s", "gain of the speed loop, Kp = (1 + inertia_ratio) rotor_inertia speed_gain",
          data.speed_gain, 0.1, 5000, "estimate: medium stiffness of an auto-tuned axis"),
      row("integral_time", "ms", "integral time Ti of the speed loop", data.integral_time, 0.1, 1e5,
          "estimate: as speed_gain"),
      row("inertia_ratio", "", "load to motor inertia, as set in the amplifier", data.inertia_ratio, 0, 300,
          from.inertia_ratio),
      row("current_lag", "ms", "time constant of the current loop, 0 = none", data.current_lag, 0, 100,
          "estimate: bandwidth of 300 Hz"),
      row("torque_forward", "%",
          "share of the torque for the reference's acceleration, by rotor_inertia and inertia_ratio, that is "
          "given ahead of the speed loop",
          data.torque_forward, 0, 200, "none: usual are 0 to 100 %"),
      row("torque_forward_filter", "ms", "time constant of that acceleration, 0 = none",
          data.torque_forward_filter, 0, 100, "estimate"),
      row("stall_torque", "N m", "continuous torque at standstill, 0 = as at rated speed", data.stall_torque,
          0, 1e4, "estimate"),
      row("torque_constant", "N m/A", "torque over the rms current, where none of the currents is given",
          data.torque_constant, 1e-3, 1e3, "estimate: rated torque at 9.6 A"),
      row("rated_current", "A", "rms current at rated torque, 0 = by torque_constant", data.rated_current, 0,
          1e4, "by torque_constant"),
      row("stall_current", "A", "rms current at stall torque, 0 = in proportion to the rated current",
          data.stall_current, 0, 1e4, "by torque_constant"),
      row("peak_current", "A",
          "rms current at peak torque, 0 = in proportion, and a quarter more where one of the others is "
          "given",
          data.peak_current, 0, 1e5, "by torque_constant"),
      row("winding_resistance", "ohm",
          "between two phases at 20 degC, 0 = 6 % of the rated power is lost in it", data.winding_resistance,
          0, 1e4, "estimate: usual in the class"),
  };
  return joined(std::move(rows), torque_filter_parameters(data.filters),
                motor_heat_parameters(data.heat, "estimate: usual in the class"),
                amplifier_parameters(data.amplifier, "estimate: amplifier of the 2 kW class"),
                group("supply.", supply_parameters(data.supply)));
}

}  // namespace drycut::plants
