// The order of events of a cam, tick by tick (003 4).
#include "tests/devices/lx3vp/bench.hpp"
#include "tests/devices/lx3vp/covers.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Lx3vpSequence, EnablingConfiguresAndWordFiveStarts) {
  CamBench bench;
  bench.set(word::start, 0);
  bench.enable();
  bench.move(500);
  EXPECT_EQ(bench.get(word::version), 1);
  EXPECT_EQ(bench.get(word::status), 0);
  EXPECT_EQ(bench.output(), 0);

  bench.set(word::start, 1);
  bench.move(500);  // takes the block
  EXPECT_TRUE(bench.flag(status::cyclic, status::initialised));
  bench.move(500);  // ready
  EXPECT_TRUE(bench.flag(status::initialised));
  EXPECT_EQ(bench.move(500), 0);  // the master's counts begin here
  EXPECT_EQ(bench.move(7), 7);
  EXPECT_EQ(bench.get_wide(word::master_position), 7);
  covers({"word 0", "word 5", "word 1 bit 0", "word 1 bit 6"});
}

TEST(Lx3vpSequence, ACyclicCamRepeatsItsTableAndSumsUp) {
  CamBench bench;
  bench.table({{0, 0}, {600, 100}, {1000, 250}});
  bench.start(1);
  EXPECT_EQ(bench.travel(1300), 250 + 50);
  EXPECT_THAT(bench.wide_words(
                  {word::master_position, word::slave_position, word::slave_pulses, word::master_counts}),
              ElementsAre(300, 50, 50, 1300));
  EXPECT_TRUE(bench.flag(status::completed | status::cycle_completed));
  covers({"word 19", "word 21", "word 25", "word 27", "word 38", "word 40", "word 42", "word 39"});
}

TEST(Lx3vpSequence, OnlyTheProgramResetsTheCompletedBits) {
  CamBench bench;
  bench.table({{0, 0}, {1000, 10}});
  bench.start(1);
  bench.travel(999);
  EXPECT_TRUE(bench.flag(0, status::completed | status::cycle_completed));
  bench.move(1);
  EXPECT_TRUE(bench.flag(status::completed | status::cycle_completed));
  bench.move(1);
  EXPECT_TRUE(bench.flag(status::completed | status::cycle_completed));
  bench.set(word::status, bench.get(word::status) & ~static_cast<int>(status::completed));
  bench.move(1);
  EXPECT_TRUE(bench.flag(status::cycle_completed, status::completed));
  bench.set(word::status, 0);  // what the cam writes itself comes back, what the program may reset does not
  bench.move(1);
  EXPECT_EQ(bench.get(word::status), static_cast<int>(status::cyclic));
  bench.travel(1000);
  EXPECT_TRUE(bench.flag(status::completed | status::cycle_completed));
  covers({"word 1 bit 1", "word 1 bit 9", "word 1"});
}

TEST(Lx3vpSequence, WordFiveStopsAtOnceWithoutLosingItsPlace) {
  CamBench bench(1);
  bench.travel(300);
  bench.set(word::start, 0);
  EXPECT_EQ(bench.travel(300), 300);
  EXPECT_TRUE(bench.flag(0, status::initialised | status::cyclic));
  EXPECT_THAT(bench.wide_words({word::master_position, word::slave_pulses}), ElementsAre(300, 300));
}

TEST(Lx3vpSequence, ARestartNeedsMoreThanATickOfZero) {
  CamBench bench(1);
  bench.travel(300);
  bench.set(word::start, 0);
  bench.tick();
  bench.set(word::start, 1);
  bench.tick(10);
  EXPECT_FALSE(bench.flag(status::cyclic));
  bench.set(word::start, 0);
  bench.tick(2);
  bench.set(word::start, 1);
  bench.tick();
  EXPECT_TRUE(bench.flag(status::cyclic));
}

TEST(Lx3vpSequence, AChangeOfModeNeedsAStop) {
  CamBench bench(1);
  bench.set(word::start, 2);
  bench.tick(10);
  EXPECT_TRUE(bench.flag(status::cyclic, status::non_cyclic));
  EXPECT_EQ(bench.travel(2500), 2500);
  bench.set(word::start, 0);
  bench.tick(2);
  bench.set(word::start, 2);
  bench.tick();
  EXPECT_TRUE(bench.flag(status::non_cyclic, status::cyclic));
  bench.set(word::start, 3);  // any other value stops
  bench.tick();
  EXPECT_FALSE(bench.flag(status::non_cyclic));
  covers({"word 1 bit 7"});
}

TEST(Lx3vpSequence, StopAfterCycleEndsExactlyAtTheEndOfTheCycle) {
  CamBench bench(1);
  bench.travel(1900);
  bench.set(word::live, live::stop_after_cycle);
  EXPECT_EQ(bench.travel(90), 1990);
  EXPECT_EQ(bench.travel(90), 2000);
  EXPECT_EQ(bench.get_wide(word::master_position), 1000);
  EXPECT_TRUE(bench.flag(status::completed | status::cycle_completed, status::initialised | status::cyclic));
  EXPECT_EQ(bench.travel(500), 2000);
  // Word 5 has to be 0 before the next start.
  bench.set(word::live, 0);
  bench.tick(100);
  EXPECT_FALSE(bench.flag(status::cyclic));
  bench.restart(1);
  EXPECT_EQ(bench.move(5), 2005);
  covers({"word 4", "word 4 bit 1"});
}

