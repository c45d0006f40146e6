#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Every function of the inputs (000 1.7) on the normal input, which sees the counts of its sample, and on
/// the interrupt input, which has them latched at the edge; every function of the output (000 1.8).
class Camming4Functions : public Camming4Test, public testing::WithParamInterface<bool> {
 protected:
  bool interrupt() { return GetParam(); }
  std::string mark(int function) {
    return (interrupt() ? "interrupt input " : "normal input ") + std::to_string(function);
  }
  void prepare() {
    does("power pgain=0 feedfw=0 syncrange=999999 blocked=1");
    rows({{154, 1000, 1000}, {137, 1}});
    does("INIT LOOPON posit=0 positm=0 delta1=7000 delta2=-7000 +3");
  }
  int armed() { return get(interrupt() ? "st_intenbl" : "st_enbl"); }
  int done() { return get(interrupt() ? "st_intcapt" : "st_capt"); }
  void arm(int function) {
    write(interrupt() ? "funInt" : "funInp", function);
    does(interrupt() ? "intcapt=2 INTENBL +2" : "inpcapt=2 ENBL +2");
    EXPECT_EQ(armed(), 1);
  }
  /// The axes run on by 40 and 30, the edge comes, they run on by 4 and 3, the device samples.
  void fire() {
    does(interrupt() ? "count+=40 master+=30 rise:5" : "count+=40 master+=30 2.INP03=1");
    does("count+=4 +1*3 2.INP03=0");
    cards.interrupt_lines[5].level = false;
  }
  /// The edge of an armed function, which runs it once.
  void runs(int function) {
    arm(function);
    fire();
    EXPECT_EQ(armed(), 0);
    EXPECT_EQ(done(), 1);
  }
  /// Counts at which the device sees the edge.
  int slave_seen() { return interrupt() ? 40 : 44; }
  int master_seen() { return interrupt() ? 30 : 33; }
};

INSTANTIATE_TEST_SUITE_P(Inputs, Camming4Functions, testing::Bool(),
                         [](const auto& instance) { return instance.param ? "interrupt" : "normal"; });

TEST_P(Camming4Functions, ZeroDoesNothingAndStaysArmed) {
  prepare();
  arm(0);
  fire();
  EXPECT_EQ(armed(), 1);
  EXPECT_EQ(done(), 0);
  shows("delta1=7000 !camex");
  covers({mark(0)});
}

TEST_P(Camming4Functions, OneStopsTheCam) {
  prepare();
  does("forget");
  runs(1);
  shows("still");
  EXPECT_THAT(diagnostics(), Contains(HasSubstr("STOPCAM: by fun")));
  does("STARTCAM");
  arm(1);
  does("+30*10");
  fire();
  shows("!camex !still dec");
  covers({mark(1), "st_dec"});
}

TEST_P(Camming4Functions, TwoNineTenElevenAndTwelveStartTheCam) {
  for (const int function : {2, 9, 10, 11, 12}) {
    SCOPED_TRACE(function);
    prepare();
    runs(function);
    shows("camex");
    // The cam has run since the edge: the axis stood still when it began.
    EXPECT_EQ(get("follerr"), interrupt() ? 44 - 3 : 44);
    EXPECT_EQ(get("delta1"), function == 9 || function == 11 ? slave_seen() : 7000);
    EXPECT_EQ(get("delta2"), function == 10 || function == 12 ? master_seen() : -7000);
    // STOPCAM is blocked for 25 ms, 12 samples, after functions 11 and 12.
    const bool blocks = function >= 11;
    for (int ms = period; ms <= 24; ms += period) {
      if (blocks || ms == 24) command("STOPCAM");
      if (!blocks && ms < 24) tick();
      ASSERT_EQ(get("st_camex"), blocks ? 1 : ms < 24 ? 1 : 0) << ms;
    }
    after("STOPCAM", "!camex");
    covers({mark(function)});
  }
}

TEST_P(Camming4Functions, ThreeAndFourCaptureTheCounts) {
  prepare();
  runs(3);
  EXPECT_EQ(get("delta1"), slave_seen());
  shows("delta2=-7000");
  covers({mark(3), "delta1"});
  prepare();
  runs(4);
  EXPECT_EQ(get("delta2"), master_seen());
  shows("delta1=7000");
  covers({mark(4), "delta2"});
}

TEST_P(Camming4Functions, FiveAndSixCountEvents) {
  prepare();
  for (const int count : {1, 2, 3}) {
    runs(5);
    EXPECT_EQ(get("delta1"), 7000 + count);
  }
  arm(6);
  fire();
  shows("delta2=-6999 delta1=7003");
  covers({mark(5), mark(6)});
}

