#include "plants/transducers.hpp"

#include <utility>

#include "base/state_archive.hpp"

namespace drycut::plants {

namespace {

constexpr double beyond = 1000;  // width of a limit switch's target: longer than any axis [m]

PositionSwitchData limit_switch(double edge, double side, double delay) {
  return {edge + side * beyond / 2, beyond, 0.5e-3, delay};
}

Parameters scale_and_switch_parameters(AxisTransducersData& data, const AxisTransducersSources& from) {
  return {
      row("scale.resolution", "mm", "travel for a count (x4) of the linear scale", data.scale_resolution,
          1e-6, 1000, from.scale_resolution),
      row("scale.pitch", "mm", "travel between two of its reference marks", data.scale_pitch, 0.01, 1e5,
          "a usual scale"),
      row("home.position", "mm", "middle of the home switch's target", data.home.centre, -1e6, 1e6,
          from.home),
      row("home.width", "mm", "width of the target", data.home.width, 0.01, 1e6, "estimate"),
      row("home.hysteresis", "mm", "the home switch lets go this far behind the target", data.home.hysteresis,
          0, 100, "estimate: proximity switch"),
      row("home.delay", "ms", "delay of the home switch", data.home.delay, 0, 100,
          "estimate: proximity switch of 1 kHz"),
      row("limit_min", "mm", "the lower limit switch is on below this", data.limit_min, -1e6, 1e6,
          from.limits),
      row("limit_max", "mm", "the upper limit switch is on above this", data.limit_max, -1e6, 1e6,
          from.limits),
      row("limit_delay", "ms", "delay of the limit switches", data.limit_delay, 0, 100,
          "estimate: proximity switch of 1 kHz"),
  };
}

}  // namespace

AxisTransducers::AxisTransducers(const AxisTransducersData& data, double start, double revolutions,
                                 Random encoder_noise, Random scale_noise)
    : data_(data),
      start_(start),
      encoder_(data.encoder, revolutions, encoder_noise),
      scale_(scale_noise),
      home_(data.home, 0, start),
      limit_min_(limit_switch(data.limit_min, -1, data.limit_delay), 0, start),
      limit_max_(limit_switch(data.limit_max, 1, data.limit_delay), 0, start) {}

void AxisTransducers::sense(const Shaft& rotor, const Slide& part, double h) {
  encoder_.sense(rotor, h);

  const double before = (part.position_before - start_) / data_.scale_resolution;
  const double now = (part.position - start_) / data_.scale_resolution;
  scale_.carry(before, now, h);
  scale_index_.edges.clear();
  if (before != now && !scale_.stuck())
    put_index(scale_index_, part.position_before / data_.scale_pitch, part.position / data_.scale_pitch,
              before, now, data_.scale_pitch / data_.scale_resolution);

  for (PositionSwitch* s : {&home_, &limit_min_, &limit_max_})
    s->sense(part.position_before, part.position, h);
}

void AxisTransducers::offer_ports(std::vector<Port>& ports) {
  ports.push_back({"encoder", &encoder_.pulses.port, "encoder on the motor"});
  ports.push_back({"encoder.index", &encoder_.index, "its index pulse, once a turn of the motor"});
  ports.push_back({"scale", &scale_.port, "linear scale on the moving part"});
  ports.push_back({"scale.index", &scale_index_, "its reference marks"});
  ports.push_back({"home", &home_.port, "home switch"});
  ports.push_back({"limit_min", &limit_min_.port, "limit switch at the lower end, on beyond it"});
  ports.push_back({"limit_max", &limit_max_.port, "limit switch at the upper end, on beyond it"});
}

void AxisTransducers::offer_channels(std::vector<Channel>& channels) const {
  channels.push_back({"encoder.count", "", [this] { return static_cast<double>(encoder_.pulses.port.count); },
                      "count of the encoder (x4), after faults"});
  channels.push_back({"scale.count", "", [this] { return static_cast<double>(scale_.port.count); },
                      "count of the linear scale (x4), after faults"});
  channels.push_back(on_off("home", home_.port.level, "home switch"));
  channels.push_back(on_off("limit_min", limit_min_.port.level, "lower limit switch"));
  channels.push_back(on_off("limit_max", limit_max_.port.level, "upper limit switch"));
}

void AxisTransducers::offer_faults(std::vector<Fault>& faults) {
  encoder_.pulses.offer_faults(faults, "encoder");
  scale_.offer_faults(faults, "scale");
  home_.offer_faults(faults, "home");
  limit_min_.offer_faults(faults, "limit_min");
  limit_max_.offer_faults(faults, "limit_max");
}

void AxisTransducers::visit(StateArchive& archive) {
  STATE(archive, encoder_, scale_, scale_index_, home_, limit_min_, limit_max_);
}

Parameters axis_transducer_parameters(AxisTransducersData& data, const AxisTransducersSources& from) {
  Parameters rows = {
      row("encoder.lines", "lines of the motor's encoder per turn; counted four times", data.encoder.lines, 1,
          1000000, "10000 counts a turn"),
      row("encoder.reverse", "it counts down in positive direction", data.encoder.reverse,
          "wired the usual way"),
  };
  return joined(std::move(rows), group("encoder.", encoder_error_parameters(data.encoder)),
                scale_and_switch_parameters(data, from));
}

}  // namespace drycut::plants
