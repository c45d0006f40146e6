#include "plants/bench.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/state_archive.hpp"

namespace drycut::plants {

void Bench::CounterInput::sense(double h) {
  port.before = position.value();
  position.add(rate * h);
  port.now = position.value();
  port.count = port.count_at(1);
  index.edges.clear();
  // The timeline acts at the start of a step: the index latches the count of that moment.
  for (; pulses_wanted > 0; --pulses_wanted) {
    index.add_edge(true, 0, rate != 0 ? 1 / std::abs(rate * h) : 0);
    index.add_edge(false, 0);
    ++pulses;
  }
}

void Bench::CounterInput::set_count(double count) {
  position = ExactSum(count);
  port.before = port.now = count;
  port.count = port.count_at(1);
}

Bench::Bench() = default;

void Bench::sense(double h) {
  for (CounterInput& counter : counters_) counter.sense(h);
  for (DigitalInput& input : inputs_) {
    input.port.edges.clear();
    if (input.shown == input.port.level) continue;
    input.shown = input.port.level;
    input.port.add_edge(input.shown, 0);
  }
}

void Bench::CounterInput::visit(StateArchive& archive) {
  STATE(archive, port, index, position, rate, pulses_wanted, pulses);
}
void Bench::DigitalInput::visit(StateArchive& archive) { STATE(archive, port, shown); }
void Bench::visit(StateArchive& archive) { STATE(archive, counters_, inputs_, outputs_, analogue_); }

std::vector<Port> Bench::ports() {
  std::vector<Port> ports;
  for (int i = 0; i < counters; ++i) {
    CounterInput& c = counters_[static_cast<std::size_t>(i)];
    ports.push_back({fmt::format("counter{}", i + 1), &c.port, "a transducer for a counter input"});
    ports.push_back({fmt::format("counter{}.index", i + 1), &c.index, "its index pulse"});
  }
  for (int i = 0; i < digital; ++i)
    ports.push_back({fmt::format("input{}", i + 1), &inputs_[static_cast<std::size_t>(i)].port,
                     "a switch for a digital input"});
  for (int i = 0; i < digital; ++i)
    ports.push_back({fmt::format("output{}", i + 1), &outputs_[static_cast<std::size_t>(i)],
                     "a lamp for a digital output"});
  for (int i = 0; i < analogue; ++i)
    ports.push_back({fmt::format("analogue{}", i + 1), &analogue_[static_cast<std::size_t>(i)],
                     "a voltmeter for an analogue output"});
  return ports;
}

std::vector<Channel> Bench::channels() {
  std::vector<Channel> channels;
  for (int i = 0; i < counters; ++i) {
    CounterInput& c = counters_[static_cast<std::size_t>(i)];
    const std::string name = fmt::format("counter{}", i + 1);
    channels.push_back(
        {name + ".count", "", [&c] { return static_cast<double>(c.port.count); }, "count (x4)"});
    channels.push_back({name + ".rate", "1/s", [&c] { return c.rate; }, "counts per second"});
    channels.push_back({name + ".index", "", [&c] { return static_cast<double>(c.pulses); },
                        "index pulses since the start"});
  }
  for (int i = 0; i < digital; ++i) {
    DigitalInput& input = inputs_[static_cast<std::size_t>(i)];
    channels.push_back({fmt::format("input{}", i + 1), "", [&input] { return input.port.level ? 1.0 : 0.0; },
                        "digital input"});
  }
  for (int i = 0; i < digital; ++i) {
    CommandPort& output = outputs_[static_cast<std::size_t>(i)];
    channels.push_back({fmt::format("output{}", i + 1), "", [&output] { return output.level ? 1.0 : 0.0; },
                        "digital output"});
  }
  for (int i = 0; i < analogue; ++i) {
    ReferencePort& volts = analogue_[static_cast<std::size_t>(i)];
    channels.push_back(
        {fmt::format("analogue{}", i + 1), "V", [&volts] { return volts.volts; }, "analogue output"});
  }
  return channels;
}

std::vector<Setting> Bench::settings() {
  std::vector<Setting> settings;
  for (int i = 0; i < counters; ++i) {
    CounterInput& c = counters_[static_cast<std::size_t>(i)];
    const std::string name = fmt::format("counter{}", i + 1);
    settings.push_back({name + ".rate",
                        "1/s",
                        [&c](double v) { c.rate = v; },
                        [&c] { return c.rate; },
                        "counts (x4) per second",
                        {-1e9, 1e9, false}});
    settings.push_back({name + ".count", "", [&c](double v) { c.set_count(v); },
                        [&c] { return c.position.value(); }, "steps the count to a value", in_counts});
    settings.push_back({name + ".index", "", [&c](double v) { c.pulses_wanted += v != 0 ? 1 : 0; },
                        [&c] { return static_cast<double>(c.pulses_wanted); }, "1: one index pulse now"});
  }
  for (int i = 0; i < digital; ++i) {
    DigitalInput& input = inputs_[static_cast<std::size_t>(i)];
    settings.push_back({fmt::format("input{}", i + 1), "", [&input](double v) { input.port.level = v != 0; },
                        [&input] { return input.port.level ? 1.0 : 0.0; }, "digital input"});
  }
  return settings;
}

std::unique_ptr<Plant> BenchDefinition::build(World& world,
                                              const std::function<Plant*(std::string_view)>& find) {
  (void)world;
  (void)find;
  return std::make_unique<Bench>();
}

}  // namespace drycut::plants
