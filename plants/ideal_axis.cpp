#include "plants/ideal_axis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

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
  pulses_.carry(direction * before, direction * now, h);
  index_.edges.clear();
  const double counts_per_pitch = data_.index_pitch / data_.resolution;
  const double origin = data_.start / data_.resolution;
  if (before != now && !pulses_.stuck())
    put_index(index_, (origin + before) / counts_per_pitch, (origin + now) / counts_per_pitch,
              direction * before, direction * now, direction * counts_per_pitch);
  for (PositionSwitch& s : switches_)
    s.sense(data_.start + before * data_.resolution, data_.start + now * data_.resolution, h);
}

void IdealAxis::visit(StateArchive& archive) {
  STATE(archive, reference_, speed_, travel_, pulses_, index_, switches_);
}

std::vector<Port> IdealAxis::ports() {
  return {{"reference", &reference_, "speed reference, +-10 V"},
          {"encoder", &pulses_.port, "incremental encoder"},
          {"encoder.index", &index_, "its index pulse, once an index_pitch"},
          {"switch1", &switches_[0].port, "limit or preset switch"},
          {"switch2", &switches_[1].port, "limit or preset switch"}};
}

std::optional<PlugScale> IdealAxis::scale_of(std::string_view port) const {
  if (port == "encoder") return PlugScale{1 / data_.resolution, false};
  if (port == "reference") return PlugScale{data_.speed_at_10v, false};
  return {};
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
  static constexpr std::string_view round = "a round number";
  const auto rows_of = [](PositionSwitchData& of, std::string_view position) {
    return Parameters{
        row("position", "mm", position, of.centre, -1e6, 1e6, round),
        row("width", "mm", "width of its target", of.width, 0, 1e6, round),
        row("hysteresis", "mm", "it lets go this far behind the target", of.hysteresis, 0, 1000, round),
        row("delay", "ms", "delay of its filter", of.delay, 0, 1000, round)};
  };
  return joined(
      {row("speed_at_10v", "mm/s", "speed at a reference of 10 V", data.speed_at_10v, 0.001, 100000, round),
       row("resolution", "mm", "travel per count (x4)", data.resolution, 1e-6, 1000, round),
       row("index_pitch", "mm", "travel between two index pulses", data.index_pitch, 0.01, 100000, round),
       row("start", "mm", "position at the start; the count is 0 there", data.start, -1e6, 1e6, round),
       row("reverse", "counts down in positive direction", data.reverse, "")},
      group("switch1.", rows_of(data.switches[0], "middle of the target of switch 1")),
      group("switch2.", rows_of(data.switches[1], "middle of the target of switch 2")));
}

std::vector<PlantDefinition::Objection> IdealAxisDefinition::objections(double h) {
  constexpr double most = 1000;  // more pulses a step are a slip of a unit, and slow
  const double pulses = data.speed_at_10v * h / data.index_pitch;
  if (pulses <= most) return {};
  return {{"plant.step-too-long"_code, "index_pitch",
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
