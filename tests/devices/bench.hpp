#pragma once
#include <gmock/gmock.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "devices/cards.hpp"
#include "devices/device.hpp"
#include "tests/devices/coverage.hpp"

namespace drycut::devices {

/// Whatever `device` has to say since it was last asked.
inline std::vector<std::string> said_by(Device& device) {
  std::vector<std::string> result;
  for (const Diagnostic& diagnostic : device.take_diagnostics())
    result.push_back(diagnostic.subject + ": " + diagnostic.text);
  return result;
}

/// The terminals of a device as its record of the .CNF has them: "2 2.CNT01 X 3" is a period or an interrupt
/// line by its number, a terminal by its address, X what is not used.
inline Resources terminals_of(const std::string& text) {
  Resources resources;
  std::istringstream words{text};
  for (std::string word; words >> word;) {
    Resource& resource = resources.emplace_back();
    if (word.find('.') != std::string::npos)
      resource.address = parse_address(word).value();
    else if (word != "X")
      resource.number = std::stoi(word);
  }
  return resources;
}

/// The line of a test that asks for something.
struct Place {
  // NOLINTNEXTLINE(google-explicit-constructor): a default argument, of the line of the call
  Place(const char* file_name = __builtin_FILE(), int number = __builtin_LINE())
      : file(file_name), line(number) {}
  const char* file;
  int line;
};

/// What another device on the same cards shows.
inline std::int32_t value_of(const Device& device, std::string_view name) {
  return device.read(find_symbol(device.type(), name).value());
}
/// Writes, commands and samples of it, as a bench has them: "pulse=4 INIT LOOPON! sample".
inline void drive(Device& device, const std::string& script) {
  std::istringstream words{script};
  for (std::string word; words >> word;) {
    const auto sign = word.find_first_of("=!");
    const std::string name = word.substr(0, sign);
    if (sign != std::string::npos && word[sign] == '=')
      device.write(find_symbol(device.type(), name).value(), std::stoi(word.substr(sign + 1)));
    else if (word != "sample")
      device.command(find_command(device.type(), name).value());
    if (sign == std::string::npos) device.sample();
  }
}

/// A device of movement on cards of its own, and how a test says what happens and what is seen then:
///
///   after("INIT LOOPON setpos=1000 START +20", "!still acc posit=12~2 DAC>0");
///
/// What happens, word by word:
///   INIT        the command, taken by the next sample       INIT!      given, and waiting for a sample
///   setpos=100  a write; so of the hardware `count=5`, `count+=5` (bits of the axis), `2.INP01=1`,
///   `blocked=1` +20         periods of the axis; +20*5: its master runs 5 bits in each sample      a sample
///   in which the axis does not move    rise:5 fall:5  an edge of an interrupt line until:still
///   until:!still:60   periods until a state is there, 20000 at most or 60; it must come power       power
///   lost and restored                     forget     drops what the device has said
///
/// What is seen: `still` and `!still` are states, without their st_; `posit=12`, `posit=12~2` (give or take
/// 2), `posit<12`, `posit>12`, `posit!=12` are values, also of the hardware (`count`, `DAC`); `silent`:
/// nothing said.
class DeviceBench : public testing::Test {
 public:
  using Make = std::unique_ptr<Device> (*)(const Resources&, Cards&);

  /// `counter` is the one that its axis turns.
  DeviceBench(Make make, const std::string& terminals, const std::string& counter = "2.CNT01")
      : address(parse_address(counter).value()), device(make(terminals_of(terminals), cards)) {}
  void TestBody() override {}  // a bench may also stand in a test as an object