TEST_P(Camming4Functions, SevenAndEightLoadTheCounts) {
  prepare();
  runs(7);
  EXPECT_EQ(get("encoder"), interrupt() ? 7004 : 7000);
  arm(8);
  fire();
  EXPECT_EQ(get("encoderm"), interrupt() ? -6997 : -7000);
  covers({mark(7), mark(8), "encoder", "encoderm"});
  prepare();
  does("STARTCAM");
  for (const int function : {7, 8}) {
    arm(function);
    does("forget");
    fire();
    EXPECT_THAT(diagnostics(), Contains(HasSubstr(function == 7 ? "encoder: by fun" : "encoderm: by fun")));
  }
  shows("encoder<200 encoderm>-200");
}

TEST_P(Camming4Functions, SevenInAMovementKeepsTheQuotaOfTheTarget) {
  prepare();
  does("setpos=9000 pgain=200 feedfw=1000 blocked=0 START");
  arm(7);
  does("+60");
  fire();
  const std::int64_t to_go = 9000 - get("posit");
  EXPECT_NEAR(static_cast<double>(to_go), 2000, 20);
  const std::int64_t at = count();
  after("until:still", "posit=9000~30");  // the profile itself ends there
  after("+200", "posit=9000~1");
  EXPECT_NEAR(static_cast<double>(count() - at), static_cast<double>(to_go), 1);
}

TEST_P(Camming4Functions, ElevenThatStartsNothingBlocksNothing) {
  prepare();
  does("CALON");
  arm(11);
  fire();
  shows("!camex");
  after("CALOFF STARTCAM", "camex");
  after("STOPCAM", "!camex");
}

TEST_P(Camming4Functions, AnUnknownNumberIsReported) {
  prepare();
  arm(13);
  does("forget");
  fire();
  EXPECT_THAT(diagnostics(), Contains(HasSubstr("function 13 does nothing")));
}

using Camming4Delay = Camming4Test;

TEST_F(Camming4Delay, EachParameterTakesTheSamplesOfTheManual) {
  struct Delay {
    int samples;
    std::vector<const char*> names;
  };
  // 000 1.4
  const Delay delays[] = {
      {1,
       {"codeG1", "codeQs2", "codeQm3", "codeQsa4", "codeQma128", "maxpos", "minpos", "prspos", "prsposm",
        "toll", "tacc", "tdec", "taccmax", "tdecmax", "syncrange", "pgain", "feedfw", "integt", "derivt"}},
      {2, {"tbfm"}},
      {3, {"tbf"}},
      {5, {"maxvel"}},
      {6, {"decpt", "unitvel"}},
      {130, {"pulsem", "measurem"}},
      {139, {"pulse", "measure"}},
      {0, {"codeM1",   "prsvel", "sprsvel", "maxfollerr", "prsmode", "prsmodem", "prsdir",  "mtype",
           "ramptype", "rtype",  "stopt",   "offset",     "posit",   "positm",   "encoder", "encoderm",
           "delta2",   "setvel", "setpos",  "funInp",     "funOut",  "inpcapt"}}};
  does("INIT funInt=5 intcapt=2");
  for (const auto& [count, names] : delays)
    for (const char* name : names) {
      SCOPED_TRACE(name);
      for (const char* each : {"INTENBL", "RSINTCAPT", "RSWRN"}) command(each);
      does("+150");
      const int before = get("delta1");
      write(name, 1);
      does("rise:5");
      int waited = 0;
      for (tick(); get("delta1") == before && waited < 1000; ++waited) tick();
      EXPECT_EQ(waited, count);
      EXPECT_EQ(get("wrncode"), count > 0 ? 8 : 0);
    }
  covers({"warning 8"});
}

TEST_F(Camming4Delay, ADelayedCaptureKeepsTheCountOfItsEdge) {
  does("INIT funInt=3 intcapt=2 INTENBL +3 maxvel=40000 count=500 rise:5");
  for (int i = 0; i < 5; ++i) after("count+=100 +1", "!intcapt");
  after("RSWRN", "intcapt delta1=500 !warning");  // said once
}

