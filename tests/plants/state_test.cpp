// The state of machines: kept at any moment and restored, there or in others, they go on to the last bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/state_archive.hpp"
#include "plants/backlash_axis.hpp"
#include "plants/bench.hpp"
#include "plants/flying_saw.hpp"
#include "plants/ideal_axis.hpp"
#include "plants/linear_axis.hpp"
#include "plants/motor_load.hpp"
#include "plants/rotary_knife.hpp"
#include "plants/servo_drive.hpp"
#include "plants/vertical_press.hpp"
#include "plants/web.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

using Bytes = StateArchive::Bytes;
using Members = std::vector<StateArchive::Member>;

constexpr int steps_between_moments = 83;
constexpr int moments = 83;

/// What a fault or setting is set to [SI].
double some_value(std::string_view unit, const Range& range) {
  static const std::map<std::string_view, double> by_unit = {
      {"V", 0.05},  {"V/s", 0.5}, {"N m", 4}, {"N", 60},    {"%", 0.2},
      {"mm", 3e-3}, {"ms", 4e-3}, {"kg", 30}, {"1/s", 500}, {"m/min", 1.3}};
  const auto found = by_unit.find(unit);
  if (found != by_unit.end()) return found->second;
  return range.whole ? std::min(range.max, 9.0) : 0.3;
}

/// Machines in one world, worked by who knows nothing but the number of the step: what they came to is in
/// them.
class Site {
 public:
  template <class Definition>
  Site& add(const std::string& name, Definition&& definition) {
    auto plant = definition.build(world_, [this](std::string_view other) -> Plant* {
      for (auto& [known, built] : plants_)
        if (known == other) return built.get();
      return nullptr;
    });
    plants_.emplace_back(name, std::move(plant));
    return *this;
  }
  /// Once all machines stand.
  Site& built() {
    for (auto& [name, plant] : plants_) {
      for (Port& port : plant->ports()) ports_.push_back(std::move(port));
      for (Channel& channel : plant->channels()) channels_.push_back(std::move(channel));
      for (Fault& fault : plant->faults()) faults_.push_back(std::move(fault));
      for (Setting& setting : plant->settings()) settings_.push_back(std::move(setting));
      for (Parameter& row : plant->live_parameters()) live_.emplace_back(plant.get(), std::move(row));
    }
    return *this;
  }
  std::function<double(double)> volts = [](double t) { return 4 * std::sin(turn * t / 0.13); };
  std::function<bool(const std::string&, int)> level = [](const std::string& plug, int step) {
    return step / (400 + 130 * static_cast<int>(plug.size() % 7)) % 2 == 0;
  };

  /// A step; what it gave is what can be seen of the machines from outside.
  std::vector<double> step() {
    work();
    for (auto& [name, plant] : plants_) plant->drive(h);
    world_.step(h);
    for (auto& [name, plant] : plants_) plant->sense(h);
    ++step_;
    std::vector<double> seen;
    for (const Channel& channel : channels_) seen.push_back(channel.read());
    for (const Port& port : ports_) see(port, seen);
    for (auto& [name, plant] : plants_)
      for (const MachineEvent& event : plant->take_events()) {
        seen.push_back(event.fraction);
        for (const auto& value : event.values) seen.push_back(value.number);
        events.insert(std::string(event.name));
      }
    return seen;
  }
  /// What a picture would show now.
  std::vector<double> picture() {
    std::vector<double> shown;
    for (auto& [name, plant] : plants_) {
      for (const Part& part : plant->parts()) {
        const PartPose pose = part.now();
        shown.push_back(pose.visible ? 1 : 0);
        if (!pose.visible) continue;
        shown.insert(shown.end(), pose.pose.position.begin(), pose.pose.position.end());
        shown.insert(shown.end(), pose.pose.rotation.begin(), pose.pose.rotation.end());
        shown.insert(shown.end(), pose.scale.begin(), pose.scale.end());
      }
      std::vector<Callout> callouts;
      plant->callouts(callouts);
      for (const Callout& callout : callouts)
        shown.insert(shown.end(), {callout.at[0], callout.at[1], callout.to[0], callout.to[1]});
    }
    return shown;
  }
  void visit(StateArchive& archive) {
    for (auto& [name, plant] : plants_)
      archive.under(name, [&, plant = plant.get()] { plant->visit_all(archive); });
    archive.named("world", world_);
    archive.named("step", step_);
  }
  Plant& plant(std::size_t n) { return *plants_[n].second; }
  World& world() { return world_; }
  bool faults = true;  ///< act
  std::set<std::string> events;

