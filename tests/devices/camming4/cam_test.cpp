#include <gmock/gmock.h>

#include <algorithm>

#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;

class Camming4Cam : public Camming4Test {
 protected:
  /// The table of the manual's introduction (000 1): 565 Um of slave over 700 Um of master.
  void load_introduction() {
    rows({{132, 100, 50, 0, 0, 11},
          {133, 200, 200, 0, 0, 12},
          {134, 160, 120},
          {133, 150, 150},
          {135, 90, 45},
          {136}});
  }
  /// A cam that keeps the slave at the master's speed after 100 Um.
  void load_constant() { rows({{132, 100, 50, 0, 0, 1000}, {133, 1000, 1000, 0, 0, 1001}, {137, 2}}); }
  /// A stiff axis that leaves nearly no following error.
  void stiff() { set({{"pgain", 1000}, {"feedfw", 1000}}); }
};

TEST_F(Camming4Cam, RunsTheIntroductionToTheCount) {
  load_introduction();
  stiff();
  after("INIT LOOPON STARTCAM", "camex still");  // D19
  shows("rowex=1 codeMex=11");
  after("+60*2", "rowex=2 codeMex=12 sync");
  after("+289*2", "rowex=5");
  after("+1*2", "!camex rowex=0 codeMex=0 !sync");
  after("+300", "count=565 posit=565 positm=700 !warning");
}

TEST_F(Camming4Cam, IsStartedOnceOnly) {
  load_constant();
  does("INIT LOOPON STARTCAM +1*10 forget STARTCAM");
  EXPECT_THAT(diagnostics(), Contains("STARTCAM: st_camex is 1, must be 0"));
  shows("rowex=1");
}

TEST_F(Camming4Cam, FeedForwardFollowsTheTheoreticalSpeed) {
  load_constant();
  does("INIT LOOPON STARTCAM +30*10");  // 5000 Um/s, slave as fast as master: a tenth of maxvel
  shows("rowex=2 ffwdreg=3277");
}

TEST_F(Camming4Cam, StopCamLeavesTheMasterWithARamp) {
  load_constant();
  stiff();
  does("INIT LOOPON STARTCAM +100*10");
  const int posit = get("posit");
  after("STOPCAM", "!camex rowex=0 !still dec");
  // From 5000 Um/s with 50000 Um/s2: 0.1 s and 250 Um, whatever the master does.
  after("+48*50", "!still");
  after("+1*50", "still");
  does("+300");
  EXPECT_NEAR(get("posit") - posit, 250, 12);
  shows("!toll");
}

TEST_F(Camming4Cam, GearingTakesANewRatio) {
  rows({{132, 100, 50}, {154, 1000, 1000, 0, 2}});
  after("INIT LOOPON STARTCAM +40*10", "ffwdreg=3277");
  after("codeQs2=500 +2*10", "!error ffwdreg=1638");
  after("codeQm2=500 +1*10", "errcode=5");
}

TEST_F(Camming4Cam, TakesNegativeBytesAsCodes) {
  does("forget");
  write("codeG1", 132 - 256);
  write("codeG2", 254 - 256);
  shows("codeG1=132 codeG2=254 silent");
  says("codeG3=255", {"codeG3: 255 is outside -128..254, taken anyway"});
}

TEST_F(Camming4Cam, PosIsNotWrittenInACam) {
  load_constant();
  does("INIT LOOPON STARTCAM forget");
  for (const char* name : {"posit", "positm", "encoder", "encoderm"}) {
    write(name, 77);
    does("+1");
    EXPECT_THAT(diagnostics(), Contains(std::string(name) + ": st_camex is 1, must be 0"));
  }
}

TEST_F(Camming4Cam, UpdatesCountsWithoutMovingTheAxis) {
  rows({{132, 100, 50}, {133, 100, 100}, {139, 200, 150}, {137, 2}});
  stiff();
  does("INIT LOOPON STARTCAM +200*7");
  // Updates of 200/150 at 200, 300, ... 1400 Um of master: 13.
  shows("rowex=2");
  EXPECT_EQ(get("positm"), 1400 - 13 * 200);
  EXPECT_NEAR(get("posit"), 1350 - 13 * 150, 12);
  shows("count=1350~12");
}

TEST_F(Camming4Cam, AwkwardRatiosDoNotDrift) {
  // Loops of 301 Um master and 100 Um slave; 7 bits for 3 Um and 11 bits for 5 Um, no regulation.
  does("measurem=3 pulsem=7 measure=5 pulse=11 pgain=0 feedfw=0");
  rows({{132, 101, 50}, {134, 100, 0}, {135, 100, 50}, {138}});
  does("INIT LOOPON STARTCAM");
  // 301 Um of master are 2107/3 bits: three loops are 2107 bits.
  const int rounds = 30000;
  for (int i = 0; i < rounds; ++i)
    for (const std::int64_t bits : {60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60,
                                    60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 7})
      tick(bits);
  shows("!error positm=0");
  // The axis stays where it is, so the slave space of all loops is following error.
  EXPECT_EQ(get("follerr"), std::int64_t{rounds} * 3 * 100 * 11 / 5);
}

TEST_F(Camming4Cam, RecoveryIsSuperimposed) {
  rows({{132, 100, 50}, {180, 0, 40}, {133, 2000, 2000}, {135, 100, 50}, {136}});
  does("setvel=1000 tacc=20 tdec=20");
  stiff();
  does("INIT LOOPON STARTCAM +40*5");
  EXPECT_GT(get("ffwdreg"), 1638 + 300);  // 2500 Um/s of the cam and 1000 Um/s beside it
  ASSERT_TRUE(wait("st_camex", 0, 600, 5));
  does("+300");
  EXPECT_NEAR(static_cast<double>(count()), 50 + 40 + 2000 + 50, 1);
}

TEST_F(Camming4Cam, ReadsOutTheJumpCounter) {
  rows({{132, 100, 50}, {133, 100, 100}, {190, 2, 2}, {135, 100, 50}, {136}});
  after("INIT LOOPON STARTCAM +35*10", "codeQma3=2");
  ASSERT_TRUE(wait("st_camex", 0, 600, 10));
  shows("codeQma3=0");
}

TEST_F(Camming4Cam, ChangesMasterInMidCam) {
  load_constant();
  stiff();
  does("INIT LOOPON STARTCAM +30*10 mtype=1 +1*10");
  const int posit = get("positm");
  for (int i = 0; i < 20; ++i) after("master_b+=10 +1*-3", "ffwdreg=3277");
  EXPECT_EQ(get("positm"), posit + 200);
}

TEST_F(Camming4Cam, OutputFollowsItsFunction) {
  load_constant();
  does("INIT LOOPON");
  const auto with = [&](int function) {
    write("funOut", function);
    does("+1");
    return output();
  };
  EXPECT_TRUE(with(2));
  EXPECT_TRUE(with(0));  // not driven: it stays
  EXPECT_FALSE(with(1));
  EXPECT_FALSE(with(0));
  EXPECT_FALSE(with(3));
  EXPECT_TRUE(with(4));
  EXPECT_FALSE(with(5));
  does("STARTCAM");
  EXPECT_TRUE(with(5));
  EXPECT_TRUE(with(6));
  EXPECT_TRUE(with(7));
  EXPECT_FALSE(with(8));
  EXPECT_FALSE(with(9));
  after("+20*10", "codeMex=1001");
  EXPECT_TRUE(with(8));
  EXPECT_FALSE(with(6));
  does("syncrange=-1");
  EXPECT_FALSE(with(7));
}

}  // namespace
}  // namespace drycut::devices::camming4
