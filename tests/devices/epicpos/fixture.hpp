#pragma once
#include <gmock/gmock.h>

#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "devices/cards.hpp"
#include "tests/devices/epicpos/covers.hpp"

namespace drycut::devices::epicpos {

/// An EPICPOS (or EANPOS) wired to an ideal axis: the output voltage is the speed, exactly. TCamp 2 ms,
/// cntratio 400000, so that 1 Um = 1 bit; maxvel 50000 Um/s, so the way at full speed in a period is 100
/// bits.
class PositionerTest : public testing::Test {
 protected:
  static constexpr double full_speed = 50000;  ///< of the ideal axis [bits/s]
  static constexpr int period = 2;             ///< [ms]
  static constexpr int zero_line = 3;
  using Make = std::unique_ptr<Device> (*)(const Resources&, Cards&);

  explicit PositionerTest(Make make = make_epicpos, const char* counter = "2.CNT01")
      : address(*parse_address(counter)),
        device(make({{period, {}},
                     {0, address},
                     {zero_line, {}},
                     {0, parse_address("2.INP01")},
                     {0, parse_address("2.AN01")}},
                    cards)) {
    set({{"cntratio", 400000},
         {"unitvel", 1},
         {"maxvel", 50000},
         {"taccdec", 100},
         {"minpos", -999999},
         {"maxpos", 999999},
         {"feedfw", 1000},
         {"pgain", 200},
         {"setvel", 5000},
         {"toll", 2},
         {"maxfollerr", 1000},
         {"prsvel", 5000},
         {"sprsvel", 1000}});
    static_cast<void>(diagnostics());
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
  std::vector<std::string> diagnostics() {
    std::vector<std::string> result;
    for (const Diagnostic& diagnostic : device->take_diagnostics())
      result.push_back(diagnostic.subject + ": " + diagnostic.text);
    return result;
  }
  /// INIT and LOOPON.
  void start() {
    command("INIT");
    command("LOOPON");
    ASSERT_EQ(get("st_loopon"), 1);
  }

  // The hardware's side.
  void sample() {
    device->sample();
    ++samples;
  }
  /// One period: the axis follows the voltage, then a sample.
  void tick() {
    way_ += word() / 32767.0 * full_speed * period / 1000;
    const double whole = std::floor(way_);
    way_ -= whole;
    if (!blocked) count() += static_cast<std::int64_t>(whole);
    sample();
  }
  void ticks(int number) {
    for (int i = 0; i < number; ++i) tick();
  }
  /// Ticks until the state has the value; false if it does not come within `most` periods.
  bool wait(std::string_view state, std::int32_t value, int most = 20000) {
    for (int i = 0; i < most && get(state) != value; ++i) tick();
    return get(state) == value;
  }
  /// Places the axis and lets it come to rest; false if it does not end.
  bool place(std::int32_t quota) {
    write("setpos", quota);
    command("START");
    const bool ended = wait("st_still", 1);
    ticks(200);
    return ended;
  }
  /// Periods from a command until the axis is still again.
  long duration(std::string_view name) {
    order(name);
    const long before = samples;
    tick();
    EXPECT_TRUE(wait("st_still", 1));
    return samples - before;
  }
  /// Theoretical speed [bits/s], as feedfw 1000 shows it.
  double speed() { return get("ffwdreg") * full_speed / 32767; }
  std::int64_t& count() { return cards.counters.at(address).count; }
  bool& enable() { return cards.inputs.at(*parse_address("2.INP01")).level; }
  [[nodiscard]] int word() { return cards.analogue_outputs.at(*parse_address("2.AN01")).word; }

  Cards cards;
  Address address;
  std::unique_ptr<Device> device;
  bool blocked = false;  ///< the axis does not move
  long samples = 0;

 private:
  double way_ = 0;
};

}  // namespace drycut::devices::epicpos
