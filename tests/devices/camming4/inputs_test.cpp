#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;
using testing::HasSubstr;

class Camming4Inputs : public Camming4Test {
 protected:
  static constexpr const char* normal = "2.INP03";
  static constexpr int function_line = 5;

  void load_cam() {
    row(1, {132, 100, 50});
    row(2, {133, 1000, 1000});
    row(3, {137, 2});
  }
  void arm_input(int function, int mode = 2) {
    set({{"funInp", function}, {"inpcapt", mode}});
    command("ENBL");
  }
  void arm_interrupt(int function, int mode = 2) {
    set({{"funInt", function}, {"intcapt", mode}});
    command("INTENBL");
    ticks(2);
  }
  void pulse_input(std::int64_t bits = 0) {
    input(normal) = true;
    tick(bits);
    input(normal) = false;
  }
};

TEST_F(Camming4Inputs, ShowsTheInterruptLine) {
  command("INIT");
  edge(function_line, true);
  tick();
  EXPECT_EQ(get("st_int"), 1);
  edge(function_line, false);
  tick();
  EXPECT_EQ(get("st_int"), 0);
  covers({"st_int"});
}

TEST_F(Camming4Inputs, CapturesOnceOnTheArmedEdge) {
  command("INIT");
  slave().count = 42;
  arm_input(3, 2);
  EXPECT_EQ(get("st_enbl"), 1);
  pulse_input();
  EXPECT_EQ(get("delta1"), 42);
  EXPECT_EQ(get("st_enbl"), 0);
  EXPECT_EQ(get("st_capt"), 1);
  slave().count = 50;
  tick();
  pulse_input();
  EXPECT_EQ(get("delta1"), 42);
  command("RSCAPT");
  EXPECT_EQ(get("st_capt"), 0);
  covers({"ENBL accepted", "RSCAPT accepted", "st_enbl", "st_capt", "normal input 3", "funInp"});
}

TEST_F(Camming4Inputs, TakesTheFallingEdgeToo) {
  command("INIT");
  arm_input(5, 1);
  input(normal) = true;
  tick();
  EXPECT_EQ(get("delta1"), 0);
  input(normal) = false;
  tick();
  EXPECT_EQ(get("delta1"), 1);
  covers({"inpcapt"});
}

TEST_F(Camming4Inputs, MayBeArmedBeforeTheEdgeIsChosen) {
  // 000 1.9.5 asks ENBL and INTENBL for st_init alone; INTDSBL for an edge too.
  command("INIT");
  set({{"funInp", 5}, {"funInt", 6}});
  diagnostics();
  command("ENBL");
  command("INTENBL");
  EXPECT_THAT(diagnostics(), testing::IsEmpty());
  EXPECT_EQ(get("st_enbl"), 1);
  EXPECT_EQ(get("st_intenbl"), 1);
  pulse_input();
  edge(function_line, true);
  tick();
  EXPECT_EQ(get("st_capt"), 0);  // no edge is chosen yet
  EXPECT_EQ(get("st_intcapt"), 0);
  command("INTDSBL");
  EXPECT_EQ(get("st_intenbl"), 1);
  EXPECT_THAT(diagnostics(), Contains("INTDSBL: needs intcapt > 0"));
  set({{"inpcapt", 2}, {"intcapt", 2}});
  tick();
  pulse_input();
  edge(function_line, true);
  tick();
  EXPECT_EQ(get("delta1"), 1);
  EXPECT_EQ(get("delta2"), 1);
  EXPECT_EQ(get("st_enbl"), 0);
  EXPECT_EQ(get("st_intenbl"), 0);
  covers({"ENBL accepted", "INTENBL accepted", "INTDSBL refused", "inpcapt", "intcapt"});
}

TEST_F(Camming4Inputs, ADisarmedInputDoesNothing) {
  command("INIT");
  arm_input(5);
  command("DSBL");
  pulse_input();
  EXPECT_EQ(get("delta1"), 0);
  EXPECT_EQ(get("st_capt"), 0);
  arm_interrupt(5);
  command("INTDSBL");
  edge(function_line, true);
  tick();
  EXPECT_EQ(get("delta1"), 0);
  arm_interrupt(0);
  edge(function_line, true);
  tick();
  EXPECT_EQ(get("st_intcapt"), 0);
  covers({"DSBL accepted", "INTDSBL accepted", "interrupt input 0"});
}

TEST_F(Camming4Inputs, LatchesTheExactCountAtTheEdge) {
  command("INIT");
  arm_interrupt(3);
  slave().count = 1003;
  edge(function_line, true);
  slave().count = 1010;
  tick();
  EXPECT_EQ(get("delta1"), 1003);
  EXPECT_EQ(get("encoder"), 1010);
  EXPECT_EQ(get("st_intenbl"), 0);
  EXPECT_EQ(get("st_intcapt"), 1);
  command("RSINTCAPT");
  EXPECT_EQ(get("st_intcapt"), 0);
  command("CNTREVM");
  arm_interrupt(4, 1);
  master().count = 7;
  edge(function_line, false);
  master().count = 20;
  tick();
  EXPECT_EQ(get("delta2"), -7);
  covers({"INTENBL accepted", "RSINTCAPT accepted", "st_intenbl", "st_intcapt", "intcapt", "funInt",
          "interrupt input 3", "interrupt input 4"});
}

