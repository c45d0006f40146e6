#pragma once
#include "tests/devices/bench.hpp"
#include "tests/devices/oopos2/covers.hpp"

namespace drycut::devices::oopos2 {

/// An OOPOS2 wired to an axis with two speeds, that coasts a given way when its outputs go off. TCamp 10 ms,
/// so that a timer's 1/100 s are samples; cntratio 400000, so that 1 Um = 1 bit.
class Oopos2Test : public DeviceBench {
 public:
  static constexpr int period = 10;  ///< [ms]
  static constexpr int zero_line = 3;

  explicit Oopos2Test(int period_ms = period)
      : DeviceBench(make_oopos2, std::to_string(period_ms) +
                                     " 2.CNT01 3 2.INP01 2.OUT01 2.OUT02 2.OUT03 2.OUT04 2.OUT05 2.OUT06") {
    does("cntratio=400000 minpos=-10000 maxpos=10000 slowpos=200 tollp=50 tolln=50 unitvel=1");
  }

  bool& output(int number) { return cards.outputs.at({Kind::output, 2, number}).level; }
  /// The outputs that are on: A forward, I backward, D direction, M movement, R slowdown, F brake.
  std::string on() {
    std::string letters;
    for (int i = 1; i <= 6; ++i)
      if (output(i)) letters += "AIDMRF"[i - 1];
    return letters;
  }
  /// One period: the axis moves by the outputs, then a sample.
  void tick(std::int64_t /*master_bits*/ = 0) override {
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
  /// The outputs over so many samples: "3 AM" if A and M are on from sample 3 on; 0 is the next one.
  std::vector<std::string> record(int number) {
    std::vector<std::string> changes;
    std::string last = on();
    for (int i = 0; i < number; ++i) {
      tick();
      if (on() == last) continue;
      last = on();
      changes.push_back(std::to_string(i) + " " + last);
    }
    return changes;
  }
  /// Gives a command; the outputs over the next samples.
  void switches(std::string_view script, int number, const std::vector<std::string>& expected,
                Place at = {}) {
    const testing::ScopedTrace trace(at.file, at.line, script);
    does(script);
    EXPECT_EQ(record(number), expected);
  }
  /// Places the axis and waits for the end.
  void place(std::int32_t quota) {
    write("setpos", quota);
    command("START");
    EXPECT_TRUE(wait("st_still", 1)) << quota;
  }
  bool& enable() { return input("2.INP01"); }

  int fast = 20;  ///< speeds [bits a sample]
  int slow = 4;
  int coast = 0;  ///< ways after the outputs [bits]
  int coast_fast = 0;

 protected:
  void expect(const std::string& name, const std::string& wanted) override {
    if (name == "on")
      EXPECT_EQ(on(), wanted);
    else
      DeviceBench::expect(name, wanted);
  }

 private:
  int coasting_ = 0;  ///< left
};

}  // namespace drycut::devices::oopos2
