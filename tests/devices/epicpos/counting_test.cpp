#include <gmock/gmock.h>

#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Counting, resolution and their remainders (002 1.2.1, 1.3.4; spec 1.2-1.4, 1.7).
class EpicposCounting : public PositionerTest {
 protected:
  void count_to(std::int64_t bits) {
    count() = bits;
    sample();
  }
};

TEST_F(EpicposCounting, DoesNothingBeforeInit) {
  covers({"st_init", "INIT accepted"});
  count_to(500);
  order("LOOPON");
  sample();
  EXPECT_EQ(get("st_loopon"), 0);
  EXPECT_EQ(get("posit"), 0);
  command("INIT");
  EXPECT_EQ(get("st_init"), 1);
  count_to(600);
  EXPECT_EQ(get("posit"), 100);
}

TEST_F(EpicposCounting, CntratioIsUmPerPulse) {
  covers({"cntratio", "posit"});
  struct Case {
    int ratio;
    std::int64_t bits;
    int um;
  };
  // 18.2 cm in 500 pulses (002 1.2.1.3), one Um a pulse, 1000 mm in 20000 pulses, the ends of the range.
  for (const Case& c : {Case{36400, 2000, 182}, Case{100000, 4096, 1024}, Case{5000, 80000, 1000},
                        Case{374, 400000, 374}, Case{400000, 77, 77}, Case{100000, -7, -1}}) {
    device->power_up();
    set({{"cntratio", c.ratio}, {"posit", 0}});
    count() = 0;
    command("INIT");
    count_to(c.bits);
    EXPECT_EQ(get("posit"), c.um) << c.ratio;
  }
}

TEST_F(EpicposCounting, NoCountIsLostOverManyMoves) {
  write("cntratio", 36400);
  command("INIT");
  for (int i = 0; i < 100000; ++i) {
    count() += 100003;  // odd steps: each conversion leaves a remainder
    sample();
    count() -= 100000;
    sample();
  }
  // 300000 bits * 0.364 / 4 Um
  EXPECT_EQ(get("posit"), 27300);
}

TEST_F(EpicposCounting, WritingPositDropsTheRemainderAndDelcntKeepsIt) {
  covers({"delta", "DELCNT accepted"});
  write("cntratio", 100000);
  command("INIT");
  count_to(9);  // 2.25 Um
  EXPECT_EQ(get("posit"), 2);
  write("delta", 2);
  command("DELCNT");
  EXPECT_EQ(get("posit"), 4);
  count_to(12);  // 5.00: the quarter was kept
  EXPECT_EQ(get("posit"), 5);
  count_to(13);  // 5.25
  write("posit", 7);
  sample();
  count_to(16);  // 7.75: the quarter is gone
  EXPECT_EQ(get("posit"), 7);
  count_to(17);
  EXPECT_EQ(get("posit"), 8);
}

TEST_F(EpicposCounting, ChangingTheRatioDropsTheRemainder) {
  write("cntratio", 100000);
  command("INIT");
  count_to(11);  // 2.75
  write("cntratio", 200000);
  sample();
  EXPECT_EQ(get("posit"), 2);
  count_to(12);  // 2.5, not 3.25
  EXPECT_EQ(get("posit"), 2);
  count_to(13);
  EXPECT_EQ(get("posit"), 3);
}

TEST_F(EpicposCounting, TwoDelcntsInOneSampleAreOne) {
  command("INIT");
  set({{"posit", 1000}, {"delta", -100}});
  order("DELCNT");
  order("DELCNT");
  EXPECT_FALSE(device->settled());
  sample();
  EXPECT_EQ(get("posit"), 900);
  command("DELCNT");  // after a read statement has waited for the first
  EXPECT_EQ(get("posit"), 800);
  write("delta", 3);
  command("DELCNT");
  write("delta", 40);
  command("DELCNT");
  EXPECT_EQ(get("posit"), 843);
}