 private:
  static void see(const Port& port, std::vector<double>& seen) {
    if (const auto* encoder = std::get_if<EncoderPort*>(&port.plug)) {
      seen.insert(seen.end(), {static_cast<double>((*encoder)->count), (*encoder)->before, (*encoder)->now});
    } else if (const auto* signal = std::get_if<SignalPort*>(&port.plug)) {
      seen.push_back((*signal)->level ? 1 : 0);
      for (const auto& edge : (*signal)->edges) seen.insert(seen.end(), {edge.fraction, edge.width});
    }
  }

  // Plugs all the time; faults, settings and live parameters one after the other, each in its turn.
  void work() {
    for (const Port& port : ports_) {
      if (const auto* reference = std::get_if<ReferencePort*>(&port.plug)) {
        (*reference)->volts = volts(step_ * h);
      } else if (const auto* command = std::get_if<CommandPort*>(&port.plug)) {
        (*command)->level = port.name.ends_with("enable") ? step_ % 2900 < 2700 : level(port.name, step_);
      } else if (const auto* train = std::get_if<PulsePort*>(&port.plug)) {
        (*train)->pulses += step_ % 1500 < 1000 ? 2 : 0;
      }
    }
    const int last = steps_between_moments * moments;
    for (std::size_t i = 0; faults && i < faults_.size(); ++i) {
      const int begin = last / 4 + static_cast<int>(i) * (last / 2) / static_cast<int>(faults_.size());
      if (step_ == begin) faults_[i].act(some_value(faults_[i].unit, faults_[i].range));
      if (step_ == begin + 170) faults_[i].act(0);
    }
    for (std::size_t i = 0; i < settings_.size(); ++i)
      if (step_ == 700 + 83 * static_cast<int>(i))
        settings_[i].write(some_value(settings_[i].unit, settings_[i].range));
    for (std::size_t i = 0; i < live_.size(); ++i) {
      if (step_ != 400 + 67 * static_cast<int>(i)) continue;
      *std::get<double*>(live_[i].second.value) *= 1.03;
      live_[i].first->parameters_changed();
    }
  }

  World world_{7};
  std::vector<std::pair<std::string, std::unique_ptr<Plant>>> plants_;
  std::vector<Port> ports_;
  std::vector<Channel> channels_;
  std::vector<Fault> faults_;
  std::vector<Setting> settings_;
  std::vector<std::pair<Plant*, Parameter>> live_;
  int step_ = 0;
};

Bytes saved(Site& site, Members* members = nullptr) {
  Bytes bytes;
  StateArchive::save(bytes, site, members);
  return bytes;
}

void restore(Site& site, const Bytes& bytes, std::optional<std::size_t> skip = {}) {
  StateArchive archive = StateArchive::restoring(bytes.data(), bytes.size(), skip);
  site.visit(archive);
  ASSERT_EQ(archive.left(), 0U);
}

/// The first member that a site has otherwise than `wanted`, "" where there is none.
std::string difference(Site& site, const Bytes& wanted) {
  Members members;
  const Bytes now = saved(site, &members);
  if (now == wanted) return "";
  for (const auto& member : members) {
    const std::size_t end = member.offset + member.size;
    if (end > wanted.size() || !std::equal(now.begin() + static_cast<std::ptrdiff_t>(member.offset),
                                           now.begin() + static_cast<std::ptrdiff_t>(end),
                                           wanted.begin() + static_cast<std::ptrdiff_t>(member.offset)))
      return member.name;
  }
  return "the end";
}

/// A run in one piece: the state and the picture at each moment, and what each step gave.
struct Whole {
  std::vector<Bytes> states;
  std::vector<std::vector<double>> pictures;
  std::vector<std::vector<double>> seen;
  std::set<std::string> events;

  explicit Whole(Site& site) {
    for (int moment = 0; moment <= moments; ++moment) {
      states.push_back(saved(site));
      pictures.push_back(site.picture());
      if (moment == moments) break;
      for (int n = 0; n < steps_between_moments; ++n) seen.push_back(site.step());
    }
    events = site.events;
  }
  /// Restores a moment and goes on to the one after the next: where it is not as it was.
  std::string goes_on(Site& site, std::size_t moment) const {
    restore(site, states[moment]);
    if (const std::string member = difference(site, states[moment]); !member.empty())
      return "not restored: " + member;
    if (site.picture() != pictures[moment]) return "the picture";
    const std::size_t last = std::min(moment + 2, states.size() - 1);
    for (std::size_t n = moment * steps_between_moments; n < last * steps_between_moments; ++n)
      if (site.step() != seen[n]) return "step " + std::to_string(n);
    if (site.picture() != pictures[last]) return "the picture later on";
    return difference(site, states[last]);
  }
};

