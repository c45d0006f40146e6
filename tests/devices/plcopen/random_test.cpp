#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

/// All blocks on one slave, in the hands of an operator without sense.
struct Monkey : Bench {
  std::vector<std::unique_ptr<FunctionBlock>> blocks;
  std::mt19937_64 random;

  explicit Monkey(unsigned seed) : random(seed) {
    table({0, 400'000, 1'500'000, 2'900'000}, 3, Interpolation::polynom_3);
    table({0, 0, 600'000, 0, 1'200'000, 1'800'000, 1'800'000, 1'800'000}, 7, Interpolation::poly5_line, 2);
    for (const BlockType& type : block_types())
      if (type.name != "MC_Power") blocks.push_back(type.make());
    set("cam_gear.v_max_slave", 800'000);
  }
  double real() {
    constexpr std::array strange{0.0, -1.0, 1e300, -3e9, 0.5};
    if (random() % 20 == 0) return random() % 2 == 0 ? std::nan("") : strange[random() % strange.size()];
    return std::pow(10, static_cast<double>(random() % 600) / 100.0) * (random() % 4 == 0 ? -1 : 1);
  }
  void twist(FunctionBlock& block, const BlockType& type) {
    for (std::size_t i = 0; i < type.pins.size(); ++i) {
      if (type.pins[i].direction == PinDirection::output) continue;
      const PinValue value = type.pin(block, i);
      const std::string_view name = type.pins[i].name;
      if (auto* const* flag = std::get_if<bool*>(&value)) **flag = random() % 2 == 0;
      if (auto* const* number = std::get_if<double*>(&value))
        **number = name == "MasterScaling" || name == "SlaveScaling" ? 1 : real();
      if (auto* const* axis = std::get_if<AxisRef*>(&value)) **axis = name == "Master" ? master : slave;
      if (auto* const* id = std::get_if<std::uint16_t*>(&value))
        **id = static_cast<std::uint16_t>(random() % 4);
      if (name == "Direction") *std::get<std::int16_t*>(value) = static_cast<std::int16_t>(random() % 6);
      if (name == "StartMode") *std::get<std::uint32_t*>(value) = static_cast<std::uint32_t>(random() % 160);
      if (name == "TableFctType") *std::get<std::uint32_t*>(value) = 6;
    }
  }
  /// Calls all blocks, one in so many with other inputs.
  void play(unsigned one_in) {
    std::size_t number = 0;
    for (const BlockType& type : block_types()) {
      if (type.name == "MC_Power") continue;
      FunctionBlock& block = *blocks[number++];
      if (random() % one_in == 0) twist(block, type);
      block.call(kernel);
    }
  }
};

TEST(PlcopenRandom, WhateverIsOrderedTheSlaveNeverLeaps) {
  int synchronized = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Monkey b(seed);
    b.start_master();
    for (int i = 0; i < 15'000; ++i) {
      b.play(300);
      if (b.random() % 200 == 0) b.s().control.override_percent = static_cast<double>(b.random() % 150);
      if (b.random() % 1'000 == 0) b.s().drive.emergency_stop = b.random() % 2 == 0;
      b.s().control.feed_enable = b.random() % 1'000 != 0;
      b.s().control.feed_hold = i % 1'000 > 900;
      // MC_SetPosition has moved the zero here, not the axis.
      const double last = b.at(b.s());
      const double speed = std::abs(b.s().set().velocity);
      b.kernel.cycle();
      const AxisMotion now = b.s().set();
      ASSERT_TRUE(std::isfinite(now.position.part) && std::isfinite(now.velocity) &&
                  std::isfinite(now.acceleration));
      ASSERT_GE(now.position.part, 0);
      ASSERT_LT(now.position.part, turn);
      // A new order may find an acceleration that carries the speed beyond its limit, a2/(2j) at most: with
      // a small jerk of its own that is far, but no leap.
      // MC_Home moves the zero, not the axis.
      const bool homed = b.s().state() == AxisState::standstill;
      if (!homed) {
        ASSERT_LE(std::abs(b.at(b.s()) - last),
                  std::max({1.6e7, speed, std::abs(now.velocity)}) * cycle_s * 1.001)
            << seed << " " << i << " " << name_of(b.s().state());
      }
      if (b.s().state() == AxisState::synchronized_motion) ++synchronized;
    }
  }
  EXPECT_GT(synchronized, 1'000);
}

TEST(PlcopenRandom, TheSameOrdersGiveTheSameMotion) {
  const auto run = [](unsigned seed) {
    Monkey b(seed);
    b.start_master();
    std::vector<double> positions;
    for (int i = 0; i < 2'000; ++i) {
      b.play(100);
      b.kernel.cycle();
      positions.push_back(b.at(b.s()));
    }
    return positions;
  };
  EXPECT_EQ(run(5), run(5));
  EXPECT_NE(run(5), run(6));
}

TEST(PlcopenRandom, TheLargestScalingsDoNoHarm) {
  Bench b;
  b.table({0, 1'000'000, 2'000'000});
  b.cam.MasterScaling = 2147483647;
  b.cam.SlaveScaling = -2147483647;
  b.start_master();
  b.couple(hli_ci_f_periodic | hli_ci_endless_positive);
  b.step(2'000);
  EXPECT_TRUE(std::isfinite(b.s().set().position.part));
}

}  // namespace
}  // namespace drycut::devices::plcopen
