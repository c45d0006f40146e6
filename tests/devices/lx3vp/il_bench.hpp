#pragma once
// Programs for the tests of the instruction list, and a controller that only writes down what it is told.
#include <gmock/gmock.h>

#include <memory>
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

/// Writes the calls down: "decam 12 K10 D2000 X2 Y0 Y4 on".
struct Notes : Instructions {
  std::vector<std::string> calls;

  static std::string state(bool on) { return on ? " on" : " off"; }
  void decam(int step, const DecamOperands& o, bool powered) override {
    const char master = o.master.kind == MasterSource::Kind::counter ? 'C'
                        : o.master.kind == MasterSource::Kind::word  ? 'D'
                                                                     : 'K';
    calls.push_back("decam " + std::to_string(step) + " " + master + std::to_string(o.master.number) + " D" +
                    std::to_string(o.block) + (o.start.is_input ? " X" : " M") +
                    std::to_string(o.start.number) + " Y" + std::to_string(o.output) + " Y" +
                    std::to_string(o.direction) + state(powered));
  }
  void plsv(int step, std::int32_t frequency, int output, int direction, bool powered) override {
    calls.push_back("plsv " + std::to_string(step) + " " + std::to_string(frequency) + " Y" +
                    std::to_string(output) + " Y" + std::to_string(direction) + state(powered));
  }
  void drive(int step, bool absolute, std::int32_t pulses, std::int32_t frequency, int output, int direction,
             bool powered) override {
    calls.push_back((absolute ? "drva " : "drvi ") + std::to_string(step) + " " + std::to_string(pulses) +
                    " " + std::to_string(frequency) + " Y" + std::to_string(output) + " Y" +
                    std::to_string(direction) + state(powered));
  }
  void pulse_train(int step, std::int32_t frequency, std::int32_t pulses, int output, bool powered) override {
    calls.push_back("plsy " + std::to_string(step) + " " + std::to_string(frequency) + " " +
                    std::to_string(pulses) + " Y" + std::to_string(output) + state(powered));
  }
  void zero_return(int step, std::int32_t speed, std::int32_t creep, DogSignal dog, int output,
                   bool powered) override {
    calls.push_back("zrn " + std::to_string(step) + " " + std::to_string(speed) + " " +
                    std::to_string(creep) + " " + "XYMS"[static_cast<int>(dog.kind)] +
                    std::to_string(dog.number) + " Y" + std::to_string(output) + state(powered));
  }
  void high_speed_counter(int number, std::int32_t preset, bool powered) override {
    calls.push_back("counter C" + std::to_string(number) + " " + std::to_string(preset) + state(powered));
  }
  void error(int step, int code, const std::string& text) override {
    calls.push_back("error " + std::to_string(step) + " " + std::to_string(code) + " " + text);
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
    scanner_ = std::make_unique<Scanner>(program_);
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

  Registers registers;
  Notes notes;

 private:
  Program program_;
  std::unique_ptr<Scanner> scanner_;
};

}  // namespace drycut::devices::lx3vp::il