  // What is said of it.
  void does(std::string_view script) {
    std::istringstream words{std::string(script)};
    for (std::string word; words >> word;) act(word);
  }
  void after(std::string_view script, std::string_view expected, Place at = {}) {
    const testing::ScopedTrace trace(at.file, at.line, script);
    taken_.clear();
    does(script);
    for (const std::string& command : taken_) coverage::show(command + " accepted");
    shows(expected, at);
  }
  void shows(std::string_view expected, Place at = {}) {
    const testing::ScopedTrace trace(at.file, at.line, expected);
    std::istringstream words{std::string(expected)};
    for (std::string word; words >> word;) look(word);
  }
  /// The device has said these things and nothing else since it was last asked.
  void says(const std::vector<std::string>& expected, Place at = {}) {
    const testing::ScopedTrace trace(at.file, at.line, "says");
    EXPECT_EQ(diagnostics(), expected);
  }
  /// The same of what it says when this happens.
  void says(std::string_view script, const std::vector<std::string>& expected, Place at = {}) {
    does(script);
    says(expected, at);
  }
  /// Gives commands, one after the other, that are not taken; `why` is all that is said of each.
  void refuses(const std::string& commands, const std::string& why, Place at = {}) {
    std::istringstream words{commands};
    for (std::string word; words >> word;) {
      static_cast<void>(diagnostics());
      command(word);
      says({word + ": " + why}, at);
      coverage::show(word + " refused");
    }
  }

  /// Every command but INIT is refused before INIT.
  void none_runs_before_init() {
    static_cast<void>(diagnostics());
    for (const DeviceCommand& entry : device->type().commands.subspan(1)) {
      const std::string name(entry.name);
      command(name);
      EXPECT_THAT(diagnostics(),
                  testing::ElementsAre(testing::StartsWith(name + ": st_init is 0, must be 1")));
      coverage::show(name + " refused");
    }
  }

  /// The parameters that the test is about: without them it would see something else.
  static void about(const std::string& parameters) {
    std::istringstream words{parameters};
    for (std::string word; words >> word;) coverage::show(word);
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
    hear();
  }
  std::vector<std::string> diagnostics() {
    hear();
    return std::exchange(heard_, {});
  }

  // The hardware's side.
  void sample() {
    device->sample();
    ++samples;
  }
  /// One period: the axis moves as its outputs want, the master by so many bits, then a sample.
  virtual void tick(std::int64_t master_bits = 0) = 0;
  void ticks(int number, std::int64_t master_bits = 0) {
    for (int i = 0; i < number; ++i) tick(master_bits);
  }
  /// Ticks until the state has the value; false if it does not come within `most` periods.
  bool wait(std::string_view state, std::int32_t value, int most = 20000, std::int64_t master_bits = 0) {
    for (int i = 0; i < most && get(state) != value; ++i) tick(master_bits);
    return get(state) == value;
  }
  /// An edge on an interrupt line while the counters are where they are.
  void edge(int line, bool rising) {
    for (auto& [address, counter] : cards.counters) counter.latched = counter.count;
    cards.interrupt_lines[line].level = rising;
    device->interrupt(line, rising);
  }
  Counter& counter() { return cards.counters.at(address); }
  std::int64_t& count() { return counter().count; }
  bool& input(const char* address) { return cards.inputs.at(*parse_address(address)).level; }
  [[nodiscard]] int word() { return cards.analogue_outputs.at(*parse_address("2.AN01")).word; }

  Cards cards;
  Address address;
  std::unique_ptr<Device> device;
  bool blocked = false;  ///< the axis does not move
  long samples = 0;

