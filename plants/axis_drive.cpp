#include "plants/axis_drive.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/axis_objections.hpp"

namespace drycut::plants {

namespace {

std::variant<ServoDrive, Inverter, ContactorDrive, SharedMotor> chosen(const AxisDriveData& data,
                                                                       World& world,
                                                                       const std::string& name) {
  if (data.kind == "shared" && data.has_servo_motor())
    return SharedMotor(data.shared, motor_current(data.servo), data.servo.heat, ratings(data.servo));
  if (data.kind == "shared")
    return SharedMotor(data.shared, motor_current(data.motor), data.motor.heat,
                       ratings(data.motor, data.inverter.torque_limit));
  if (data.kind == "inverter") return Inverter(data.inverter, data.motor);
  if (data.kind == "contactors")
    return ContactorDrive(data.contactors, data.motor, world.random(name + " contactors"));
  return ServoDrive(data.servo, world.random(name + " servo"));
}

double state_number(Inverter::State state) {
  switch (state) {
    case Inverter::State::off:
      return 0;
    case Inverter::State::running:
      return 1;
    case Inverter::State::tripped:
      return 3;
    default:
      return 2;
  }
}
double state_number(ContactorDrive::State state) {
  return state == ContactorDrive::State::tripped ? 3 : state == ContactorDrive::State::running ? 1 : 0;
}

void offer(const ServoDrive& servo, std::vector<Channel>& channels) {
  channels.push_back({"servo.reference", "V", [&servo] { return servo.volts(); },
                      "speed reference as the amplifier reads it"});
  channels.push_back({"servo.set_speed", "rpm", [&servo] { return servo.speed_reference() * units::rpm; },
                      "speed reference after offset, drift and filter"});
  channels.push_back({"servo.asked", "N m", [&servo] { return servo.asked(); },
                      "torque that the speed loop asks for, before test signal and limit"});
  channels.push_back({"servo.saturated", "", [&servo] { return servo.saturated() ? 1.0 : 0.0; },
                      "1 while the torque limit acts"});
}

void offer(const SharedMotor& motor, std::vector<Channel>& channels) {
  channels.push_back({"shared.closed", "", [&motor] { return motor.contact().closed() ? 1.0 : 0.0; },
                      "1 while the contactor connects the motor to the drive"});
}

// Inverter and contactors look alike from outside: one scene may try either.
template <class Drive>
void offer(const Drive& drive, std::vector<Channel>& channels) {
  channels.push_back({"drive.state", "", [&drive] { return state_number(drive.state()); },
                      "0 off, 1 runs, 2 stops or holds, 3 has tripped"});
  channels.push_back({"drive.frequency", "Hz", [&drive] { return drive.frequency(); },
                      "frequency at the motor, negative backwards"});
  channels.push_back({"drive.field_speed", "rpm", [&drive] { return drive.field_speed() * units::rpm; },
                      "speed of the motor's field"});
  channels.push_back(
      {"drive.slip", "rpm", [&drive] { return drive.slip() * units::rpm; }, "field less rotor"});
  channels.push_back({"drive.forward", "", [&drive] { return drive.forward_on() ? 1.0 : 0.0; },
                      "contactor forward, or the input after its filter"});
  channels.push_back({"drive.backward", "", [&drive] { return drive.backward_on() ? 1.0 : 0.0; },
                      "contactor backward, or the input after its filter"});
  channels.push_back({"drive.slow", "", [&drive] { return drive.slow_on() ? 1.0 : 0.0; },
                      "contactor slow, or the input after its filter"});
}

void offer(ServoDrive& servo, std::vector<Port>& ports) {
  ports.push_back({"servo.reference", &servo.reference, "speed reference, +-10 V"});
  ports.push_back({"servo.enable", &servo.enable, "enable of the amplifier; strapped high unless wired"});
}

void offer(SharedMotor& motor, std::vector<Port>& ports) {
  ports.push_back({"shared.select", &motor.select,
                   "closes the contactor that connects the motor to the other axis' drive"});
}

template <class Drive>
void offer(Drive& drive, std::vector<Port>& ports) {
  ports.push_back({"drive.forward", &drive.forward, "inverter's input or contactor for positive motion"});
  ports.push_back({"drive.backward", &drive.backward, "for negative motion"});
  ports.push_back({"drive.slow", &drive.slow, "slow speed instead of fast; moves nothing alone"});
}

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace

AxisDrive::AxisDrive(const AxisDriveData& data, World& world, const std::string& name)
    : data_(data),
      drive_(chosen(data, world, name)),
      brake_(data.brake, world.random(name + " brake")),
      changeover_(data.shared) {}

void AxisDriveData::share(const AxisDriveData& lender) {
  AxisDriveData own = lender;
  own.kind = kind;
  own.fed_as = lender.kind;
  own.brake = brake;
  own.shared = shared;
  *this = std::move(own);
}

void AxisDrive::lend_to(AxisDrive& other, Shaft& rotor) {
  changeover_.add(std::get<SharedMotor>(other.drive_), rotor);
}

bool AxisDrive::live() const {
  return std::visit(Overloaded{[](const ServoDrive& servo) { return servo.enabled(); },
                               [](const Inverter& inverter) { return inverter.live(); },
                               [](const auto& drive) { return drive.moving(); }},
                    drive_);
}

// Contacts that open while the drive gives current burn; those that close onto its voltage let it jump.
void AxisDrive::switch_over(double h) {
  const int now = changeover_.update(h);
  if (now != connected_ && live()) {
    if (connected_ != Changeover::nothing)
      switched_.push_back({"switched_live", 0, {{"torque", drive_torque(), "N m"}, {"closed", 0, ""}}});
    if (now != Changeover::nothing)
      switched_.push_back({"switched_live", 0, {{"torque", 0, "N m"}, {"closed", 1, ""}}});
  }
  connected_ = now;
  if (changeover_.take_trip()) power().switch_off();
}

PowerStage::Step AxisDrive::given() const {
  return std::visit(Overloaded{[](const ServoDrive& servo) {
                                 return PowerStage::Step{servo.torque(), 0, 0, servo.enabled()};
                               },
                               [](const Inverter& inverter) { return inverter.given(); },
                               [](const auto&) { return PowerStage::Step{}; }},
                    drive_);
}

void AxisDrive::drive(Shaft& rotor, double h) {
  if (data_.brake.torque > 0) brake_.account(rotor, h);
  const bool shared = changeover_.shared();
  const int before = connected_;
  if (shared) switch_over(h);
  SharedMotor* const other = changeover_.other(connected_);
  const SharedMotor* const other_before = changeover_.other(before);
  Shaft& fed = changeover_.rotor(connected_, rotor);
  const Feed feed{shared && connected_ == Changeover::nothing, &changeover_.rotor(before, rotor),
                  other_before != nullptr ? &other_before->power() : nullptr};
  bool tripped = false;
  moves_ = std::visit(Overloaded{[&](ServoDrive& servo) {
                                   servo.drive(fed, h, feed);
                                   return servo.enabled();
                                 },
                                 [&](Inverter& inverter) {
                                   inverter.drive(fed, h, feed);
                                   tripped = inverter.state() == Inverter::State::tripped;
                                   return inverter.moving();
                                 },
                                 [&](ContactorDrive& contactors) {
                                   contactors.drive(rotor, h);
                                   tripped = contactors.state() == ContactorDrive::State::tripped;
                                   return contactors.moving();
                                 },
                                 [&](SharedMotor& motor) {
                                   motor.drive(rotor, h);
                                   return motor.moving();
                                 }},
                      drive_);
  if (other != nullptr) other->give(given());
  if (feed.open || other != nullptr) moves_ = false;
  just_tripped_ = tripped && !tripped_;
  tripped_ = tripped;
  brake_.update(moves_, h);
  // A changeover overlaps the two for less.
  constexpr double no_overlap = 0.2;  // [s]
  const bool told = against_brake_ >= no_overlap;
  const bool against = data_.brake.torque > 0 && moves_ && brake_.commanded_to_hold();
  against_brake_ = against ? against_brake_ + h : 0;
  just_against_brake_ = !told && against_brake_ >= no_overlap;
}

double AxisDrive::torque() const {
  if (connected_ > Changeover::own) return 0;
  return drive_torque();
}

double AxisDrive::drive_torque() const {
  return std::visit([](const auto& drive) { return drive.torque(); }, drive_);
}

PowerStage& AxisDrive::power() {
  return std::visit([](auto& drive) -> PowerStage& { return drive.power(); }, drive_);
}

double AxisDrive::rated_torque() const {
  return data_.has_servo_motor() ? data_.servo.rated_torque : data_.motor.winding.rated_torque;
}

void AxisDrive::offer_ports(std::vector<Port>& ports) {
  std::visit([&ports](auto& drive) { offer(drive, ports); }, drive_);
  if (data_.kind != "shared") power().offer_ports(ports, data_.kind == "servo" ? "servo" : "drive");
  if (data_.brake.torque > 0)
    ports.push_back({"brake.release", &brake_.release,
                     "releases the brake, with the drive unless brake.control says otherwise; strapped high "
                     "unless wired"});
}

void AxisDrive::offer_channels(std::vector<Channel>& channels) const {
  channels.push_back({"motor.torque", "N m", [this] { return torque(); }, "torque of the motor"});
  channels.push_back({"motor.utilisation", "%", [this] { return std::abs(torque()) / rated_torque() * 100; },
                      "motor torque over rated torque"});
  std::visit(
      [&channels](const auto& drive) {
        offer(drive, channels);
        drive.power().offer_channels(channels);
      },
      drive_);
  // What it takes from the mains is the drive's.
  if (data_.kind == "shared")
    std::erase_if(channels, [](const Channel& channel) { return channel.name == "drive.energy"; });
  changeover_.offer_channels(channels);
  if (data_.brake.torque > 0) brake_.offer_channels(channels);
}

void AxisDrive::offer_settings(std::vector<Setting>& settings) {
  if (auto* const servo = std::get_if<ServoDrive>(&drive_)) servo->offer_settings(settings);
}

void AxisDrive::offer_faults(std::vector<Fault>& faults) {
  std::visit(Overloaded{[&faults](ServoDrive& servo) { servo.offer_faults(faults, "servo"); },
                        [&faults](SharedMotor& motor) { motor.contact().offer_faults(faults, "shared"); },
                        [&faults](auto& drive) { drive.offer_faults(faults); }},
             drive_);
  changeover_.offer_faults(faults);
  if (data_.brake.torque > 0) brake_.offer_faults(faults);
}

bool AxisDrive::has_events() {
  return just_tripped_ || just_against_brake_ || !switched_.empty() || power().has_events();
}

std::vector<MachineEvent> AxisDrive::take_events(const Shaft& rotor) {
  std::vector<MachineEvent> events = power().take_events();
  for (MachineEvent& event : switched_) events.push_back(std::move(event));
  switched_.clear();
  if (just_tripped_) events.push_back({"trip", 0, {{"speed", rotor.speed_before * units::rpm, "rpm"}}});
  if (just_against_brake_)
    events.push_back({"against_brake",
                      0,
                      {{"torque", torque(), "N m"}, {"speed", rotor.speed_before * units::rpm, "rpm"}}});
  return events;
}

void AxisDrive::offer_events(std::vector<EventType>& types) {
  types.push_back({"trip",
                   {{"speed", "rpm"}},
                   "inverter or breaker has switched the motor off: both contactors closed, a phase lost "
                   "behind the inverter, an overload, the fault trip; speed of the motor then",
                   Severity::error});
  types.push_back({"against_brake",
                   {{"torque", "N m"}, {"speed", "rpm"}},
                   "the drive has moved the motor for 0.2 s against a brake that is told to hold: once each "
                   "time; torque of the motor and speed then",
                   Severity::error});
  types.push_back({"switched_live",
                   {{"torque", "N m"}, {"closed", ""}},
                   "a contactor between a shared drive and its motors has opened (closed 0) or closed (1) "
                   "while the drive was on: it burns, or the motor jumps; torque that it has interrupted",
                   Severity::damage});
  types.push_back({"pulled_out",
                   {{"speed", "rpm"}, {"slip", "rpm"}},
                   "the motor has lost its load: on the mains beyond its pull-out torque, on an inverter at "
                   "the torque limit, it does not come nearer to the speed of its field for half a second, "
                   "or the load drives it away from there; speed of the motor and slip then",
                   Severity::error});
  PowerStage::offer_events(types);
}

void AxisDrive::visit(StateArchive& archive) {
  std::visit([&archive](auto& drive) { archive.named("drive_", drive); }, drive_);
  STATE(archive, brake_, changeover_, connected_, moves_, tripped_, just_tripped_, against_brake_,
        just_against_brake_);
  if (archive.restores()) switched_.clear();
}

Parameters axis_drive_parameters(AxisDriveData& data, const AxisDriveSources& from) {
  return joined({row("drive",
                     "what drives the axis: servo by voltage; inverter or contactors with plugs "
                     "drive.forward, drive.backward, drive.slow",
                     data.kind, {"servo", "inverter", "contactors"}, from.kind),
                 model_row("servo.model", data.servo_model)},
                group("servo.", servo_parameters(data.servo, from.servo)),
                Parameters{model_row("induction_motor.model", data.motor_model)},
                group("induction_motor.", induction_motor_parameters(data.motor)),
                group("inverter.", inverter_parameters(data.inverter)),
                group("contactors.", contactor_parameters(data.contactors)),
                group("brake.", holding_brake_parameters(data.brake, from.brake_torque)));
}

namespace {

using Objections = std::vector<PlantDefinition::Objection>;

void object_to_winding(const WindingData& data, const std::string& prefix, double inertia, double h,
                       Objections& found) {
  if (data.rated_speed >= data.synchronous_speed) {
    found.push_back({"plant.parameters-contradict"_code, prefix + "rated_speed",
                     "it is not below synchronous_speed: no torque without slip",
                     "less than synchronous_speed"});
    return;
  }
  if (data.pullout_torque < 1.05 * data.rated_torque) {
    found.push_back({"plant.parameters-contradict"_code, prefix + "pullout_torque",
                     "it is not above rated_torque", "1.6 to 3 times rated_torque"});
    return;
  }
  // The curve is steepest at no slip.
  AxisObjections steep("rotor", h);
  steep.damper(prefix + "rated_speed", 2 * data.pullout_torque / Winding(data).pullout_slip(), inertia,
               "field and rotor");
  for (auto& objection : steep.take()) found.push_back(std::move(objection));
}

}  // namespace

Objections axis_drive_objections(const AxisDriveData& data, double inertia, double h) {
  if (data.has_servo_motor()) return servo_objections(data.servo, inertia, h);
  Objections found;
  object_to_winding(data.motor.winding, "induction_motor.", inertia, h, found);
  if (data.motor.max_speed <= data.motor.winding.rated_speed)
    found.push_back({"plant.parameters-contradict"_code, "induction_motor.max_speed",
                     "it is not above rated_speed", "more than rated_speed"});
  const InductionMotorData motor = electrical(data.motor);
  if (motor.no_load_current >= motor.rated_current)
    found.push_back({"plant.parameters-contradict"_code, "induction_motor.no_load_current",
                     "it is not below rated_current", "30 to 60 % of rated_current"});
  if (data.kind == "contactors") {
    object_to_winding(data.contactors.slow, "contactors.slow.", inertia, h, found);
    return found;
  }
  for (auto& objection : power_objections("inverter.", data.inverter.amplifier, data.inverter.supply))
    found.push_back(std::move(objection));
  const auto frequency = [&](const char* name, double hertz) {
    if (hertz > data.motor.rated_frequency)
      found.push_back({"plant.parameters-contradict"_code, name,
                       fmt::format("{:g} Hz is above the rated frequency: the flux would weaken", hertz),
                       fmt::format("at most {:g} Hz", data.motor.rated_frequency)});
  };
  frequency("inverter.fast", data.inverter.fast);
  frequency("inverter.slow", data.inverter.slow);
  if (data.inverter.torque_limit > data.motor.winding.pullout_torque)
    found.push_back({"plant.parameters-contradict"_code, "inverter.torque_limit",
                     "it is above induction_motor.pullout_torque",
                     fmt::format("at most {:g} N m", data.motor.winding.pullout_torque)});
  return found;
}

}  // namespace drycut::plants
