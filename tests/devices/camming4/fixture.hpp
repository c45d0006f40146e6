#pragma once
#include <gmock/gmock.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "devices/camming4/camming4.hpp"

namespace drycut::devices::camming4 {

/// A CAMMING4 wired to an ideal axis: the output voltage is the speed, exactly. TCamp 2 ms, 1 Um = 1 bit,
/// maxvel 50000 Um/s, so the way at full speed in a period is 100 bits.
class Camming4Test : public testing::Test {
 protected:
  static constexpr double full_speed = 50000;  ///< of the ideal axis [bits/s]
  static constexpr int period = 2;             ///< [ms]

  explicit Camming4Test(const char* slave = "2.CNT01", const char* master = "2.CNT02", int period_ms = period)
      : slave_address(*parse_address(slave)),
        master_address(*parse_address(master)),
        device({{period_ms, {}},
                {0, slave_address},
                {0, master_address},
                {0, parse_address("2.CNT03")},
                {1, {}},
                {0, parse_address("2.INP01")},
                {2, {}},
                {0, parse_address("2.INP02")},
                {0, parse_address("2.INP03")},
                {5, {}},
                {0, parse_address("2.AN01")},
                {0, parse_address("2.OUT01")}},
               cards) {
    set({{"decpt", 0},
         {"unitvel", 1},
         {"measure", 1},
         {"pulse", 1},
         {"measurem", 1},
         {"pulsem", 1},
         {"maxvel", 50000},
         {"tacc", 100},
         {"tdec", 100},
         {"minpos", -999999},
         {"maxpos", 999999},
         {"feedfw", 1000},
         {"pgain", 200},
         {"setvel", 5000},
         {"maxfollerr", 1000},
         {"prsvel", 5000},
         {"sprsvel", 1000},
         {"syncrange", 50},
         {"toll", 2}});
    static_cast<void>(diagnostics());
  }

  // The program's side.
  void write(std::string_view name, std::int32_t value) {
    device.write(*find_symbol(device.type(), name), value);
  }
  void set(std::initializer_list<std::pair<const char*, std::int32_t>> values) {
    for (const auto& [name, value] : values) write(name, value);
  }
  std::int32_t get(std::string_view name) { return device.read(*find_symbol(device.type(), name)); }
  void order(std::string_view name) { device.command(*find_command(device.type(), name)); }
  /// Gives a command and lets the device take it.
  void command(std::string_view name) {
    order(name);
    sample();
  }
  std::vector<std::string> diagnostics() {
    std::vector<std::string> result;
    for (const Diagnostic& diagnostic : device.take_diagnostics())
      result.push_back(diagnostic.subject + ": " + diagnostic.text);
    return result;
  }
  /// INIT and LOOPON.
  void start() {
    command("INIT");
    command("LOOPON");
    ASSERT_EQ(get("st_loopon"), 1);
  }
  void row(int number, const std::vector<std::int32_t>& values) {
    static constexpr const char* columns[] = {"codeG", "codeQm", "codeQs", "codeQma", "codeQsa", "codeM"};
    int column = 0;
    for (const std::int32_t value : values) write(columns[column++] + std::to_string(number), value);
  }

  // The hardware's side.
  void sample() {
    device.sample();
    ++samples;
  }
  /// One period: the slave follows the voltage, the master runs `bits` on, then a sample.
  void tick(std::int64_t bits = 0) {
    if (!slave_blocked) way_ += word() / 32767.0 * full_speed * period / 1000;
    const double whole = std::floor(way_);
    way_ -= whole;
    slave().count += static_cast<std::int64_t>(whole);
    master().count += bits;
    sample();
  }
  void ticks(int count, std::int64_t bits = 0) {
    for (int i = 0; i < count; ++i) tick(bits);
  }
  /// Ticks until the state has the value; false if it does not come within `most` periods.
  bool wait(std::string_view state, std::int32_t value, int most = 20000, std::int64_t bits = 0) {
    for (int i = 0; i < most && get(state) != value; ++i) tick(bits);
    return get(state) == value;
  }
  /// An edge on an interrupt line while the counters are where they are.
  void edge(int line, bool rising) {
    for (auto& [address, counter] : cards.counters) counter.latched = counter.count;
    cards.interrupt_lines[line].level = rising;
    device.interrupt(line, rising);
  }
  Counter& slave() { return cards.counters.at(slave_address); }
  Counter& master() { return cards.counters.at(master_address); }
  Counter& master_b() { return cards.counters.at(*parse_address("2.CNT03")); }
  bool& input(const char* address) { return cards.inputs.at(*parse_address(address)).level; }
  [[nodiscard]] bool output() { return cards.outputs.at(*parse_address("2.OUT01")).level; }
  [[nodiscard]] int word() { return cards.analogue_outputs.at(*parse_address("2.AN01")).word; }

  Cards cards;
  Address slave_address;
  Address master_address;
  Camming4 device;
  bool slave_blocked = false;
  long samples = 0;

 private:
  double way_ = 0;
};

}  // namespace drycut::devices::camming4
