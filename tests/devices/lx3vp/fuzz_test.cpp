// Whatever stands in the registers, the cams neither crash nor give more than they may.
#include <random>

#include "devices/cards.hpp"
#include "tests/devices/lx3vp/bench.hpp"

namespace drycut::devices::lx3vp {
namespace {

TEST(Lx3vpFuzz, AnyBlockIsHarmless) {
  std::mt19937 random(17);
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  constexpr int most_a_tick = 20;  // 200 kHz
  int started = 0;
  for (int round = 0; round < 400; ++round) {
    CamBench bench;
    bench.table({{0, 0}, {draw(1, 2000), draw(-2000, 2000)}});
    bench.operands.master = draw(0, 3) == 0
                                ? MasterSource{MasterSource::Kind::time, draw(-1, 3)}
                                : MasterSource{MasterSource::Kind::word, CamBench::master_register};
    bench.operands.block = draw(0, 5) == 0 ? draw(0, 8255) : CamBench::block;
    bench.operands.output = draw(0, 9) == 0 ? draw(0, 255) : 0;
    bench.enable();
    bench.set(word::start, draw(1, 2));
    bench.tick(2);
    for (int i = 0; i < 200; ++i) {
      const int kind = draw(0, 30);
      if (kind == 0) bench.set(draw(0, 60), draw(0, 65535));
      if (kind == 1) bench.set(draw(0, 60), draw(0, 9));
      if (kind == 2) bench.set(word::start, draw(0, 2));
      if (kind == 3) bench.enable(draw(0, 1) == 1);
      if (kind == 4) bench.inputs[CamBench::start_input] = draw(0, 1) == 1;
      if (kind == 5) bench.registers.m[8145] = draw(0, 3) == 0;
      const auto before = bench.unit.pulses(0);
      bench.move(kind == 6 ? static_cast<std::int32_t>(random()) : draw(-30, 30));
      const auto given = bench.unit.pulses(0) - before;
      ASSERT_GE(given, 0) << "a train never goes back";
      ASSERT_LE(given, most_a_tick);
    }
    if (bench.unit.pulses(0) > 0) ++started;
  }
  EXPECT_GT(started, 200) << "the blocks are not so odd that nothing is tried";
}

TEST(Lx3vpTerminals, OfABaseUnitAreOctal) {
  const auto name = [](const char* text) { return to_string(parse_base_terminal(text).value()); };
  EXPECT_EQ(parse_base_terminal("X10"), (Address{Kind::input, 0, 8}));
  EXPECT_EQ(parse_base_terminal("y377"), (Address{Kind::output, 0, 255}));
  EXPECT_EQ(parse_base_terminal("C251"), (Address{Kind::counter, 0, 251}));
  for (const char* text : {"X0", "X17", "X377", "Y0", "Y20", "C0", "C255"}) EXPECT_EQ(name(text), text);
  for (const char* text : {"", "X", "X8", "X18", "X400", "Y-1", "C256", "2.X0", "X0 ", "Z1", "XX1", "INP01"})
    EXPECT_FALSE(parse_base_terminal(text)) << text;
  EXPECT_FALSE(parse_address("X0")) << "of a slot it is none: a QMOVE program may have a variable X0";
  EXPECT_FALSE(parse_address("C235"));
}

}  // namespace
}  // namespace drycut::devices::lx3vp
