#pragma once
// Programs for the tests of the instruction list, and a controller that only writes down what it is told.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/il_scan.hpp"

namespace drycut::devices::lx3vp::il {

/// The faults of a text as they are printed, without the file's name.
inline std::vector<std::string> faults(const std::string& text) {
  Problems problems;
  compile(text, "p.il", problems);
  std::vector<std::string> told;
  for (const auto& problem : problems) told.push_back(to_string(problem).substr(std::string("p.il:").size()));
  return told;
}

/// A text and all that it is refused for.
struct Refused {
  std::string text;
  std::vector<std::string> faults;
};
inline void expect_faults(const std::vector<Refused>& cases) {
  for (const auto& [text, told] : cases) EXPECT_THAT(faults(text), testing::ElementsAreArray(told)) << text;
}

/// Writes the calls down: "decam 12 K10 D2000 X2 Y0 Y4 on".
struct Notes : Instructions {
  std::vector<std::string> calls;

  static std::string state(bool on) { return on ? " on" : " off"; }
  void decam(int step, const DecamOperands& o, bool powered) override {
    const char master = "CDK"[static_cast<std::size_t>(o.master.kind)];
    calls.push_back(fmt::format("decam {} {}{} D{} {}{} Y{} Y{}{}", step, master, o.master.number, o.block,
                                o.start.is_input ? 'X' : 'M', o.start.number, o.output, o.direction,
                                state(powered)));
  }
  void pulses(int step, const PulseOrder& o, bool powered) override {
    static constexpr std::array names = {"plsv", "drvi", "drva", "plsy", "plsr", "pwm", "zrn"};
    using enum PulseOrder::Kind;
    auto text = fmt::format("{} {}", names[static_cast<std::size_t>(o.kind)], step);
    if (o.kind == distance || o.kind == position) text += fmt::format(" {}", o.pulses);
    text += fmt::format(" {}", o.frequency);
    if (o.kind == train || o.kind == ramped) text += fmt::format(" {}", o.pulses);
    if (o.kind == ramped) text += fmt::format(" {}", o.ramp_ms);
    if (o.kind == pwm) text += fmt::format(" {} {}", o.width_ms, o.period_ms);
    if (o.kind == zero) text += fmt::format(" {} {}{}", o.creep, o.dog.letter, o.dog.number);
    text += fmt::format(" Y{}", o.output);
    if (o.direction >= 0) text += fmt::format(" Y{}", o.direction);
    calls.push_back(text + state(powered));
  }
  void high_speed_counter(int number, std::int32_t preset, bool powered) override {
    calls.push_back(fmt::format("counter C{} {}{}", number, preset, state(powered)));
  }
  void compare_counter(int step, const CounterCompare& c, bool powered) override {
    static constexpr std::array names = {"set", "reset", "zone"};
    calls.push_back(fmt::format("{} {} C{} {} {} {}{}{}", names[static_cast<std::size_t>(c.kind)], step,
                                c.counter, c.low, c.high, c.letter, c.number, state(powered)));
  }
  void measure_speed(int step, const SpeedMeasure& m, bool powered) override {
    calls.push_back(
        fmt::format("speed {} X{} {} D{}{}", step, m.input, m.period_ms, m.result, state(powered)));
  }
  void refresh(char letter, int first, int count) override {
    calls.push_back(fmt::format("refresh {}{} {}", letter, first, count));
  }
  void error(int step, int code, const std::string& text) override {
    calls.push_back(fmt::format("error {} {} {}", step, code, text));
  }
  void watchdog(int step, const std::string& text) override {
    calls.push_back("watchdog " + std::to_string(step) + " " + text);
  }
  void cam_table(int step, std::int32_t result, const std::string& text) override {
    if (result < 0) calls.push_back("cam " + std::to_string(step) + " " + text);
  }
};

/// A program with its registers, scanned every 10 ms.
class Plc {
 public:
  explicit Plc(const std::string& text) {
    Problems problems;
    program_ = compile(text + "\nEND\n", "p.il", problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    scanner_ = std::make_unique<ProgramScan>(program_);
    registers.m[8000] = true;  // always ON
  }
  Plc& scan(int times = 1) {
    for (int i = 0; i < times; ++i) {
      notes.calls.clear();
      scanner_->scan(registers, notes);
      registers.time_ns += 10'000'000;
    }
    return *this;
  }
  void restart() { scanner_->restart(); }
  /// By the names of registers, with blanks between them: "D0 DD10 M5".
  [[nodiscard]] std::vector<double> values(const std::string& names) const {
    std::vector<double> read;
    std::istringstream words(names);
    for (std::string name; words >> name;) read.push_back(lx3vp::read(registers, *parse_register(name)));
    return read;
  }

  Registers registers;
  Notes notes;

 private:
  IlProgram program_;
  std::unique_ptr<ProgramScan> scanner_;
};

}  // namespace drycut::devices::lx3vp::il