TEST_F(Camming4Inputs, LoadsCountsAtTheEdge) {
  command("INIT");
  set({{"delta1", 500}, {"delta2", -30}});
  arm_interrupt(7);
  slave().count = 100;
  edge(function_line, true);
  slave().count = 104;
  tick();
  EXPECT_EQ(get("posit"), 504);
  arm_input(8);
  pulse_input();
  EXPECT_EQ(get("positm"), -30);
  covers({"interrupt input 7", "normal input 8"});
}

TEST_F(Camming4Inputs, CountsEvents) {
  command("INIT");
  write("delta2", 2147483647);
  for (int i = 0; i < 3; ++i) {
    arm_input(5);
    pulse_input();
    tick();
  }
  EXPECT_EQ(get("delta1"), 3);
  arm_input(6);
  pulse_input();
  EXPECT_EQ(get("delta2"), -2147483647 - 1);
}

TEST_F(Camming4Inputs, StartsTheCamFromTheLatchedCount) {
  load_cam();
  start();
  arm_interrupt(10);
  master().count = 1000;
  edge(function_line, true);
  tick(30);  // the master is 30 Um on at the sample
  EXPECT_EQ(get("delta2"), 1000);
  EXPECT_EQ(get("st_camex"), 1);
  slave_blocked = true;
  ticks(17, 10);  // 200 Um in all: 50 + 100
  EXPECT_EQ(get("follerr") + get("posit"), 150);
  covers({"interrupt input 10"});
}

TEST_F(Camming4Inputs, ARecalculationDelaysTheEvent) {
  load_cam();
  start();
  arm_interrupt(2);
  write("maxvel", 40000);  // 5 samples
  edge(function_line, true);
  tick(10);
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_EQ(get("wrncode"), 8);
  ticks(4, 10);
  EXPECT_EQ(get("st_camex"), 0);
  tick(10);
  EXPECT_EQ(get("st_camex"), 1);
  // Its origin is the present count, not the latched one: row 1 ends 100 Um from here.
  ticks(9, 10);
  EXPECT_EQ(get("rowex"), 1);
  tick(10);
  EXPECT_EQ(get("rowex"), 2);
  covers({"warning 8", "interrupt input 2"});
}

TEST_F(Camming4Inputs, EachParameterHasItsRecalculationTime) {
  struct Delay {
    const char* name;
    int samples;
  };
  command("INIT");
  for (const auto& [name, count] :
       {Delay{"codeQm1", 1}, Delay{"toll", 1}, Delay{"tbfm", 2}, Delay{"tbf", 3}, Delay{"decpt", 6},
        Delay{"pulsem", 130}, Delay{"measure", 139}, Delay{"offset", 0}, Delay{"setpos", 0}}) {
    arm_interrupt(5);
    while (get("st_intcapt") == 1) command("RSINTCAPT");
    const int before = get("delta1");
    write(name, 1);
    edge(function_line, true);
    int waited = 0;
    for (tick(); get("delta1") == before && waited < 1000; ++waited) tick();
    EXPECT_EQ(waited, count) << name;
  }
}

TEST_F(Camming4Inputs, StopCamIsInhibitedAfterFunctionEleven) {
  load_cam();
  start();
  arm_input(11);
  pulse_input();
  EXPECT_EQ(get("st_camex"), 1);
  for (int ms = 2; ms < 24; ms += 2) {
    command("STOPCAM");
    ASSERT_EQ(get("st_camex"), 1) << ms;
  }
  EXPECT_THAT(diagnostics(), Contains(HasSubstr("STOPCAM: needs 25 ms")));
  ticks(2);
  command("STOPCAM");
  EXPECT_EQ(get("st_camex"), 0);
}

TEST_F(Camming4Inputs, AnInputStopsTheCam) {
  load_cam();
  start();
  arm_input(1);
  pulse_input();
  EXPECT_EQ(get("st_still"), 1);
  command("STARTCAM");
  ticks(20, 10);
  order("ENBL");
  tick(10);
  pulse_input(10);
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_EQ(get("st_still"), 0);
}

TEST_F(Camming4Inputs, AStartWhoseConditionsFailIsReported) {
  load_cam();
  start();
  command("EMRG");
  arm_input(9);
  slave().count = 5;
  diagnostics();
  pulse_input();
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_EQ(get("delta1"), 5);
  EXPECT_THAT(diagnostics(), Contains("STARTCAM: by funInp: its conditions do not hold"));
  write("funInp", 44);
  command("ENBL");
  pulse_input();
  EXPECT_THAT(diagnostics(), Contains("funInp: function 44 does nothing"));
}

}  // namespace
}  // namespace drycut::devices::camming4
