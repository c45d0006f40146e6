#pragma once
#include "tests/devices/epicpos/covers.hpp"
#include "tests/devices/ideal_axis.hpp"

namespace drycut::devices::epicpos {

/// An EPICPOS (or EANPOS) on an ideal axis, cntratio 400000, so that 1 Um = 1 bit.
class PositionerTest : public IdealAxisBench {
 public:
  static constexpr int zero_line = 3;

  explicit PositionerTest(Make make = make_epicpos, const std::string& counter = "2.CNT01")
      : IdealAxisBench(make, "2 " + counter + " 3 2.INP01 2.AN01", counter) {
    does("cntratio=400000 taccdec=100 forget");
  }
  bool& enable() { return input("2.INP01"); }
};

}  // namespace drycut::devices::epicpos
