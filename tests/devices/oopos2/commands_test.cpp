#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Commands and their conditions, manual movements, counting (001 1.6.2).
class Oopos2Commands : public Oopos2Test {};

TEST_F(Oopos2Commands, NoneButInitRunsBeforeInit) {
  covers({"STOP refused", "CNTLOCK refused", "CNTUNLOCK refused", "CNTREV refused", "CNTDIR refused",
          "REGON refused", "REGOFF refused", "PRESET refused"});
  diagnostics();
  for (const Command& entry : oopos2_type.commands) {
    const std::string name(entry.name);
    if (name == "INIT") continue;
    EXPECT_THAT(refusal(name.c_str()), testing::StartsWith(name + ": st_init is 0, must be 1"));
  }
  command("INIT");
  EXPECT_THAT(diagnostics(), IsEmpty());
  for (const State& state : oopos2_type.states)
    EXPECT_EQ(get(state.name),
              state.name == "st_still" || state.name == "st_init" || state.name == "st_brake")
        << state.name;
}

TEST_F(Oopos2Commands, BeforeInitNothingIsPutOutOrCounted) {
  count() += 50;
  ticks(3);
  EXPECT_EQ(on(), "");
  EXPECT_EQ(get("posit"), 0);
  command("INIT");
  EXPECT_EQ(on(), "F");
  EXPECT_EQ(get("posit"), 0);
  count() += 5;
  tick();
  EXPECT_EQ(get("posit"), 5);
}

TEST_F(Oopos2Commands, InitOnce) {
  covers({"INIT refused"});
  command("INIT");
  EXPECT_EQ(refusal("INIT"), "INIT: st_init is 1, must be 0");
}

TEST_F(Oopos2Commands, TheManualsStartUpIsNoRefusal) {
  for (const char* name : {"INIT", "CNTUNLOCK", "CNTDIR", "REGON", "STOP"}) command(name);
  EXPECT_THAT(diagnostics(), IsEmpty());
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(on(), "F");
}

TEST_F(Oopos2Commands, ManualMovementsSwitchTheirOutputs) {
  covers({"MANFFW accepted", "MANFBW accepted", "MANSFW accepted", "MANSBW accepted"});
  set({{"tbrake", 2}, {"toldly", 3}});
  command("INIT");
  const std::pair<const char*, const char*> cases[] = {
      {"MANFFW", "2 AM"}, {"MANSFW", "2 AMR"}, {"MANFBW", "2 IDM"}, {"MANSBW", "2 IDMR"}};
  for (const auto& [name, expected] : cases) {
    order(name);
    EXPECT_EQ(record(10).back(), expected);
    EXPECT_EQ(get("st_still"), 0);
    order("STOP");
    tick();
    EXPECT_EQ(output(4), false);
    ASSERT_TRUE(wait("st_still", 1, 3)) << name;
  }
}

TEST_F(Oopos2Commands, AManualMovementReplacesTheOneThatRuns) {
  set({{"tinvt", 4}, {"setpos", 5000}});
  command("INIT");
  order("START");
  ticks(5);
  order("MANSFW");
  EXPECT_THAT(record(3), ElementsAre("0 AMR"));  // slow: without a break
  order("MANFFW");
  EXPECT_THAT(record(3), ElementsAre("0 AM"));
  order("MANFBW");
  EXPECT_THAT(record(9), ElementsAre("0 ", "4 IDM"));
  EXPECT_EQ(get("st_still"), 0);
  ticks(600);
  EXPECT_NEAR(get("posit"), -10000, 20);  // to the limit, past every quota
}

TEST_F(Oopos2Commands, ManualMovementsEndAtTheLimits) {
  set({{"maxpos", 1000}, {"minpos", -1000}, {"toldly", 3}});
  command("INIT");
  for (const auto& [name, limit] : {std::pair{"MANFFW", 1000}, {"MANFBW", -1000}, {"MANSFW", 1000}}) {
    command(name);
    ASSERT_TRUE(wait("st_still", 1)) << name;
    EXPECT_EQ(get("posit"), limit);
    EXPECT_EQ(get("st_toll"), 0);
  }
}

