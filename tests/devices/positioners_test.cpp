// What CAMMING4 (000 1.1, 1.9), EPICPOS (002) and EANPOS do alike as positioners, on the same ideal axis.
#include "devices/camming4/camming4.hpp"
#include "devices/epicpos/epicpos.hpp"
#include "tests/devices/ideal_axis.hpp"
#include "tests/devices/search_bench.hpp"

namespace drycut::devices {
namespace {

struct Kind {
  const char* name;
  DeviceBench::Make make;
  const char* terminals;
  const char* ramps;   ///< of 1 s to maxvel, with 1 Um = 1 bit
  const char* coarse;  ///< 1 Um = 4 bits
  const char* delta;   ///< what DELCNT adds
};

constexpr const char* epicpos_ramps = "cntratio=400000 taccdec=100 forget";
constexpr Kind kinds[] = {
    {"CAMMING4", camming4::make_camming4,
     "2 2.CNT01 2.CNT02 2.CNT03 1 2.INP01 2 2.INP02 2.INP03 5 2.AN01 2.OUT01",
     "measure=1 pulse=1 measurem=1 pulsem=1 tacc=100 tdec=100 syncrange=50 forget", "pulse=4", "delta1"},
    {"EPICPOS", epicpos::make_epicpos, "2 2.CNT01 1 2.INP01 2.AN01", epicpos_ramps, "cntratio=100000",
     "delta"},
    {"EANPOS", eanpos::make_eanpos, "2 2.CNT01 1 2.INP01 2.AN01", epicpos_ramps, "cntratio=100000", "delta"},
};

class PositionerOfAnyKind : public IdealAxisBench, public testing::WithParamInterface<Kind> {
 public:
  PositionerOfAnyKind() : IdealAxisBench(GetParam().make, GetParam().terminals, "2.CNT01") {
    does(GetParam().ramps);
  }
};

using Positioner = PositionerOfAnyKind;
/// The enable is active from 2000 Um on, a zero pulse comes each 512 bits.
class PositionerSearch : public SearchBench<PositionerOfAnyKind, 512, 1> {
 public:
  PositionerSearch() : SearchBench(2000, 1000000) { write("pgain", 500); }
};

const auto name_of_kind = [](const auto& kind) { return std::string(kind.param.name); };
INSTANTIATE_TEST_SUITE_P(Each, PositionerOfAnyKind, testing::ValuesIn(kinds), name_of_kind);
INSTANTIATE_TEST_SUITE_P(Each, PositionerSearch, testing::ValuesIn(kinds), name_of_kind);

TEST_P(PositionerOfAnyKind, NoneButInitRunsBeforeInit) {
  none_runs_before_init();
  for (const State& state : device->type().states)
    EXPECT_EQ(get(state.name), state.name == "st_still") << state.name;
  after("LOOPON! count=500 sample", "!loopon posit=0 !init");
  after("INIT", "init");
  after("count=600 sample", "posit=100");
  command("INIT");
  EXPECT_THAT(diagnostics(),
              testing::IsSupersetOf({"LOOPON: st_init is 0, must be 1", "INIT: st_init is 1, must be 0"}));
  coverage::show("INIT refused");
}

TEST_P(PositionerOfAnyKind, PlacesTheAxisExactly) {
  about("setpos");
  after("INIT LOOPON", "still");
  for (const int target : {1000, -2000, -1999, 0}) {
    write("setpos", target);
    after("START", "!still !toll");
    does("until:still +300");
    EXPECT_NEAR(get("posit"), target, 1);
    shows("toll silent");
  }
}

TEST_P(PositionerOfAnyKind, APlacementTakesItsClosedFormTime) {
  about("taccdec tacc tdec setvel maxvel");
  // 5000 Um/s, 50000 Um/s2: 0.1 s each ramp, 500 Um in ramps, 500 Um at speed.
  does("INIT LOOPON setpos=1000");
  EXPECT_EQ(duration("START"), 150);
  // A tenth of the speed: 0.01 s ramps and 5 Um, 990 Um at 500 Um/s.
  does("setpos=0 setvel=500");
  EXPECT_EQ(duration("START"), 5 + 995 + 5);
}

TEST_P(PositionerOfAnyKind, HoldsTheSoftwareLimits) {
  about("minpos maxpos");
  does("minpos=-300 maxpos=500 INIT LOOPON setpos=900 sample forget");
  says("START", {"START: setpos 900 is outside minpos..maxpos, the axis goes to 500"});
  after("until:still +300", "posit=500~1");
  after("posit=500 MANFW", "still");
  says({"MANFW: posit 500 is already at maxpos 500"});
  after("MANBW until:still +300", "posit=-300~1 movdir");
  after("posit=-300 sample MANBW", "still");
  says({"MANBW: posit -300 is already at minpos -300"});
}

TEST_P(PositionerOfAnyKind, AManualMovementNeverEndsWhenItsCountIsSetBack) {
  does("maxpos=2000 INIT LOOPON MANFW +60");
  for (int i = 0; i < 20; ++i) after("+50 posit=0 +1", "!still ffwdreg=3277");
  after("until:still +300", "posit=2000~1 count>10000");
}

TEST_P(PositionerOfAnyKind, AnOpenLoopMovesOnFeedForwardFromWhereTheAxisStands) {
  does("INIT count+=700 +2 setpos=1000");  // moved by hand
  after("START until:still", "propreg=0 DAC=0 posit=1000~2");
  after("MANFW +100 STOP until:still LOOPON", "loopon follerr=0");
  after("count+=-40 sample", "DAC>0");
  after("LOOPOFF", "!loopon DAC=0");
}

TEST_P(PositionerOfAnyKind, EmergencyStopsWithoutRampAndResumeReactsOnTheSpot) {
  after("INIT LOOPON MANFW +60", "DAC>3000");
  after("EMRG", "DAC=0 emrg still loopon");
  const int stopped_at = get("posit");
  after("count+=777 +3", "DAC=0");  // moved by hand: no reaction
  after("RESUME", "!emrg follerr=0 DAC=0");
  EXPECT_EQ(get("posit"), stopped_at + 777);
  after("count+=10 sample", "propreg=-655");  // pgain 200: 0.2 * 10/100 of 32767
  ASSERT_TRUE(place(4000));                   // and a START places it again
  shows("posit=4000~1");
}

TEST_P(PositionerOfAnyKind, AnAxisOnItsQuotaStaysInToleranceUntilAnotherMovement) {
  does("INIT LOOPON");
  ASSERT_TRUE(place(1000));
  after("EMRG", "emrg toll");
  after("count+=50 sample", "!toll");  // by hand, there
  after("count+=-50 sample", "toll");  // and back
  after("RESUME CALON", "cal toll");
  after("CALOFF", "toll");
  after("MANBW", "!toll");
  after("+60 STOP until:still MANFW", "!toll");
}

TEST_P(PositionerOfAnyKind, AnEmergencyOnTheWayIsNotInTolerance) {
  after("INIT LOOPON setpos=1000 START +20 EMRG", "!toll");
  after("count=1000 +2", "posit=1000 !toll");
}

TEST_P(PositionerOfAnyKind, CalibrationIsAVoltageSource) {
  says("INIT LOOPON vout=50 sample", {"vout: st_cal is 0, must be 1"});
  after("CALON", "cal DAC=0");
  after("vout=5 sample", "DAC=1638");
  after("vout=-100 sample", "DAC=-32767");
  after("vout=100 sample", "DAC=32767 silent");
  after("+50", "posit>4000");
  after("offset=7 vout=-25 sample", "DAC=-8185 vout=-25");
  after("count+=-4000 sample CALOFF", "!cal follerr=0 DAC=7");
  const int there = get("posit");
  does("offset=0 +20");
  EXPECT_NEAR(get("posit"), there, 1);
  about("offset");
}

TEST_P(PositionerOfAnyKind, RegulationOffLeavesTheOutputAsItStands) {
  after("INIT LOOPON blocked=1 count=-20 sample", "DAC=1311");  // 0.2 * 20/100 of 32767
  after("REGOFF count=300 +5", "regoff DAC=1311 posit=300");    // it counts on
  cards.analogue_outputs.begin()->second.word = 123;
  after("sample", "DAC=123");       // the DAC is free for another device
  after("REGON", "!regoff DAC=0");  // it reacts where it stands
}

// 002 1.3.1: with regulation off an axis has no access to the DAC, which may be another one's.
TEST_P(PositionerOfAnyKind, AnEmergencyWithRegulationOffLeavesTheOutputAsItStands) {
  does("INIT LOOPON REGOFF");
  cards.analogue_outputs.begin()->second.word = 123;
  after("EMRG +5", "emrg regoff DAC=123");
  after("RESUME +2", "!emrg DAC=123");
  after("REGON", "!regoff DAC=0");
}

TEST_P(PositionerOfAnyKind, AnEmergencyAndRegulationOffInOneSampleLeaveZeroVolts) {
  after("INIT LOOPON MANFW +60", "DAC>3000");
  after("EMRG! REGOFF! sample", "emrg regoff still DAC=0");
}

TEST_P(PositionerOfAnyKind, FollowingErrorIsHeldForHalfASecond) {
  about("maxfollerr");
  after("maxfollerr=40 INIT LOOPON blocked=1 count=-40 sample", "!foller");
  after("count=-41 sample", "foller still !emrg DAC!=0");  // nothing stops by itself
  EXPECT_THAT(diagnostics(),
              testing::ElementsAre("st_foller: the following error of 41 bits x4 is above maxfollerr, 40"));
  does("count=0");
  for (int ms = period; ms < 500; ms += period) after("sample", "foller");
  after("sample", "!foller");
}

TEST_P(PositionerOfAnyKind, AFollowingErrorIsReportedByTheBitsThatItShows) {
  about("maxfollerr");
  does("setvel=50 maxfollerr=10 pgain=0 feedfw=0 blocked=1 INIT LOOPON MANFW");
  while (get("st_foller") == 0 && samples < 1000) tick();  // 0.1 bit more in each
  shows("foller follerr=11");
}

TEST_P(PositionerOfAnyKind, LocksAndReversesItsCount) {
  after("INIT count+=100 CNTLOCK", "cntlock posit=100");
  after("count+=200 sample", "posit=100");
  after("CNTUNLOCK", "!cntlock");
  after("count+=10 CNTREV", "cntrev posit=110");
  after("count+=20 sample", "posit=90");
  after("CNTDIR", "!cntrev");
  after("count+=5 sample", "posit=95");
}

TEST_P(PositionerOfAnyKind, DelcntKeepsTheRemainderAndAWriteOfPositDropsIt) {
  about(GetParam().delta);
  does(GetParam().coarse);
  after("INIT count=9 sample", "posit=2");  // 2.25 Um
  write(GetParam().delta, 2);
  after("DELCNT", "posit=4");
  after("count=12 sample", "posit=5");  // 5.00: the quarter was kept
  does("count=13 sample posit=7 sample");
  after("count=16 sample", "posit=7");  // 7.75: the quarter is gone
  after("count=17 sample", "posit=8");
}

TEST_P(PositionerOfAnyKind, TwoDelcntsInOneSampleAreOne) {
  does("INIT posit=1000");
  write(GetParam().delta, -100);
  does("DELCNT! DELCNT!");
  EXPECT_FALSE(device->settled());
  after("sample", "posit=900");
  after("DELCNT", "posit=800");  // after a read statement has waited for the first
  write(GetParam().delta, 3);
  command("DELCNT");
  write(GetParam().delta, 40);
  after("DELCNT", "posit=843");
}

TEST_P(PositionerOfAnyKind, PowerLossKeepsPositionsAndParameters) {
  does("INIT LOOPON MANFW +100");
  const int posit = get("posit");
  after("power", "DAC=0 !init still !loopon setvel=5000 maxvel=50000");
  EXPECT_EQ(get("posit"), posit);
  after("INIT LOOPON +100", "still");
  EXPECT_EQ(get("posit"), posit);
}

TEST_P(PositionerSearch, ModeZeroLoadsAtTheEnablesRelease) {
  about("prspos prsvel sprsvel prsmode");
  after("prspos=700 INIT LOOPON PRESET", "prson !still");
  after("+60", "speed=5000~1 setvel=5000");
  double slowest = 0;
  for (; get("st_prson") == 1 && samples < 20000; tick()) slowest = std::min(slowest, speed());
  EXPECT_NEAR(slowest, -1000, 1);
  shows("prsok !prson still setvel=1000 setpos=700");
  // The quota 700 lies where the slow leg left the enable, within the way of one sample (2 Um).
  after("+200", "posit=700~1 count=1999~3 silent");
}

TEST_P(PositionerSearch, ModeZeroBackwardCrossesAShortEnable) {
  about("prsdir");
  from = -1010;
  to = -1000;
  // The limits do not count meanwhile.
  after("prspos=-50 prsdir=1 minpos=-100 maxpos=100 INIT LOOPON PRESET +60", "movdir");
  // It ran over the enable, came back forward and left it at its upper end.
  after("until:!prson +200", "posit=-50~1 count=-1000~3");
}

TEST_P(PositionerSearch, ModeOneLoadsAtTheFirstZeroPulseAfterTheRelease) {
  after("prspos=0 prsmode=1 INIT LOOPON PRESET until:!prson +200", "prsok posit=0~1");
  // Below 2000 the first pulse is at 1536, and its exact count is the quota.
  EXPECT_EQ(get("posit"), count() - 1536);
}

TEST_P(PositionerSearch, InsideTheEnableTheSlowLegIsFirst) {
  from = -400;
  after("prspos=10 INIT LOOPON +2 PRESET +60", "setvel=1000 speed=-1000~1");
  after("until:!prson", "count=-401~4");
}

TEST_P(PositionerSearch, PresetAgainTurnsTheSearch) {
  from = 1000000;
  after("INIT LOOPON PRESET +100", "speed>0");
  after("PRESET +150", "speed=-5000~1 prson");
  after("STOP", "!prson !prsok");
  does("until:still");
}

TEST_P(PositionerSearch, ModeTwoLoadsWithoutASearchAndTellsAQuotaOutOfReach) {
  by_hand = true;
  after("prspos=99 prsmode=2 2.INP01=1 INIT LOOPON +5", "!prsok");  // active at power-up: released first
  after("PRESET", "!prson");
  after("2.INP01=0 +2", "posit=0");
  after("2.INP01=1 +1", "prsok posit=99 still silent");
  does("2.INP01=0 prspos=20000 setpos=3000 START +100 forget");
  says("2.INP01=1 +1", {"IAZero: the running movement cannot reach its quota any more and stops"});
  after("+5 2.INP01=0 until:still", "prsok !toll silent");
}

}  // namespace
}  // namespace drycut::devices
