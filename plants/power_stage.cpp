#include "plants/power_stage.hpp"

#include <algorithm>
#include <cmath>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

namespace {

constexpr double settles_every = 0.5e-3;  // [s]
constexpr double saturation_gap = 10e-3;  // shorter gaps do not end a saturation [s]
constexpr double percent = 100;

double celsius(double kelvin) { return kelvin - 273.15; }

double time_constant(const AmplifierData& data) {
  const double ratio = data.current / data.peak_current;
  return -data.overload_time / std::log1p(-ratio * ratio);
}

// The square of the current [A2] for means of torque squared and rotor loss, while there is current in
// `energised` of the time.
double amperes_squared(const MotorCurrent& motor, double torque_squared, double rotor_loss,
                       double energised) {
  return motor.no_load * motor.no_load * energised + torque_squared * motor.per_torque_squared +
         rotor_loss * motor.per_rotor_loss;
}

// For ever at standstill, as the sheet's temperatures hold for it.
double stall_squared(const MotorCurrent& motor, double torque) {
  return amperes_squared(motor, torque * torque, motor.rated_rotor_loss, 1) +
         (motor.bends() ? motor.more_squared(torque) : 0);
}

double on_line(const MotorCurrent::Point& from, const MotorCurrent::Point& to, double torque) {
  if (to.torque <= from.torque) return to.current;
  return from.current + (to.current - from.current) * (torque - from.torque) / (to.torque - from.torque);
}

}  // namespace

double MotorCurrent::amperes(double torque) const {
  const double size = std::abs(torque);
  if (size <= rated.torque) return rated.current * size / rated.torque;
  return size <= stall.torque ? on_line(rated, stall, size) : on_line(stall, peak, size);
}

double MotorCurrent::torque_of(double amperes) const {
  const auto back = [&](const Point& from, const Point& to) {
    return on_line({from.current, from.torque}, {to.current, to.torque}, amperes);
  };
  if (amperes <= rated.current) return rated.torque * amperes / rated.current;
  return amperes <= stall.current ? back(rated, stall) : back(stall, peak);
}

double DriveRatings::continuous(double speed) const {
  return stall_torque + (rated_torque - stall_torque) * std::min(1.0, std::abs(speed) / rated_speed);
}

double DriveRatings::peak(double speed) const {
  const double n = std::abs(speed);
  if (n <= rated_speed) return peak_torque;
  if (n <= max_speed)
    return peak_torque + (torque_at_max_speed - peak_torque) * (n - rated_speed) / (max_speed - rated_speed);
  const double overspeed = (n / max_speed - 1) / 0.05;
  return std::max(0.0, torque_at_max_speed * (1 - overspeed));
}

DriveTotals DriveTotals::combined(const DriveTotals& other, double sign) const {
  DriveTotals sum = *this;
  for (double DriveTotals::*const one :
       {&DriveTotals::time, &DriveTotals::work, &DriveTotals::copper, &DriveTotals::rotor_loss,
        &DriveTotals::from_mains, &DriveTotals::in_resistor, &DriveTotals::torque_squared,
        &DriveTotals::current_squared, &DriveTotals::fed_squared, &DriveTotals::travel,
        &DriveTotals::saturated})
    sum.*one += sign * other.*one;
  return sum;
}

PowerStage::PowerStage(const MotorCurrent& current, const MotorHeatData& heat, const DriveRatings& ratings,
                       const std::optional<AmplifierData>& amplifier, const std::optional<SupplyData>& link)
    : ratings_(ratings),
      amplifier_(amplifier),
      current_(current),
      heat_(heat, current.resistance * stall_squared(current, ratings.stall_torque),
            current.rated_rotor_loss),
      limit_(heat.temperature_limit) {
  if (link) link_.emplace(*link);
  ready.level = mains_ok.level = true;
}

void PowerStage::prepare(double h) {
  h_ = h;
  every_ = std::max(1, static_cast<int>(std::lround(settles_every / h)));
  if (amplifier_) i2t_share_ = -std::expm1(-every_ * h / time_constant(*amplifier_));
}

// Another motor has the torque: amplifier and link feel it, this motor stands still.
void PowerStage::feed(const Step& step, const PowerStage& other, double speed, double h) {
  elsewhere_resistance_ = other.heat_.resistance();
  elsewhere_.work += step.torque * speed * h;
  elsewhere_.torque_squared += step.torque * step.torque * h;
  if (current_.bends()) elsewhere_.more_current += current_.more_squared(step.torque) * h;
  elsewhere_.rotor_loss += step.rotor_loss * h;
  if (step.energised) elsewhere_.energised += h;
  torque_ = speed_ = 0;
}

void PowerStage::saturate(double asked, double h) {
  totals_.saturated += h;
  const double now = totals_.time + steps_ * h;
  if (!saturation_.on) saturation_ = {true, now, now, 0};
  saturation_.end = now + h;
  saturation_.asked = std::max(saturation_.asked, asked);
}

void PowerStage::end_saturation() {
  saturation_.on = false;
  events_.push_back({"saturated",
                     1,
                     {{"begin", saturation_.begin, "s"},
                      {"end", saturation_.end, "s"},
                      {"asked", saturation_.asked * percent, "%"}}});
}

