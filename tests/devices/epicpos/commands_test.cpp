#include <gmock/gmock.h>

#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::IsEmpty;

// The conditions of the commands (002 1.4.2; D16).
using EpicposCommands = PositionerTest;

TEST_F(EpicposCommands, TheManualsStartUpIsNoRefusal) {
  // 002 1.6.2 gives these whatever the states are.
  after("INIT CNTUNLOCK CNTDIR REGON RESUME LOOPON CALOFF",
        "!cntlock !cntrev !regoff !emrg !cal !prsok !prson loopon silent");
}

TEST_F(EpicposCommands, MovementsNeedARegulatingAxis) {
  does("INIT LOOPON REGOFF");
  refuses("START MANFW MANBW PRESET", "st_regoff is 1, must be 0");
  does("REGON EMRG");
  refuses("START MANFW MANBW PRESET", "st_emrg is 1, must be 0");
  does("RESUME CALON");
  refuses("START MANFW MANBW PRESET", "st_cal is 1, must be 0");
  after("CALOFF", "still");
}

TEST_F(EpicposCommands, MovementsNeedAStillAxis) {
  does("INIT LOOPON MANFW +10");
  refuses("START MANFW MANBW REGOFF DELCNT", "st_still is 0, must be 1");
  refuses("PRESET", "needs st_still = 1 or st_prson = 1");
  does("STOP until:still PRESET");
  refuses("MANFW", "st_still is 0, must be 1; st_prson is 1, must be 0");
}

TEST_F(EpicposCommands, StopNeedsAMovement) {
  does("INIT LOOPON");
  refuses("STOP", "st_still is 1, must be 0");
}

TEST_F(EpicposCommands, WhatHoldsAlreadyIsSilent) {
  does("INIT LOOPON");
  for (const char* name : {"RESUME", "REGON", "CALOFF"}) after(name, "silent posit=0");
  // Taken, RESUME and REGON would end the following error.
  after("blocked=1 pgain=0 MANFW +50", "follerr>100");
  after("RESUME REGON CALOFF", "follerr>100");
}

TEST_F(EpicposCommands, EmergencyEndsASearchAndCalibrationAMovement) {
  after("INIT LOOPON PRESET +20 EMRG", "!prson");
  after("RESUME MANFW +50 CALON", "still DAC=0");
}

TEST_F(EpicposCommands, SaysWhatUnsetParametersActAs) {
  says("cntratio=0 maxvel=0 forget INIT", {"cntratio: 0 acts as 1"});
  for (const char* name : {"START", "MANFW", "PRESET"}) {
    command(name);
    EXPECT_THAT(
        diagnostics(),
        testing::Contains("maxvel: 0 is no speed: ramps take no time, and the output is offset alone"))
        << name;
    does("EMRG RESUME");
  }
}

}  // namespace
}  // namespace drycut::devices::epicpos
