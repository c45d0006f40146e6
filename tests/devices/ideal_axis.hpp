#pragma once
#include "tests/devices/bench.hpp"

namespace drycut::devices {

/// A device with an analogue output on an ideal axis: the voltage is the speed, exactly. TCamp 2 ms, 1 Um = 1
/// bit, maxvel 50000 Um/s, so the way at full speed in a period is 100 bits.
class IdealAxisBench : public DeviceBench {
 public:
  static constexpr double full_speed = 50000;  ///< of the ideal axis [bits/s]
  static constexpr int period = 2;             ///< [ms]

  IdealAxisBench(Make make, const std::string& terminals, const std::string& counter)
      : DeviceBench(make, terminals, counter) {
    does(
        "unitvel=1 maxvel=50000 minpos=-999999 maxpos=999999 feedfw=1000 pgain=200 setvel=5000 toll=2 "
        "maxfollerr=1000 prsvel=5000 sprsvel=1000");
  }

  void start() { after("INIT LOOPON", "loopon"); }
  /// One period: the axis follows the voltage, the master runs on, then a sample.
  void tick(std::int64_t master_bits = 0) override {
    if (!blocked) way_ += word() / 32767.0 * full_speed * period / 1000;
    const double whole = std::floor(way_);
    way_ -= whole;
    count() += static_cast<std::int64_t>(whole);
    if (master_bits != 0) *hardware("master") += master_bits;
    sample();
  }
  /// Places the axis and lets it come to rest; false if it does not end.
  bool place(std::int32_t quota) {
    write("setpos", quota);
    command("START");
    const bool ended = wait("st_still", 1);
    ticks(200);
    return ended;
  }
  /// Periods until the axis stands.
  int time_to_still() {
    const long before = samples;
    EXPECT_TRUE(wait("st_still", 1));
    return static_cast<int>(samples - before);
  }
  /// Periods from a command until the axis is still again.
  int duration(std::string_view name) {
    order(name);
    tick();
    return 1 + time_to_still();
  }
  /// Theoretical speed [bits/s], as feedfw 1000 shows it.
  double speed() { return get("ffwdreg") * full_speed / 32767; }

 protected:
  double seen(const std::string& name) override {
    return name == "speed" ? speed() : DeviceBench::seen(name);
  }

 private:
  double way_ = 0;
};

}  // namespace drycut::devices
