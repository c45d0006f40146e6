// Whatever ends a movement, and in whichever sample it comes: the axis gets to a state from which START is
// taken, by the ways that the manuals give (000 1.1.6 and 1.9.5, 001 1.6.2, 002 1.4.2).
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/fuzz/device_commands.hpp"

namespace drycut::devices {
namespace {

constexpr int period = 10;  // [ms]
constexpr std::string_view power_off = "power off";

struct Movement {
  const char* name;
  std::vector<std::pair<const char*, std::int32_t>> parameters;
  std::vector<const char*> commands;  ///< the first one that a device has
  int runs = 0;                       ///< samples before the next command
  const char* then = nullptr;         ///< and then
};

const std::vector<Movement>& movements() {
  static const std::vector<Movement> all = {
      {"search_to_the_release", {{"prsmode", 0}}, {"PRESET"}},
      {"search_to_the_zero_pulse", {{"prsmode", 1}}, {"PRESET"}},
      {"search_turned_by_the_program", {}, {"PRESET"}, 3, "PRESET"},
      {"placement", {{"setpos", 150}}, {"START"}},
      {"placement_with_backlash", {{"setpos", -150}, {"bklashmode", 1}, {"overpos", 40}}, {"START"}},
      {"placement_epicycloidal", {{"setpos", 150}, {"ramptype", 1}, {"stopt", 0}}, {"START"}},
      {"manual_movement", {{"maxpos", 200}}, {"MANFW", "MANFFW"}},
      {"cam", {}, {"STARTCAM"}},
      {"cam_stop", {}, {"STARTCAM"}, 6, "STOPCAM"},
  };
  return all;
}

constexpr const char* interruptions[] = {"STOP",   "EMRG",   "LOOPOFF", "LOOPON", "CALON",
                                         "PRESET", "REGOFF", "STOPCAM", "INIT",   power_off.data()};

/// A device with an axis that goes where the output drives it, and a master that runs. 1 Um = 1 bit.
class Axis : public fuzz::DevicePlayer {
 public:
  explicit Axis(const CatalogueEntry& entry) : DevicePlayer(entry, period, 2) {
    set_up();
    set({{"codeG1", 131},
         {"codeQm1", 100},
         {"codeQs1", 50},
         {"codeG2", 135},
         {"codeQm2", 100},
         {"codeQs2", 50},
         {"codeG3", 136}});
    switch_on();
  }

  void begin(const Movement& movement) {
    for (const auto& parameter : movement.parameters) set({parameter});
    for (const char* name : movement.commands) command(name);
    if (movement.then == nullptr) return;
    ticks(movement.runs);
    command(movement.then);
  }
  void interrupt_by(std::string_view what) {
    if (what == power_off)
      device->power_up();
    else
      command(what);
  }
  void switch_on() {
    command("INIT");
    tick();
    command("LOOPON");
    tick();
    static_cast<void>(device->take_diagnostics());
  }
  /// One period: the axis moves, the enable is on for 80 Um in 160, a zero pulse comes every 16.
  void tick() {
    Counter& slave = cards.counters.at({Kind::counter, 2, 1});
    if (cards.counters.size() > 1) cards.counters.at({Kind::counter, 2, 2}).count += 10;
    const std::int64_t before = slave.count;
    slave.count += axis_way();
    cards.inputs.at({Kind::input, 2, 1}).level = std::abs(slave.count) / 80 % 2 == 1;
    slave.latched = slave.count / 16 * 16;
    if (slave.count / 16 != before / 16) device->interrupt(1, true);
    device->sample();
  }
  void ticks(int number) {
    for (int i = 0; i < number; ++i) tick();
  }
  [[nodiscard]] bool is(const char* state) const { return find_symbol(type, state) && get(state) == 1; }
  [[nodiscard]] bool at_rest() const { return is("st_still") && !is("st_camex") && !is("st_prson"); }
  /// Samples until the axis rests, if it does.
  std::optional<int> rest() {
    for (int samples = 1; samples < 600; ++samples) {
      tick();
      if (at_rest()) return samples;
    }
    return std::nullopt;
  }

  /// Gets the axis ready for a START, as the manual says.
  void recover(std::string_view what) {
    if (what == power_off) switch_on();
    if (is("st_emrg")) command("RESUME");
    if (is("st_cal")) command("CALOFF");
    ASSERT_TRUE(rest()) << "never at rest";
    if (is("st_regoff")) command("REGON");
    command("LOOPON");
    tick();
    static_cast<void>(device->take_diagnostics());
  }
  /// A placement from here, refused or missed: what went wrong, or "".
  std::string place(std::int32_t quota) {
    set({{"setpos", quota}, {"bklashmode", 0}, {"maxpos", 999}});
    command("START");
    tick();
    for (const Diagnostic& said : device->take_diagnostics())
      if (said.kind == Diagnostic::Kind::command_refused) return said.subject + ": " + said.text;
    if (is("st_still")) return "did not start";
    if (!rest()) return "did not end";
    ticks(60);
    return std::abs(get("posit") - quota) <= 40 ? "" : "ended at " + std::to_string(get("posit"));
  }

 private:
  std::int64_t axis_way() {
    if (cards.analogue_outputs.empty()) {
      const auto on = [&](int number) { return cards.outputs.at({Kind::output, 2, number}).level; };
      const int speed = on(5) ? 4 : 20;
      return (on(1) ? speed : 0) - (on(2) ? speed : 0);
    }
    way_ += cards.analogue_outputs.begin()->second.word / 32767.0 * 5000 * period / 1000;
    const auto whole = static_cast<std::int64_t>(way_);
    way_ -= static_cast<double>(whole);
    return whole;
  }

  double way_ = 0;
};

struct Case {
  const CatalogueEntry* entry;
  const Movement* movement;
  std::string_view interruption;
};

std::string name_of(const Case& one) {
  const std::string_view what = one.interruption == power_off ? "power" : one.interruption;
  return std::string(one.entry->type->name) + "_" + one.movement->name + "_" + std::string(what);
}
void PrintTo(const Case& one, std::ostream* out) { *out << name_of(one); }

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const CatalogueEntry& entry : catalogue())
    for (const Movement& movement : movements())
      for (const char* what : interruptions) {
        const auto has = [&](std::string_view name) { return find_command(*entry.type, name).has_value(); };
        const bool moves = has(movement.commands.front()) || has(movement.commands.back());
        if (moves && (what == power_off || has(what))) all.push_back({&entry, &movement, what});
      }
  return all;
}

class InterruptedMovement : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Each, InterruptedMovement, testing::ValuesIn(cases()),
                         [](const auto& instance) { return name_of(instance.param); });

TEST_P(InterruptedMovement, InAnySampleLeavesAnAxisThatCanStart) {
  const auto& [entry, movement, what] = GetParam();
  Axis whole(*entry);
  whole.begin(*movement);
  const auto samples = whole.rest();
  ASSERT_TRUE(samples) << "the movement itself does not end";
  for (int at = 0; at <= *samples; ++at) {
    SCOPED_TRACE("after " + std::to_string(at) + " of " + std::to_string(*samples) + " samples");
    Axis axis(*entry);
    axis.begin(*movement);
    axis.ticks(at);
    axis.interrupt_by(what);
    axis.tick();
    ASSERT_NO_FATAL_FAILURE(axis.recover(what));
    ASSERT_EQ(axis.place(axis.get("posit") > 0 ? -100 : 100), "");
  }
}

}  // namespace
}  // namespace drycut::devices
