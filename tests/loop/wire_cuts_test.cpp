// Wires that are cut: what comes through an open end, and what is lost once it is mended.
#include <gtest/gtest.h>

#include "base/state_archive.hpp"
#include "sim/loop/wire_cuts.hpp"

namespace drycut::sim::loop {
namespace {

struct Ends {
  plants::EncoderPort encoder;
  plants::SignalPort home;
  plants::CommandPort clamp;
  plants::ReferencePort reference;
  plants::PulsePort pulses;
  const plants::EncoderPort* counter = &encoder;
  const plants::SignalPort* input = &home;
  plants::CommandPort* output = &clamp;
  plants::ReferencePort* analogue = &reference;
  plants::PulsePort* train = &pulses;
  WireCuts cuts;

  Ends() {
    cuts.add("2.CNT01", counter);
    cuts.add("2.INP01", input);
    cuts.add("2.OUT01", output);
    cuts.add("2.AN01", analogue);
    cuts.add("Y0", train);
  }
  void cut(std::size_t wire, double on = 1) { cuts.faults().at(wire).second.act(on); }
};

TEST(WireCuts, AreFaultsOfEachWire) {
  Ends ends;
  const auto faults = ends.cuts.faults();
  ASSERT_EQ(faults.size(), 5U);
  EXPECT_EQ(faults[1].first, "wire.2.INP01");
  EXPECT_EQ(faults[1].second.name, "cut");
  EXPECT_FALSE(ends.cuts.any());
  EXPECT_EQ(ends.counter, &ends.encoder) << "who cuts nothing pays nothing";
}

TEST(WireCuts, ACounterStandsAndGoesOnBehind) {
  Ends ends;
  ends.encoder.count = 100;
  ends.cut(0);
  EXPECT_EQ(ends.counter->count, 100);
  ends.encoder.count = 130;
  ends.cuts.count();
  EXPECT_EQ(ends.counter->count, 100);
  EXPECT_EQ(ends.counter->count_at(0.5), 100) << "an index latches what was counted";
  ends.cut(0, 0);
  ends.encoder.before = 130;
  ends.encoder.now = 150;
  ends.encoder.count = 150;
  ends.cuts.count();
  EXPECT_EQ(ends.counter->count, 120) << "30 counts are lost";
  EXPECT_EQ(ends.counter->count_at(0.5), 110);
}

TEST(WireCuts, AnInputFallsOnce) {
  Ends ends;
  ends.home.level = true;
  ends.cut(1);
  EXPECT_FALSE(ends.input->level);
  ASSERT_EQ(ends.input->edges.size(), 1U);
  EXPECT_FALSE(ends.input->edges[0].rising);
  ends.cuts.clear_edges();
  EXPECT_TRUE(ends.input->edges.empty());
  ends.cut(1, 0);
  EXPECT_TRUE(ends.input->level);
}

TEST(WireCuts, WhatTheControllerDrivesGetsNothing) {
  Ends ends;
  ends.clamp.level = true;
  ends.reference.volts = 5;
  ends.pulses.pulses = 40;
  for (const std::size_t wire : {2U, 3U, 4U}) ends.cut(wire);
  EXPECT_FALSE(ends.clamp.level);
  EXPECT_EQ(ends.reference.volts, 0);
  ends.output->level = true;
  ends.analogue->volts = 7;
  ends.train->pulses = 60;
  ends.cuts.count();
  EXPECT_FALSE(ends.clamp.level);
  EXPECT_EQ(ends.reference.volts, 0);
  EXPECT_EQ(ends.pulses.pulses, 40);
  ends.cut(4, 0);
  ends.train->pulses = 65;
  ends.cuts.count();
  EXPECT_EQ(ends.pulses.pulses, 45) << "20 pulses are lost";
}

TEST(WireCuts, AreState) {
  Ends ends;
  StateArchive::Bytes whole;
  StateArchive::save(whole, ends.cuts);
  ends.encoder.count = 100;
  ends.cut(0);
  ends.cut(3);
  StateArchive::Bytes open;
  StateArchive::save(open, ends.cuts);

  auto mended = StateArchive::restoring(whole.data(), whole.size());
  ends.cuts.visit(mended);
  EXPECT_FALSE(ends.cuts.any());
  EXPECT_EQ(ends.counter, &ends.encoder);
  EXPECT_EQ(ends.analogue, &ends.reference);

  Ends others;
  auto again = StateArchive::restoring(open.data(), open.size());
  others.cuts.visit(again);
  EXPECT_TRUE(others.cuts.any());
  EXPECT_EQ(others.counter->count, 100);
  EXPECT_EQ(others.input, &others.home);
  others.analogue->volts = 3;
  EXPECT_EQ(others.reference.volts, 0);
}

}  // namespace
}  // namespace drycut::sim::loop
