#include <gmock/gmock.h>

#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The conditions of the commands (002 1.4.2; D16).
class EpicposCommands : public PositionerTest {
 protected:
  /// Gives a command that must not be taken; why not.
  std::string refusal(const char* name) {
    diagnostics();
    command(name);
    const auto said = diagnostics();
    EXPECT_EQ(said.size(), 1u) << name;
    return said.empty() ? "" : said.front();
  }
};

TEST_F(EpicposCommands, NoneButInitRunsBeforeInit) {
  covers({"EMRG refused", "LOOPON refused", "LOOPOFF refused", "CNTLOCK refused", "CNTUNLOCK refused",
          "CNTREV refused", "CNTDIR refused", "CALON refused"});
  for (const Command& entry : epicpos_type.commands) {
    const std::string name(entry.name);
    if (name == "INIT") continue;
    order(name);
    sample();
    const auto said = diagnostics();
    ASSERT_EQ(said.size(), 1u) << name;
    EXPECT_THAT(said.front(), testing::StartsWith(name + ": st_init is 0, must be 1"));
  }
  for (const State& state : epicpos_type.states)
    EXPECT_EQ(get(state.name), state.name == "st_still") << state.name;
}

TEST_F(EpicposCommands, InitOnce) {
  covers({"INIT refused"});
  command("INIT");
  EXPECT_EQ(refusal("INIT"), "INIT: st_init is 1, must be 0");
}

TEST_F(EpicposCommands, TheManualsStartUpIsNoRefusal) {
  // 002 1.6.2 gives these whatever the states are.
  for (const char* name : {"INIT", "CNTUNLOCK", "CNTDIR", "REGON", "RESUME", "LOOPON", "CALOFF"})
    command(name);
  for (const char* name :
       {"st_cntlock", "st_cntrev", "st_regoff", "st_emrg", "st_cal", "st_prsok", "st_prson"})
    EXPECT_EQ(get(name), 0) << name;
  EXPECT_EQ(get("st_loopon"), 1);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(EpicposCommands, MovementsNeedARegulatingAxis) {
  covers({"START refused", "MANFW refused", "MANBW refused", "PRESET refused"});
  start();
  command("REGOFF");
  for (const char* name : {"START", "MANFW", "MANBW", "PRESET"})
    EXPECT_EQ(refusal(name), std::string(name) + ": st_regoff is 1, must be 0");
  command("REGON");
  command("EMRG");
  for (const char* name : {"START", "MANFW", "MANBW", "PRESET"})
    EXPECT_EQ(refusal(name), std::string(name) + ": st_emrg is 1, must be 0");
  command("RESUME");
  command("CALON");
  for (const char* name : {"START", "MANFW", "MANBW", "PRESET"})
    EXPECT_EQ(refusal(name), std::string(name) + ": st_cal is 1, must be 0");
  command("CALOFF");
  EXPECT_EQ(get("st_still"), 1);
}

TEST_F(EpicposCommands, MovementsNeedAStillAxis) {
  covers({"REGOFF refused", "DELCNT refused"});
  start();
  command("MANFW");
  ticks(10);
  for (const char* name : {"START", "MANFW", "MANBW", "REGOFF", "DELCNT"})
    EXPECT_EQ(refusal(name), std::string(name) + ": st_still is 0, must be 1");
  EXPECT_EQ(refusal("PRESET"), "PRESET: needs st_still = 1 or st_prson = 1");
  command("STOP");
  EXPECT_TRUE(wait("st_still", 1));
  command("PRESET");
  EXPECT_EQ(refusal("MANFW"), "MANFW: st_still is 0, must be 1; st_prson is 1, must be 0");
}

TEST_F(EpicposCommands, StopNeedsAMovement) {
  covers({"STOP refused"});
  start();
  EXPECT_EQ(refusal("STOP"), "STOP: st_still is 1, must be 0");
}

TEST_F(EpicposCommands, WhatHoldsAlreadyIsSilent) {
  covers({"RESUME refused", "REGON refused", "CALOFF refused"});
  start();
  for (const char* name : {"RESUME", "REGON", "CALOFF"}) {
    const int posit = get("posit");
    command(name);
    EXPECT_THAT(diagnostics(), IsEmpty()) << name;
    EXPECT_EQ(get("posit"), posit);
  }
  // Taken, RESUME and REGON would end the following error.
  blocked = true;
  write("pgain", 0);
  command("MANFW");
  ticks(50);
  ASSERT_GT(get("follerr"), 100);
  command("RESUME");
  command("REGON");
  command("CALOFF");
  EXPECT_GT(get("follerr"), 100);
}

TEST_F(EpicposCommands, EmergencyStopsWithoutRamp) {
  covers({"EMRG accepted", "RESUME accepted", "st_emrg"});
  start();
  write("setpos", 4000);
  command("START");
  ticks(100);
  ASSERT_GT(word(), 3000);
  command("EMRG");
  EXPECT_EQ(get("st_emrg"), 1);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(word(), 0);
  EXPECT_EQ(get("st_loopon"), 1);
  const int stopped_at = get("posit");
  count() += 300;  // moved by hand: no reaction
  ticks(3);
  EXPECT_EQ(word(), 0);
  command("RESUME");
  EXPECT_EQ(get("st_emrg"), 0);
  tick();
  EXPECT_EQ(word(), 0);  // it reacts where it stands
  EXPECT_EQ(get("posit"), stopped_at + 300);
  count() += 10;
  sample();
  EXPECT_LT(word(), 0);
  ASSERT_TRUE(place(4000));  // START takes the placement up again
  EXPECT_NEAR(get("posit"), 4000, 1);
}

TEST_F(EpicposCommands, EmergencyEndsASearchAndCalibrationAMovement) {
  start();
  command("PRESET");
  ticks(20);
  command("EMRG");
  EXPECT_EQ(get("st_prson"), 0);
  command("RESUME");
  command("MANFW");
  ticks(50);
  command("CALON");
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(word(), 0);
}

TEST_F(EpicposCommands, PowerLossForgetsWhatIsNotRetentive) {
  start();
  command("MANFW");
  ticks(100);
  const int posit = get("posit");
  device->power_up();
  EXPECT_EQ(word(), 0);
  EXPECT_EQ(get("st_init"), 0);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("st_loopon"), 0);
  EXPECT_EQ(get("posit"), posit);
  EXPECT_EQ(get("setvel"), 5000);
  start();
  ticks(100);
  EXPECT_EQ(get("posit"), posit);
  EXPECT_EQ(get("st_still"), 1);
}

TEST_F(EpicposCommands, SaysWhatUnsetParametersActAs) {
  set({{"cntratio", 0}, {"maxvel", 0}});
  diagnostics();
  command("INIT");
  EXPECT_THAT(diagnostics(), ElementsAre("cntratio: 0 acts as 1"));
  for (const char* name : {"START", "MANFW", "PRESET"}) {
    command(name);
    EXPECT_THAT(
        diagnostics(),
        testing::Contains("maxvel: 0 is no speed: ramps take no time, and the output is offset alone"))
        << name;
    command("EMRG");
    command("RESUME");
  }
}

}  // namespace
}  // namespace drycut::devices::epicpos
