#pragma once
#include "devices/camming4/camming4.hpp"
#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/ideal_axis.hpp"

namespace drycut::devices::camming4 {

/// A CAMMING4 on an ideal axis, with a master that the test moves. A script has `master` and `master_b`, the
/// counts of the masters, and sees `output`, its digital output.
class Camming4Test : public IdealAxisBench {
 public:
  explicit Camming4Test(const std::string& slave = "2.CNT01", const std::string& master = "2.CNT02",
                        int period_ms = period)
      : IdealAxisBench(make_camming4,
                       std::to_string(period_ms) + " " + slave + " " + master +
                           " 2.CNT03 1 2.INP01 2 2.INP02 2.INP03 5 2.AN01 2.OUT01",
                       slave),
        master_address(parse_address(master).value()) {
    does("measure=1 pulse=1 measurem=1 pulsem=1 tacc=100 tdec=100 syncrange=50 forget");
  }

  /// Writes rows of the cam table, from row 1 on; what a row leaves out stays as it is.
  void rows(const std::vector<std::vector<std::int32_t>>& table) {
    int number = 1;
    for (const auto& values : table) row(number++, values);
  }
  void row(int number, const std::vector<std::int32_t>& values) {
    static constexpr const char* columns[] = {"codeG", "codeQm", "codeQs", "codeQma", "codeQsa", "codeM"};
    int column = 0;
    for (const std::int32_t value : values) write(columns[column++] + std::to_string(number), value);
  }
  /// Nothing regulates and the axis stands: the following error is the theoretical way.
  void without_gains() { does("pgain=0 feedfw=0 blocked=1"); }

  Counter& master() { return cards.counters.at(master_address); }
  Counter& master_b() { return cards.counters.at(*parse_address("2.CNT03")); }
  bool& output() { return cards.outputs.at(*parse_address("2.OUT01")).level; }

  Address master_address;

 protected:
  double seen(const std::string& name) override {
    return name == "output" ? static_cast<double>(output()) : IdealAxisBench::seen(name);
  }
  std::int64_t* hardware(std::string_view name) override {
    if (name == "master") return &master().count;
    if (name == "master_b") return &master_b().count;
    return IdealAxisBench::hardware(name);
  }
};

}  // namespace drycut::devices::camming4
