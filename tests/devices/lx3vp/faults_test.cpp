// Errors 6781 to 6783: what raises them, what they leave in the block, how they end.
#include "tests/devices/lx3vp/bench.hpp"
#include "tests/devices/lx3vp/covers.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Starts the cam that `wrong` has spoilt; it must stand still, with this message and these words.
template <typename Spoil>
void expect_fault(Spoil wrong, const std::string& message, int error_word, unsigned bit) {
  CamBench bench;
  wrong(bench);
  bench.start(1);
  for (int i = 0; i < 10; ++i) bench.move(10);
  EXPECT_THAT(bench.notes(), ElementsAre(message));
  EXPECT_EQ(bench.get(word::error), error_word) << message;
  EXPECT_TRUE(bench.flag(status::stopped | bit)) << message;
  EXPECT_FALSE(bench.flag(status::parameter_error | status::table_error)) << message;
  EXPECT_FALSE(bench.flag(status::initialised)) << message;
  EXPECT_FALSE(bench.flag(status::cyclic)) << message;
  EXPECT_EQ(bench.output(), 0) << message;
}

TEST(Lx3vpFaults, ParametersAreChecked) {
  const auto fault = [](auto wrong, const std::string& message) {
    expect_fault(wrong, message, 6781, status::parameter_error);
  };
  for (const int ratio : {23, 24, 29, 30}) {
    fault([&](CamBench& bench) { bench.set(ratio, 0); },
          fmt::format("6781: word {} (D{}), a term of a ratio, is 0; write 1 to 65535", ratio, 2000 + ratio));
  }
  fault([](CamBench& bench) { bench.set(word::table_offset, 41); },
        "6781: word 39 (D2039) is 41; the table begins at 40");
  fault([](CamBench& bench) { bench.set(word::sync_output, 256); },
        "6781: word 8 (D2008) is 256; outputs are 0 to 255");
  fault(
      [](CamBench& bench) {
        bench.set(word::live, live::sync_output);
        bench.set(word::sync_output, 7);
        bench.set_wide(word::sync_low, 30);
        bench.set_wide(word::sync_high, 20);
      },
      "6781: the synchronous output is on from 30 (D2009) to 20 (D2011), which is lower");
  fault([](CamBench& bench) { bench.set(word::live, live::sync_output); },
        "6781: the synchronous output Y0 of word 8 (D2008) is the cam's own pulse output");
  fault(
      [](CamBench& bench) {
        bench.set(word::live, live::sync_output);
        bench.set(word::sync_output, 4);
      },
      "6781: the synchronous output Y4 of word 8 (D2008) is the cam's own direction");
  fault(
      [](CamBench& bench) {
        bench.operands.master = {MasterSource::Kind::time, 0};
      },
      "6781: the time axis K0 does not move; write K1 (100 us) or more");
  fault([](CamBench& bench) { bench.operands.output = 5; }, "6781: Y5 gives no pulses; Y0 to Y3 do");
  fault([](CamBench& bench) { bench.operands.direction = 0; }, "6781: Y0 is pulse and direction at once");
  covers({"word 2", "word 1 bit 3", "word 1 bit 4"});
}

TEST(Lx3vpFaults, TheStartPositionLiesInTheTable) {
  for (const int position : {0, 100, 999, 1000}) {
    CamBench bench;
    bench.table({{100, 0}, {1000, 10}});
    bench.set(word::function, function::start_position);
    bench.set_wide(word::start_position, position);
    bench.start(2);
    const auto notes = bench.notes();
    if (position == 0 || position == 1000)
      EXPECT_THAT(notes, ElementsAre(fmt::format(
                             "6781: the start position {} (D2017) is outside the table; write 100 to 999",
                             position)));
    else
      EXPECT_THAT(notes, IsEmpty());
  }
}