TEST(Lx3vpSequence, StopAfterCycleHoldsBackwardsToo) {
  CamBench bench(1);
  bench.travel(-300);
  EXPECT_EQ(bench.tick(), -300);  // the direction changes a tick before the pulses
  bench.set(word::live, live::stop_after_cycle);
  EXPECT_EQ(bench.travel(-900), -1000);
}

TEST(Lx3vpSequence, ANonCyclicCamWaitsForItsSignal) {
  CamBench bench(2, function::external_start);
  EXPECT_TRUE(bench.flag(status::initialised | status::non_cyclic));
  EXPECT_EQ(bench.travel(400), 0);
  bench.trigger();
  EXPECT_EQ(bench.travel(400), 400);
  bench.trigger();  // while it runs a signal is nothing
  EXPECT_EQ(bench.travel(800), 1000);
  EXPECT_EQ(bench.get_wide(word::master_position), 1000);
  EXPECT_TRUE(
      bench.flag(status::completed | status::cycle_completed | status::non_cyclic, status::initialised));
  covers({"word 3", "word 3 bit 5"});
}

TEST(Lx3vpSequence, ASignalThatIsOnAlreadyIsNoStart) {
  CamBench bench;
  bench.set(word::function, function::external_start);
  bench.inputs[CamBench::start_input] = true;
  bench.start(2);
  EXPECT_EQ(bench.travel(400), 0);
  bench.inputs[CamBench::start_input] = false;
  bench.tick();
  bench.trigger();
  EXPECT_EQ(bench.travel(400), 400);
}

TEST(Lx3vpSequence, TheSignalMayBeARelay) {
  CamBench bench;
  bench.operands.start = {false, 20};
  bench.set(word::function, function::external_start);
  bench.start(2);
  bench.trigger();
  EXPECT_EQ(bench.move(10), 0);
  bench.registers.m[20] = true;
  bench.tick();
  EXPECT_EQ(bench.move(10), 10);
}

TEST(Lx3vpSequence, FiveMillisecondsLieBetweenTwoRuns) {
  CamBench bench;
  bench.table({{0, 0}, {1000, 10}});
  bench.set(word::function, function::external_start);
  bench.start(2);
  bench.trigger();
  EXPECT_EQ(bench.move(1500), 10);
  bench.tick(48);
  bench.trigger();  // 4.9 ms after the end
  bench.move(100);
  EXPECT_TRUE(bench.flag(status::initialised)) << "armed again at 5 ms";
  EXPECT_EQ(bench.output(), 10);
  bench.trigger();
  EXPECT_EQ(bench.move(100), 11);

  CamBench second;
  second.table({{0, 0}, {1000, 10}});
  second.set(word::function, function::external_start);
  second.start(2);
  second.trigger();
  second.move(1500);
  second.tick(49);
  EXPECT_FALSE(second.flag(status::initialised));
  second.trigger();  // 5.0 ms after the end
  EXPECT_EQ(second.move(100), 11);
}

TEST(Lx3vpSequence, WithoutExternalStartOneStartIsOneRun) {
  CamBench bench(2);
  EXPECT_EQ(bench.travel(1500), 1000);
  EXPECT_FALSE(bench.flag(status::non_cyclic));
  bench.tick(100);
  EXPECT_EQ(bench.travel(1500), 1000);
  bench.restart(2);
  EXPECT_EQ(bench.travel(100), 1100);
}

TEST(Lx3vpSequence, RepeatsFollowEachOtherWithoutLoss) {
  CamBench bench;
  bench.set(word::repeats, 2);
  bench.start(2);
  for (int i = 0; i < 10; ++i) bench.travel(270);
  EXPECT_EQ(bench.output(), 2700);
  EXPECT_TRUE(bench.flag(status::cycle_completed, status::completed));
  bench.travel(270);
  EXPECT_EQ(bench.travel(270), 3000);
  EXPECT_TRUE(bench.flag(status::completed));
  covers({"word 14"});
}

TEST(Lx3vpSequence, TheLargestRepeatIsEndless) {
  CamBench bench;
  bench.set(word::repeats, 0xFFFF);
  bench.table({{0, 0}, {1000, 0}});
  bench.start(2);
  for (int i = 0; i < 70; ++i) bench.move(1'000'000);
  EXPECT_TRUE(bench.flag(status::cyclic)) << "it has turned cyclic";
  EXPECT_TRUE(bench.flag(status::completed));
  EXPECT_EQ(bench.get_wide(word::master_counts), 70'000'000);
}

