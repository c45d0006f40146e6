#include <gmock/gmock.h>

#include "devices/camming4/camming4.hpp"
#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// PID with feed-forward, calibration and the DAC (002 1.2.2-1.2.4, 1.3.1; spec 5.2). The unit of error is 100
// bits, the way of maxvel in one TCamp.
class EpicposRegulation : public PositionerTest {
 protected:
  /// Closes the loop on a blocked axis and turns it `bits` away.
  void disturb(std::int64_t bits) {
    blocked = true;
    start();
    count() += bits;
    sample();
  }
};

TEST_F(EpicposRegulation, ProportionalGainOf1000GivesTenVoltsAtTheUnitOfError) {
  covers({"pgain", "propreg", "follerr"});
  write("pgain", 1000);
  disturb(-100);
  EXPECT_EQ(get("follerr"), 100);
  EXPECT_EQ(get("propreg"), 32767);
  EXPECT_EQ(word(), 32767);
  count() += 150;
  sample();
  EXPECT_EQ(get("follerr"), -50);
  EXPECT_EQ(word(), -16384);
  write("pgain", 10);
  sample();
  EXPECT_EQ(word(), -164);  // 1 %
}

TEST_F(EpicposRegulation, FeedForwardOf1000GivesTenVoltsAtMaxvel) {
  covers({"feedfw", "ffwdreg"});
  set({{"pgain", 0}, {"setvel", 50000}, {"taccdec", 10}});
  start();
  command("MANFW");
  ticks(100);
  EXPECT_EQ(get("ffwdreg"), 32767);
  EXPECT_EQ(word(), 32767);
  write("feedfw", 985);
  tick();
  EXPECT_EQ(get("ffwdreg"), 32275);  // 98.5 %
  write("feedfw", 2000);
  tick();
  EXPECT_EQ(word(), 32767);  // the DAC ends at 10 V
}

TEST_F(EpicposRegulation, TheIntegralGrowsToItsRangeOf1024) {
  covers({"integt", "integ"});
  set({{"pgain", 0}, {"integt", 1000}});
  disturb(-10);
  // Each 2 ms sample of 1000 ms adds 0.1 * 32767 * 2 / 1000 bits.
  EXPECT_EQ(get("integ"), 7);
  ticks(9);
  EXPECT_EQ(get("integ"), 66);
  ticks(1000);
  EXPECT_EQ(get("integ"), 1024);
  EXPECT_EQ(word(), 1024);
  count() += 20;
  ticks(2000);
  EXPECT_EQ(get("integ"), -1024);
  command("LOOPON");
  EXPECT_EQ(get("integ"), 0);
}

TEST_F(EpicposRegulation, TheDerivativeActsOnAChangeOnlyUpTo1024) {
  covers({"derivt", "derreg"});
  set({{"pgain", 0}, {"derivt", 2}});
  disturb(0);
  count() -= 1;
  sample();
  EXPECT_EQ(get("derreg"), 328);  // one bit in one TCamp
  sample();
  EXPECT_EQ(get("derreg"), 0);
  count() -= 50;
  sample();
  EXPECT_EQ(get("derreg"), 1024);
  EXPECT_EQ(word(), 1024);
  count() += 70;
  sample();
  EXPECT_EQ(get("derreg"), -1024);
}

TEST_F(EpicposRegulation, OffsetIsAlwaysAdded) {
  covers({"offset"});
  write("offset", -150);
  start();
  EXPECT_EQ(word(), -150);
  command("LOOPOFF");
  EXPECT_EQ(word(), -150);
  command("CALON");
  EXPECT_EQ(word(), -150);
  write("offset", -32768);
  sample();
  EXPECT_EQ(word(), -32767);
}

TEST_F(EpicposRegulation, AnOpenLoopDoesNotReact) {
  covers({"st_loopon", "LOOPON accepted", "LOOPOFF accepted"});
  disturb(-40);
  ASSERT_NE(word(), 0);
  command("LOOPOFF");
  EXPECT_EQ(get("st_loopon"), 0);
  EXPECT_EQ(word(), 0);
  command("LOOPON");
  EXPECT_EQ(get("st_loopon"), 1);
  EXPECT_EQ(get("follerr"), 0);
  EXPECT_EQ(word(), 0);
  count() -= 40;
  sample();
  ASSERT_NE(word(), 0);
  command("LOOPON");  // again: the error is forgotten again
  EXPECT_EQ(get("follerr"), 0);
}

TEST_F(EpicposRegulation, OpenLoopMovementsBeginWhereTheAxisStands) {
  command("INIT");
  count() += 700;  // by hand
  ticks(2);
  ASSERT_TRUE(place(1000));
  EXPECT_NEAR(get("posit"), 1000, 2);  // the ideal axis does what the feed-forward says
  command("MANFW");
  ticks(100);
  command("STOP");
  EXPECT_TRUE(wait("st_still", 1));
}

TEST_F(EpicposRegulation, FollowingErrorIsHeldFor500Milliseconds) {
  covers({"maxfollerr", "st_foller"});
  write("maxfollerr", 30);
  disturb(-30);
  EXPECT_EQ(get("st_foller"), 0);
  count() -= 1;
  sample();
  EXPECT_EQ(get("st_foller"), 1);
  count() += 1;
  for (int i = 0; i < 249; ++i) {
    sample();
    ASSERT_EQ(get("st_foller"), 1) << i;
  }
  sample();
  EXPECT_EQ(get("st_foller"), 0);
  EXPECT_EQ(get("st_still"), 1);
}