TEST_F(EpicposCounting, LockAndReversal) {
  covers({"st_cntlock", "st_cntrev", "CNTLOCK accepted", "CNTUNLOCK accepted", "CNTREV accepted",
          "CNTDIR accepted"});
  command("INIT");
  count_to(100);
  command("CNTLOCK");
  EXPECT_EQ(get("st_cntlock"), 1);
  count_to(300);
  EXPECT_EQ(get("posit"), 100);
  command("CNTUNLOCK");
  EXPECT_EQ(get("st_cntlock"), 0);
  count_to(310);
  EXPECT_EQ(get("posit"), 110);
  command("CNTREV");
  EXPECT_EQ(get("st_cntrev"), 1);
  count_to(330);
  EXPECT_EQ(get("posit"), 90);
  command("CNTDIR");
  EXPECT_EQ(get("st_cntrev"), 0);
  count_to(335);
  EXPECT_EQ(get("posit"), 95);
}

TEST_F(EpicposCounting, LockReversalAndPositionOutliveThePower) {
  write("cntratio", 100000);
  command("INIT");
  command("CNTREV");
  count_to(-10);  // 2.5 Um
  command("CNTLOCK");
  device->power_up();
  EXPECT_EQ(get("posit"), 2);
  EXPECT_EQ(get("st_cntlock"), 1);
  EXPECT_EQ(get("st_cntrev"), 1);
  count() = 4000;  // moved without power: nobody saw it
  command("INIT");
  EXPECT_EQ(get("posit"), 2);
  command("CNTUNLOCK");
  count_to(3998);
  EXPECT_EQ(get("posit"), 3);  // the half was kept too
}

TEST_F(EpicposCounting, FrequencyAndSpeedOverAWindow) {
  covers({"frq", "vel"});
  set({{"unitvel", 0}, {"decpt", 1}});
  command("INIT");
  const std::int64_t before = count();
  for (int i = 0; i < 120; ++i) {  // 240 ms
    EXPECT_EQ(get("frq"), 0);
    count_to(count() - 10);
  }
  ASSERT_EQ(count() - before, -1200);
  EXPECT_EQ(get("frq"), 1250);   // 5000 bits/s
  EXPECT_EQ(get("vel"), 30000);  // 5000 Um/s = 300000 Um/min = 30000.0
}

TEST_F(EpicposCounting, OutOfRangeIsTakenAndReported) {
  set({{"cntratio", 347}, {"tinvt", 1000}, {"setvel", 50001}, {"sprsvel", 5001}, {"prspos", -1000000}});
  EXPECT_THAT(diagnostics(),
              ElementsAre("cntratio: 347 is outside 374..400000, taken anyway",
                          "tinvt: 1000 is outside 0..999, taken anyway",
                          "setvel: 50001 is outside 0..50000 (maxvel), taken anyway",
                          "sprsvel: 5001 is outside 0..5000 (prsvel), taken anyway",
                          "prspos: -1000000 is outside -999999..999999, taken anyway",
                          "prspos: -1000000 is outside -999999..999999 (maxpos), taken anyway"));
  EXPECT_EQ(get("cntratio"), 347);
  EXPECT_EQ(get("prspos"), -1000000);
}

TEST_F(EpicposCounting, NonsenseInEveryParameterDoesNotStopIt) {
  for (const std::int32_t nonsense : {0, -1, 2147483647, -2147483647 - 1}) {
    device->power_up();
    for (const Variable& variable : epicpos_type.variables)
      if (variable.access == Access::read_write) write(variable.name, nonsense);
    command("INIT");
    for (const char* name : {"LOOPON", "START", "STOP", "MANBW", "PRESET", "STOP", "CALON", "CALOFF"}) {
      command(name);
      count() += 12345;
      ticks(20);
    }
    EXPECT_EQ(get("st_init"), 1);
  }
}

TEST_F(EpicposCounting, ParametersCanBeLoadedAndReadBeforeInit) {
  write("maxvel", 1234);
  EXPECT_TRUE(device->settled());
  EXPECT_EQ(get("maxvel"), 1234);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

}  // namespace
}  // namespace drycut::devices::epicpos
