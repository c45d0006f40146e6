// Numbers that no type holds, in every language: the largest is taken, what is above is a problem at its
// place. 4294967296 + n and 18446744073709551616 + n are n to a reader that drops what overflows.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "devices/lx3vp/il_program.hpp"
#include "devices/plcopen/st/program.hpp"
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/program.hpp"

namespace drycut::devices {
namespace {

using Reader = Problems (*)(const std::string& text);

Problems cnf(const std::string& text) {
  Problems problems;
  qmove::parse_configuration(text, "f", catalogue(), problems);
  return problems;
}
Problems qcl(const std::string& line) {
  Problems problems;
  const auto configuration = qmove::parse_configuration(
      "GLOBAL\nglA L\ngsS S\nARRGBL\nglB L 3\nTIMER\ntm\nEND\n", "f", catalogue(), problems);
  qmove::compile_module(line + "\nEND\n", "f", configuration, catalogue(), problems);
  return problems;
}
Problems il(const std::string& line) {
  Problems problems;
  lx3vp::il::compile("LD X0\n" + line + "\nEND\n", "f", problems);
  return problems;
}
Problems declared(const std::string& variable) {
  Problems problems;
  plcopen::st::compile("PROGRAM m VAR\n" + variable + " END_VAR\nEND_PROGRAM\n", "f", problems);
  return problems;
}
Problems st(const std::string& statement) {
  Problems problems;
  plcopen::st::compile(
      "PROGRAM m VAR w : WORD; q : LWORD; i : INT; l : LINT; u : ULINT; y : BYTE; r : REAL; x : LREAL; t : "
      "TIME; a : ARRAY[-1..3] OF INT; END_VAR\n" +
          statement + "\nEND_PROGRAM\n",
      "f", problems);
  return problems;
}

/// A text with a literal in place of '@': `good` is taken, each of `bad` is a problem.
struct Row {
  Reader read;
  std::string text;
  std::string good;
  std::vector<std::string> bad;
  int line = 2;
};

std::vector<Row> rows() {
  const std::string huge = "99999999999999999999";
  const std::string once = "18446744073709551616";  // 2^64: 0 to a reader that drops what overflows
  return {
      {st, "w.%X@ := TRUE;", "15", {"16", "4294967296", once, "18446744073709551619", huge}},
      {st, "y := w.%B@;", "1", {"2", "4294967297", once, huge}},
      {st, "q.%D@ := 1;", "1", {"2", once, huge}},
      {st, "w.@ := TRUE;", "15", {"16", "4294967299", once, huge}},
      {st, "i := @;", "32767", {"32768", "4294967297", once, huge}},
      {st, "i := INT#@;", "32767", {"32768", "4294967297", once, huge}},
      {st, "w := 16#@;", "FFFF", {"10000", "100000001", "10000000000000001"}},
      {st, "l := @;", "9223372036854775807", {"9223372036854775808", once, huge}},
      {st, "l := -@;", "9223372036854775808", {"9223372036854775809", "18446744073709551615", once}},
      {st, "l := LINT#-@;", "9223372036854775808", {"9223372036854775809", "18446744073709551615"}},
      {st, "u := @;", "18446744073709551615", {once, huge}},
      {st, "u := -@;", "0", {"1", "18446744073709551615", once}},
      {st, "r := @;", "3.4E38", {"3.5E38", "1E999"}},
      {st, "x := @;", "1.7E308", {"1.8E308", "1E999"}},
      {st, "t := T#@ms;", "4294967295", {"4294967296", once, huge}},
      {st, "a[@] := 1;", "3", {"4", "4294967296", "18446744073709551615", once}},
      {st, "CASE i OF @: i := 1; END_CASE;", "32767", {"4294967296", "18446744073709551615", once}},
      {st, "FOR i := 0 TO @ DO END_FOR;", "32767", {"4294967296", "18446744073709551615", once}},
      {declared, "b : ARRAY[0..@] OF INT;", "9", {"4294967305", "18446744073709551615", once}},
      {declared, "b : ARRAY[@..3] OF INT;", "0", {"4294967296", "18446744073709551615", once}},
      {declared, "b : STRING[@];", "80", {"4294967297", "18446744073709551615", once}},
      {declared, "b : INT(0..@);", "9", {"4294967305", "18446744073709551615", once}},
      {declared, "b : (one := @);", "1", {"4294967297", "18446744073709551615", once}},
      {declared, "b AT %IX@.0 : BOOL;", "0", {"65536", "4294967296", once}},
      {declared, "b AT %IX0.@ : BOOL;", "7", {"8", "4294967296", once}},

      {qcl, "glA = @", "2147483647", {"2147483648", "4294967297", once, huge}, 1},
      {qcl, "glA = -@", "2147483648", {"2147483649", "4294967297", once}, 1},
      {qcl, "gsS = @", "3.0", {"1" + std::string(39, '0') + ".0"}, 1},
      {qcl, "glB[@] = 1", "3", {"4", "4294967297", once}, 1},
      {qcl, "tm = @", "100", {"4294967396", once}, 1},

      {cnf, "CONST\nA @\nEND\n", "2147483647", {"2147483648", "4294967297", once, huge}},
      {cnf, "CONST\nA @\nEND\n", "-2147483648", {"-2147483649", "-18446744073709551617"}},
      {cnf, "CONST\nA @\nEND\n", "1.0", {"1" + std::string(39, '0') + ".0"}},
      {cnf, "ARRGBL\nA L @\nEND\n", "3", {"0", "65536", "4294967299", "18446744073709551619"}},
      {cnf, "BUS\n@ 1CPUB 02\nEND\n", "1", {"0", "4294967297", "18446744073709551617"}},
      {cnf, "INPUT\nA F @.INP01\nEND\n", "2", {"4294967298", "18446744073709551618"}},
      {cnf, "INPUT\nA F 2.INP@\nEND\n", "1", {"4294967297", "18446744073709551617"}},
      {cnf, "INTDEVICE\nA EANPOS @ 2.CNT01 1 2.INP01 2.AN01\nEND\n", "5", {"256", "4294967301", once}},
      {cnf, "INTDEVICE\nA EANPOS 5 2.CNT01 @ 2.INP01 2.AN01\nEND\n", "1", {"9", "4294967297", once}},

      {il, "MOV K@ D0", "32767", {"32768", "4294967297", once}},
      {il, "DMOV K@ D0", "2147483647", {"2147483648", "4294967297", once}},
      {il, "DMOV K@ D0", "-2147483648", {"-2147483649"}},
      {il, "DMOV H@ D0", "FFFFFFFF", {"100000000", "10000000000000001"}},
      {il, "DEMOV E@ D0", "3.4E38", {"3.5E38", "1E999"}},
      {il, "MOV D@ D0", "7", {"4294967303", once}},
      {il, "OUT Y@", "7", {"40000000007", "2000000000000000000007"}},
      {il, "OUT M@", "7", {"4294967303", once}},
      {il, "OUT D0.@", "7", {"10", "100000007"}},
      {il, "OUT T@ K5", "7", {"4294967303", once}},
      {il, "OUT T0 K@", "7", {"4294967303", once}},
      {il, "MOV K@M0 D0", "4", {"5", "4294967300", once}},
      {il, "MOV K4M@ D0", "0", {"4294967296", once}},
      {il, "MOV K1Z@ D0", "7", {"8", "4294967303", once}},
      {il, "CJ P@\nLD M8000\nOUT Y0\nP7", "7", {"4294967303", once}},
  };
}

TEST(LiteralsOutOfRange, AreProblemsAtTheirPlace) {
  for (const Row& row : rows()) {
    const auto with = [&](const std::string& literal) {
      auto text = row.text;
      return text.replace(text.find('@'), 1, literal);
    };
    EXPECT_THAT(row.read(with(row.good)), testing::IsEmpty()) << with(row.good);
    for (const auto& bad : row.bad) {
      const auto problems = row.read(with(bad));
      ASSERT_FALSE(problems.empty()) << with(bad);
      EXPECT_EQ(problems.front().line, row.line) << with(bad);
      EXPECT_GT(problems.front().column, 0) << with(bad);
    }
  }
}

TEST(LiteralsOutOfRange, AreToldAsTheyWereWritten) {
  const auto told = [](const Problems& problems) { return problems.empty() ? "" : problems.front().what; };
  for (const char* number : {"18446744073709551615", "9223372036854775809"}) {
    EXPECT_THAT(told(st(std::string("l := -") + number + ";")), testing::HasSubstr(number));
    EXPECT_THAT(told(st(std::string("a[") + number + "] := 1;")), testing::HasSubstr(number));
    EXPECT_THAT(told(declared(std::string("b : ARRAY[0..") + number + "] OF INT;")),
                testing::HasSubstr(number));
  }
}

}  // namespace
}  // namespace drycut::devices