 protected:
  static std::int64_t number(std::string_view text) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) ADD_FAILURE() << "no number: " << text;
    return value;
  }
  /// The hardware's things that a script may set or add to, and see; nullptr: it is none of them.
  virtual std::int64_t* hardware(std::string_view name) { return name == "count" ? &count() : nullptr; }
  /// Whatever else a script may see.
  virtual double seen(const std::string& name) {
    if (name == "DAC") return word();
    if (const std::int64_t* thing = hardware(name)) return static_cast<double>(*thing);
    coverage::show(name);
    return get(name);
  }
  virtual void expect(const std::string& name, const std::string& wanted) {
    const auto around = std::min(wanted.find('~'), wanted.size());
    const auto tolerance =
        around == wanted.size() ? 0.0 : static_cast<double>(number(wanted.substr(around + 1)));
    EXPECT_NEAR(seen(name), static_cast<double>(number(wanted.substr(0, around))), tolerance) << name;
  }

 private:
  void hear() {
    for (std::string& text : said_by(*device)) heard_.push_back(std::move(text));
  }
  void act(std::string_view word) {
    const auto after_first = [&](char sign) { return word.substr(word.find(sign) + 1); };
    if (const auto sign = word.find('='); sign != std::string_view::npos) {
      assign(word.substr(0, sign), number(word.substr(sign + 1)));
    } else if (word.front() == '+') {
      const auto times = std::min(word.find('*'), word.size());
      ticks(static_cast<int>(number(word.substr(1, times - 1))),
            times == word.size() ? 0 : number(word.substr(times + 1)));
    } else if (word.starts_with("until:")) {
      await(word.substr(6));
    } else if (word.starts_with("rise:") || word.starts_with("fall:")) {
      edge(static_cast<int>(number(after_first(':'))), word.front() == 'r');
    } else if (word == "sample") {
      sample();
    } else if (word == "forget") {
      static_cast<void>(diagnostics());
    } else if (word == "power") {
      device->power_up();
    } else if (word.back() == '!') {
      order(word.substr(0, word.size() - 1));
    } else {
      const std::size_t before = (hear(), heard_.size());
      command(word);
      const std::string subject = std::string(word) + ": ";
      if (std::none_of(heard_.begin() + static_cast<std::ptrdiff_t>(before), heard_.end(),
                       [&](const std::string& text) { return text.starts_with(subject); }))
        taken_.emplace_back(word);
    }
  }
  void assign(std::string_view name, std::int64_t value) {
    const bool more = name.back() == '+';
    if (more) name.remove_suffix(1);
    if (name == "blocked")
      blocked = value != 0;
    else if (name.find('.') != std::string_view::npos)
      input(std::string(name).c_str()) = value != 0;
    else if (std::int64_t* thing = hardware(name))
      *thing = more ? *thing + value : value;
    else
      write(name, static_cast<std::int32_t>(value));
  }
  void await(std::string_view state) {
    const int value = state.front() == '!' ? 0 : 1;
    if (value == 0) state.remove_prefix(1);
    const auto colon = std::min(state.find(':'), state.size());
    const int most = colon == state.size() ? 20000 : static_cast<int>(number(state.substr(colon + 1)));
    const std::string name = "st_" + std::string(state.substr(0, colon));
    EXPECT_TRUE(wait(name, value, most)) << name << " never came to " << value;
    coverage::show(name);
  }
  void look(std::string_view word) {
    if (word == "silent") {
      EXPECT_THAT(diagnostics(), testing::IsEmpty());
      return;
    }
    const auto sign = word.find_first_of("=<>!", 1);
    if (sign == std::string_view::npos) {
      const bool off = word.front() == '!';
      const std::string state = "st_" + std::string(word.substr(off ? 1 : 0));
      EXPECT_EQ(get(state), off ? 0 : 1) << state;
      coverage::show(state);
      return;
    }
    const std::string name(word.substr(0, sign));
    const std::string wanted(word.substr(sign + (word[sign] == '!' ? 2 : 1)));
    if (word[sign] == '=')
      expect(name, wanted);
    else if (word[sign] == '<')
      EXPECT_LT(seen(name), number(wanted)) << name;
    else if (word[sign] == '>')
      EXPECT_GT(seen(name), number(wanted)) << name;
    else
      EXPECT_NE(seen(name), number(wanted)) << name;
  }

  std::vector<std::string> heard_;
  std::vector<std::string> taken_;
};

}  // namespace drycut::devices
