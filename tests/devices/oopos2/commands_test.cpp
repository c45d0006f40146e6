#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

// Commands and their conditions, manual movements, counting (001 1.6.2).
class Oopos2Commands : public Oopos2Test {};

TEST_F(Oopos2Commands, NoneButInitRunsBeforeInit) {
  none_runs_before_init();
  after("INIT", "silent");
  for (const State& state : oopos2_type.states)
    EXPECT_EQ(get(state.name),
              state.name == "st_still" || state.name == "st_init" || state.name == "st_brake")
        << state.name;
}

TEST_F(Oopos2Commands, BeforeInitNothingIsPutOutOrCounted) {
  after("count+=50 +3", "on= posit=0");
  after("INIT", "on=F posit=0");
  after("count+=5 +1", "posit=5");
}

TEST_F(Oopos2Commands, InitOnce) {
  does("INIT");
  refuses("INIT", "st_init is 1, must be 0");
}

TEST_F(Oopos2Commands, TheManualsStartUpIsNoRefusal) {
  after("INIT CNTUNLOCK CNTDIR REGON STOP", "silent still on=F");
}

TEST_F(Oopos2Commands, ManualMovementsSwitchTheirOutputs) {
  covers({"MANFFW accepted", "MANFBW accepted", "MANSFW accepted", "MANSBW accepted"});
  does("tbrake=2 toldly=3 INIT");
  const std::pair<const char*, const char*> cases[] = {
      {"MANFFW", "2 AM"}, {"MANSFW", "2 AMR"}, {"MANFBW", "2 IDM"}, {"MANSBW", "2 IDMR"}};
  for (const auto& [name, expected] : cases) {
    order(name);
    EXPECT_EQ(record(10).back(), expected);
    shows("!still");
    does("STOP! +1");
    EXPECT_EQ(output(4), false);
    ASSERT_TRUE(wait("st_still", 1, 3)) << name;
  }
}

TEST_F(Oopos2Commands, AManualMovementReplacesTheOneThatRuns) {
  switches("tinvt=4 setpos=5000 INIT START! +5 MANSFW!", 3, {"0 AMR"});  // slow: without a break
  switches("MANFFW!", 3, {"0 AM"});
  switches("MANFBW!", 9, {"0 ", "4 IDM"});
  shows("!still");
  after("+600", "posit=-10000~20");  // to the limit, past every quota
}

TEST_F(Oopos2Commands, ManualMovementsEndAtTheLimits) {
  does("maxpos=1000 minpos=-1000 toldly=3 INIT");
  for (const auto& [name, limit] : {std::pair{"MANFFW", 1000}, {"MANFBW", -1000}, {"MANSFW", 1000}}) {
    command(name);
    ASSERT_TRUE(wait("st_still", 1)) << name;
    EXPECT_EQ(get("posit"), limit);
    shows("!toll");
  }
}

TEST_F(Oopos2Commands, AtTheLimitTheyAreRefused) {
  does("INIT posit=10000 +1");
  refuses("MANFFW", "needs posit < maxpos");
  refuses("MANSFW", "needs posit < maxpos");
  does("posit=-10000 +1");
  refuses("MANFBW", "needs posit > minpos");
  refuses("MANSBW", "needs posit > minpos");
  shows("still");
  after("MANFFW", "!still");
}

TEST_F(Oopos2Commands, TheLimitIsThatOfTheCountOfTheSameSample) {
  does("INIT count=10000");
  refuses("MANFFW", "needs posit < maxpos");
}

TEST_F(Oopos2Commands, AManualMovementIsNoPlacementAnyMore) {
  does("setpos=1000 maxpos=1000 inertmode=2 toldly=3 slowpos=300");
  coast = 7;
  after("INIT START until:movslow MANFFW until:still", "posit=1000 !toll iner01=0");
}

TEST_F(Oopos2Commands, StartNeedsAStillAxis) {
  does("INIT MANFFW");
  refuses("START", "st_still is 0, must be 1");
  refuses("DELCNT", "st_still is 0, must be 1");
}

TEST_F(Oopos2Commands, RegulationOffRefusesMovements) {
  after("INIT REGOFF", "regoff");
  refuses("START STOP PRESET MANSFW MANSBW MANFFW MANFBW", "st_regoff is 1, must be 0");
  after("count+=30 +1", "posit=30");  // it counts on
  after("REGON", "!regoff");
  after("MANFFW", "on=AM");
}