// The manual gives the samples of one parameter; of several, one calculation follows the other.
TEST_F(Camming4Delay, RecalculationsFollowEachOther) {
  struct Written {
    std::vector<std::pair<const char*, std::int32_t>> values;
    int samples;
  };
  const std::vector<Written> cases = {
      {{{"maxvel", 40000}, {"tbf", 1}}, 8},                    // 5 + 3
      {{{"tbf", 1}, {"tbf", 2}, {"tbf", 0}}, 3},               // one parameter
      {{{"measure", 2000}, {"pulse", 2000}}, 139},             // one ratio
      {{{"measure", 1000}, {"pulsem", 1000}}, 269},            // two
      {{{"decpt", 1}, {"unitvel", 1}, {"decpt", 0}}, 6},       // one scale
      {{{"codeQm1", 5}, {"codeQs1", 5}, {"codeG2", 130}}, 2},  // two rows
      {{{"toll", 5}, {"pgain", 5}, {"offset", 0}}, 2},
  };
  does("INIT funInt=5 intcapt=2");
  for (const Written& c : cases) {
    SCOPED_TRACE(c.values.front().first);
    for (const char* each : {"INTENBL", "RSINTCAPT", "RSWRN"}) command(each);
    does("+300");
    const int before = get("delta1");
    for (const auto& [name, number] : c.values) write(name, number);
    does("rise:5");
    int waited = 0;
    for (tick(); get("delta1") == before && waited < 1000; ++waited) tick();
    EXPECT_EQ(waited, c.samples);
  }
}

// A program that writes a parameter each scan delays an event by one sample, not for ever.
TEST_F(Camming4Delay, WritesAfterTheEventDoNotDelayItFurther) {
  does("INIT funInt=5 intcapt=2 INTENBL +3");
  int waited = -1;
  does("pgain=100 rise:5");
  for (int i = 0; i < 50 && get("delta1") == 0; ++i, ++waited) {
    write("pgain", 100 + i);
    does("+1");
  }
  EXPECT_EQ(waited, 1);
  shows("delta1=1");
}

TEST_F(Camming4Delay, ADisarmedInputForgetsTheEventThatWaits) {
  after("INIT funInt=5 intcapt=2 INTENBL +3 maxvel=40000 rise:5 +1 INTDSBL INTENBL +20", "delta1=0 intenbl");
}

TEST_F(Camming4Delay, TheWarningOfTheHighestPriorityStays) {
  // 8 (priority 0) stays when 11 (priority 11) comes; 11 goes when 8 comes.
  after("INIT funInt=5 intcapt=2 INTENBL STOPCAM", "wrncode=11");
  after("tbf=1 rise:5 +1", "wrncode=8");
  after("STOPCAM", "wrncode=8");
}

using Camming4Output = Camming4Test;

TEST_F(Camming4Output, FollowsItsFunctionAlone) {
  struct Case {
    int function;
    int codeM;
    bool toll;
    bool tpos;
    bool sync;
    bool on;
  };
  const auto bring = [&](const Case& wanted) {
    does("power");
    set({{"pgain", 0}, {"feedfw", 0}, {"toll", 2}, {"syncrange", wanted.sync ? 999999 : -1}});
    does("blocked=1");
    rows({{154, 1000, 0, 0, 0, wanted.codeM}, {137, 1}});
    does("INIT posit=0 setpos=0 sample");
    if (wanted.toll) {
      does("START +2");
    }
    if (wanted.codeM != 0) command("STARTCAM");
    write("setpos", wanted.tpos ? 2 : 3);
    does("sample");
    EXPECT_EQ(get("st_toll"), wanted.toll ? 1 : 0);
    EXPECT_EQ(get("st_tpos"), wanted.tpos ? 1 : 0);
    EXPECT_EQ(get("st_sync"), wanted.sync && wanted.codeM != 0 ? 1 : 0);
    EXPECT_EQ(get("codeMex"), wanted.codeM);
  };
  for (const Case& wanted :
       {Case{1, 1000, false, true, true, false}, Case{2, 0, false, false, false, true},
        Case{3, 0, true, false, false, true}, Case{3, 0, false, true, false, false},
        Case{4, 0, false, true, false, true}, Case{4, 0, true, false, false, false},
        Case{5, 5, false, false, true, true}, Case{5, 1000, false, true, false, false},
        Case{6, 1000, false, false, false, true}, Case{6, 1001, false, true, true, false},
        Case{7, 1000, false, false, true, true}, Case{7, 1000, false, true, false, false},
        Case{7, 1001, false, true, true, false}, Case{8, 1001, false, false, false, true},
        Case{8, 1000, false, true, true, false}, Case{9, 1002, false, false, false, true},
        Case{9, 1001, false, true, true, false}}) {
    SCOPED_TRACE(wanted.function);
    SCOPED_TRACE(wanted.codeM);
    bring(wanted);
    for (const bool before : {false, true}) {
      cards.outputs.at(*parse_address("2.OUT01")).level = before;
      write("funOut", wanted.function);
      does("sample");
      EXPECT_EQ(output(), wanted.on);
      // 0: the device leaves it alone, whatever was there.
      cards.outputs.at(*parse_address("2.OUT01")).level = before;
      does("funOut=0 sample");
      EXPECT_EQ(output(), before);
    }
    covers({"output " + std::to_string(wanted.function), "output 0", "funOut"});
  }
}

}  // namespace
}  // namespace drycut::devices::camming4
