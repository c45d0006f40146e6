#include "devices/lx3vp/pulse_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/state_archive.hpp"

namespace drycut::devices::lx3vp {

namespace {

constexpr int number_of_cams = 6783;
constexpr int most_cams = 4;
constexpr std::array<int, pulse_outputs> position_registers{8140, 8142, 8150, 8152};
constexpr std::array<int, pulse_outputs> stop_relays{8145, 8146, 8152, 8153};
constexpr int first_busy_relay = 8147;
constexpr int arrived_relay = 8029;
constexpr int bias_speed_register = 8145;
constexpr int top_speed_register = 8146;
constexpr int ramp_register = 8148;

bool stopped(const Registers& registers, int output) {
  return registers.m[static_cast<std::size_t>(stop_relays[static_cast<std::size_t>(output)])];
}

}  // namespace

void PulseNote::visit(StateArchive& archive) { STATE(archive, step, code, text, owner); }
void PulseUnit::Motion::visit(StateArchive& archive) {
  STATE(archive, step, order, target, speed, at_dog, ticks);
}
void PulseUnit::Line::visit(StateArchive& archive) { STATE(archive, output, motion, given); }
void PulseUnit::visit(StateArchive& archive) { STATE(archive, lines_, cams_, drives_, refused_, notes_); }

void PulseUnit::decam(int step, const DecamOperands& operands, bool powered, CamPort& port) {
  auto place = std::ranges::lower_bound(cams_, step, {}, &std::pair<int, Decam>::first);
  if (place == cams_.end() || place->first != step) place = cams_.emplace(place, step, Decam());
  Decam& cam = place->second;
  if (powered == cam.enabled()) return;
  if (!powered) return cam.disable(port);
  std::optional<CamFault> fault;
  int enabled = 0;
  for (const auto& [other_step, other] : cams_) {
    if (!other.enabled() || other.refused()) continue;
    ++enabled;
    if (other.operands().output == operands.output)
      fault = {number_of_cams, 0, fmt::format("Y{:o} has a cam already", operands.output)};
  }
  if (enabled >= most_cams) fault = {number_of_cams, 0, fmt::format("{} cams are enabled already", enabled)};
  cam.enable(operands, port, fault);
  if (auto told = cam.take_fault()) notes_.push_back({step, told->code, std::move(told->text)});
}

std::bitset<pulse_outputs> PulseUnit::used_by_cams() const {
  std::bitset<pulse_outputs> used;
  for (const auto& [step, cam] : cams_)
    if (uses_output(cam)) used.set(static_cast<std::size_t>(cam.operands().output));
  return used;
}

bool PulseUnit::take(Line& line, int step, int output) {
  if (line.motion.step == step) return true;
  const bool by_cam = used_by_cams()[static_cast<std::size_t>(output)];
  if (line.motion.step < 0 && !by_cam) {
    line.motion = {step};
    line.output.halt();
    return true;
  }
  if (!std::exchange(refused_[step], true))
    notes_.push_back({step, 0,
                      fmt::format("Y{:o} is in use by {}; this instruction gives no pulses", output,
                                  by_cam ? "a cam" : "another instruction"),
                      line.motion.step});
  return false;
}

bool PulseUnit::lets_go(Line& line, int step, bool powered) {
  if (powered) return false;
  refused_[step] = false;
  if (line.motion.step == step) line.motion = {};
  return true;
}

bool PulseUnit::begins(int step, int output, bool powered, Registers& registers) {
  Line& line = lines_[static_cast<std::size_t>(output)];
  Progress& progress = drives_[step];
  bool begins = false;
  if (lets_go(line, step, powered)) {
    progress = Progress::off;
  } else if (progress == Progress::off && take(line, step, output)) {
    progress = Progress::on;
    begins = true;
  }
  registers.m[arrived_relay] = progress == Progress::arrived;
  return begins;
}

void PulseUnit::pulses(int step, const PulseOrder& order, bool powered, Registers& registers) {
  using enum PulseOrder::Kind;
  Line& line = lines_[static_cast<std::size_t>(order.output)];
  // The level goes with the power, at the end of the scan.
  if (order.kind == pwm && !powered && line.motion.step == step)
    registers.y[static_cast<std::size_t>(order.output)] = false;
  if (order.kind == speed || order.kind == pwm) {
    if (!lets_go(line, step, powered) && take(line, step, order.output)) line.motion.order = order;
  } else if (begins(step, order.output, powered, registers)) {
    begin(line, order, registers);
  }
  // What may change on the way.
  if (!powered || line.motion.step != step) return;
  if (order.kind == speed)
    line.motion.order.frequency = std::clamp(order.frequency, -max_frequency_hz, max_frequency_hz);
  if (order.kind == train) line.motion.order.frequency = std::min(order.frequency, max_frequency_hz);
}

void PulseUnit::begin(Line& line, const PulseOrder& order, const Registers& registers) {
  using enum PulseOrder::Kind;
  const std::int32_t frequency = order.frequency;
  Motion& motion = line.motion;
  motion.order = order;
  motion.target = line.output.position() + order.pulses;
  if (order.kind == position)
    motion.target -= registers.i32(position_registers[static_cast<std::size_t>(order.output)]);
  if (order.kind == distance || order.kind == position || order.kind == ramped)
    motion.order.frequency =
        std::clamp(std::abs(std::max(frequency, -max_frequency_hz)), 1, max_frequency_hz);
  if (order.kind == train || order.kind == ramped) line.output.face(true);
  if (order.kind != zero) return;
  motion.order.frequency = std::min(frequency, max_frequency_hz);
  motion.order.creep = std::min(order.creep, motion.order.frequency);
  line.output.face(false);
}

namespace {

/// A trapezoid of speed by D8145, D8146 and D8148.
struct PulseRamp {
  explicit PulseRamp(const Registers& registers)
      : top(std::clamp(registers.i32(top_speed_register), 10, max_frequency_hz)) {
    const double bias = std::clamp<double>(registers.d[bias_speed_register], 0, top / 10);
    const double ramp_s = std::clamp<double>(registers.d[ramp_register], 50, 5000) / 1000;
    slope = (top - bias) / ramp_s;
    least = std::max({bias, std::sqrt(slope / 2), 1.0});
  }
  /// PLSR: with ramps of its own.
  explicit PulseRamp(const PulseOrder& order) : top(std::max(order.frequency, 10)) {
    slope = top / (std::clamp<double>(order.ramp_ms, 50, 5000) / 1000);
    least = std::max(std::sqrt(slope / 2), 1.0);
  }
  double top;        ///< [Hz]
  double slope = 0;  ///< [Hz/s]
  double least = 0;  ///< from which a motor may start and stop [Hz]
};

bool is_on(const DogSignal& dog, const CamPort& port) {
  const auto at = static_cast<std::size_t>(dog.number);
  if (dog.letter == 'X') return port.inputs[at];
  if (dog.letter == 'Y') return port.outputs[at];
  return *bit_at(port.registers, dog.letter, dog.number);
}

}  // namespace

// A ramp, and a speed that still leaves the way to stop.
PulseTick PulseUnit::move(Line& line, const Registers& registers) {
  Motion& motion = line.motion;
  const bool own_ramp = motion.order.kind == PulseOrder::Kind::ramped;
  const PulseRamp ramp = own_ramp ? PulseRamp(motion.order) : PulseRamp(registers);
  const auto remaining = static_cast<double>(std::abs(motion.target - line.output.position()));
  const double most = std::max(ramp.least, std::min<double>(motion.order.frequency, ramp.top));
  motion.speed = std::clamp(motion.speed + ramp.slope / ticks_per_second, ramp.least, most);
  motion.speed = std::min(motion.speed, std::sqrt(ramp.least * ramp.least + 2 * ramp.slope * remaining));
  const auto frequency = static_cast<std::int32_t>(std::lround(motion.speed));
  const auto tick = line.output.run(motion.target > line.output.position() ? frequency : -frequency,
                                    static_cast<std::int64_t>(remaining));
  if (line.output.position() == motion.target) arrive(line);
  return tick;
}

PulseTick PulseUnit::train(Line& line) {
  const Motion& motion = line.motion;
  const auto left = motion.ends() ? motion.target - line.output.position() : max_frequency_hz;
  const auto tick = line.output.run(motion.order.frequency, left);
  if (motion.ends() && line.output.position() == motion.target) arrive(line);
  return tick;
}

// Backwards to the dog, slower from there on, to where it ends: that is 0.
PulseTick PulseUnit::seek(Line& line, const CamPort& port) {
  Motion& motion = line.motion;
  const bool dog = is_on(motion.order.dog, port);
  if (motion.at_dog && !dog) {
    port.registers.set_i32(position_registers[static_cast<std::size_t>(&line - lines_.data())], 0);
    arrive(line);
    return {0, false, false};
  }
  // A start on the dog has no way left to be fast.
  if (dog && motion.speed == 0) motion.speed = motion.order.creep;
  motion.at_dog = dog;
  const PulseRamp ramp(port.registers);
  const double wanted = dog ? motion.order.creep : std::min<double>(motion.order.frequency, ramp.top);
  const double change = ramp.slope / ticks_per_second;
  motion.speed = std::max(motion.speed, std::min(ramp.least, wanted));
  motion.speed = motion.speed < wanted ? std::min(motion.speed + change, wanted)
                                       : std::max(motion.speed - change, wanted);
  return line.output.run(-static_cast<std::int32_t>(std::lround(motion.speed)), max_frequency_hz);
}

void PulseUnit::modulate(Line& line, int output, CamPort& port) {
  constexpr std::int64_t ticks_per_ms = ticks_per_second / 1000;
  Motion& motion = line.motion;
  if (motion.ticks >= motion.order.period_ms * ticks_per_ms) motion.ticks = 0;
  const bool on = motion.ticks++ < motion.order.width_ms * ticks_per_ms;
  port.give(output, on && !stopped(port.registers, output));
}

void PulseUnit::arrive(Line& line) {
  drives_[line.motion.step] = Progress::arrived;
  line.motion = {};
}

void PulseUnit::count(int output, const PulseTick& tick, Registers& registers) {
  if (tick.pulses == 0) return;
  lines_[static_cast<std::size_t>(output)].given += tick.pulses;
  const int at = position_registers[static_cast<std::size_t>(output)];
  const auto pulses = static_cast<std::uint32_t>(tick.pulses);
  registers.set_u32(at, registers.u32(at) + (tick.forwards ? pulses : 0U - pulses));
}

void PulseUnit::tick_cam(int step, Decam& cam, CamPort& port) {
  const int output = cam.operands().output;
  Line& line = lines_[static_cast<std::size_t>(output)];
  count(output, cam.tick(port, line.output, stopped(port.registers, output), line.motion.step >= 0),
        port.registers);
  if (line.motion.step < 0) port.give(cam.operands().direction, line.output.forwards());
  if (!cam.has_news()) return;
  for (auto& note : cam.take_notes()) notes_.push_back({step, note.warns ? 0 : -1, std::move(note.text)});
  if (auto fault = cam.take_fault())
    notes_.push_back({step, fault->code, std::move(fault->text), line.motion.step});
}

void PulseUnit::tick_motion(int output, CamPort& port) {
  Line& line = lines_[static_cast<std::size_t>(output)];
  const int direction = line.motion.order.direction;
  const bool stop = stopped(port.registers, output);
  PulseTick tick{0, line.output.forwards(), false};
  if (line.motion.order.kind == PulseOrder::Kind::pwm) return modulate(line, output, port);
  if (line.motion.order.kind == PulseOrder::Kind::speed)
    tick = line.output.run(stop ? 0 : line.motion.order.frequency, max_frequency_hz);
  else if (stop)
    line.motion = {};
  else if (line.motion.order.kind == PulseOrder::Kind::train)
    tick = train(line);
  else if (line.motion.order.kind == PulseOrder::Kind::zero)
    tick = seek(line, port);
  else
    tick = move(line, port.registers);
  if (direction >= 0) port.give(direction, line.output.forwards());
  count(output, tick, port.registers);
}

void PulseUnit::tick(CamPort& port) {
  std::array<bool, pulse_outputs> by_cams{};
  for (auto& [step, cam] : cams_) {
    if (!cam.enabled() || cam.refused()) continue;
    tick_cam(step, cam, port);
    by_cams[static_cast<std::size_t>(cam.operands().output)] |= uses_output(cam);
  }
  for (std::size_t at = 0; at < lines_.size(); ++at) {
    const Motion& motion = lines_[at].motion;
    if (motion.step >= 0) tick_motion(static_cast<int>(at), port);
    const bool moves =
        motion.step >= 0 && (motion.order.kind != PulseOrder::Kind::speed || motion.order.frequency != 0);
    port.registers.m[first_busy_relay + at] = moves || by_cams[at];
  }
}

std::vector<int> PulseUnit::held() const {
  std::vector<int> held;
  const auto hold = [&](int y) {
    if (y >= 0) held.push_back(y);
  };
  for (const auto& [step, cam] : cams_) {
    if (!cam.enabled() || cam.refused()) continue;
    hold(cam.operands().direction);
    if (cam.sync_output()) hold(*cam.sync_output());
  }
  for (const Line& line : lines_)
    if (line.motion.step >= 0)
      hold(line.motion.order.kind == PulseOrder::Kind::pwm ? line.motion.order.output
                                                           : line.motion.order.direction);
  return held;
}

std::vector<PulseNote> PulseUnit::take_notes() { return std::exchange(notes_, {}); }

}  // namespace drycut::devices::lx3vp
