#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/devices/camming4/cam_bench.hpp"

namespace drycut::devices::camming4 {
namespace {

/// Plain arithmetic on the generator's bits: the same on every library.
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : generator_(seed) {}
  std::int32_t between(std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(generator_() % static_cast<std::uint32_t>(high - low + 1));
  }
  template <typename Container>
  const auto& of(const Container& container) {
    return container[generator_() % container.size()];
  }

 private:
  std::mt19937 generator_;
};

/// A movement with spaces of its kind.
Row random_movement(Draw& draw, int code) {
  Row row{.codeG = code};
  row.codeQm = draw.between(20, 200);
  row.codeQs = draw.between(-200, 200);
  const Code& entry = *find_code(code);
  if (entry.qma == Use::master_space) {
    row.codeQma = draw.between(20, 200);
    row.codeQsa = draw.between(-9000, 9000);
  }
  if (entry.qm == Use::radius) {
    row.codeQs = draw.between(1, 200);
    row.codeQsa = draw.between(-200, 200);
    row.codeQm =
        (draw.between(0, 1) == 0 ? 1 : -1) *
        (1 + static_cast<std::int32_t>(std::hypot(row.codeQs, row.codeQsa) / 2) + draw.between(0, 300));
  }
  return row;
}

bool enters_with_a_step(const Code& code) {
  return code.zero_start || code.qm == Use::radius || code.qma == Use::softening;
}

/// Runs count by count, 0.01 Um: the slave moves by its mean speed, and the speed jumps only at the start of
/// sectors that say so. Gives the number of boundaries passed.
int run_smoothly(CamBench& bench) {
  bench.start();
  int boundaries = 0;
  CamStep before = bench.to(0);
  for (double was = 0; bench.cam.running(); was = bench.slave_um()) {
    bench.to(bench.master + 1);
    const CamStep& now = bench.cam.step();
    if (!now.running) break;
    const bool boundary = now.row != before.row;
    const bool step = boundary && enters_with_a_step(*find_code(bench.cam.row(now.row).codeG));
    // The steepest cycloid changes the speed by 0.3 within a count, so its corner costs 0.3*0.01/8.
    const double mean = step ? 0 : 0.005 * (now.ratio + before.ratio);
    const double spread = step ? 0.01 * (std::abs(now.ratio) + std::abs(before.ratio)) : 0;
    const double moved_um = bench.slave_um() - was;
    if (std::abs(moved_um - mean) > spread + 4e-4 || (!step && std::abs(now.ratio - before.ratio) > 0.3)) {
      ADD_FAILURE() << "at count " << bench.master << " row " << now.row << ": moved " << moved_um
                    << ", speed from " << before.ratio << " to " << now.ratio;
      return boundaries;
    }
    boundaries += boundary ? 1 : 0;
    before = now;
  }
  EXPECT_TRUE(bench.errors.empty());
  EXPECT_TRUE(bench.cam.step().ended);
  return boundaries;
}

TEST(CamRandom, SpeedAndPositionAreContinuousAcrossEveryPairOfMovements) {
  Draw draw(1);
  int joints = 0;
  for (const Code& first : codes)
    for (const Code& second : codes) {
      if (first.what != CodeClass::movement || second.what != CodeClass::movement) continue;
      SCOPED_TRACE(std::to_string(first.code) + " to " + std::to_string(second.code));
      CamBench bench({{133, 50, draw.between(-50, 50)},
                      random_movement(draw, first.code),
                      random_movement(draw, second.code),
                      end_row},
                     hundredths);
      joints += run_smoothly(bench);
      ASSERT_FALSE(HasFailure());
    }
  EXPECT_EQ(joints, 24 * 24 * 2);
}

TEST(CamRandom, ChainsEndOnTheSumOfTheirSpaces) {
  Draw draw(2);
  const std::vector<int> movements{131, 132, 133, 134, 135, 150, 151, 152, 153,
                                   154, 231, 232, 233, 234, 235, 252, 253, 254};
  for (int round = 0; round < 200; ++round) {
    const CamSettings settings{.master = {draw.between(1, 2000), draw.between(2000, 9000)},
                               .slave = {draw.between(1, 2000), draw.between(2000, 9000)},
                               .decpt = 0};
    CamBench bench({}, settings);
    std::int64_t master = 0;
    std::int64_t slave = 0;
    for (int number = 1; number <= 20; ++number) {
      const Row row = random_movement(draw, draw.of(movements));
      const Code& code = *find_code(row.codeG);
      bench.put(number, row);
      if (code.qm == Use::master_space) {
        master += row.codeQm * settings.master.pulse;
        slave += row.codeQs * settings.slave.pulse;
      }
      if (code.qma == Use::master_space) {
        master += row.codeQma * settings.master.pulse;
        slave += row.codeQsa * settings.slave.measure;
      }
    }
    bench.put(21, end_row);
    bench.start();
    // 20 Um are at least 20 counts: no sector fits between two samplings.
    const std::int64_t last = (master + settings.master.measure - 1) / settings.master.measure;
    bench.run(last - 1, 17);
    ASSERT_TRUE(bench.errors.empty()) << round;
    ASSERT_TRUE(bench.cam.running()) << round;
    EXPECT_TRUE(bench.to(last).ended);
    EXPECT_EQ(bench.cam.slave_origin(), moved(Point{}, {slave, 0}, settings.slave.measure));
  }
}

TEST(CamRandom, TheWayBackIsTheWayThere) {
  Draw draw(3);
  const std::vector<int> movements{131, 133, 134, 135, 151, 153, 154, 170,
                                   171, 172, 173, 174, 175, 233, 234, 254};
  for (int round = 0; round < 60; ++round) {
    CamBench bench({}, hundredths);
    for (int number = 1; number <= 8; ++number) bench.put(number, random_movement(draw, draw.of(movements)));
    bench.put(9, end_row);
    bench.start();
    std::vector<double> there;
    bench.to(0);
    for (int i = 0; bench.cam.running() && i < 500; ++i) {
      there.push_back(bench.slave_um());
      bench.to(bench.master + 150);
    }
    if (!bench.cam.running()) continue;
    ASSERT_TRUE(bench.errors.empty());
    for (std::size_t i = there.size(); i-- > 0;) {
      bench.to(static_cast<std::int64_t>(i) * 150);
      EXPECT_NEAR(bench.slave_um(), there[i], 1e-8);
    }
  }
}

/// Any 32-bit number, with those that break things more often than chance would.
std::int32_t hostile(Draw& draw) {
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
  switch (draw.between(0, 9)) {
    case 0:
      return least;
    case 1:
      return most;
    case 2:
      return 0;
    case 3:
      return draw.between(-2, 2);
    case 4:
    case 5:
      return draw.between(-1000, 1000);
    case 6:
      return draw.between(1, 200);
    default:
      return draw.between(-999999, 999999) * 2000;
  }
}

Row hostile_row(Draw& draw) {
  Row row{draw.of(codes).code, hostile(draw), hostile(draw), hostile(draw), hostile(draw), hostile(draw)};
  if (draw.between(0, 30) == 0) row.codeG = hostile(draw);
  if (find_code(row.codeG) != nullptr && find_code(row.codeG)->qm == Use::target_row &&
      draw.between(0, 3) != 0)
    row.codeQm = draw.between(1, 12);
  return row;
}

void expect_sane(const CamStep& step) {
  EXPECT_GE(step.slave_fraction, 0);
  EXPECT_LT(step.slave_fraction, 1);
  EXPECT_TRUE(std::isfinite(step.ratio));
  EXPECT_EQ(step.running, step.row != 0);
  EXPECT_LE(step.warning_count, static_cast<int>(step.warnings.size()));
  EXPECT_LE(step.read_out_count, static_cast<int>(step.read_outs.size()));
}

TEST(CamRandom, HostileTablesNeitherCrashNorHang) {
  Draw draw(4);
  int errors = 0;
  for (int round = 0; round < 3000; ++round) {
    const CamSettings settings{.master = {hostile(draw), hostile(draw)},
                               .slave = {hostile(draw), hostile(draw)},
                               .decpt = hostile(draw)};
    Cam cam;
    cam.set(settings);
    for (int number = 1; number <= 12; ++number) {
      const Row row = hostile_row(draw);
      cam.write(number, Column::codeG, row.codeG);
      cam.write(number, Column::codeQm, row.codeQm);
      cam.write(number, Column::codeQs, row.codeQs);
      cam.write(number, Column::codeQma, row.codeQma);
      cam.write(number, Column::codeQsa, row.codeQsa);
    }
    CamSample sample;
    cam.start({.master_count = hostile(draw), .slave_bits = hostile(draw), .slave_fraction = 0.5});
    for (int i = 0; i < 60; ++i) {
      sample.master_count += draw.between(0, 3) == 0 ? hostile(draw) : draw.between(-50, 400);
      sample.master_grains = std::int64_t{hostile(draw)} * hostile(draw);
      sample.slave_grains = std::int64_t{hostile(draw)} * hostile(draw);
      sample.slave_count = hostile(draw);
      sample.master_speed = hostile(draw);
      const CamStep& step = cam.advance(sample);
      expect_sane(step);
      errors += step.error.code != 0 ? 1 : 0;
      if (i % 10 == 9) cam.write(draw.between(1, 12), Column::codeQs, hostile(draw));
      if (i % 20 == 19) cam.write(draw.between(1, 12), Column::codeQsa, draw.between(0, 2));
    }
  }
  EXPECT_GT(errors, 500);
  EXPECT_LT(errors, 3000);
}

TEST(CamRandom, ExtremeCountsSaturate) {
  constexpr std::int64_t far = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t count : {far, -far - 1}) {
    Cam cam;
    cam.set(CamSettings{.master = {1 << 30, 1}, .slave = {1, 1 << 30}, .decpt = 0});
    cam.write(1, Column::codeG, 154);
    cam.write(1, Column::codeQm, 1);
    cam.write(1, Column::codeQs, 1);
    cam.write(2, Column::codeG, 142);
    cam.write(3, Column::codeG, 138);
    cam.start({.master_count = 0, .slave_bits = -far - 1});
    cam.advance({count, far, far, -far - 1, 0});
    expect_sane(cam.step());
    cam.start({.master_count = count, .slave_bits = far});
    cam.advance({~count, -far - 1, -far - 1, far, 1e300});
    expect_sane(cam.step());
  }
}

}  // namespace
}  // namespace drycut::devices::camming4
