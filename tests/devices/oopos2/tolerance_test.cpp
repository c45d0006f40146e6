#include "devices/oopos2/laws.hpp"
#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

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
    set({{"toldly", 20}, {"tollp", 20}, {"tolln", 40}});
    slow = 1;
    command("INIT");
  }
};

TEST_F(Oopos2Tolerance, ExcessAndShortageHaveLimitsOfTheirOwn) {
  covers({"tollp", "tolln"});
  for (const int off : {-5, -4, 0, 2, 3}) {
    count() = 0;
    tick();
    write("posit", 0);
    coast = 10;
    write("iner01", 100 - off * 10);
    place(500);
    EXPECT_EQ(get("posit"), 500 + off);
    EXPECT_EQ(get("st_toll"), off >= -4 && off <= 2) << off;
  }
}

TEST_F(Oopos2Tolerance, ItIsJudgedOnceWhenToldlyIsOver) {
  coast = 50;  // 10 samples: still in tolerance when the outputs go off
  write("iner01", 480);
  write("setpos", 500);
  command("START");
  int judged = 0;
  while (get("st_still") == 0) {
    EXPECT_EQ(get("st_toll"), 0);
    tick();
    ++judged;
  }
  EXPECT_EQ(get("st_toll"), 1);
  count() += 100;
  tick();
  EXPECT_EQ(get("st_toll"), 1);  // of the placement, not of where the axis is now
  command("MANFFW");
  EXPECT_EQ(get("st_toll"), 0);
}

TEST_F(Oopos2Tolerance, StartInToleranceMovesNothing) {
  covers({"enstol", "enstol 0", "st_sttoll"});
  place(500);
  command("START");
  EXPECT_EQ(get("st_sttoll"), 1);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("st_toll"), 1);
  EXPECT_EQ(on(), "F");
  ticks(100);
  EXPECT_EQ(on(), "F");
  EXPECT_EQ(get("posit"), 500);
  write("setpos", 499);  // still inside
  command("START");
  EXPECT_EQ(get("st_sttoll"), 1);
  write("setpos", 490);
  command("START");
  EXPECT_EQ(get("st_sttoll"), 0);
  EXPECT_EQ(get("st_still"), 0);
}

TEST_F(Oopos2Tolerance, EveryMovementCommandClearsSttoll) {
  place(500);
  for (const char* name : {"MANSFW", "MANSBW", "MANFFW", "MANFBW", "PRESET"}) {
    command("START");
    ASSERT_EQ(get("st_sttoll"), 1) << name;
    command(name);
    EXPECT_EQ(get("st_sttoll"), 0) << name;
    EXPECT_EQ(get("st_toll"), 0) << name;
    command("STOP");
    ASSERT_TRUE(wait("st_still", 1));
    write("setpos", get("posit"));
  }
}

TEST_F(Oopos2Tolerance, WithEnstolItPlacesAgain) {
  covers({"enstol 1"});
  place(500);
  set({{"enstol", 1}, {"setpos", 502}});
  command("START");
  EXPECT_EQ(get("st_sttoll"), 0);
  EXPECT_EQ(get("st_still"), 0);
  EXPECT_EQ(get("st_toll"), 0);
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 502);
  EXPECT_EQ(get("st_toll"), 1);
}

TEST_F(Oopos2Tolerance, TheToolIsAddedAtStart) {
  covers({"tool"});
  write("tool", 35);  // 3.5 Um
  place(500);
  EXPECT_EQ(get("posit"), 504);  // 503.5 by steps of 1
  EXPECT_EQ(get("setpos"), 500);
  write("tool", -35);
  write("setpos", 700);
  command("START");
  write("tool", 1000);  // too late for this one
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 697);  // 696.5
}

TEST_F(Oopos2Tolerance, AQuotaBeyondTheLimitsIsHeldThere) {
  covers({"minpos", "maxpos"});
  write("maxpos", 600);
  diagnostics();
  write("setpos", 650);
  command("START");
  EXPECT_THAT(diagnostics(), ElementsAre("setpos: 650 is outside -10000..600 (maxpos), taken anyway",
                                         "START: setpos 650 plus tool is outside minpos..maxpos, the axis "
                                         "goes to 600"));
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 600);
  write("minpos", -100);
  place(-200);
  EXPECT_EQ(get("posit"), -100);
  diagnostics();
  set({{"setpos", 600}, {"tool", 1}});
  command("START");
  EXPECT_EQ(diagnostics().size(), 1u);
}

// One bit is 0.1 Um: QPS places to it (001 1.5.1).
TEST_F(Oopos2Tolerance, QpsPlacesToATenth) {
  covers({"cntratio"});
  set({{"cntratio", 40000}, {"tollp", 0}, {"tolln", 0}, {"iner01", 7}, {"slowpos", 10}});
  coast = 7;
  place(30);
  EXPECT_EQ(get("posit"), 30);
  EXPECT_EQ(count(), 300);  // to the bit, beginning at 0
  EXPECT_EQ(get("st_toll"), 1);
  write("iner01", 6);
  place(40);
  EXPECT_EQ(count(), 401);
  EXPECT_EQ(get("posit"), 40);
  EXPECT_EQ(get("st_toll"), 0);  // 0.1 beyond
}

TEST_F(Oopos2Tolerance, CntratioIsUmOfAPulse) {
  set({{"cntratio", 100000}, {"posit", 0}});  // 001 1.3.2: one Um a pulse, 4 bits
  tick();
  count() += 1000;
  tick();
  EXPECT_EQ(get("posit"), 250);
  write("cntratio", 5000);  // 001 1.4.3: 1000 Um in 20000 pulses
  write("posit", 0);
  tick();
  count() += 80000;
  tick();
  EXPECT_EQ(get("posit"), 1000);
}

TEST_F(Oopos2Tolerance, ANewRatioKeepsThePositionAndDropsTheRemainder) {
  set({{"cntratio", 100000}, {"posit", 0}});
  tick();
  count() += 7;  // 1.75 Um
  tick();
  EXPECT_EQ(get("posit"), 1);
  write("cntratio", 200000);
  tick();
  count() += 1;
  tick();
  EXPECT_EQ(get("posit"), 1);  // 1.5, not 2.25
  count() += 1;
  tick();
  EXPECT_EQ(get("posit"), 2);
}

}  // namespace
}  // namespace drycut::devices::oopos2
