#pragma once
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "devices/cards.hpp"
#include "tests/devices/oopos2/covers.hpp"

namespace drycut::devices::oopos2 {

/// Whatever `device` has to say since it was last asked.
inline std::vector<std::string> said_by(Device& device) {
  std::vector<std::string> result;
  for (const Diagnostic& diagnostic : device.take_diagnostics())
    result.push_back(diagnostic.subject + ": " + diagnostic.text);
  return result;
}

/// An OOPOS2 wired to an axis with two speeds, that coasts a given way when its outputs go off. TCamp 10 ms,
/// so that a timer's 1/100 s are samples; cntratio 400000, so that 1 Um = 1 bit.
class Oopos2Test : public testing::Test {
 protected:
  static constexpr int period = 10;  ///< [ms]
  static constexpr int zero_line = 3;

  explicit Oopos2Test(int period_ms = period)
      : device(make_oopos2({{period_ms, {}},
                            {0, parse_address("2.CNT01")},
                            {zero_line, {}},
                            {0, parse_address("2.INP01")},
                            {0, parse_address("2.OUT01")},
                            {0, parse_address("2.OUT02")},
                            {0, parse_address("2.OUT03")},
                            {0, parse_address("2.OUT04")},
                            {0, parse_address("2.OUT05")},
                            {0, parse_address("2.OUT06")}},
                           cards)) {
    set({{"cntratio", 400000},
         {"minpos", -10000},
         {"maxpos", 10000},
         {"slowpos", 200},
         {"tollp", 50},
         {"tolln", 50},
         {"unitvel", 1}});
  }

  // The program's side.
  void write(std::string_view name, std::int32_t value) {
    device->write(find_symbol(device->type(), name).value(), value);
  }
  void set(std::initializer_list<std::pair<const char*, std::int32_t>> values) {
    for (const auto& [name, value] : values) write(name, value);
  }
  std::int32_t get(std::string_view name) { return device->read(find_symbol(device->type(), name).value()); }
  void order(std::string_view name) { device->command(find_command(device->type(), name).value()); }
  /// Gives a command and lets the device take it.
  void command(std::string_view name) {
    order(name);
    sample();
  }
  std::vector<std::string> diagnostics() { return said_by(*device); }
  /// Gives a command that must not be taken; why not.
  std::string refusal(const char* name) {
    diagnostics();
    command(name);
    const auto said = diagnostics();
    EXPECT_EQ(said.size(), 1u) << name;
    return said.empty() ? "" : said.front();
  }

  // The hardware's side.
  bool& output(int number) { return cards.outputs.at({Kind::output, 2, number}).level; }
  /// The outputs that are on: A forward, I backward, D direction, M movement, R slowdown, F brake.
  std::string on() {
    std::string letters;
    for (int i = 1; i <= 6; ++i)
      if (output(i)) letters += "AIDMRF"[i - 1];
    return letters;
  }
  void sample() { device->sample(); }
  /// One period: the axis moves by the outputs, then a sample.
  void tick() {
    const int direction = output(1) ? 1 : output(2) ? -1 : 0;
    if (direction != 0) {
      count() += direction * (output(5) ? slow : fast);
      coasting_ = direction * (output(5) ? coast : coast_fast);
    } else if (coasting_ != 0) {
      const int step = std::clamp(coasting_, -5, 5);
      count() += step;
      coasting_ -= step;
    }
    sample();
  }
  void ticks(int number) {
    for (int i = 0; i < number; ++i) tick();
  }
  bool wait(std::string_view state, std::int32_t value, int most = 5000) {
    for (int i = 0; i < most && get(state) != value; ++i) tick();
    return get(state) == value;
  }
  /// The outputs over so many samples: "3 AM" if A and M are on from sample 3 on; 0 is the next one.
  std::vector<std::string> record(int samples) {
    std::vector<std::string> changes;
    std::string last = on();
    for (int i = 0; i < samples; ++i) {
      tick();
      if (on() == last) continue;
      last = on();
      changes.push_back(std::to_string(i) + " " + last);
    }
    return changes;
  }
  /// Places the axis and waits for the end.
  void place(std::int32_t quota) {
    write("setpos", quota);
    command("START");
    EXPECT_TRUE(wait("st_still", 1)) << quota;
  }
  std::int64_t& count() { return cards.counters.at(*parse_address("2.CNT01")).count; }
  bool& enable() { return cards.inputs.at(*parse_address("2.INP01")).level; }

  Cards cards;
  std::unique_ptr<Device> device;
  int fast = 20;  ///< speeds [bits a sample]
  int slow = 4;
  int coast = 0;  ///< ways after the outputs [bits]
  int coast_fast = 0;

 private:
  int coasting_ = 0;  ///< left
};

}  // namespace drycut::devices::oopos2
