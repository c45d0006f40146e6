#include <gmock/gmock.h>

#include <algorithm>

#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

class Camming4Cam : public Camming4Test {
 protected:
  /// The table of the manual's introduction (000 1): 565 Um of slave over 700 Um of master.
  void load_introduction() {
    row(1, {132, 100, 50, 0, 0, 11});
    row(2, {133, 200, 200, 0, 0, 12});
    row(3, {134, 160, 120});
    row(4, {133, 150, 150});
    row(5, {135, 90, 45});
    row(6, {136});
  }
  /// A cam that keeps the slave at the master's speed after 100 Um.
  void load_constant() {
    row(1, {132, 100, 50, 0, 0, 1000});
    row(2, {133, 1000, 1000, 0, 0, 1001});
    row(3, {137, 2});
  }
  /// A stiff axis that leaves nearly no following error.
  void stiff() { set({{"pgain", 1000}, {"feedfw", 1000}}); }
};

TEST_F(Camming4Cam, RunsTheIntroductionToTheCount) {
  load_introduction();
  stiff();
  start();
  command("STARTCAM");
  EXPECT_EQ(get("st_camex"), 1);
  EXPECT_EQ(get("st_still"), 1);  // D19
  EXPECT_EQ(get("rowex"), 1);
  EXPECT_EQ(get("codeMex"), 11);
  ticks(60, 2);
  EXPECT_EQ(get("rowex"), 2);
  EXPECT_EQ(get("codeMex"), 12);
  EXPECT_EQ(get("st_sync"), 1);
  ticks(289, 2);
  EXPECT_EQ(get("rowex"), 5);
  tick(2);
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_EQ(get("rowex"), 0);
  EXPECT_EQ(get("codeMex"), 0);
  EXPECT_EQ(get("st_sync"), 0);
  ticks(300);
  EXPECT_EQ(slave().count, 565);
  EXPECT_EQ(get("posit"), 565);
  EXPECT_EQ(get("positm"), 700);
  EXPECT_EQ(get("st_warning"), 0);
}

TEST_F(Camming4Cam, IsStartedOnceOnly) {
  load_constant();
  start();
  command("STARTCAM");
  tick(10);
  diagnostics();
  command("STARTCAM");
  EXPECT_THAT(diagnostics(), Contains("STARTCAM: st_camex is 1, must be 0"));
  EXPECT_EQ(get("rowex"), 1);
}

TEST_F(Camming4Cam, FeedForwardFollowsTheTheoreticalSpeed) {
  load_constant();
  start();
  command("STARTCAM");
  ticks(30, 10);  // 5000 Um/s, slave as fast as master: a tenth of maxvel
  EXPECT_EQ(get("rowex"), 2);
  EXPECT_EQ(get("ffwdreg"), 3277);
}

TEST_F(Camming4Cam, StopCamLeavesTheMasterWithARamp) {
  load_constant();
  stiff();
  start();
  command("STARTCAM");
  ticks(100, 10);
  const int posit = get("posit");
  command("STOPCAM");
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_EQ(get("rowex"), 0);
  EXPECT_EQ(get("st_still"), 0);
  EXPECT_EQ(get("st_dec"), 1);
  // From 5000 Um/s with 50000 Um/s2: 0.1 s and 250 Um, whatever the master does.
  ticks(48, 50);
  EXPECT_EQ(get("st_still"), 0);
  tick(50);
  EXPECT_EQ(get("st_still"), 1);
  ticks(300);
  EXPECT_NEAR(get("posit") - posit, 250, 12);
  EXPECT_EQ(get("st_toll"), 0);
}

TEST_F(Camming4Cam, EmergencyEndsTheCam) {
  load_constant();
  start();
  command("STARTCAM");
  ticks(30, 10);
  command("EMRG");
  EXPECT_EQ(word(), 0);
  EXPECT_EQ(get("st_camex"), 0);
  command("RESUME");
  ticks(10, 10);
  EXPECT_EQ(get("st_camex"), 0);
  command("STARTCAM");
  EXPECT_EQ(get("rowex"), 1);
}

TEST_F(Camming4Cam, GearingTakesANewRatio) {
  row(1, {132, 100, 50});
  row(2, {154, 1000, 1000, 0, 2});
  start();
  command("STARTCAM");
  ticks(40, 10);
  EXPECT_EQ(get("ffwdreg"), 3277);
  write("codeQs2", 500);
  ticks(2, 10);
  EXPECT_EQ(get("st_error"), 0);
  EXPECT_EQ(get("ffwdreg"), 1638);
  write("codeQm2", 500);
  tick(10);
  EXPECT_EQ(get("errcode"), 5);
}

TEST_F(Camming4Cam, TakesNegativeBytesAsCodes) {
  diagnostics();
  write("codeG1", 132 - 256);
  write("codeG2", 254 - 256);
  EXPECT_EQ(get("codeG1"), 132);
  EXPECT_EQ(get("codeG2"), 254);
  EXPECT_THAT(diagnostics(), IsEmpty());
  write("codeG3", 255);
  EXPECT_THAT(diagnostics(), ElementsAre("codeG3: 255 is outside -128..254, taken anyway"));
}