TEST(Lx3vpFaults, TablesAreChecked) {
  const auto fault = [](auto wrong, const std::string& message, int row) {
    expect_fault(wrong, message, row, status::table_error);
  };
  for (const int count : {0, 1, 513, 65535}) {
    fault([&](CamBench& bench) { bench.set(word::rows, count); },
          fmt::format("6782: a table of {} rows in word 38 (D2038); write 2 to 512", count), count);
  }
  fault(
      [](CamBench& bench) {
        bench.table({{0, 0}, {10, 5}, {10, 6}, {9, 7}});
      },
      "6782: the master of row 2 (D2048) is 10, not above 10 of the row before", 2);
  fault(
      [](CamBench& bench) {
        bench.table({{-1, 0}, {10, 5}});
      },
      "6782: the master of row 0 (D2040) is -1; it is not negative", 0);
  covers({"word 1 bit 5"});
}

TEST(Lx3vpFaults, TheBlockEndsBelowTheSpecialRegisters) {
  CamBench bench;
  constexpr int at = 7952;  // words 40 to 47 are the last two rows
  bench.operands.block = at;
  bench.initialise(at);
  bench.table({{0, 0}, {1000, 1000}}, at);
  bench.set(word::start, 1, at);
  bench.enable();
  bench.tick(3);
  EXPECT_EQ(bench.move(5), 5);
  EXPECT_THAT(bench.notes(), IsEmpty());

  CamBench longer;
  longer.operands.block = at;
  longer.initialise(at);
  longer.set(word::rows, 3, at);
  longer.set(word::start, 1, at);
  longer.enable();
  longer.tick(3);
  EXPECT_THAT(longer.notes(), ElementsAre("6782: row 2 of the table goes beyond D7999"));
  EXPECT_EQ(longer.get(word::error, at), 2);

  CamBench beyond;
  beyond.operands.block = 7961;
  beyond.enable();
  beyond.tick(3);
  EXPECT_THAT(beyond.notes(), ElementsAre("6781: the block of 40 words at D7961 goes beyond D7999"));
  beyond.enable(false);
}

TEST(Lx3vpFaults, TheNextStartClearsThem) {
  CamBench bench;
  bench.set(word::rows, 1);
  bench.start(1);
  EXPECT_TRUE(bench.flag(status::stopped | status::table_error));
  bench.table({{0, 0}, {1000, 1000}});
  bench.tick(100);
  EXPECT_TRUE(bench.flag(status::stopped)) << "until word 5 goes from 0 to 1";
  bench.set(word::start, 0);
  bench.tick(2);
  EXPECT_TRUE(bench.flag(status::stopped));
  bench.set(word::start, 1);
  bench.tick();
  EXPECT_FALSE(bench.flag(status::stopped));
  EXPECT_EQ(bench.get(word::error), 0);
  bench.tick(2);
  EXPECT_EQ(bench.move(10), 10);
}

TEST(Lx3vpFaults, AnOutputHasOneCam) {
  CamBench bench(1);
  DecamOperands second = bench.operands;
  second.block = 3000;
  bench.initialise(3000);
  bench.set(word::start, 1, 3000);
  CamPort port = bench.port();
  bench.unit.decam(20, second, true, port);
  bench.tick(5);
  EXPECT_THAT(bench.notes(), ElementsAre("6783: Y0 has a cam already"));
  EXPECT_EQ(bench.get(word::error, 3000), 6783);
  EXPECT_EQ(bench.get(word::status, 3000), static_cast<int>(status::stopped));
  EXPECT_EQ(bench.move(10), 10) << "the first goes on";
  // With the first off, the second is enabled by getting power again.
  bench.enable(false);
  bench.unit.decam(20, second, false, port);
  bench.table({{0, 0}, {1000, 1000}}, 3000);
  bench.unit.decam(20, second, true, port);
  bench.tick(3);
  EXPECT_EQ(bench.move(7), 17);
}

TEST(Lx3vpFaults, ThereAreFourCams) {
  CamBench bench;
  CamPort port = bench.port();
  for (int i = 0; i < 5; ++i) {
    DecamOperands operands = bench.operands;
    operands.block = 1000 * (i + 1);
    operands.output = i % 4;
    operands.direction = 8 + i;
    bench.unit.decam(i, operands, true, port);
  }
  EXPECT_THAT(bench.notes(), ElementsAre("6783: 4 cams are enabled already"));
}

}  // namespace
}  // namespace drycut::devices::lx3vp