TEST_F(Oopos2Commands, CountLockReversalAndTheirEnds) {
  after("INIT count+=10 CNTLOCK", "posit=10 cntlock");
  after("count+=100 +1", "posit=10");
  after("CNTUNLOCK", "!cntlock");
  after("CNTREV", "cntrev");
  after("count+=4 +1", "posit=6");
  after("CNTDIR", "!cntrev");
  after("count+=4 +1", "posit=10");
}

TEST_F(Oopos2Commands, DelcntKeepsTheFraction) {
  covers({"delta"});
  does("cntratio=100000 INIT count+=9");  // 2.25 Um
  after("+1 delta=2 DELCNT", "posit=4");
  after("count+=3 +1", "posit=5");  // 4.25 + 0.75
  does("posit=5");                  // this one forgets it
  after("count+=3 +1", "posit=5");
}

// 001 1.4.9.2: two commands in one sample are one.
TEST_F(Oopos2Commands, DelcntTwiceInOneSampleIsOne) {
  after("INIT posit=1000 delta=-100 DELCNT! DELCNT! +1", "posit=900");
  after("DELCNT", "posit=800");
}

TEST_F(Oopos2Commands, PowerLossKeepsWhatIsRetentive) {
  does("inertmode=2 toldly=9 tbrake=3 slowtype=1 maxvel=1000 maxslow=100 ninert=8");
  coast = 8;
  does("INIT CNTREV CNTDIR");
  place(1000);
  shows("iner05>0");
  after("MANFFW CNTLOCK +30", "on=AM");
  std::vector<std::pair<std::string, std::int32_t>> kept;
  for (const DeviceVariable& row : oopos2_type.variables)
    kept.emplace_back(row.name, row.retention == Retention::retentive ? get(row.name) : 0);
  after("power", "on=");
  for (const auto& [name, value] : kept) EXPECT_EQ(get(name), value) << name;
  for (const State& state : oopos2_type.states)
    EXPECT_EQ(get(state.name), state.name == "st_still" || state.name == "st_cntlock") << state.name;
  after("+3", "on=");
  const int posit = get("posit");
  does("INIT +5");
  EXPECT_EQ(get("posit"), posit);
  shows("still on=F");
}

TEST_F(Oopos2Commands, RestoredMemoryIsInForceAfterInit) {
  for (const auto& [name, value] :
       {std::pair{"posit", 500}, {"cntratio", 200000}, {"tbrake", 4}, {"toldly", 2}})
    device->restore(find_symbol(oopos2_type, name).value(), value);
  after("INIT", "posit=500");
  after("count+=4 +1", "posit=502");  // a pulse of 4 bits is 2 Um
  switches("MANFFW!", 10, {"0 ", "4 AM"});
  switches("STOP!", 10, {"0 ", "2 F"});
}

TEST_F(Oopos2Commands, WritesArePlainlyReported) {
  does("INIT forget cntratio=347 slowpos=10000 ninert=9 prspos=10001 prsdir=4");
  for (const char* name : {"frq", "vel", "actiner", "exeslow", "st_still"}) write(name, 1);
  says("+1", {"cntratio: 347 is outside 374..400000, taken anyway",
              "slowpos: 10000 is outside 0..9999, taken anyway", "ninert: 9 is outside 1..8, taken anyway",
              "prspos: 10001 is outside -10000..10000 (maxpos), taken anyway",
              "prsdir: 4 is outside 0..3, taken anyway", "frq: read only", "vel: read only",
              "actiner: read only", "exeslow: read only", "st_still: read only"});
  shows("slowpos=10000");
}

TEST_F(Oopos2Commands, PositIsWrittenAfterInitOnly) {
  says("forget posit=5", {"posit: st_init is 0, must be 1"});
  shows("posit=0");
}

TEST_F(Oopos2Commands, SaysWhatUnsetParametersActAs) {
  says("cntratio=0 slowtype=1 setpos=500 forget INIT", {"cntratio: 0 acts as 1"});
  does("cntratio=400000 START");
  EXPECT_THAT(diagnostics(),
              testing::Contains("maxvel: 0 is no speed to compare with: the slow range is maxslow"));
}

}  // namespace
}  // namespace drycut::devices::oopos2