TEST_F(Camming4Cam, PosIsNotWrittenInACam) {
  load_constant();
  start();
  command("STARTCAM");
  diagnostics();
  for (const char* name : {"posit", "positm", "encoder", "encoderm"}) {
    write(name, 77);
    tick();
    EXPECT_THAT(diagnostics(), Contains(std::string(name) + ": st_camex is 1, must be 0"));
  }
}

TEST_F(Camming4Cam, UpdatesCountsWithoutMovingTheAxis) {
  row(1, {132, 100, 50});
  row(2, {133, 100, 100});
  row(3, {139, 200, 150});
  row(4, {137, 2});
  stiff();
  start();
  command("STARTCAM");
  ticks(200, 7);
  // Updates of 200/150 at 200, 300, ... 1400 Um of master: 13.
  EXPECT_EQ(get("rowex"), 2);
  EXPECT_EQ(get("positm"), 1400 - 13 * 200);
  EXPECT_NEAR(get("posit"), 1350 - 13 * 150, 12);
  EXPECT_NEAR(static_cast<double>(slave().count), 1350, 12);
}

TEST_F(Camming4Cam, AwkwardRatiosDoNotDrift) {
  // Loops of 301 Um master and 100 Um slave; 7 bits for 3 Um and 11 bits for 5 Um, no regulation.
  set({{"measurem", 3}, {"pulsem", 7}, {"measure", 5}, {"pulse", 11}, {"pgain", 0}, {"feedfw", 0}});
  row(1, {132, 101, 50});
  row(2, {134, 100, 0});
  row(3, {135, 100, 50});
  row(4, {138});
  start();
  command("STARTCAM");
  // 301 Um of master are 2107/3 bits: three loops are 2107 bits.
  const int rounds = 30000;
  for (int i = 0; i < rounds; ++i)
    for (const std::int64_t bits : {60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60,
                                    60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 60, 7})
      tick(bits);
  EXPECT_EQ(get("st_error"), 0);
  EXPECT_EQ(get("positm"), 0);
  // The axis stays where it is, so the slave space of all loops is following error.
  EXPECT_EQ(get("follerr"), std::int64_t{rounds} * 3 * 100 * 11 / 5);
}

TEST_F(Camming4Cam, RecoveryIsSuperimposed) {
  row(1, {132, 100, 50});
  row(2, {180, 0, 40});
  row(3, {133, 2000, 2000});
  row(4, {135, 100, 50});
  row(5, {136});
  set({{"setvel", 1000}, {"tacc", 20}, {"tdec", 20}});
  stiff();
  start();
  command("STARTCAM");
  ticks(40, 5);
  EXPECT_GT(get("ffwdreg"), 1638 + 300);  // 2500 Um/s of the cam and 1000 Um/s beside it
  ASSERT_TRUE(wait("st_camex", 0, 600, 5));
  ticks(300);
  EXPECT_NEAR(static_cast<double>(slave().count), 50 + 40 + 2000 + 50, 1);
}

TEST_F(Camming4Cam, ReadsOutTheJumpCounter) {
  row(1, {132, 100, 50});
  row(2, {133, 100, 100});
  row(3, {190, 2, 2});
  row(4, {135, 100, 50});
  row(5, {136});
  start();
  command("STARTCAM");
  ticks(35, 10);
  EXPECT_EQ(get("codeQma3"), 2);
  ASSERT_TRUE(wait("st_camex", 0, 600, 10));
  EXPECT_EQ(get("codeQma3"), 0);
}

TEST_F(Camming4Cam, ChangesMasterInMidCam) {
  load_constant();
  stiff();
  start();
  command("STARTCAM");
  ticks(30, 10);
  write("mtype", 1);
  tick(10);
  const int posit = get("positm");
  for (int i = 0; i < 20; ++i) {
    master_b().count += 10;
    tick(-3);
    EXPECT_EQ(get("ffwdreg"), 3277);
  }
  EXPECT_EQ(get("positm"), posit + 200);
}

TEST_F(Camming4Cam, OutputFollowsItsFunction) {
  load_constant();
  start();
  const auto with = [&](int function) {
    write("funOut", function);
    tick();
    return output();
  };
  EXPECT_TRUE(with(2));
  EXPECT_TRUE(with(0));  // not driven: it stays
  EXPECT_FALSE(with(1));
  EXPECT_FALSE(with(0));
  EXPECT_FALSE(with(3));
  EXPECT_TRUE(with(4));
  EXPECT_FALSE(with(5));
  command("STARTCAM");
  EXPECT_TRUE(with(5));
  EXPECT_TRUE(with(6));
  EXPECT_TRUE(with(7));
  EXPECT_FALSE(with(8));
  EXPECT_FALSE(with(9));
  ticks(20, 10);
  EXPECT_EQ(get("codeMex"), 1001);
  EXPECT_TRUE(with(8));
  EXPECT_FALSE(with(6));
  write("syncrange", -1);
  EXPECT_FALSE(with(7));
}

}  // namespace
}  // namespace drycut::devices::camming4
