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

TEST(StLosses, OfStandardFunctionsAreToldAtTheirCall) {
  const auto told = [](const std::string& statements) {
    Bench bench(
        "PROGRAM p VAR d : DATE; t : TOD; m : DT; lt : LTOD; lm : LDT; u : UINT; us : USINT; w : WORD; "
        "b : BYTE; two : INT := 2; END_VAR\n" +
        statements + "\nEND_PROGRAM");
    std::vector<std::string> losses;
    for (int scan = 0; scan < 2; ++scan) {
      bench.scan();
      for (const auto& loss : bench.runtime->take_losses())
        losses.push_back(fmt::format("{}:{}: {}", loss.line, loss.column, loss.text));
    }
    return losses;
  };
  EXPECT_THAT(told("d := CONCAT_DATE(2024, two, 30);"),
              ElementsAre("2:6: CONCAT_DATE(2024, 2, 30) does not fit, D#2024-03-01 is made of it"));
  EXPECT_THAT(told("u := WORD_BCD_TO_UINT(16#1A);"),
              ElementsAre("2:6: WORD_BCD_TO_UINT(16#1A) does not fit, 20 is made of it"));
  EXPECT_THAT(told("w := UINT_TO_BCD_WORD(12345);"),
              ElementsAre("2:6: UINT_TO_BCD_WORD(12345) does not fit, 16#2345 is made of it"));
  for (const char* statement :
       {"t := CONCAT_TOD(25, 0, 0, 0);", "t := CONCAT_TOD(0, 0, -1, 0);", "lt := CONCAT_LTOD(0, 60, 0, 0);",
        "m := CONCAT_DT(2023, 2, 29, 0, 0, 0, 0);", "m := CONCAT_DT(2023, 2, 28, 24, 0, 0, 0);",
        "m := CONCAT_DT(2106, 2, 7, 6, 28, 16, 0);", "lm := CONCAT_LDT(2023, 13, 1, 0, 0, 0, 0);",
        "lm := CONCAT_LDT(2262, 4, 11, 23, 47, 16, 855);", "lm := CONCAT_LDT(2262, 4, 12, 0, 0, 0, 0);",
        "lm := CONCAT_LDT(32767, 1, 1, 0, 0, 0, 0);", "lm := CONCAT_LDT(1969, 12, 31, 0, 0, 0, 0);",
        "d := CONCAT_DATE(1969, 12, 31);", "d := CONCAT_DATE(2106, 2, 8);", "us := BCD_TO_USINT(16#256);",
        "us := BYTE_BCD_TO_USINT(16#A0);", "b := TO_BCD_BYTE(100);", "b := USINT_TO_BCD_BYTE(100);"})
    EXPECT_THAT(told(statement), testing::SizeIs(1)) << statement;
  for (const char* statement :
       {"t := CONCAT_TOD(23, 59, 59, 999);", "d := CONCAT_DATE(2024, 2, 29);",
        "d := CONCAT_DATE(2106, 2, 7);", "m := CONCAT_DT(2106, 2, 7, 6, 28, 15, 999);",
        "lm := CONCAT_LDT(2024, 2, 29, 23, 59, 59, 999);", "lm := CONCAT_LDT(2262, 4, 11, 23, 47, 16, 854);",
        "us := BCD_TO_USINT(16#255);", "w := UINT_TO_BCD_WORD(9999);", "b := TO_BCD_BYTE(99);"})
    EXPECT_THAT(told(statement), IsEmpty()) << statement;
}

TEST(StLosses, OfConstantsAreNotedAsThoseOfVariablesAreTold) {
  const auto noted = [](const std::string& statements) {
    return Bench("PROGRAM p VAR i : SINT; u : USINT; t : TIME; r : REAL; b : BYTE; l : LREAL; END_VAR\n" +
                 statements + "\nEND_PROGRAM")
        .doubts;
  };
  EXPECT_THAT(noted("i := INT_TO_SINT(300);"),
              ElementsAre("2:6: 300 does not fit in SINT, which makes 44 of it"));
  EXPECT_THAT(noted("u := DINT_TO_USINT(-1);"),
              ElementsAre("2:6: -1 does not fit in USINT, which makes 255 of it"));
  EXPECT_THAT(noted("i := LREAL_TO_SINT(127.6);"),
              ElementsAre("2:6: 127.6 does not fit in SINT, which makes -128 of it"));
  EXPECT_THAT(noted("r := LREAL_TO_REAL(1E39);"), ElementsAre("2:6: a REAL overflows; it goes to 3.4e38"));
  for (const char* statement :
       {"i := INT_TO_SINT(-128);", "u := DINT_TO_USINT(255);", "b := WORD_TO_BYTE(16#1234);",
        "i := LREAL_TO_SINT(127.4);", "r := LREAL_TO_REAL(1E38);", "t := DINT_TO_TIME(5);"})
    EXPECT_THAT(noted(statement), IsEmpty()) << statement;
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
