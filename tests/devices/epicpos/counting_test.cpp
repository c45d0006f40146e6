#include <gmock/gmock.h>

#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

// Counting, resolution and their remainders (002 1.2.1, 1.3.4; spec 1.2-1.4, 1.7).
class EpicposCounting : public PositionerTest {
 protected:
  void count_to(std::int64_t bits) {
    count() = bits;
    does("sample");
  }
};

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
    does("power");
    set({{"cntratio", c.ratio}, {"posit", 0}});
    does("count=0 INIT");
    count_to(c.bits);
    EXPECT_EQ(get("posit"), c.um) << c.ratio;
  }
}

TEST_F(EpicposCounting, NoCountIsLostOverManyMoves) {
  does("cntratio=36400 INIT");
  for (int i = 0; i < 100000; ++i) {
    does("count+=100003");  // odd steps: each conversion leaves a remainder
    does("sample count+=-100000 sample");
  }
  // 300000 bits * 0.364 / 4 Um
  shows("posit=27300");
}

TEST_F(EpicposCounting, ChangingTheRatioDropsTheRemainder) {
  does("cntratio=100000 INIT count=11 sample");  // 2.75
  after("cntratio=200000 sample", "posit=2");
  does("count=12 sample");  // 2.5, not 3.25
  shows("posit=2");
  after("count=13 sample", "posit=3");
}

TEST_F(EpicposCounting, LockReversalAndPositionOutliveThePower) {
  does("cntratio=100000 INIT CNTREV count=-10 sample");  // 2.5 Um
  after("CNTLOCK power", "posit=2 cntlock cntrev");
  does("count=4000");  // moved without power: nobody saw it
  after("INIT", "posit=2");
  after("CNTUNLOCK count=3998 sample", "posit=3");  // the half was kept too
}

TEST_F(EpicposCounting, FrequencyAndSpeedOverAWindow) {
  does("unitvel=0 decpt=1 INIT");
  const std::int64_t before = count();
  for (int i = 0; i < 120; ++i) {  // 240 ms
    shows("frq=0");
    count_to(count() - 10);
  }
  ASSERT_EQ(count() - before, -1200);
  shows("frq=1250");   // 5000 bits/s
  shows("vel=30000");  // 5000 Um/s = 300000 Um/min = 30000.0
}

TEST_F(EpicposCounting, OutOfRangeIsTakenAndReported) {
  says("cntratio=347 tinvt=1000 setvel=50001 sprsvel=5001 prspos=-1000000",
       {"cntratio: 347 is outside 374..400000, taken anyway", "tinvt: 1000 is outside 0..999, taken anyway",
        "setvel: 50001 is outside 0..50000 (maxvel), taken anyway",
        "sprsvel: 5001 is outside 0..5000 (prsvel), taken anyway",
        "prspos: -1000000 is outside -999999..999999, taken anyway",
        "prspos: -1000000 is outside -999999..999999 (maxpos), taken anyway"});
  shows("cntratio=347 prspos=-1000000");
}

TEST_F(EpicposCounting, NonsenseInEveryParameterDoesNotStopIt) {
  for (const std::int32_t nonsense : {0, -1, 2147483647, -2147483647 - 1}) {
    does("power");
    for (const DeviceVariable& variable : epicpos_type.variables)
      if (variable.access == Access::read_write) write(variable.name, nonsense);
    does("INIT");
    for (const char* name : {"LOOPON", "START", "STOP", "MANBW", "PRESET", "STOP", "CALON", "CALOFF"}) {
      command(name);
      does("count+=12345 +20");
    }
    shows("init");
  }
}

TEST_F(EpicposCounting, ParametersCanBeLoadedAndReadBeforeInit) {
  does("maxvel=1234");
  EXPECT_TRUE(device->settled());
  shows("maxvel=1234 silent");
}

}  // namespace
}  // namespace drycut::devices::epicpos