// Heat, I2t and link over the steps that were summed up.
void PowerStage::settle(double h) {
  if (h != h_) prepare(h);
  const double seconds = steps_ * h;
  const double energised = sum_.energised / seconds;
  const double rotor_loss = sum_.rotor_loss / seconds;
  const double squared = amperes_squared(current_, sum_.torque_squared / seconds, rotor_loss, energised) +
                         sum_.more_current / seconds;
  loss_ = current_.resistance * squared * heat_.resistance() + rotor_loss;
  heat_.warm(loss_, seconds);
  const double copper = loss_ * seconds;
  double fed = squared;
  double energy = sum_.work + copper;
  bool energised_at_all = energised > 0;
  if (elsewhere_resistance_ > 0) {
    const double lost = elsewhere_.rotor_loss / seconds;
    const double theirs =
        amperes_squared(current_, elsewhere_.torque_squared / seconds, lost, elsewhere_.energised / seconds) +
        elsewhere_.more_current / seconds;
    fed += theirs;
    energy += elsewhere_.work + (current_.resistance * theirs * elsewhere_resistance_ + lost) * seconds;
    energised_at_all = energised_at_all || elsewhere_.energised > 0;
    elsewhere_resistance_ = 0;
    elsewhere_ = {};
  }
  if (amplifier_) i2t_ += (fed / (amplifier_->current * amplifier_->current) - i2t_) * i2t_share_;
  if (link_) {
    link_->carry(energy, seconds);
    speed_share_ = link_->speed_share();
    totals_.from_mains = link_->from_mains();
    totals_.in_resistor = link_->in_resistor();
    peaks_.voltage = std::max(peaks_.voltage, link_->voltage());
    if (!link_->mains_well()) without_mains_ += seconds;
  } else {
    totals_.from_mains += energy;
  }
  totals_.time += seconds;
  totals_.work += sum_.work;
  totals_.copper += copper;
  totals_.rotor_loss += sum_.rotor_loss;
  totals_.current_squared += squared * seconds;
  totals_.fed_squared += fed * seconds;
  totals_.torque_squared += sum_.torque_squared;
  totals_.travel += sum_.travel;
  const double torque = std::abs(sum_.torque);
  peaks_.torque = std::max(peaks_.torque, torque);
  peaks_.speed = std::max(peaks_.speed, sum_.speed);
  const double available =
      sum_.torque * sum_.speed_then > 0 ? ratings_.peak(sum_.speed_then) : ratings_.peak_torque;
  peaks_.i2t = std::max(peaks_.i2t, i2t_);
  peaks_.winding = std::max(peaks_.winding, heat_.winding());
  if (torque > 0) peaks_.share = std::max(peaks_.share, available > 0 ? torque / available : 1);

  if (saturation_.on && totals_.time - saturation_.end > saturation_gap) end_saturation();
  watch(energised_at_all);
  show();
  sum_ = {};
  steps_ = 0;
}

void PowerStage::trip(std::string_view event, std::vector<MachineEvent::Value> values) {
  tripped_ = true;
  events_.push_back({event, 1, std::move(values)});
}

void PowerStage::pulled_out(double speed, double slip) {
  events_.push_back(
      {"pulled_out", 1, {{"speed", speed * units::rpm, "rpm"}, {"slip", slip * units::rpm, "rpm"}}});
}

void PowerStage::watch(bool energised) {
  if (tripped_ || !energised || !armed_) return;
  if (i2t_ > 1 || heat_.winding() > limit_ || (link_ && link_->resistor_load() >= 1))
    trip("overload", {{"i2t", i2t_ * percent, "%"},
                      {"temperature", celsius(heat_.winding()), "degC"},
                      {"resistor", link_ ? link_->resistor_load() * percent : 0, "%"}});
  else if (link_ && link_->over())
    trip("bus_overvoltage", {{"voltage", link_->voltage(), "V"}});
  else if (link_ && link_->under())
    trip("bus_undervoltage", {{"voltage", link_->voltage(), "V"}});
}

void PowerStage::show() {
  const bool fed = !link_ || (!link_->under() && !link_->over());
  edge_ = ready.show(fed && !tripped_);
  edge_ = mains_ok.show(!link_ || link_->mains_well()) || edge_;
}

void PowerStage::clear_edges() {
  ready.edges.clear();
  mains_ok.edges.clear();
  edge_ = false;
}

void DriveTotals::visit(StateArchive& archive) {
  STATE(archive, time, work, copper, rotor_loss, from_mains, in_resistor, torque_squared, current_squared,
        fed_squared, travel, saturated);
}

void DrivePeaks::visit(StateArchive& archive) { STATE(archive, torque, speed, share, voltage, i2t, winding); }

void PowerStage::Step::visit(StateArchive& archive) { STATE(archive, torque, rotor_loss, asked, energised); }

void PowerStage::Sum::visit(StateArchive& archive) {
  STATE(archive, work, torque_squared, more_current, torque, speed_then, speed, travel, rotor_loss,
        energised);
}