using Builder = std::function<void(Site&)>;

/// A drum at web speed, 1 m/s, with some ripple.
void follow_the_web(Site& site, std::size_t knife) {
  auto& machine = static_cast<RotaryKnife&>(site.plant(knife));
  machine.drum().speed = 1 / machine.radius();
  machine.rotor().speed = machine.drum().speed * 5;
  const double volts = machine.rotor().speed * rpm / 200;  // 2000 rpm at 10 V
  site.volts = [volts](double t) { return volts * (1 + 0.02 * std::sin(turn * t / 0.1)); };
}

struct Case {
  std::string name;
  Builder build;
  std::string event = {};  ///< that comes
  friend void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const PlantType& type : plant_types())
    all.push_back({std::string(type.name), [&type](Site& site) {
                     if (type.name == "rotary_knife" || type.name == "flying_saw")
                       site.add("web", WebDefinition());
                     site.add("machine", *type.define()).built();
                   }});

  all.push_back({"a straight blade",
                 [](Site& site) {
                   WebDefinition web;
                   web.data.wheel.acceleration_slip = 1e-3;
                   web.data.wheel.eccentricity = 1e-3;
                   RotaryKnifeDefinition knife;
                   knife.data.circumference = 0.2;
                   knife.data.drive.servo.offset = 0.01;
                   knife.data.sensors.encoder.eccentricity = 0.01;
                   knife.data.drum_eccentricity = 1e-4;
                   site.add("web", web).add("knife", knife).built();
                   follow_the_web(site, 1);
                 },
                 "cut"});
  all.push_back({"helical blades",
                 [](Site& site) {
                   WebDefinition web;
                   web.data.strip.on = true;
                   web.data.marks = {.pitch = 0.05, .scatter = 1e-3};
                   RotaryKnifeDefinition knife;
                   knife.data.helix = 0.05;
                   knife.data.counter.kind = "blades";
                   knife.data.motors = 2;
                   knife.data.circumference = 0.2;
                   knife.data.sensors.encoder_on_load = true;
                   site.add("web", web).add("knife", knife).built();
                   follow_the_web(site, 1);
                 },
                 "cut"});
  all.push_back({"pieces that are cut again",
                 [](Site& site) {
                   WebDefinition web;
                   web.data.lead = 0.25;
                   web.data.marks = {.pitch = 0.1, .scatter = 1e-3};
                   web.data.outfeed.start = 0.02;
                   RotaryKnifeDefinition first;
                   first.data.circumference = 0.2;
                   RotaryKnifeDefinition second;
                   second.data.circumference = 0.2;
                   second.data.initial_angle = 0.3;
                   second.data.station = {.place = 0.45, .scrap_shorter = 0.03, .scrap_every = 2};
                   site.add("web", web).add("first", first).add("second", second).built();
                   follow_the_web(site, 1);
                   follow_the_web(site, 2);
                 },
                 "scrap"});
  for (const std::string drive : {"servo", "pulses"})
    for (const double place : {0.0, 0.4})
      all.push_back({drive + (place > 0 ? " saw on pieces" : " saw"),
                     [drive, place](Site& site) {
                       WebDefinition web;
                       web.data.section = place > 0 ? "strip" : "tube";
                       web.data.width = 0.04;
                       web.data.thickness = 2e-3;
                       web.data.drive.speed = 0.2;
                       web.data.lead = 0.9;
                       FlyingSawDefinition saw;
                       saw.data.drive.kind = drive;
                       saw.data.drive.pulses.following_limit = 0.05;
                       saw.data.station.place = place;
                       saw.data.start = 0.2;
                       site.add("web", web);
                       // The saw is in the strip when the knife before it cuts that off.
                       RotaryKnifeDefinition knife;
                       knife.data.initial_angle = 2 * pi - 0.35;
                       if (place > 0) site.add("knife", knife);
                       site.add("saw", saw).built();
                       site.volts = [](double t) { return std::fmod(t, 0.6) < 0.45 ? 0.8 : -2.0; };
                       site.level = [](const std::string& plug, int step) {
                         const int part = step % 3000;
                         if (plug == "clamp") return part > 300 && part < 2700;
                         if (plug == "head.plunge") return part > 500 && part < 2600;
                         return plug == "servo.direction" || part < 100;
                       };
                     },
                     "cut"});
  for (const auto& [kind, stop] : std::vector<std::pair<std::string, std::string>>{
           {"inverter", "ramp"}, {"inverter", "dc_brake"}, {"contactors", ""}, {"servo", ""}})
    all.push_back({"press, " + kind + stop,
                   [kind = kind, stop = stop](Site& site) {
                     VerticalPressDefinition press;
                     press.data.drive.kind = kind;
                     if (!stop.empty()) press.data.drive.inverter.stop = stop;
                     press.data.drive.contactors.scatter = 5e-3;
                     press.data.drive.brake.scatter = 5e-3;
                     press.data.workpiece = {1e6, 1e3};
                     press.data.workpiece_height = 0.302;
                     press.data.gear.backlash = 1e-3;
                     site.add("press", press).built();
                     site.level = [](const std::string& plug, int step) {
                       return step / 700 % 3 == (plug == "drive.backward" ? 1 : 0);
                     };
                   },
                   "pressed"});
  for (const std::string event : {"pulled_out", "sag"})
    all.push_back({"a press that loses its ram: " + event,
                   [event](Site& site) {
                     VerticalPressDefinition press;
                     press.data.drive.inverter.torque_limit = 3;
                     press.data.drive.brake.torque = 1;
                     site.add("press", press).built();
                     site.faults = false;
                     site.level = [event](const std::string& plug, int step) {
                       return plug == "drive.forward" && event == "pulled_out" && step > 1000;
                     };
                   },
                   event});
  all.push_back({"a saw that leans on its stop",
                 [](Site& site) {
                   FlyingSawDefinition saw;
                   saw.data.start = 0.7;
                   site.add("web", WebDefinition()).add("saw", saw).built();
                   site.volts = [](double) { return 3.0; };
                 },
                 "crash"});
  all.push_back({"a motor that gets hot",
                 [](Site& site) {
                   LinearAxisDefinition axis;
                   axis.data.drive.servo.heat.temperature_limit = 273.15 + 40.05;
                   site.add("axis", axis).built();
                   site.volts = [](double t) { return std::fmod(t, 0.2) < 0.1 ? 8 : -8; };
                 },
                 "overload"});
  for (const std::string kind : {"servo", "inverter"})
    all.push_back({kind + " that changes its motor",
                   [kind](Site& site) {
                     for (const std::string name : {"a", "b", "c"}) {
                       LinearAxisDefinition axis;
                       axis.data.start = 0.5;
                       axis.data.inclination = 0.3;
                       axis.data.drive.kind = name == "a" ? kind : "shared";
                       axis.data.drive.shared = {.close_delay = 3.3e-3, .open_delay = 2.1e-3};
                       if (name != "a") axis.data.drive.shared.drive = "a";
                       axis.data.drive.brake.torque = 5;
                       site.add(name, axis);
                     }
                     site.built();
                   },
                   "switched_live"});
  all.push_back({"an axis in its stops with its pen down",
                 [](Site& site) {
                   BacklashAxisDefinition worn;
                   worn.axis.data.start = 1.04;
                   LinearAxisDefinition pen;
                   pen.data.tool = "pen";
                   pen.data.carrier = "worn";
                   pen.data.sensors.encoder.tooth_error = 1e-4;
                   pen.data.guide_friction.breakaway = 20;
                   site.add("worn", worn).add("pen", pen).built();
                   site.volts = [](double t) { return 6 + 4 * std::sin(turn * t / 0.2); };
                 },
                 "end_stop"});
  return all;
}

