// What does not fit where it is put is told once, at its line.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <limits>

#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Of two scans; the statements are line 2.
std::vector<std::string> losses_of(const std::string& statements) {
  Bench bench(
      "PROGRAM p VAR r : REAL := 3E38; x : LREAL := 1E10; i : INT; u : USINT; d : DINT := 70000; b : BYTE; "
      "s : STRING(3); t : STRING := 'abcdef'; w : WORD := 16#1234; END_VAR\n" +
      statements + "\nEND_PROGRAM");
  std::vector<std::string> told;
  for (int scan = 0; scan < 2; ++scan) {
    bench.scan();
    for (const auto& loss : bench.runtime->take_losses())
      told.push_back(fmt::format("{}:{}: {}", loss.line, loss.column, loss.text));
  }
  return told;
}

TEST(StLosses, AreToldOnceAtTheirLine) {
  EXPECT_THAT(losses_of("r := r * 10.0; r := 3E38;"),
              ElementsAre("2:8: a REAL overflows; it goes to 3.4e38"));
  EXPECT_THAT(losses_of("r := LREAL_TO_REAL(x * 1E200);"),
              ElementsAre("2:6: a REAL overflows; it goes to 3.4e38"));
  EXPECT_THAT(losses_of("i := DINT_TO_INT(d);"),
              ElementsAre("2:6: 70000 does not fit in INT, which makes 4464 of it"));
  EXPECT_THAT(losses_of("i := LREAL_TO_INT(x);"),
              ElementsAre("2:6: 10000000000 does not fit in INT, which makes -7168 of it"));
  EXPECT_THAT(losses_of("u := DINT_TO_USINT(-1);\nu := TO_USINT(i - 1);"),
              ElementsAre("3:6: -1 does not fit in USINT, which makes 255 of it"));
  EXPECT_THAT(losses_of("s := t;"), ElementsAre("2:1: a text of 6 characters is cut off at 3"));
}

TEST(StLosses, AreNoneWhereBitsAreMeant) {
  EXPECT_THAT(
      losses_of("b := WORD_TO_BYTE(w); b := w.%B1; i := i + 30000; i := LREAL_TO_INT(32767.4); w.%B0 := b;"),
      IsEmpty());
}

TEST(StLosses, LeaveNumbersThatCanBeRecorded) {
  Bench bench(
      "PROGRAM p VAR r : REAL := 3E38; x : LREAL := 1E308; n : LREAL; END_VAR\n"
      "r := r * 10.0; x := x * 1E10; n := x - x; END_PROGRAM");
  bench.scan();
  EXPECT_EQ(bench["r"], static_cast<double>(std::numeric_limits<float>::max()));
  EXPECT_EQ(bench["x"], std::numeric_limits<double>::max());
  EXPECT_EQ(bench["n"], 0);
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
