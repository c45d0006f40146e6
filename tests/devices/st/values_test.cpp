// Types, operators, functions and conversions by closed forms.
#include <cmath>
#include <map>

#include "devices/plcopen/pins.hpp"
#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

TEST(StValues, WholeNumbersWrapInTheirWidth) {
  struct Row {
    const char* type;
    double low, high;
  };
  for (const Row& row : {Row{"SINT", -128, 127},
                         {"INT", -32768, 32767},
                         {"DINT", -2147483648.0, 2147483647},
                         {"USINT", 0, 255},
                         {"UINT", 0, 65535},
                         {"UDINT", 0, 4294967295.0},
                         {"BYTE", 0, 255},
                         {"WORD", 0, 65535},
                         {"DWORD", 0, 4294967295.0}}) {
    const std::string up =
        std::string("n : ") + row.type + " := " + std::to_string(static_cast<long long>(row.high)) + ";";
    const std::string down =
        std::string("n : ") + row.type + " := " + std::to_string(static_cast<long long>(row.low)) + ";";
    EXPECT_EQ(value_of(row.type, "n + 1", up), row.low) << row.type;
    EXPECT_EQ(value_of(row.type, "n - 1", down), row.high) << row.type;
    EXPECT_EQ(value_of(row.type, "n * n", up), 1) << row.type;
  }
  EXPECT_EQ(value_of("LINT", "n - 9223372036854775807 - 2", "n : LINT;"), 9223372036854775807.0);
  EXPECT_EQ(value_of("TIME", "n - T#1ms", "n : TIME;"), 4294967.295);
}

TEST(StValues, TruthTablesOfLogic) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      const std::string vars =
          "a : BOOL := " + std::to_string(a) + "; b : BOOL := " + std::to_string(b) + ";";
      expect_values("BOOL",
                    {{"a AND b", a & b},
                     {"a & b", a & b},
                     {"a OR b", a | b},
                     {"a XOR b", a ^ b},
                     {"a AND_THEN b", a & b},
                     {"a OR_ELSE b", a | b},
                     {"NOT a", 1 - a}},
                    vars);
    }
  EXPECT_EQ(value_of("WORD", "NOT w", "w : WORD := 16#00F0;"), 0xFF0F);
  EXPECT_EQ(value_of("BYTE", "w AND 2#1010_1010 OR 1", "w : BYTE := 16#F0;"), 0xA1);
}

TEST(StValues, OnlyAndThenAndOrElseLeaveTheirRightSideOut) {
  const std::string units =
      "VAR_GLOBAL n : INT; END_VAR FUNCTION G : BOOL n := n + 1; G := TRUE; END_FUNCTION ";
  EXPECT_EQ(run("x : INT; b : BOOL;", "b := b AND G(); b := TRUE OR G(); x := n;", units), 2);
  EXPECT_EQ(run("x : INT; b : BOOL;", "b := b AND_THEN G(); b := TRUE OR_ELSE G(); x := n;", units), 0);
}

TEST(StValues, PrecedenceIsThatOfIec) {
  expect_values("DINT", {{"2 + 3 * 4 - 6 / 2", 11}, {"20 / 2 / 5 * 3 MOD 4", 2}});
  expect_values("LREAL", {{"-2 ** 2", -4}, {"2 ** 3 ** 2", 64}, {"2 ** -1", 0.5}});
  expect_values("BOOL", {{"TRUE OR TRUE AND FALSE", 1},
                         {"TRUE XOR TRUE AND FALSE", 1},
                         {"1 + 1 < 3 = TRUE", 1},
                         {"NOT FALSE AND FALSE", 0}});
  EXPECT_EQ(value_of("INT", "(2 + 3) * 4"), 20);
}

TEST(StValues, DivisionGoesTowardsZero) {
  EXPECT_EQ(value_of("INT", "a / b", "a : INT := -7; b : INT := 2;"), -3);
  EXPECT_EQ(value_of("INT", "a MOD b", "a : INT := -7; b : INT := 2;"), -1);
  EXPECT_EQ(value_of("INT", "a / b", "a : INT := -32768; b : INT := -1;"), -32768);
  EXPECT_EQ(value_of("LREAL", "a / 2", "a : INT := 7;"), 3);
  EXPECT_EQ(value_of("LREAL", "a / 2.0", "a : INT := 7;"), 3.5);
}

