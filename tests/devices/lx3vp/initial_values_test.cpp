// Words of a block that nothing has written have the manual's initial values (003 5); what a cam tells of its
// block that is no error.
#include "devices/lx3vp/ecamtbx_registers.hpp"
#include "tests/devices/lx3vp/bench.hpp"
#include "tests/devices/lx3vp/covers.hpp"
#include "tests/devices/lx3vp/ecamtbx_bench.hpp"

namespace drycut::devices::lx3vp {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A cam whose block nobody has written: all 0.
CamBench untouched() {
  CamBench bench;
  bench.registers = {};
  bench.table({{0, 0}, {1000, 500}});
  return bench;
}

TEST(Lx3vpInitialValues, AreThoseOfWordsThatNothingHasWritten) {
  auto bench = untouched();
  bench.set(word::live, 0);
  bench.start(1);
  EXPECT_THAT(
      bench.notes(),
      ElementsAre("the block D2000 has the initial values of its words that nothing has written: D2006 "
                  "200000, D2023 1, D2024 1, D2029 1, D2030 1, D2039 40"));
  EXPECT_EQ(bench.get_wide(word::max_frequency), 200'000);
  EXPECT_EQ(bench.travel(2000), 1000);
}

TEST(Lx3vpInitialValues, AreNotThoseOfA0ThatWasWritten) {
  for (const int ratio : {23, 24, 29, 30}) {
    auto bench = untouched();
    bench.set(ratio, 0);
    bench.start(1);
    const auto told = bench.notes();
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[1], fmt::format("6781: word {} (D{}), a term of a ratio, is 0; write 1 to 65535", ratio,
                                   2000 + ratio));
  }
  auto bench = untouched();
  bench.set_wide(word::max_frequency, 0);
  bench.start(1);
  bench.notes();
  bench.travel(1000);
  EXPECT_THAT(bench.notes(), ElementsAre("D2006 is 0: nothing comes out of Y0; write 1 to 200000"));
}

TEST(Lx3vpInitialValues, OneWordOfTheFrequencyIsEnoughToBeWritten) {
  auto bench = untouched();
  bench.set(word::max_frequency, 1000);
  bench.start(1);
  EXPECT_EQ(bench.get_wide(word::max_frequency), 1000);
}

// ECAMTBX gives them too; what the program writes behind it is its own.
TEST(Lx3vpInitialValues, ComeWithATable) {
  auto bench = untouched();
  auto& d = bench.registers;
  ecams::put(d, 300, SawParameters{1000, 1500, 300, 2, 8, 1});
  run_ecamtbx(d, 300, 100, CamBench::block, 330);
  EXPECT_EQ(bench.get_wide(word::max_frequency), 200'000);
  EXPECT_EQ(bench.get(word::slave_numerator), 1);
  bench.set(word::slave_numerator, 0);
  bench.start(1);
  EXPECT_TRUE(bench.flag(status::parameter_error));
}

TEST(Lx3vpThresholds, BeyondTheTableAreTold) {
  const auto told = [](std::int32_t low, std::int32_t high) {
    CamBench bench;
    bench.set(word::sync_output, 7);
    bench.set_wide(word::sync_low, low);
    bench.set_wide(word::sync_high, high);
    bench.set(word::live, live::sync_output);
    bench.start(1);
    for (int i = 0; i < 300; ++i) bench.travel(10);
    return bench.notes();
  };
  EXPECT_THAT(told(200, 1000), IsEmpty());
  EXPECT_THAT(
      told(200, 1001),
      ElementsAre("the threshold 1001 of the synchronous output (D2011) lies beyond the table's last master "
                  "1000: the output stays on to the end of the cycle; write up to 1000"));
  EXPECT_THAT(
      told(5000, 6000),
      ElementsAre("the threshold 5000 of the synchronous output (D2009) lies beyond the table's last master "
                  "1000: the output never comes on; write up to 1000"));
}

// HFFFF turns a non-cyclic cam cyclic, flags and all, from its start signal on.
TEST(Lx3vpRepeats, HFfffTurnsTheCamCyclic) {
  covers({"word 14", "word 31"});
  CamBench bench;
  bench.set(word::repeats, 0xFFFF);
  bench.set(word::function, function::external_start);
  bench.start(2);
  EXPECT_TRUE(bench.flag(status::non_cyclic)) << "until the start signal";
  EXPECT_FALSE(bench.flag(status::cyclic));
  bench.trigger();
  EXPECT_TRUE(bench.flag(status::cyclic, status::non_cyclic));
  for (int i = 0; i < 25; ++i) bench.travel(100);
  EXPECT_EQ(bench.output(), 2500);
  EXPECT_TRUE(bench.flag(status::completed | status::initialised));
  for (int i = 0; i < 30; ++i) bench.travel(-100);
  EXPECT_EQ(bench.output(), -500) << "past the first row, as a cyclic cam";
  bench.set(word::repeats, 0xFFFF);
  EXPECT_TRUE(bench.unit.cam(CamBench::step)->cyclic());
}

}  // namespace
}  // namespace drycut::devices::lx3vp