TEST_F(Oopos2Commands, AtTheLimitTheyAreRefused) {
  covers({"MANFFW refused", "MANFBW refused", "MANSFW refused", "MANSBW refused"});
  command("INIT");
  write("posit", 10000);
  tick();
  EXPECT_EQ(refusal("MANFFW"), "MANFFW: needs posit < maxpos");
  EXPECT_EQ(refusal("MANSFW"), "MANSFW: needs posit < maxpos");
  write("posit", -10000);
  tick();
  EXPECT_EQ(refusal("MANFBW"), "MANFBW: needs posit > minpos");
  EXPECT_EQ(refusal("MANSBW"), "MANSBW: needs posit > minpos");
  EXPECT_EQ(get("st_still"), 1);
  command("MANFFW");
  EXPECT_EQ(get("st_still"), 0);
}

TEST_F(Oopos2Commands, TheLimitIsThatOfTheCountOfTheSameSample) {
  command("INIT");
  count() = 10000;
  EXPECT_EQ(refusal("MANFFW"), "MANFFW: needs posit < maxpos");
}

TEST_F(Oopos2Commands, AManualMovementIsNoPlacementAnyMore) {
  set({{"setpos", 1000}, {"maxpos", 1000}, {"inertmode", 2}, {"toldly", 3}, {"slowpos", 300}});
  coast = 7;
  command("INIT");
  command("START");
  ASSERT_TRUE(wait("st_movslow", 1));
  command("MANFFW");
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 1000);
  EXPECT_EQ(get("st_toll"), 0);
  EXPECT_EQ(get("iner01"), 0);
}

TEST_F(Oopos2Commands, StartNeedsAStillAxis) {
  covers({"START refused", "DELCNT refused"});
  command("INIT");
  command("MANFFW");
  EXPECT_EQ(refusal("START"), "START: st_still is 0, must be 1");
  EXPECT_EQ(refusal("DELCNT"), "DELCNT: st_still is 0, must be 1");
}

TEST_F(Oopos2Commands, RegulationOffRefusesMovements) {
  covers({"st_regoff", "REGOFF accepted", "REGON accepted"});
  command("INIT");
  command("REGOFF");
  EXPECT_EQ(get("st_regoff"), 1);
  for (const char* name : {"START", "STOP", "PRESET", "MANSFW", "MANSBW", "MANFFW", "MANFBW"})
    EXPECT_EQ(refusal(name), std::string(name) + ": st_regoff is 1, must be 0");
  count() += 30;
  tick();
  EXPECT_EQ(get("posit"), 30);  // it counts on
  command("REGON");
  EXPECT_EQ(get("st_regoff"), 0);
  command("MANFFW");
  EXPECT_EQ(on(), "AM");
}

TEST_F(Oopos2Commands, CountLockReversalAndTheirEnds) {
  covers({"CNTLOCK accepted", "CNTUNLOCK accepted", "CNTREV accepted", "CNTDIR accepted", "st_cntlock",
          "st_cntrev", "posit"});
  command("INIT");
  count() += 10;
  command("CNTLOCK");
  EXPECT_EQ(get("posit"), 10);
  EXPECT_EQ(get("st_cntlock"), 1);
  count() += 100;
  tick();
  EXPECT_EQ(get("posit"), 10);
  command("CNTUNLOCK");
  EXPECT_EQ(get("st_cntlock"), 0);
  command("CNTREV");
  EXPECT_EQ(get("st_cntrev"), 1);
  count() += 4;
  tick();
  EXPECT_EQ(get("posit"), 6);
  command("CNTDIR");
  EXPECT_EQ(get("st_cntrev"), 0);
  count() += 4;
  tick();
  EXPECT_EQ(get("posit"), 10);
}

TEST_F(Oopos2Commands, DelcntKeepsTheFraction) {
  covers({"delta", "DELCNT accepted"});
  write("cntratio", 100000);
  command("INIT");
  count() += 9;  // 2.25 Um
  tick();
  write("delta", 2);
  command("DELCNT");
  EXPECT_EQ(get("posit"), 4);
  count() += 3;
  tick();
  EXPECT_EQ(get("posit"), 5);  // 4.25 + 0.75
  write("posit", 5);           // this one forgets it
  count() += 3;
  tick();
  EXPECT_EQ(get("posit"), 5);
}