TEST(StValues, ComparisonsOfAllKinds) {
  for (const char* type : {"INT", "LREAL", "TIME"}) {
    const std::string small = type == std::string("TIME") ? "T#1s" : "1";
    const std::string large = type == std::string("TIME") ? "T#2s" : "2";
    const std::string vars =
        std::string("a : ") + type + " := " + small + "; b : " + type + " := " + large + ";";
    const std::map<std::string, double> results{
        {"a < b", 1},  {"b < a", 0},  {"a < a", 0}, {"a <= a", 1}, {"b <= a", 0}, {"b > a", 1}, {"a > a", 0},
        {"a >= a", 1}, {"a >= b", 0}, {"a = a", 1}, {"a = b", 0},  {"a <> b", 1}, {"a <> a", 0}};
    for (const auto& [text, wanted] : results)
      EXPECT_EQ(value_of("BOOL", text, vars), wanted) << type << " " << text;
  }
}

TEST(StValues, ConversionsRoundHalvesToTheEvenOneAndWrap) {
  for (const auto& [r, n] :
       {std::pair{0.5, 0.0}, {1.5, 2.0}, {2.5, 2.0}, {-0.5, 0.0}, {-1.5, -2.0}, {2.4, 2.0}, {-2.6, -3.0}})
    EXPECT_EQ(value_of("INT", "LREAL_TO_INT(r)", "r : LREAL := " + std::to_string(r) + ";"), n) << r;
  EXPECT_EQ(value_of("DINT", "TRUNC(r)", "r : LREAL := -2.9;"), -2);
  EXPECT_EQ(value_of("INT", "DINT_TO_INT(d)", "d : DINT := 70000;"), 4464);
  EXPECT_EQ(value_of("USINT", "TO_USINT(d)", "d : DINT := -1;"), 255);
  EXPECT_EQ(value_of("REAL", "LREAL_TO_REAL(r)", "r : LREAL := 0.1;"), static_cast<double>(0.1F));
  EXPECT_EQ(value_of("DINT", "TIME_TO_DINT(t)", "t : TIME := T#1m2s3ms;"), 62003);
  EXPECT_EQ(value_of("TIME", "LREAL_TO_TIME(r)", "r : LREAL := 1500.0;"), 1.5);
  EXPECT_EQ(value_of("BOOL", "INT_TO_BOOL(i)", "i : INT := 2;"), 1);
  EXPECT_EQ(value_of("INT", "BOOL_TO_INT(b)", "b : BOOL := TRUE;"), 1);
  EXPECT_EQ(value_of("INT", "TO_INT(r)", "r : REAL := 3.5;"), 4);
}

TEST(StValues, WideningIsImplicit) {
  EXPECT_EQ(value_of("LREAL", "s + u", "s : SINT := -100; u : USINT := 200;"), 100);
  EXPECT_EQ(value_of("DINT", "i + w", "i : INT := -1; w : WORD := 65535;"), 65534);
  EXPECT_EQ(value_of("LREAL", "d * 0.5", "d : DINT := 3;"), 1.5);
  EXPECT_EQ(value_of("REAL", "r + 0.1", "r : REAL := 0.2;"), static_cast<double>(0.1F + 0.2F));
}

TEST(StValues, LiteralsOfAllForms) {
  EXPECT_EQ(value_of("DINT", "16#FF + 2#1010_0001 + 8#17 + 1_000"), 255 + 161 + 15 + 1000);
  EXPECT_EQ(value_of("LREAL", "1.5E-3 + LREAL#2 + INT#-5"), 1.5e-3 + 2 - 5);
  expect_values("TIME", {{"T#1d2h3m4s5ms", 86400 + 7200 + 180 + 4.005}, {"time#1.5s", 1.5}});
  EXPECT_EQ(value_of("BOOL", "BOOL#TRUE"), 1);
  EXPECT_EQ(value_of("DWORD", "HLI_CI_F_PERIODIC OR HLI_CI_ENDLESS_POSITIVE"), 0x30);
  EXPECT_EQ(value_of("UDINT", "POLY5_LINE"), 5);
  EXPECT_EQ(value_of("INT", "mcNegativeDirection"), 3);
}

TEST(StValues, TimesAreScaled) {
  EXPECT_EQ(value_of("TIME", "t * 3 + t / 2 - T#1ms", "t : TIME := T#100ms;"), 0.349);
  EXPECT_EQ(value_of("TIME", "2.5 * t", "t : TIME := T#100ms;"), 0.25);
  EXPECT_EQ(value_of("TIME", "t / 0.5", "t : TIME := T#100ms;"), 0.2);
}

