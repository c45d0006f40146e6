#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/machine.hpp"
#include "tests/devices/variable_rule.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* at_rest = "still !camex !prson";
constexpr const char* count = "init !camex";

/// 000 1.9.2-1.9.4 and spec qem.md 8.1.
constexpr VariableRule variable_rules[] = {
    {"decpt", 'B', "RW", 'R', 0, 3, at_rest},
    {"measure", 'L', "RW", 'R', 1, 999999, at_rest},
    {"pulse", 'L', "RW", 'R', 1, 999999, at_rest},
    {"measurem", 'L', "RW", 'R', 1, 999999, at_rest},
    {"pulsem", 'L', "RW", 'R', 1, 999999, at_rest},
    {"unitvel", 'B', "RW", 'R', 0, 1, at_rest},
    {"maxvel", 'L', "RW", 'R', 0, 999999, at_rest},
    {"prsvel", 'L', "RW", 'R', 0, 999999, "!prson"},
    {"sprsvel", 'L', "RW", 'R', 0, 999999, "!prson"},
    {"taccmax", 'W', "RW", 'R', 0, 999, "!prson"},
    {"tdecmax", 'W', "RW", 'R', 0, 999, "!prson"},
    {"tacc", 'W', "RW", 'R', 0, 999},
    {"tdec", 'W', "RW", 'R', 0, 999},
    {"maxpos", 'L', "RW", 'R', -999999, 999999, "still"},
    {"minpos", 'L', "RW", 'R', -999999, 999999, "still"},
    {"prspos", 'L', "RW", 'R', -999999, 999999, "still"},
    {"prsposm", 'L', "RW", 'R', -999999, 999999, "!prsonm"},
    {"toll", 'L', "RW", 'R', 0, 999999, "still"},
    {"maxfollerr", 'L', "RW", 'R', 0, most},
    {"syncrange", 'L', "RW", 'R', 0, 9999999},
    {"prsmode", 'B', "RW", 'R', 0, 2, "!prson"},
    {"prsmodem", 'B', "RW", 'R', 0, 2, "!prsonm"},
    {"prsdir", 'B', "RW", 'R', 0, 1, "!prson"},
    {"mtype", 'B', "RW", 'R', 0, 1},
    {"ramptype", 'B', "RW", 'R', 0, 1, "still"},
    {"rtype", 'B', "RW", 'R', 0, 1},
    {"stopt", 'B', "RW", 'R', 0, 1},
    {"pgain", 'W', "RW", 'R', 0, 32767},
    {"feedfw", 'W', "RW", 'R', 0, 32767},
    {"integt", 'W', "RW", 'R', 0, 32767},
    {"derivt", 'W', "RW", 'R', 0, 32767},
    {"offset", 'W', "RW", 'R', -32767, 32767},
    {"tbfm", 'W', "RW", 'R', 0, 3},
    {"tbf", 'W', "RW", 'R', 0, 3},
    {"frqm", 'L', "RW", '0', least, most},
    {"positm", 'L', "RW", 'R', -999999, 999999, count},
    {"encoderm", 'L', "RW", 'R', least, most, count},
    {"vout", 'B', "RW", '0', -100, 100, "init cal"},
    {"follerr", 'L', "R", '0', least, most},
    {"vel", 'L', "R", '0', least, most},
    {"frq", 'L', "R", '0', least, most},
    {"posit", 'L', "RW", 'R', -999999, 999999, count},
    {"encoder", 'L', "RW", 'R', least, most, count},
    {"delta1", 'L', "RW", 'R', least, most},
    {"delta2", 'L', "RW", 'R', least, most},
    {"setvel", 'L', "RW", 'R', 0, 999999},
    {"setpos", 'L', "RW", 'R', -999999, 999999},
    {"rowex", 'W', "R", '0', 0, 128},
    {"ffwdreg", 'L', "R", '0', least, most},
    {"propreg", 'L', "R", '0', least, most},
    {"intreg", 'L', "R", '0', least, most},
    {"derreg", 'L', "R", '0', least, most},
    {"codeMex", 'L', "R", '0', least, most},
    {"funInp", 'B', "RW", 'R', 0, 99},
    {"funInt", 'B', "RW", 'R', 0, 99},
    {"funOut", 'B', "RW", 'R', 0, 99},
    {"inpcapt", 'B', "RW", '0', 0, 2},
    {"intcapt", 'B', "RW", '0', 0, 2},
    {"errcode", 'B', "R", '0', 0, 100},
    {"errvalue", 'B', "R", '0', 0, 128},
    {"wrncode", 'B', "R", '0', 0, 100},
    {"wrnvalue", 'B', "R", '0', 0, 128},
    {"codeG", 'W', "RW", 'R', -128, 254},
    {"codeQm", 'L', "RW", 'R', -159154, 999999},
    {"codeQs", 'L', "RW", 'R', -999999, 999999},
    {"codeQma", 'L', "RW", 'R', 0, 999999},
    {"codeQsa", 'L', "RW", 'R', -999999, 999999},
    {"codeM", 'L', "RW", 'R', least, most},
};