TEST_F(EpicposRegulation, CalibrationIsAVoltageSource) {
  covers({"vout", "st_cal", "CALON accepted", "CALOFF accepted"});
  start();
  write("vout", 50);
  sample();
  EXPECT_THAT(diagnostics(), ElementsAre("vout: st_cal is 0, must be 1"));
  command("CALON");
  EXPECT_EQ(get("st_cal"), 1);
  EXPECT_EQ(word(), 0);
  for (const auto& [tenths, bits] : {std::pair{5, 1638}, {-100, -32767}, {100, 32767}}) {
    write("vout", tenths);
    sample();
    EXPECT_EQ(word(), bits);
  }
  EXPECT_THAT(diagnostics(), IsEmpty());
  ticks(50);
  EXPECT_GT(get("posit"), 4000);
  command("CALOFF");
  EXPECT_EQ(get("st_cal"), 0);
  EXPECT_EQ(get("follerr"), 0);
  const int there = get("posit");
  ticks(20);
  EXPECT_NEAR(get("posit"), there, 1);
}

TEST_F(EpicposRegulation, RegoffLeavesTheDacAsItStands) {
  covers({"st_regoff", "REGOFF accepted", "REGON accepted"});
  write("pgain", 1000);
  disturb(-20);
  const int last = word();
  ASSERT_GT(last, 6000);
  command("REGOFF");
  EXPECT_EQ(get("st_regoff"), 1);
  count() -= 200;
  ticks(5);
  EXPECT_EQ(word(), last);
  EXPECT_EQ(get("posit"), -220);  // it counts on
  cards.analogue_outputs.begin()->second.word = 123;
  sample();
  EXPECT_EQ(word(), 123);  // the DAC is free for another device
  command("REGON");
  EXPECT_EQ(get("st_regoff"), 0);
  EXPECT_EQ(word(), 0);  // it reacts where it stands
}

// Several axes on one DAC (002 1.3.1).
class EpicposSharedDac : public EpicposRegulation {
 protected:
  static constexpr const char* warning =
      "another device regulates on the same analogue output; of devices that share one, all but one need "
      "REGOFF";
  static Resources record(std::size_t fields, std::size_t dac) {
    Resources resources(fields);
    resources[0].number = period;
    resources[dac].address = parse_address("2.AN01");
    return resources;
  }
  std::unique_ptr<Device> second = make_epicpos(record(5, 4), cards);
  void give(Device& to, const char* name) { to.command(find_command(to.type(), name).value()); }
  void both() {
    device->sample();
    second->sample();
  }
  std::vector<std::string> said_by(Device& other) {
    std::vector<std::string> said;
    for (const Diagnostic& diagnostic : other.take_diagnostics())
      said.push_back(diagnostic.subject + ": " + diagnostic.text);
    return said;
  }
};

TEST_F(EpicposSharedDac, TurnsAreInOrder) {
  give(*device, "INIT");
  give(*device, "REGOFF");
  give(*second, "INIT");
  give(*second, "REGOFF");
  both();
  for (int i = 0; i < 3; ++i) {
    give(*device, "REGON");
    both();
    both();
    // The same turn of the program hands it over, and back: the order of sampling does not matter.
    give(*device, "REGOFF");
    give(*second, "REGON");
    both();
    both();
    give(*second, "REGOFF");
    give(*device, "REGON");
    both();
    both();
    give(*device, "REGOFF");
    both();
  }
  EXPECT_THAT(diagnostics(), IsEmpty());
  EXPECT_THAT(said_by(*second), IsEmpty());
}

TEST_F(EpicposSharedDac, TwoAtOnceAreReportedOnce) {
  give(*device, "INIT");
  give(*second, "INIT");
  for (int i = 0; i < 10; ++i) both();
  EXPECT_THAT(diagnostics(), IsEmpty());
  EXPECT_THAT(said_by(*second), ElementsAre(std::string("IOutA: ") + warning));
  give(*second, "REGOFF");
  both();
  give(*second, "REGON");
  for (int i = 0; i < 10; ++i) both();
  EXPECT_THAT(said_by(*second), ElementsAre(std::string("IOutA: ") + warning));
  device->power_up();
  for (int i = 0; i < 10; ++i) both();
  EXPECT_THAT(said_by(*second), IsEmpty());
  give(*device, "INIT");
  for (int i = 0; i < 10; ++i) both();
  EXPECT_THAT(diagnostics(), ElementsAre(std::string("IOutA: ") + warning));  // now it is the second
}

TEST_F(EpicposSharedDac, Camming4TakesPart) {
  const auto cam = camming4::make_camming4(record(12, 10), cards);
  const auto all = [&] {
    device->sample();
    cam->sample();
  };
  give(*device, "INIT");
  give(*cam, "INIT");
  for (int i = 0; i < 5; ++i) all();
  EXPECT_THAT(said_by(*cam), ElementsAre(std::string("IoutA: ") + warning));
  give(*cam, "REGOFF");
  all();
  give(*device, "CALON");
  all();
  write("vout", 30);
  all();
  EXPECT_EQ(word(), 9830);  // CAMMING4 leaves it alone
  give(*device, "REGOFF");
  all();
  give(*cam, "REGON");
  for (int i = 0; i < 3; ++i) all();
  EXPECT_EQ(word(), 0);
  EXPECT_THAT(said_by(*cam), IsEmpty());
  EXPECT_THAT(diagnostics(), IsEmpty());
}

}  // namespace
}  // namespace drycut::devices::epicpos
