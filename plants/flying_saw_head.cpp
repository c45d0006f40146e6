#include "plants/flying_saw_head.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/lag.hpp"

namespace drycut::plants {

namespace {

constexpr double beyond = 10;  // a switch's target reaches past the end of the stroke [m]
constexpr EndStopData cushion = {1e6, 4e3};
constexpr double blade_speed = 2 * units::turn;  // slow enough to be seen to turn [rad/s]

}  // namespace

double plunge_speed(const SawHeadData& data) {
  return (data.down_force + data.mass * units::gravity) / data.down_throttle;
}

double return_speed(const SawHeadData& data) {
  return (data.up_force - data.mass * units::gravity) / data.up_throttle;
}

StiffPair head_cushion(const SawHeadData& data) { return {cushion.stiffness, cushion.damping, data.mass}; }

SawHead::SawHead(const SawHeadData& data, World& world)
    : data_(data),
      body_(world.add_slide({.name = "saw head", .mass = data.mass, .axis = {0, -1, 0}, .gravity = true})),
      upper_(cushion, 0, -1),
      lower_(cushion, data.stroke, 1),
      up_({data.switch_margin - beyond / 2, beyond, 0.2e-3, data.switch_delay}, 0, 0),
      down_({data.stroke - data.switch_margin + beyond / 2, beyond, 0.2e-3, data.switch_delay}, 0, 0),
      force_(-data.up_force) {}

void SawHead::valve(double h) {
  if (plunge.level == valve_down_) {
    valve_waiting_ = 0;
  } else {
    valve_waiting_ += h;
    constexpr double hair = 1e-9;  // a whole number of steps is one, whatever the last digit says
    if (valve_waiting_ > data_.valve_delay - hair) {
      valve_down_ = plunge.level;
      valve_waiting_ = 0;
    }
  }
  const double target = (valve_down_ ? data_.down_force : -data_.up_force) * (1 - pressure_loss_);
  if (h != h_) {
    h_ = h;
    fill_share_ = share_of(data_.fill_time, h);
  }
  force_ += (target - force_) * fill_share_;
}

void SawHead::drive(double h, double resistance) {
  valve(h);
  body_.add_force(force_);
  upper_.drive(body_, h);
  lower_.drive(body_, h);
  // Throttle and material resist with the speed at the end of the step: no resistance is too hard for it.
  const double weight = data_.mass * units::gravity;  // the world adds it
  const double momentum = body_.mass * body_.speed + (body_.force + weight) * h;
  const double resist = momentum > 0 ? data_.down_throttle + resistance : data_.up_throttle;
  body_.add_force(-resist * momentum / (body_.mass + resist * h));
}

void SawHead::sense(double h) {
  up_.sense(body_.position_before, body_.position, h);
  down_.sense(body_.position_before, body_.position, h);
  blade_turn_ += blade_speed * h;
  if (blade_turn_ >= units::turn) blade_turn_ = std::fmod(blade_turn_, units::turn);
}

void SawHead::offer_ports(std::vector<Port>& ports) {
  ports.push_back({"head.plunge", &plunge, "valve of the saw head: on = down"});
  ports.push_back({"head.up", &up_.port, "the head is up"});
  ports.push_back({"head.down", &down_.port, "the head is down: the blade is through"});
}

void SawHead::offer_channels(std::vector<Channel>& channels) const {
  channels.push_back({"head.depth", "mm", [this] { return body_.position * units::millimetres; },
                      "way of the saw head from its upper end down"});
  channels.push_back({"head.speed", "mm/s", [this] { return body_.speed * units::millimetres; },
                      "speed of the saw head, positive downwards"});
  channels.push_back({"head.force", "N", [this] { return force_; }, "force of its cylinder, downwards"});
  channels.push_back(on_off("head.up", up_.port.level, "switch: the head is up"));
  channels.push_back(on_off("head.down", down_.port.level, "switch: the head is down"));
  channels.push_back(on_off("head.plunge", plunge.level, "1 while the head is told to go down"));
}

void SawHead::offer_faults(std::vector<Fault>& faults) {
  faults.push_back(fault_value("head", "pressure_loss", "%", pressure_loss_,
                               "share of the cylinder's force that is missing, both ways", in_percent, 0.7));
  up_.offer_faults(faults, "head.up");
  down_.offer_faults(faults, "head.down");
}

void SawHead::visit(StateArchive& archive) {
  STATE(archive, plunge, upper_, lower_, up_, down_, valve_down_, valve_waiting_, force_, pressure_loss_,
        blade_turn_);
}

Parameters saw_head_parameters(SawHeadData& data) {
  return {
      row("mass", "kg", "mass of the saw head with spindle and blade", data.mass, 0.1, 1000, "estimate"),
      row("stroke", "mm", "way of the head between the ends of its cylinder", data.stroke, 1, 2000,
          "a tube of 50 mm with room above and below"),
      row("clearance", "mm", "blade over the material with the head up", data.clearance, 0, 1000, "estimate"),
      row("down_force", "N", "force of the cylinder downwards", data.down_force, 1, 1e5,
          "cylinder of 32 mm at 5 bar, less friction"),
      row("up_force", "N", "force of the cylinder upwards", data.up_force, 1, 1e5,
          "cylinder of 40 mm at 5 bar"),
      row("down_throttle", "N s/m", "throttle of the exhaust downwards", data.down_throttle, 1, 1e6,
          "set for 0.8 m/s"),
      row("up_throttle", "N s/m", "throttle of the exhaust upwards", data.up_throttle, 1, 1e6,
          "set for 1 m/s"),
      row("valve_delay", "ms", "from the command until the force begins to change", data.valve_delay, 0, 1000,
          "data sheet: fast valve of the class"),
      row("fill_time", "ms", "time constant of the cylinder's force", data.fill_time, 0, 1000,
          "estimate: short hose"),
      row("switch_margin", "mm", "the end switches are on so far before the ends", data.switch_margin, 0.1,
          100, "estimate"),
      row("switch_delay", "ms", "delay of the end switches", data.switch_delay, 0, 100,
          "estimate: cylinder switch"),
  };
}

}  // namespace drycut::plants