TEST(Camming4Conditions, VariablesAreThoseOfTheManual) {
  expect_variables(camming4_type, variable_rules);
  for (const DeviceVariable& variable : camming4_type.variables)
    EXPECT_EQ(variable.rows, variable.name.starts_with("code") && variable.name != "codeMex" ? 128 : 1)
        << variable.name;
}

/// Their values live on by themselves; what a write does to them has tests of its own.
bool is_live(const std::string& name) {
  for (const char* live : {"posit", "positm", "encoder", "encoderm", "vout", "setvel", "setpos"})
    if (name == live) return true;
  return false;
}

TEST(Camming4Conditions, AWriteIsTakenOnlyIfItsConditionsHold) {
  for (const VariableRule& rule : variable_rules) {
    for (const Situation& situation : situations) {
      SCOPED_TRACE(std::string(rule.name) + " when " + situation.name);
      Machine machine;
      Machine control;
      for (Machine* each : {&machine, &control}) {
        each->does(situation.script);
        each->diagnostics();
      }
      // Row 3 of the cam table neither runs nor follows the running one.
      const std::string name =
          rule.name +
          std::string(std::string(rule.name).starts_with("code") && std::string(rule.name) != "codeMex" ? "3"
                                                                                                        : "");
      const bool writable = rule.access == "RW" && machine.holds(rule.conditions);
      const std::int32_t value = machine.get(name) == 1 ? 2 : 1;
      machine.write(name, value);
      machine.device->sample();
      control.device->sample();
      if (writable) {
        EXPECT_THAT(machine.diagnostics(), Not(Contains(HasSubstr("must be"))));
        if (!is_live(rule.name)) {
          EXPECT_EQ(machine.get(name), value);
        }
      } else {
        EXPECT_EQ(machine.everything(), control.everything());
        EXPECT_THAT(
            machine.diagnostics(),
            Contains(AllOf(StartsWith(name + ": "), AnyOf(HasSubstr("must be"), HasSubstr("read only")))));
      }
    }
  }
}

TEST(Camming4Conditions, PowerLossAndInitKeepWhatIsRetentive) {
  Machine machine;
  // A cam that warns and errs leaves as much behind as there can be.
  machine.row(1, {154, 1000, 1000, 0, 0, 77});
  machine.row(2, {137, 1});
  machine.set({{"pgain", 300}, {"integt", 20}, {"derivt", 20}, {"tbf", 2}, {"tbfm", 2}, {"maxfollerr", 1}});
  machine.start();
  machine.set({{"inpcapt", 1}, {"intcapt", 2}});
  for (const char* name : {"ENBL", "INTENBL", "CNTLOCK", "CNTREV", "CNTREVM", "PRESETM", "STOP", "STARTCAM"})
    machine.command(name);
  machine.ticks(40, -10);      // reversed: the master runs forward
  machine.write("codeM1", 3);  // error 5
  machine.order("CNTLOCKM");
  auto before = machine.everything();
  machine.device->sample();
  EXPECT_EQ(machine.get("errcode"), 5);
  EXPECT_NE(before["rowex"], 0);
  EXPECT_NE(before["intreg"], 0);
  before = machine.everything();
  machine.device->power_up();
  auto after = machine.everything();
  for (const VariableRule& rule : variable_rules) {
    const std::string name = after.contains(rule.name) ? rule.name : std::string(rule.name) + "1";
    if (name == "wrncode1" || name == "wrnvalue1") continue;  // not in everything()
    EXPECT_EQ(after[name], rule.retention == 'R' ? before[name] : 0) << name;
  }
  for (const State& state : camming4_type.states) {
    const std::string name(state.name);
    if (name == "st_warning") continue;
    const bool kept =
        name == "st_cntlock" || name == "st_cntrev" || name == "st_cntlockm" || name == "st_cntrevm";
    EXPECT_EQ(after[name], kept || name == "st_still" ? 1 : 0) << name;
  }
  for (const char* name : {"st_warning", "wrncode", "wrnvalue"}) EXPECT_EQ(machine.get(name), 0) << name;
  machine.command("INIT");
  for (const VariableRule& rule : variable_rules)
    if (rule.retention == 'R' && after.contains(rule.name)) {
      EXPECT_EQ(machine.get(rule.name), before[rule.name]) << rule.name;
    }
  covers({"st_cntlock", "st_cntrev", "st_cntlockm", "st_cntrevm", "st_init"});
}

}  // namespace
}  // namespace drycut::devices::camming4