TEST(Lx3vpSequence, StopAfterCycleCancelsTheRepeats) {
  CamBench bench;
  bench.set(word::repeats, 9);
  bench.set(word::function, function::external_start);
  bench.start(2);
  bench.trigger();
  bench.travel(1500);
  bench.set(word::live, live::stop_after_cycle);
  EXPECT_EQ(bench.travel(1500), 2000);
  EXPECT_FALSE(bench.flag(status::non_cyclic));
  bench.tick(100);
  bench.trigger();
  EXPECT_EQ(bench.travel(100), 2000);
}

TEST(Lx3vpSequence, TheDelayIsMasterTravelBeforeTheStart) {
  CamBench bench;
  bench.set(word::function, function::external_start | function::delayed_start);
  bench.set_wide(word::delay, 70'000);
  bench.start(2);
  bench.trigger();
  EXPECT_EQ(bench.travel(69'999), 0);
  EXPECT_EQ(bench.get_wide(word::master_position), 0);
  EXPECT_EQ(bench.travel(31), 30);
  EXPECT_EQ(bench.get_wide(word::master_position), 30);
  // Without its bit the delay is nothing.
  CamBench other;
  other.set_wide(word::delay, 70'000);
  other.start(2);
  EXPECT_EQ(other.move(5), 5);
  covers({"word 15", "word 3 bit 0"});
}

TEST(Lx3vpSequence, TheStartPositionShortensTheFirstCycle) {
  CamBench bench;
  bench.table({{0, 0}, {100'000, 50'000}, {200'000, 250'000}});
  bench.set(word::function, function::start_position);
  bench.set_wide(word::start_position, 80'000);
  bench.set(word::repeats, 1);
  bench.start(2);
  EXPECT_EQ(bench.move(0), 0);
  EXPECT_THAT(bench.wide_words({word::master_position, word::slave_position}), ElementsAre(80'000, 40'000));
  for (int i = 0; i < 400; ++i) bench.move(1000);
  EXPECT_EQ(bench.tick(30'000), 250'000 - 40'000 + 250'000);
  covers({"word 17", "word 3 bit 1"});
}

TEST(Lx3vpSequence, AStoppedCamResumesWhereItStood) {
  CamBench bench;
  bench.table({{0, 0}, {400, 800}, {1000, 500}});
  bench.start(1);
  EXPECT_EQ(bench.travel(1300), 500 + 600);
  bench.set(word::start, 0);
  bench.travel(77);
  bench.tick();
  bench.set(word::function, function::resume);
  bench.set(word::start, 1);
  bench.tick(3);
  EXPECT_EQ(bench.move(0), 1100) << "nothing moves by resuming";
  EXPECT_EQ(bench.travel(100), 500 + 800);
  EXPECT_EQ(bench.get_wide(word::master_counts), 1400);
  covers({"word 3 bit 6"});
}

TEST(Lx3vpSequence, TheRegistersMaySayWhereToResume) {
  CamBench bench;
  bench.set(word::function, function::resume);
  bench.set_wide(word::master_counts, 250);
  bench.set_wide(word::slave_pulses, 240);
  bench.start(1);
  EXPECT_EQ(bench.move(0), 10) << "the slave stood 10 pulses before its place";
  EXPECT_EQ(bench.travel(50), 60);
}

TEST(Lx3vpSequence, PulsesStillOwedAtTheStopComeAfterResuming) {
  CamBench bench;
  bench.set_wide(word::max_frequency, 10'000);  // one a tick
  bench.start(1);
  EXPECT_EQ(bench.move(500), 1);
  bench.set(word::start, 0);
  EXPECT_EQ(bench.tick(2), 1) << "stopped at once";
  bench.set(word::function, function::resume);
  bench.set(word::start, 1);
  EXPECT_EQ(bench.tick(600), 500);
}

TEST(Lx3vpSequence, ResumingAfterTheEndBeginsAnew) {
  CamBench bench(2, function::resume);
  EXPECT_EQ(bench.travel(1500), 1000);
  bench.restart(2);
  EXPECT_EQ(bench.travel(100), 1100);
  EXPECT_EQ(bench.get_wide(word::master_counts), 100);
}

TEST(Lx3vpSequence, LosingPowerStopsAtOnceAndPowerStartsAgain) {
  CamBench bench(1);
  bench.travel(300);
  bench.enable(false);
  EXPECT_EQ(bench.travel(300), 300);
  EXPECT_TRUE(bench.flag(0, status::initialised | status::cyclic));
  bench.enable();  // word 5 is 1 still
  bench.tick(3);
  EXPECT_EQ(bench.travel(50), 350);
}

TEST(Lx3vpSequence, TheTableIsTakenAtTheStart) {
  CamBench bench(1);
  bench.table({{0, 0}, {1000, 5000}});
  EXPECT_EQ(bench.travel(100), 100);
}

TEST(Lx3vpSequence, ANonCyclicCamHasNothingBeforeItsStart) {
  CamBench bench(2);
  EXPECT_EQ(bench.travel(-50), 0);
  EXPECT_EQ(bench.travel(150), 100);
}

}  // namespace
}  // namespace drycut::devices::lx3vp