TEST(StValues, FunctionsByTheirClosedForms) {
  const std::string v =
      "v : LREAL := 0.7; w : LREAL := -0.3; i : INT := -4; b : BYTE := 16#81; s : SINT := -128; k : INT := "
      "1;";
  const std::map<std::string, double> results{{"ABS(w)", 0.3},
                                              {"SQRT(v)", std::sqrt(0.7)},
                                              {"SIN(v)", std::sin(0.7)},
                                              {"COS(v)", std::cos(0.7)},
                                              {"TAN(v)", std::tan(0.7)},
                                              {"ASIN(v)", std::asin(0.7)},
                                              {"ACOS(v)", std::acos(0.7)},
                                              {"ATAN(v)", std::atan(0.7)},
                                              {"ATAN2(v, w)", std::atan2(0.7, -0.3)},
                                              {"EXP(v)", std::exp(0.7)},
                                              {"LN(v)", std::log(0.7)},
                                              {"LOG(v)", std::log10(0.7)},
                                              {"EXPT(v, 3)", std::pow(0.7, 3)},
                                              {"v ** w", std::pow(0.7, -0.3)},
                                              {"MIN(v, w, 3)", -0.3},
                                              {"MAX(v, w, 0.1)", 0.7},
                                              {"LIMIT(0, v, 0.5)", 0.5},
                                              {"LIMIT(1, v, 2)", 1},
                                              {"LIMIT(0, v, 2)", 0.7},
                                              {"SEL(v > w, 1.5, 2.5)", 2.5},
                                              {"SEL(v < w, 1.5, 2.5)", 1.5},
                                              {"MUX(k, v, w, 3)", -0.3},
                                              {"ABS(i)", 4},
                                              {"ABS(s)", -128},
                                              {"MIN(i, 3)", -4},
                                              {"MAX(i, 3)", 3},
                                              {"SHL(b, 1)", 2},
                                              {"SHR(b, 1)", 0x40},
                                              {"ROL(b, 1)", 3},
                                              {"ROR(b, 1)", 0xC0},
                                              {"ROL(b, 9)", 3},
                                              {"SHL(b, 8)", 0},
                                              {"SHR(b, 0)", 0x81},
                                              {"SQRT(4)", 2}};
  for (const auto& [text, wanted] : results) EXPECT_DOUBLE_EQ(value_of("LREAL", text, v), wanted) << text;
}

TEST(StBlocks, EdgesAndFlipFlops) {
  Bench bench(
      "PROGRAM p VAR in, r, rise, fall, q, q2 : BOOL; a : R_TRIG; b : F_TRIG; c : SR; d : RS; END_VAR "
      "a(CLK := in, Q => rise); b(CLK := in, Q => fall); c(SET1 := in, RESET := r, Q1 => q); d(SET := in, "
      "RESET1 := r, Q1 => q2); END_PROGRAM");
  const auto expect = [&](int in, int r, int rise, int fall, int q, int q2) {
    bench.set("in", in);
    bench.set("r", r);
    bench.scan();
    bench.expect({{"rise", rise}, {"fall", fall}, {"q", q}, {"q2", q2}});
  };
  expect(0, 0, 0, 0, 0, 0);
  expect(1, 0, 1, 0, 1, 1);
  expect(1, 0, 0, 0, 1, 1);
  expect(0, 0, 0, 1, 1, 1);
  expect(0, 1, 0, 0, 0, 0);
  expect(1, 1, 1, 0, 1, 0);
}

TEST(StBlocks, TimersKeepTheirDiagramsToTheScan) {
  Bench bench(
      "PROGRAM p VAR in : BOOL; n : TON; f : TOF; t : TP; END_VAR "
      "n(IN := in, PT := T#10ms); f(IN := in, PT := T#10ms); t(IN := in, PT := T#10ms); END_PROGRAM");
  const auto run_for = [&](int in, int scans) {
    bench.set("in", in);
    bench.scan(scans);
  };
  run_for(0, 2);
  EXPECT_EQ(bench["f.Q"], 0);
  run_for(1, 5);  // 8 ms since the edge
  bench.expect({{"n.Q", 0}, {"n.ET", 0.008}, {"t.Q", 1}, {"f.Q", 1}});
  run_for(1, 1);
  bench.expect({{"n.Q", 1}, {"t.Q", 0}, {"t.ET", 0.01}});
  run_for(0, 5);
  bench.expect({{"n.Q", 0}, {"n.ET", 0}, {"t.ET", 0}, {"f.Q", 1}});
  run_for(0, 1);
  bench.expect({{"f.Q", 0}, {"f.ET", 0.01}});
  run_for(1, 1);
  run_for(0, 4);  // a pulse goes on without its input
  EXPECT_EQ(bench["t.Q"], 1);
  run_for(0, 1);
  EXPECT_EQ(bench["t.Q"], 0);
}

