#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/machine.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct CommandRule {
  const char* name;
  const char* conditions;
  const char* silent_if = "";  ///< the effect already holds: a no-op, not a refusal [D16]
};

// 000 1.9.5 with the slips of its print corrected as spec qem.md 8.2 says; in order of priority.
constexpr CommandRule command_rules[] = {
    {"INIT", "!init"},
    {"EMRG", "init"},
    {"RESUME", "init emrg", "init !emrg"},
    {"STOP", "init !regoff !emrg !cal !still !camex"},
    {"START", "init !regoff !emrg !cal still !camex !prson"},
    {"PRESET", "init !regoff !emrg !cal !camex"},  // and still or prson
    {"RSPRSOK", "init !prson"},
    {"PRESETM", "init !camex !prsonm"},
    {"RSPRSM", "init"},
    {"RSERR", "init"},
    {"RSWRN", "init"},
    {"LOOPON", "init !loopon", "init loopon"},
    {"LOOPOFF", "init loopon", "init !loopon"},
    {"MANFW", "init !regoff !prson !camex !cal still !emrg"},
    {"MANBW", "init !regoff !prson !camex !cal still !emrg"},
    {"CALON", "init", "init cal"},
    {"CALOFF", "init cal", "init !cal"},
    {"CNTLOCK", "init"},
    {"CNTUNLOCK", "init"},
    {"CNTREV", "init"},
    {"CNTDIR", "init"},
    {"CNTLOCKM", "init"},
    {"CNTUNLOCKM", "init"},
    {"CNTREVM", "init"},
    {"CNTDIRM", "init"},
    {"STOPCAM", "init camex"},
    {"STARTCAM", "init still !camex !prson !emrg !regoff !error !cal"},
    {"REGOFF", "init still !camex !prson", "init regoff"},
    {"REGON", "init still regoff !emrg", "init !regoff"},
    {"ENBL", "init"},
    {"INTENBL", "init"},
    {"DSBL", "init"},
    {"INTDSBL", "init"},
    {"RSCAPT", "init capt", "init !capt"},
    {"RSINTCAPT", "init intcapt", "init !intcapt"},
    {"DELCNT", "init still !camex !prson !cal !regoff"},
    {"DELCNTM", "init !prsonm !camex"},
};

TEST(Camming4Conditions, ACommandRunsOnlyIfAllItsConditionsHold) {
  ASSERT_EQ(std::size(command_rules), camming4_type.commands.size());
  for (const CommandRule& rule : command_rules) {
    bool refused = false;
    bool accepted = false;
    for (const Situation& situation : situations) {
      SCOPED_TRACE(std::string(rule.name) + " when " + situation.name);
      Machine machine;
      Machine control;
      for (Machine* each : {&machine, &control}) {
        each->does(situation.script);
        each->set({{"inpcapt", 2}, {"intcapt", 2}, {"delta1", 30}, {"delta2", 40}});
        each->tick();
        each->command("RSWRN");
        each->diagnostics();
      }
      const bool silent = *rule.silent_if != 0 && machine.holds(rule.silent_if);
      bool runs = !silent && machine.holds(rule.conditions);
      if (std::string(rule.name) == "PRESET")
        runs = runs && (machine.holds("still") || machine.holds("prson"));
      machine.command(rule.name);
      control.device->sample();
      const auto said = machine.diagnostics();
      if (runs) {
        accepted = true;
        EXPECT_THAT(said, Not(Contains(HasSubstr("must be"))));
        EXPECT_EQ(machine.get("st_warning"), 0);
        continue;
      }
      EXPECT_EQ(machine.everything(), control.everything());
      EXPECT_EQ(machine.get("st_warning"), !silent && machine.holds("init") ? 1 : 0);
      if (silent) {
        EXPECT_THAT(said, testing::IsEmpty());
        continue;
      }
      refused = true;
      EXPECT_THAT(said, Contains(AllOf(StartsWith(std::string(rule.name) + ": "),
                                       AnyOf(HasSubstr("must be"), HasSubstr("needs st_still")))));
      if (machine.holds("init")) {
        EXPECT_EQ(machine.get("wrncode"), 11);
      }
    }
    EXPECT_TRUE(refused) << rule.name;
    EXPECT_TRUE(accepted || *rule.silent_if != 0) << rule.name;
    covers({std::string(rule.name) + " refused", "warning 11"});
  }
}

}  // namespace
}  // namespace drycut::devices::camming4
