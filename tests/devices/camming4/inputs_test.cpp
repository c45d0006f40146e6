#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;
using testing::HasSubstr;

class Camming4Inputs : public Camming4Test {
 public:
  void load_cam() { rows({{132, 100, 50}, {133, 1000, 1000}, {137, 2}}); }
};

TEST_F(Camming4Inputs, ShowsTheInterruptLine) {
  after("INIT rise:5 +1", "int");
  after("fall:5 +1", "!int");
}

TEST_F(Camming4Inputs, CapturesOnceOnTheArmedEdge) {
  after("INIT count=42 funInp=3 inpcapt=2 ENBL", "enbl");
  after("2.INP03=1 +1 2.INP03=0", "delta1=42 !enbl capt");
  after("count=50 +1 2.INP03=1 +1 2.INP03=0", "delta1=42");
  after("RSCAPT", "!capt");
  covers({"normal input 3", "funInp"});
}

TEST_F(Camming4Inputs, TakesTheFallingEdgeToo) {
  after("INIT funInp=5 inpcapt=1 ENBL 2.INP03=1 +1", "delta1=0");
  after("2.INP03=0 +1", "delta1=1");
  covers({"inpcapt"});
}

TEST_F(Camming4Inputs, MayBeArmedBeforeTheEdgeIsChosen) {
  // 000 1.9.5 asks ENBL and INTENBL for st_init alone; INTDSBL for an edge too.
  after("INIT funInp=5 funInt=6 forget ENBL INTENBL", "silent enbl intenbl");
  after("2.INP03=1 +1 2.INP03=0 rise:5 +1", "!capt");  // no edge is chosen yet
  shows("!intcapt");
  after("INTDSBL", "intenbl");
  EXPECT_THAT(diagnostics(), Contains("INTDSBL: needs intcapt > 0"));
  after("inpcapt=2 intcapt=2 +1 2.INP03=1 +1 2.INP03=0 rise:5 +1", "delta1=1 delta2=1 !enbl !intenbl");
  covers({"INTDSBL refused", "inpcapt"});
}

TEST_F(Camming4Inputs, ADisarmedInputDoesNothing) {
  after("INIT funInp=5 inpcapt=2 ENBL DSBL 2.INP03=1 +1 2.INP03=0", "delta1=0 !capt");
  after("funInt=5 intcapt=2 INTENBL +2 INTDSBL rise:5 +1", "delta1=0");
  after("funInt=0 intcapt=2 INTENBL +2 rise:5 +1", "!intcapt");
  covers({"interrupt input 0"});
}

TEST_F(Camming4Inputs, LatchesTheExactCountAtTheEdge) {
  after("INIT funInt=3 intcapt=2 INTENBL +2 count=1003 rise:5 count=1010 +1",
        "delta1=1003 encoder=1010 !intenbl intcapt");
  after("RSINTCAPT", "!intcapt");
  after("CNTREVM funInt=4 intcapt=1 INTENBL +2 master=7 fall:5 master=20 +1", "delta2=-7");
  covers({"funInt", "intcapt", "interrupt input 3", "interrupt input 4"});
}

TEST_F(Camming4Inputs, LoadsCountsAtTheEdge) {
  after("INIT delta1=500 delta2=-30 funInt=7 intcapt=2 INTENBL +2 count=100 rise:5 count=104 +1",
        "posit=504");
  after("funInp=8 inpcapt=2 ENBL 2.INP03=1 +1 2.INP03=0", "positm=-30");
  covers({"interrupt input 7", "normal input 8"});
}

TEST_F(Camming4Inputs, CountsEvents) {
  does("INIT delta2=2147483647");
  for (int i = 0; i < 3; ++i) does("funInp=5 inpcapt=2 ENBL 2.INP03=1 +1 2.INP03=0 +1");
  shows("delta1=3");
  does("funInp=6 inpcapt=2 ENBL 2.INP03=1 +1 2.INP03=0");
  EXPECT_EQ(get("delta2"), -2147483647 - 1);
}

TEST_F(Camming4Inputs, StartsTheCamFromTheLatchedCount) {
  load_cam();
  // The master is 30 Um on at the sample.
  after("INIT LOOPON funInt=10 intcapt=2 INTENBL +2 master=1000 rise:5 +1*30", "delta2=1000 camex");
  does("blocked=1 +17*10");  // 200 Um in all: 50 + 100
  EXPECT_EQ(get("follerr") + get("posit"), 150);
  covers({"interrupt input 10"});
}

TEST_F(Camming4Inputs, ARecalculationDelaysTheEvent) {
  load_cam();
  does("INIT LOOPON funInt=2 intcapt=2 INTENBL +2 maxvel=40000");  // 5 samples
  after("rise:5 +1*10", "!camex wrncode=8");
  after("+4*10", "!camex");
  after("+1*10", "camex");
  // Its origin is the present count, not the latched one: row 1 ends 100 Um from here.
  after("+9*10", "rowex=1");
  after("+1*10", "rowex=2");
  covers({"warning 8", "interrupt input 2"});
}

TEST_F(Camming4Inputs, StopCamIsInhibitedAfterFunctionEleven) {
  load_cam();
  after("INIT LOOPON funInp=11 inpcapt=2 ENBL 2.INP03=1 +1 2.INP03=0", "camex");
  for (int ms = 2; ms < 24; ms += 2) {
    does("STOPCAM");
    ASSERT_EQ(get("st_camex"), 1) << ms;
  }
  EXPECT_THAT(diagnostics(), Contains(HasSubstr("STOPCAM: needs 25 ms")));
  after("+2 STOPCAM", "!camex");
}

TEST_F(Camming4Inputs, AnInputStopsTheCam) {
  load_cam();
  after("INIT LOOPON funInp=1 inpcapt=2 ENBL 2.INP03=1 +1 2.INP03=0", "still");
  after("STARTCAM +20*10 ENBL! +1*10 2.INP03=1 +1*10 2.INP03=0", "!camex !still");
}

TEST_F(Camming4Inputs, AStartWhoseConditionsFailIsReported) {
  load_cam();
  after("INIT LOOPON EMRG funInp=9 inpcapt=2 ENBL count=5 forget 2.INP03=1 +1 2.INP03=0", "!camex delta1=5");
  EXPECT_THAT(diagnostics(), Contains("STARTCAM: by funInp: its conditions do not hold"));
  does("funInp=44 ENBL 2.INP03=1 +1 2.INP03=0");
  EXPECT_THAT(diagnostics(), Contains("funInp: function 44 does nothing"));
}

}  // namespace
}  // namespace drycut::devices::camming4