TEST(StBlocks, CountersCountEdges) {
  Bench bench(
      "PROGRAM p VAR up, down, reset, load : BOOL; a : CTU; b : CTD; c : CTUD; END_VAR a(CU := up, RESET := "
      "reset, PV := 2); "
      "b(CD := down, LOAD := load, PV := 2); c(CU := up, CD := down, RESET := reset, LOAD := load, PV := 2); "
      "END_PROGRAM");
  const auto pulse = [&](const char* name) {
    bench.set(name, 1);
    bench.scan(2);
    bench.set(name, 0);
    bench.scan();
  };
  pulse("up");
  EXPECT_EQ(bench["a.Q"], 0);
  pulse("up");
  bench.expect({{"a.CV", 2}, {"a.Q", 1}, {"c.QU", 1}});
  pulse("reset");
  bench.expect({{"a.CV", 0}, {"c.QD", 1}});
  pulse("load");
  bench.expect({{"b.CV", 2}, {"b.Q", 0}, {"c.CV", 2}});
  pulse("down");
  bench.expect({{"b.CV", 1}, {"c.CV", 1}});  // not at the falling edge
  pulse("down");
  bench.expect({{"b.Q", 1}, {"c.CV", 0}});
  pulse("down");
  EXPECT_EQ(bench["b.CV"], 0) << "not below 0";
}

TEST(StBlocks, EveryMotionBlockIsCalledAndItsPinsAreSeenByName) {
  for (const BlockType& type : block_types()) {
    std::string inputs;
    std::string outputs;
    for (const Pin& pin : type.pins) {
      const std::string name(pin.name);
      if (pin.direction == PinDirection::in_out || pin.type == "AXIS_REF")
        inputs += (inputs.empty() ? "" : ", ") + name + " := " + (pin.name == "Master" ? "Web" : "Knife");
      else if (pin.direction == PinDirection::output)
        outputs += "o_" + name + " := b." + name + "; ";
    }
    std::string vars;
    for (const Pin& pin : type.pins)
      if (pin.direction == PinDirection::output)
        vars += "o_" + std::string(pin.name) + " : " + std::string(pin.type) + "; ";
    Bench bench("PROGRAM p VAR_EXTERNAL Web, Knife : AXIS_REF; END_VAR VAR b : " + std::string(type.name) +
                "; " + vars + "END_VAR b(" + inputs + "); " + outputs + " END_PROGRAM");
    bench.scan(2);
    const auto fresh = type.make();
    for (std::size_t i = 0; i < type.pins.size(); ++i) {
      const Pin& pin = type.pins[i];
      if (pin.type == "AXIS_REF" || pin.type == "MC_CAM_REF") continue;
      EXPECT_GE(bench.find("b." + std::string(pin.name)), 0) << type.name << "." << pin.name;
      if (pin.direction != PinDirection::input) continue;
      bench.set("b." + std::string(pin.name), 1);
      EXPECT_EQ(bench["b." + std::string(pin.name)], 1);
    }
  }
}

TEST(StBlocks, PowerSwitchesTheAxisOnAndRefusalsAreSeen) {
  Bench bench(
      "PROGRAM p VAR_EXTERNAL knife : AXIS_REF; Web : AXIS_REF; END_VAR VAR on : BOOL; pow : MC_Power; sel : "
      "MC_CamTableSelect; "
      "ref : MC_CAM_REF := (File := 'none.tab'); id : UDINT; END_VAR pow(Axis := knife, Enable := TRUE, "
      "Status => on); "
      "sel(Master := Web, Slave := knife, CamTable := ref, Execute := TRUE, ErrorID => id); END_PROGRAM");
  bench.scan(5);
  bench.expect({{"on", 1}, {"sel.Error", 1}});
  EXPECT_NE(bench["id"], 0);
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