/// Nothing that is restored depends on what has not been, nor takes another member along.
void expect_members_are_apart(Site& site, const Whole& whole) {
  const Bytes& then = whole.states[moments / 2];
  const auto first = std::find_if(whole.states.begin(), whole.states.begin() + moments / 2,
                                  [&](const Bytes& other) { return other.size() == then.size(); });
  if (first == whole.states.begin() + moments / 2) return;  // lists of another length are another place
  Members members;
  restore(site, then);
  saved(site, &members);
  std::size_t differ = 0;
  for (std::size_t n = 0; n < members.size(); ++n) {
    if (n + 1 < members.size() && members[n + 1].name.starts_with(members[n].name)) continue;  // a length
    restore(site, *first);
    restore(site, then, n);
    const std::string found = difference(site, then);
    EXPECT_TRUE(found.empty() || found == members[n].name) << found << " with " << members[n].name;
    differ += found.empty() ? 0 : 1;
  }
  EXPECT_GT(differ, 0U);
}

class StateOf : public testing::TestWithParam<Case> {};

TEST_P(StateOf, IsWholeAtAnyMoment) {
  const Case& one = GetParam();
  Site site;
  one.build(site);
  const Whole whole(site);
  EXPECT_EQ(site.world().failure(), "");
  EXPECT_TRUE(one.event.empty() || whole.events.contains(one.event));
  // In the same machines, which have run on or are before it.
  for (std::size_t i = 0; i < moments; i += 4) {
    const std::size_t moment = i * 19 % moments;
    EXPECT_EQ(whole.goes_on(site, moment), "") << "the same machines, moment " << moment;
  }
  for (std::size_t moment = 0; moment < moments; moment += 9) {
    Site other;
    one.build(other);
    EXPECT_EQ(whole.goes_on(other, moment), "") << "other machines, moment " << moment;
  }
  expect_members_are_apart(site, whole);
}

