#include "plants/ideal_axis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/units.hpp"

namespace drycut::plants {

namespace {}

IdealAxis::IdealAxis(const IdealAxisData& data, World& world)
    : data_(data),
      pulses_(world.random("ideal axis")),
      switches_{PositionSwitch(data.switches[0], 0, data.start),
                PositionSwitch(data.switches[1], 0, data.start)} {}

void IdealAxis::sense(double h) {
  const double before = travel_.value();
  speed_ = data_.speed_at_10v / 10 * std::clamp(reference_.volts, -10.0, 10.0);
  travel_.add(speed_ * h / data_.resolution);
  const double now = travel_.value();

  const double direction = data_.reverse ? -1 : 1;
  pulses_.carry(direction * before, direction * now);
  index_.edges.clear();
  const double counts_per_pitch = data_.index_pitch / data_.resolution;
  const double origin = data_.start / data_.resolution;
  if (before != now && !pulses_.stuck())
    put_index(index_, (origin + before) / counts_per_pitch, (origin + now) / counts_per_pitch,
              direction * before, direction * now, direction * counts_per_pitch);
  for (PositionSwitch& s : switches_)
    s.sense(data_.start + before * data_.resolution, data_.start + now * data_.resolution, h);
}

std::vector<Port> IdealAxis::ports() {
  return {{"reference", &reference_, "speed reference, +-10 V"},
          {"encoder", &pulses_.port, "incremental encoder"},
          {"encoder.index", &index_, "its index pulse, once an index_pitch"},
          {"switch1", &switches_[0].port, "limit or preset switch"},
          {"switch2", &switches_[1].port, "limit or preset switch"}};
}

std::vector<Channel> IdealAxis::channels() {
  return {
      {"position", "mm",
       [this] { return (data_.start + travel_.value() * data_.resolution) * units::millimetres; },
       "position of the axis"},
      {"speed", "mm/s", [this] { return speed_ * units::millimetres; }, "speed of the axis"},
      {"reference", "V", [this] { return reference_.volts; }, "speed reference"},
      {"encoder.count", "", [this] { return static_cast<double>(pulses_.port.count); },
       "count (x4), after faults"},
      {"switch1", "", [this] { return switches_[0].port.level ? 1.0 : 0.0; }, "limit or preset switch"},
      {"switch2", "", [this] { return switches_[1].port.level ? 1.0 : 0.0; }, "limit or preset switch"},
  };
}

std::vector<Fault> IdealAxis::faults() {
  std::vector<Fault> faults;
  pulses_.offer_faults(faults, "encoder");
  switches_[0].offer_faults(faults, "switch1");
  switches_[1].offer_faults(faults, "switch2");
  return faults;
}

Parameters IdealAxisDefinition::parameters() {
  const auto row = [](const char* name, std::string_view unit, std::string_view meaning, double* value,
                      double min, double max) {
    return Parameter{name, unit, meaning, value, min, max, {}, {}, "a round number"};
  };
  return {
      row("speed_at_10v", "mm/s", "speed at a reference of 10 V", &data.speed_at_10v, 0.001, 100000),
      row("resolution", "mm", "travel per count (x4)", &data.resolution, 1e-6, 1000),
      row("index_pitch", "mm", "travel between two index pulses", &data.index_pitch, 0.01, 100000),
      row("start", "mm", "position at the start; the count is 0 there", &data.start, -1e6, 1e6),
      {.name = "reverse",
       .unit = "",
       .meaning = "counts down in positive direction",
       .value = &data.reverse,
       .max = 1},
      row("switch1.position", "mm", "middle of the target of switch 1", &data.switches[0].centre, -1e6, 1e6),
      row("switch1.width", "mm", "width of its target", &data.switches[0].width, 0, 1e6),
      row("switch1.hysteresis", "mm", "it lets go this far behind the target", &data.switches[0].hysteresis,
          0, 1000),
      row("switch1.delay", "ms", "delay of its filter", &data.switches[0].delay, 0, 1000),
      row("switch2.position", "mm", "middle of the target of switch 2", &data.switches[1].centre, -1e6, 1e6),
      row("switch2.width", "mm", "width of its target", &data.switches[1].width, 0, 1e6),
      row("switch2.hysteresis", "mm", "it lets go this far behind the target", &data.switches[1].hysteresis,
          0, 1000),
      row("switch2.delay", "ms", "delay of its filter", &data.switches[1].delay, 0, 1000),
  };
}

std::vector<PlantDefinition::Objection> IdealAxisDefinition::objections(double h) {
  constexpr double most = 1000;  // more pulses a step are a slip of a unit, and slow
  const double pulses = data.speed_at_10v * h / data.index_pitch;
  if (pulses <= most) return {};
  return {{"index_pitch",
           fmt::format("at {:g} mm/s the axis passes {:.0f} index pulses in a step of {:g} us",
                       data.speed_at_10v * units::millimetres, pulses, h * 1e6),
           fmt::format("at least {:.3g} mm", data.speed_at_10v * h / most * units::millimetres)}};
}

std::unique_ptr<Plant> IdealAxisDefinition::build(World& world,
                                                  const std::function<Plant*(std::string_view)>& find) {
  (void)find;
  return std::make_unique<IdealAxis>(data, world);
}

}  // namespace drycut::plants
