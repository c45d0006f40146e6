#include "devices/oopos2/laws.hpp"
#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

// Tolerance, START in tolerance, tool and the resolution of 0.1 Um (001 1.5.1, 1.6.3; spec 9.3).
TEST(Oopos2Laws, ToleranceIsExactAtItsEdges) {
  for (const int more : {0, 1, 50}) {
    for (const int less : {0, 7}) {
      EXPECT_TRUE(in_tolerance(more * parts_per_tenth, more, less));
      EXPECT_FALSE(in_tolerance(more * parts_per_tenth + 1, more, less));
      EXPECT_TRUE(in_tolerance(-less * parts_per_tenth, more, less));
      EXPECT_FALSE(in_tolerance(-less * parts_per_tenth - 1, more, less));
    }
  }
}

class Oopos2Tolerance : public Oopos2Test {
 protected:
  Oopos2Tolerance() {
    does("toldly=20 tollp=20 tolln=40");
    slow = 1;
    does("INIT");
  }
};

TEST_F(Oopos2Tolerance, ExcessAndShortageHaveLimitsOfTheirOwn) {
  covers({"tollp", "tolln"});
  for (const int off : {-5, -4, 0, 2, 3}) {
    does("count=0 +1 posit=0");
    coast = 10;
    write("iner01", 100 - off * 10);
    place(500);
    EXPECT_EQ(get("posit"), 500 + off);
    EXPECT_EQ(get("st_toll"), off >= -4 && off <= 2) << off;
  }
}

TEST_F(Oopos2Tolerance, ItIsJudgedOnceWhenToldlyIsOver) {
  coast = 50;  // 10 samples: still in tolerance when the outputs go off
  does("iner01=480 setpos=500 START");
  int judged = 0;
  while (get("st_still") == 0) {
    shows("!toll");
    does("+1");
    ++judged;
  }
  shows("toll");
  after("count+=100 +1", "toll");  // of the placement, not of where the axis is now
  after("MANFFW", "!toll");
}

TEST_F(Oopos2Tolerance, StartInToleranceMovesNothing) {
  covers({"enstol", "enstol 0"});
  place(500);
  after("START", "sttoll still toll on=F");
  after("+100", "on=F posit=500");
  does("setpos=499");  // still inside
  after("START", "sttoll");
  after("setpos=490 START", "!sttoll !still");
}

// 001 1.6.4 st_sttoll names START and the manual movements.
TEST_F(Oopos2Tolerance, APresetSearchLeavesSttoll) {
  place(500);
  after("START", "sttoll toll");
  after("PRESET +2", "prson !still sttoll !toll");
  after("STOP until:still", "sttoll !toll");
  write("setpos", get("posit") + 100);
  after("START", "!sttoll !still");
}

TEST_F(Oopos2Tolerance, EveryManualMovementClearsSttoll) {
  place(500);
  for (const char* name : {"MANSFW", "MANSBW", "MANFFW", "MANFBW"}) {
    does("START");
    ASSERT_EQ(get("st_sttoll"), 1) << name;
    command(name);
    EXPECT_EQ(get("st_sttoll"), 0) << name;
    EXPECT_EQ(get("st_toll"), 0) << name;
    does("STOP until:still");
    write("setpos", get("posit"));
  }
}

TEST_F(Oopos2Tolerance, WithEnstolItPlacesAgain) {
  covers({"enstol 1"});
  place(500);
  after("enstol=1 setpos=502 START", "!sttoll !still !toll");
  after("until:still", "posit=502 toll");
}

TEST_F(Oopos2Tolerance, TheToolIsAddedAtStart) {
  covers({"tool"});
  does("tool=35");  // 3.5 Um
  place(500);
  shows("posit=504");  // 503.5 by steps of 1
  shows("setpos=500");
  does("tool=-35 setpos=700 START tool=1000");  // too late for this one
  after("until:still", "posit=697");            // 696.5
}

TEST_F(Oopos2Tolerance, AQuotaBeyondTheLimitsIsHeldThere) {
  covers({"minpos", "maxpos"});
  says("maxpos=600 forget setpos=650 START",
       {"setpos: 650 is outside -10000..600 (maxpos), taken anyway",
        "START: setpos 650 plus tool is outside minpos..maxpos, the axis goes to 600"});
  after("until:still", "posit=600");
  does("minpos=-100");
  place(-200);
  shows("posit=-100");
  does("forget setpos=600 tool=1 START");
  EXPECT_EQ(diagnostics().size(), 1u);
}

// One bit is 0.1 Um: QPS places to it (001 1.5.1).
TEST_F(Oopos2Tolerance, QpsPlacesToATenth) {
  covers({"cntratio"});
  does("cntratio=40000 tollp=0 tolln=0 iner01=7 slowpos=10");
  coast = 7;
  place(30);
  shows("posit=30 count=300");  // to the bit, beginning at 0
  shows("toll");
  does("iner01=6");
  place(40);
  shows("count=401 posit=40 !toll");  // 0.1 beyond
}

TEST_F(Oopos2Tolerance, CntratioIsUmOfAPulse) {
  does("cntratio=100000 posit=0");  // 001 1.3.2: one Um a pulse, 4 bits
  after("+1 count+=1000 +1", "posit=250");
  does("cntratio=5000");  // 001 1.4.3: 1000 Um in 20000 pulses
  after("posit=0 +1 count+=80000 +1", "posit=1000");
}

TEST_F(Oopos2Tolerance, ANewRatioKeepsThePositionAndDropsTheRemainder) {
  does("cntratio=100000 posit=0 +1 count+=7");  // 1.75 Um
  after("+1", "posit=1");
  after("cntratio=200000 +1 count+=1 +1", "posit=1");  // 1.5, not 2.25
  after("count+=1 +1", "posit=2");
}

}  // namespace
}  // namespace drycut::devices::oopos2