// 001 1.4.9.2: two commands in one sample are one.
TEST_F(Oopos2Commands, DelcntTwiceInOneSampleIsOne) {
  command("INIT");
  set({{"posit", 1000}, {"delta", -100}});
  order("DELCNT");
  order("DELCNT");
  tick();
  EXPECT_EQ(get("posit"), 900);
  command("DELCNT");
  EXPECT_EQ(get("posit"), 800);
}

TEST_F(Oopos2Commands, PowerLossKeepsWhatIsRetentive) {
  set({{"inertmode", 2},
       {"toldly", 9},
       {"tbrake", 3},
       {"slowtype", 1},
       {"maxvel", 1000},
       {"maxslow", 100},
       {"ninert", 8}});
  coast = 8;
  command("INIT");
  command("CNTREV");
  command("CNTDIR");
  place(1000);
  ASSERT_GT(get("iner05"), 0);
  command("MANFFW");
  command("CNTLOCK");
  ticks(30);
  ASSERT_EQ(on(), "AM");
  std::vector<std::pair<std::string, std::int32_t>> kept;
  for (const Variable& row : oopos2_type.variables)
    kept.emplace_back(row.name, row.retention == Retention::retentive ? get(row.name) : 0);
  device->power_up();
  EXPECT_EQ(on(), "");
  for (const auto& [name, value] : kept) EXPECT_EQ(get(name), value) << name;
  for (const State& state : oopos2_type.states)
    EXPECT_EQ(get(state.name), state.name == "st_still" || state.name == "st_cntlock") << state.name;
  ticks(3);
  EXPECT_EQ(on(), "");
  const int posit = get("posit");
  command("INIT");
  ticks(5);
  EXPECT_EQ(get("posit"), posit);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(on(), "F");
}

TEST_F(Oopos2Commands, RestoredMemoryIsInForceAfterInit) {
  for (const auto& [name, value] :
       {std::pair{"posit", 500}, {"cntratio", 200000}, {"tbrake", 4}, {"toldly", 2}})
    device->restore(find_symbol(oopos2_type, name).value(), value);
  command("INIT");
  EXPECT_EQ(get("posit"), 500);
  count() += 4;
  tick();
  EXPECT_EQ(get("posit"), 502);  // a pulse of 4 bits is 2 Um
  order("MANFFW");
  EXPECT_THAT(record(10), ElementsAre("0 ", "4 AM"));
  order("STOP");
  EXPECT_THAT(record(10), ElementsAre("0 ", "2 F"));
}

TEST_F(Oopos2Commands, WritesArePlainlyReported) {
  command("INIT");
  diagnostics();
  set({{"cntratio", 347}, {"slowpos", 10000}, {"ninert", 9}, {"prspos", 10001}, {"prsdir", 4}});
  for (const char* name : {"frq", "vel", "actiner", "exeslow", "st_still"}) write(name, 1);
  tick();
  EXPECT_THAT(diagnostics(),
              ElementsAre("cntratio: 347 is outside 374..400000, taken anyway",
                          "slowpos: 10000 is outside 0..9999, taken anyway",
                          "ninert: 9 is outside 1..8, taken anyway",
                          "prspos: 10001 is outside -10000..10000 (maxpos), taken anyway",
                          "prsdir: 4 is outside 0..3, taken anyway", "frq: read only", "vel: read only",
                          "actiner: read only", "exeslow: read only", "st_still: read only"));
  EXPECT_EQ(get("slowpos"), 10000);
}

TEST_F(Oopos2Commands, PositIsWrittenAfterInitOnly) {
  diagnostics();
  write("posit", 5);
  EXPECT_THAT(diagnostics(), ElementsAre("posit: st_init is 0, must be 1"));
  EXPECT_EQ(get("posit"), 0);
}

TEST_F(Oopos2Commands, SaysWhatUnsetParametersActAs) {
  set({{"cntratio", 0}, {"slowtype", 1}, {"setpos", 500}});
  diagnostics();
  command("INIT");
  EXPECT_THAT(diagnostics(), ElementsAre("cntratio: 0 acts as 1"));
  write("cntratio", 400000);
  command("START");
  EXPECT_THAT(diagnostics(),
              testing::Contains("maxvel: 0 is no speed to compare with: the slow range is maxslow"));
}

}  // namespace
}  // namespace drycut::devices::oopos2