INSTANTIATE_TEST_SUITE_P(Machines, StateOf, testing::ValuesIn(cases()), [](const auto& tested) {
  std::string name = tested.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

TEST(State, OfAWorldThatFailedIsThatItFailed) {
  const auto build = [](Site& site) { site.add("axis", LinearAxisDefinition()).built(); };
  Site site;
  build(site);
  for (int i = 0; i < 100; ++i) site.step();
  const Bytes before = saved(site);
  static_cast<LinearAxis&>(site.plant(0)).rotor().speed = 1e6;
  site.step();
  ASSERT_NE(site.world().failure(), "");
  const Bytes failed = saved(site);
  const std::string why = site.world().failure();
  restore(site, before);
  for (int i = 0; i < 100; ++i) site.step();
  EXPECT_EQ(site.world().failure(), "");
  Site other;
  build(other);
  restore(other, failed);
  EXPECT_EQ(other.world().failure(), why);
  other.step();
  EXPECT_EQ(other.world().failure(), why);
}

// Bullet's pose of a shaft is made of its angle.
TEST(State, IsThatOfBulletsPosesToo) {
  const auto turned = [](World& world, Shaft& shaft) {
    for (int i = 0; i < 1000; ++i) {
      shaft.add_torque(0.3);
      world.step(h);
    }
  };
  World world;
  Shaft& shaft = world.add_shaft({.name = "shaft", .revolutions = 0.3, .speed = 50});
  turned(world, shaft);
  Bytes bytes;
  StateArchive::save(bytes, world);
  World other;
  Shaft& its = other.add_shaft({.name = "shaft"});
  auto restoring = StateArchive::restoring(bytes.data(), bytes.size());
  other.visit(restoring);
  turned(world, shaft);
  turned(other, its);
  EXPECT_EQ(other.pose(its).rotation, world.pose(shaft).rotation);
  EXPECT_EQ(its.part, shaft.part);
}

// A reference that stands is converted once; what comes back from another moment is of another one.
TEST(State, OfAServoIsConvertedAnew) {
  World world;
  Shaft& rotor = world.add_shaft({.name = "rotor", .inertia = 1e-3});
  ServoDrive servo({}, world.random("servo"));
  const auto volts_at = [&](double volts) {
    servo.reference.volts = volts;
    servo.drive(rotor, h);
    return servo.volts();
  };
  EXPECT_NEAR(volts_at(2), 2, 5e-3);
  Bytes bytes;
  StateArchive::save(bytes, servo);
  EXPECT_NEAR(volts_at(5), 5, 5e-3);
  auto restoring = StateArchive::restoring(bytes.data(), bytes.size());
  servo.visit(restoring);
  EXPECT_NEAR(servo.volts(), 2, 5e-3);
  EXPECT_NEAR(volts_at(5), 5, 5e-3);
}

// What was kept of a motor's load is for a report: a log beside the state.
TEST(State, OfTheLoadsOfAMotorIsApart) {
  RotaryKnifeDefinition definition;
  WebDefinition web;
  Machine line(definition, &web);
  auto& knife = static_cast<RotaryKnife&>(*line.plant);
  knife.keep_motor_loads(100);
  line.reference(1);
  line.run(0.01);
  Bytes state;
  Bytes number;
  StateArchive::save(state, [&](StateArchive& archive) { knife.visit_all(archive); });
  StateArchive::Journal journal;
  const auto loads = [&](StateArchive& archive) { archive.log("loads", *knife.motor_loads()); };
  StateArchive::save(number, loads, nullptr, &journal);

  Machine other(definition, &web);
  auto& its = static_cast<RotaryKnife&>(*other.plant);
  auto restoring = StateArchive::restoring(state.data(), state.size());
  its.visit_all(restoring);  // of one that keeps none
  its.keep_motor_loads(100);
  auto restoring_loads = StateArchive::restoring(number, journal.bytes);
  restoring_loads.log("loads", *its.motor_loads());
  ASSERT_EQ(its.motor_loads()->samples.size(), 100U);
  EXPECT_EQ(its.motor_loads()->samples.back().torque, knife.motor_loads()->samples.back().torque);
}

}  // namespace
}  // namespace drycut::plants