void PowerStage::Saturation::visit(StateArchive& archive) { STATE(archive, on, begin, end, asked); }

void PowerStage::visit(StateArchive& archive) {
  if (link_) archive.named("link_", *link_);
  STATE(archive, ready, mains_ok, heat_, every_, steps_, h_, i2t_share_, sum_, elsewhere_,
        elsewhere_resistance_, totals_, without_mains_, peaks_, torque_, speed_, i2t_, loss_, speed_share_,
        tripped_, armed_, edge_, saturation_);
  if (archive.restores()) events_.clear();
}

void PowerStage::offer_ports(std::vector<Port>& ports, const std::string& drive) {
  ports.push_back({drive + ".ready", &ready, "on while the drive is fed and has not tripped"});
  if (link_)
    ports.push_back({drive + ".mains_ok", &mains_ok,
                     "mains monitor: on while all phases have at least 85 % of their voltage"});
}

void PowerStage::offer_channels(std::vector<Channel>& channels) const {
  channels.insert(
      channels.end(),
      {{"motor.power", "W", [this] { return torque_ * speed_; }, "mechanical power of the motor"},
       {"motor.copper_loss", "W", [this] { return loss_; }, "lost in the motor's windings and bars"},
       {"motor.temperature", "degC", [this] { return celsius(heat_.winding()); },
        "of the motor's winding; ambient is 40 degC"},
       {"motor.housing_temperature", "degC", [this] { return celsius(heat_.housing()); },
        "of the motor's housing"},
       {"motor.energy", "J", [this] { return totals_.work; }, "work of the motor since the start"},
       {"drive.energy", "J", [this] { return totals_.from_mains; }, "taken from the mains since the start"}});
  if (amplifier_)
    channels.push_back({"drive.i2t", "%", [this] { return i2t_ * percent; },
                        "thermal load of the amplifier; it trips at 100 %"});
  if (!link_) return;
  channels.insert(
      channels.end(),
      {{"drive.bus_voltage", "V", [this] { return link_->voltage(); }, "of the DC link"},
       {"drive.mains.power", "W", [this] { return link_->mains_power(); }, "taken from the mains"},
       {"drive.resistor.power", "W", [this] { return link_->resistor_power(); }, "of the brake resistor"},
       {"drive.resistor.temperature", "degC", [this] { return celsius(link_->resistor_temperature()); },
        "of the brake resistor"}});
}

void PowerStage::offer_faults(std::vector<Fault>& faults) {
  if (link_) link_->offer_faults(faults);
}

void PowerStage::offer_events(std::vector<EventType>& types) {
  types.insert(
      types.end(),
      {{"saturated",
        {{"begin", "s"}, {"end", "s"}, {"asked", "%"}, {"share", "%"}},
        "the torque limit has acted from begin to end (gaps under 10 ms are none): the largest "
        "torque that the loop asked for over the limit, and how much of the machine cycle that was, at "
        "most 100 % (drives.cycle, else the last from cut to cut, else the run so far)",
        Severity::warning},
       {"overload",
        {{"i2t", "%"}, {"temperature", "degC"}, {"resistor", "%"}},
        "the drive has tripped: I2t of the amplifier or load of the brake resistor at 100 %, or "
        "the winding at its limit; it is off until enabled anew",
        Severity::error},
       {"bus_overvoltage",
        {{"voltage", "V"}},
        "the drive has tripped: braking has lifted the DC link over its limit",
        Severity::error},
       {"bus_undervoltage",
        {{"voltage", "V"}},
        "the drive has tripped: the DC link has sunk below its limit",
        Severity::error}});
}

std::vector<PlantDefinition::Objection> power_objections(const std::string& group,
                                                         const AmplifierData& amplifier,
                                                         const SupplyData& supply) {
  std::vector<PlantDefinition::Objection> found;
  if (amplifier.peak_current > 0 && amplifier.peak_current <= amplifier.current)
    found.push_back({"plant.parameters-contradict"_code, group + "amplifier_peak_current",
                     "it is not above amplifier_current", "more than amplifier_current"});
  if (supply.brake_voltage - supply.brake_hysteresis <= 1)
    found.push_back({"plant.parameters-contradict"_code, group + "supply.brake_hysteresis",
                     "the brake resistor would stay on at the voltage of the mains",
                     "less than supply.brake_voltage has above 100 %"});
  if (supply.overvoltage <= supply.brake_voltage)
    found.push_back({"plant.parameters-contradict"_code, group + "supply.overvoltage",
                     "it is not above supply.brake_voltage", "more than supply.brake_voltage"});
  return found;
}

Parameters amplifier_parameters(AmplifierData& data, std::string_view source) {
  return {
      row("amplifier_current", "A",
          "continuous rms current of the amplifier, 0 = what the motor's continuous torque takes",
          data.current, 0, 1e4, source),
      row("amplifier_peak_current", "A", "its largest rms current, 0 = what the motor's peak torque takes",
          data.peak_current, 0, 1e5, source),
      row("overload_time", "s", "at the largest current from cold, then it trips", data.overload_time, 1e-2,
          1e4, source),
  };
}

}  // namespace drycut::plants
