#include <gtest/gtest.h>

#include <cmath>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

/// An encoder axis of 10000 counts a turn, 360 increments each, with a probe.
struct Probe : Bench {
  McTouchProbe touch;
  McAbortTrigger abort;

  explicit Probe(double modulo = turn) : Bench(encoder(modulo)) { touch.Axis = abort.Axis = slave; }
  static AxisParameters encoder(double modulo) {
    AxisParameters parameters = axis_of(AxisKind::encoder);
    parameters.modulo = modulo;
    return parameters;
  }
  template <typename Block>
  void execute(Block& block) {
    plcopen::execute(block, kernel);
  }
  /// The probe's signal rises at `edge`; the next cycle sees the axis at `counts`.
  void rise(std::int64_t edge, std::int64_t counts) {
    s().drive.probe_counts = edge;
    ++s().drive.probe_edges;
    s().drive.counts = counts;
    kernel.cycle();
    touch.call(kernel);
  }
};

TEST(PlcopenProbe, RecordsTheCountOfTheEdgeNotOfTheCycle) {
  Probe b;
  b.execute(b.touch);
  EXPECT_FALSE(b.touch.Done);
  b.kernel.cycle();
  b.touch.call(b.kernel);
  EXPECT_FALSE(b.touch.Done);
  b.rise(12'345, 12'400);
  EXPECT_TRUE(b.touch.Done);
  EXPECT_DOUBLE_EQ(b.touch.RecordedPosition, 2'345 * 360.0);
  // One edge for each order; what was recorded stays.
  b.rise(13'000, 13'050);
  EXPECT_DOUBLE_EQ(b.touch.RecordedPosition, 2'345 * 360.0);
  b.execute(b.touch);
  EXPECT_FALSE(b.touch.Done);
  b.rise(14'000, 14'020);
  EXPECT_DOUBLE_EQ(b.touch.RecordedPosition, 4'000 * 360.0);
  covers("MC_TouchProbe", {"Axis", "Execute", "Done", "RecordedPosition"});
}

TEST(PlcopenProbe, AnEdgeBeforeTheOrderDoesNotCount) {
  Probe b;
  b.rise(500, 510);
  b.execute(b.touch);
  b.kernel.cycle();
  b.touch.call(b.kernel);
  EXPECT_FALSE(b.touch.Done);
  b.rise(700, 710);
  EXPECT_TRUE(b.touch.Done);
}

TEST(PlcopenProbe, TheZeroIsThatOfTheAxis) {
  Probe b;
  auto zero = b.make<McSetPosition>();
  b.s().drive.counts = 1'000;
  b.kernel.cycle();
  b.execute(zero);
  b.execute(b.touch);
  b.rise(1'250, 1'300);
  EXPECT_DOUBLE_EQ(b.touch.RecordedPosition, 250 * 360.0);
}

TEST(PlcopenProbe, AWindowLetsEdgesOutsideItPass) {
  struct Case {
    double first, last;
    std::int64_t counts;
    bool inside;
  };
  for (const Case& c : {Case{360'000, 720'000, 999, false}, Case{360'000, 720'000, 1'000, true},
                        Case{360'000, 720'000, 2'000, true}, Case{360'000, 720'000, 2'001, false},
                        // Over the end of the turn, and given beyond it.
                        Case{3'240'000, 360'000, 9'500, true}, Case{3'240'000, 360'000, 500, true},
                        Case{3'240'000, 360'000, 5'000, false}, Case{-360'000, 360'000, 9'500, true},
                        Case{-360'000, 360'000, 5'000, false}}) {
    Probe b;
    b.touch.WindowOnly = true;
    b.touch.FirstPosition = c.first;
    b.touch.LastPosition = c.last;
    b.execute(b.touch);
    b.rise(c.counts, c.counts + 5);
    EXPECT_EQ(b.touch.Done, c.inside) << c.first << " " << c.last << " " << c.counts;
    // The next edge inside it is taken.
    b.rise(std::llround(c.last / 360), 3);
    EXPECT_TRUE(b.touch.Done);
    // Without WindowOnly the window means nothing.
    b.touch.WindowOnly = false;
    b.execute(b.touch);
    b.rise(c.counts, c.counts + 5);
    EXPECT_TRUE(b.touch.Done);
  }
  covers("MC_TouchProbe", {"WindowOnly", "FirstPosition", "LastPosition"});
}

TEST(PlcopenProbe, OfALinearAxisTheWindowIsWhatItSays) {
  Probe b(0);
  b.touch.WindowOnly = true;
  b.touch.FirstPosition = -720'000;
  b.touch.LastPosition = 360'000;
  b.execute(b.touch);
  b.rise(-2'001, 0);
  EXPECT_FALSE(b.touch.Done);
  b.rise(1'001, 0);
  EXPECT_FALSE(b.touch.Done);
  b.rise(-2'000, 0);
  EXPECT_TRUE(b.touch.Done);
  EXPECT_DOUBLE_EQ(b.touch.RecordedPosition, -720'000);
  b.touch.FirstPosition = 360'001;
  b.execute(b.touch);
  EXPECT_EQ(b.touch.ErrorID, id(ErrorId::position_range));
}

TEST(PlcopenProbe, AnAbortionOrAnotherOrderEndsTheWaiting) {
  Probe b;
  b.execute(b.touch);
  b.execute(b.abort);
  EXPECT_TRUE(b.abort.Done);
  b.touch.call(b.kernel);
  EXPECT_TRUE(b.touch.CommandAborted);
  b.rise(100, 100);
  EXPECT_FALSE(b.touch.Done);
  b.touch.Execute = false;
  b.touch.call(b.kernel);
  EXPECT_FALSE(b.touch.CommandAborted);
  b.execute(b.touch);
  auto other = b.make<McTouchProbe>();
  b.execute(other);
  b.rise(200, 200);
  other.call(b.kernel);
  EXPECT_TRUE(b.touch.CommandAborted);
  EXPECT_TRUE(other.Done);
  // What is done is not aborted any more.
  b.execute(b.abort);
  other.call(b.kernel);
  EXPECT_TRUE(other.Done);
  EXPECT_FALSE(other.CommandAborted);
  covers("MC_AbortTrigger", {"Axis", "Execute", "Done"});
  covers({"MC_TouchProbe.CommandAborted"});
}

TEST(PlcopenProbe, MovementsDoNotTouchIt) {
  AxisParameters servo;
  servo.homed_at_start = true;
  Bench b(servo);
  auto touch = b.make<McTouchProbe>();
  touch.Execute = true;
  touch.call(b.kernel);
  b.s().move({Command::move_velocity, 0, {.velocity = 1'000}, Direction::positive});
  b.kernel.cycle();
  b.s().fault(ErrorId::drive_error);
  touch.call(b.kernel);
  EXPECT_FALSE(touch.Error);
  b.s().drive.probe_counts = 10;
  ++b.s().drive.probe_edges;
  touch.call(b.kernel);
  EXPECT_TRUE(touch.Done);
  EXPECT_DOUBLE_EQ(touch.RecordedPosition, 3'600);
}

TEST(PlcopenProbe, RefusesAProbeThatIsNotThere) {
  Probe b;
  const auto errors = [&](auto& block) {
    block.TriggerInput = 1;
    b.execute(block);
    EXPECT_TRUE(block.Error);
    EXPECT_EQ(block.ErrorID, id(ErrorId::no_such_probe));
    block.TriggerInput = 0;
    block.Axis = b.master;  // virtual
    b.execute(block);
    EXPECT_EQ(block.ErrorID, id(ErrorId::no_such_probe));
    block.Axis = {};
    b.execute(block);
    EXPECT_EQ(block.ErrorID, id(ErrorId::no_such_axis));
    block.Execute = false;
    block.call(b.kernel);
    EXPECT_FALSE(block.Error);
  };
  errors(b.touch);
  errors(b.abort);
  b.touch.Axis = b.slave;
  b.touch.WindowOnly = true;
  for (const double position : {3e9, std::nan("")}) {
    b.touch.LastPosition = position;
    b.execute(b.touch);
    EXPECT_EQ(b.touch.ErrorID, id(ErrorId::position_range));
  }
  covers("MC_TouchProbe", {"TriggerInput", "Error", "ErrorID"});
  covers("MC_AbortTrigger", {"TriggerInput", "Error", "ErrorID"});
  covers({"65018"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
