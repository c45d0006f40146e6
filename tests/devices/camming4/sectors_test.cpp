#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <vector>

#include "tests/devices/camming4/cam_bench.hpp"
#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::ElementsAre;

constexpr int slave_bits = 1000;  ///< a Um
constexpr int master_bits = 100;  ///< a Um

/// Runs tables through the whole device-> The slave does not move and nothing regulates, so the following
/// error is the theoretical way, to a thousandth of a Um.
class Camming4Sectors : public Camming4Test {
 protected:
  void prepare() {
    does("power");
    set({{"measure", 1},
         {"pulse", slave_bits},
         {"measurem", 1},
         {"pulsem", master_bits},
         {"decpt", 1},
         {"pgain", 0},
         {"feedfw", 0},
         {"syncrange", 999999}});
    does("blocked=1 INIT posit=0 positm=0 sample");
    master_at_ = 0;
  }
  /// The master runs on to `um` after the cam's start, at most a Um a sample.
  void master_to(double um) {
    const auto target = std::llround(um * master_bits);
    while (master_at_ < target) {
      const auto step = std::min<std::int64_t>(master_bits, target - master_at_);
      master_at_ += step;
      tick(step);
    }
  }
  double slave_um() { return get("follerr") / static_cast<double>(slave_bits); }

 private:
  std::int64_t master_at_ = 0;
};

/// A ramp of the closed forms, written down again from spec qem.md 5.4 and 8.4.
struct Piece {
  double master;
  double v0;
  double v1;
  bool cycloid = false;
  [[nodiscard]] double at(double m) const {
    const double p = m / master;
    const double share = cycloid ? p * p / 2 - (1 - std::cos(2 * pi * p)) / (4 * pi * pi) : p * p / 2;
    return master * (v0 * p + (v1 - v0) * share);
  }
};

struct SectorCase {
  std::vector<std::int32_t> row;
  int entry;  ///< hundredths of the master's speed
  double master;
  std::function<double(double)> slave;
};

std::function<double(double)> pieces(std::vector<Piece> list) {
  return [list](double m) {
    double s = 0;
    for (const Piece& piece : list) {
      if (m <= piece.master) return s + piece.at(m);
      s += piece.at(piece.master);
      m -= piece.master;
    }
    return s;
  };
}

std::vector<SectorCase> sector_cases() {
  const double quarter = 50 * pi;  // of a circle of radius 100
  const auto along = [](double scale) { return [scale](double m) { return scale * m; }; };
  // From (0, 0) to (100, 100): clockwise about (100, 0), counterclockwise about (0, 100).
  const auto sine = [](double m) { return 100 * std::sin(m / 100); };
  const auto versine = [](double m) { return 100 * (1 - std::cos(m / 100)); };
  return {
      {{131, 100, 30}, 0, 100, pieces({{100, 0, 0.6}})},
      {{132, 100, 60}, 0, 100, pieces({{50, 0, 0.7}, {50, 0.7, 1}})},
      {{133, 100, 120}, 100, 100, pieces({{100, 1, 1.4}})},
      {{134, 100, 80}, 100, 100, pieces({{50, 1, 0.6}, {50, 0.6, 1}})},
      {{135, 100, 70}, 100, 100, pieces({{50, 1, 0.9}, {50, 0.9, 0}})},
      {{150, 100, 50, 40, 10000}, 0, 140, pieces({{40, 0, 0.5}, {100, 0.5, 0.5}})},
      {{150, 100, 50, 40, 14000}, 0, 140, pieces({{20, 0, 0.45}, {20, 0.45, 0.5}, {100, 0.5, 0.5}})},
      {{151, 100, 80, 40, 22000}, 50, 140, pieces({{100, 0.5, 1.1}, {20, 1.1, 0.55}, {20, 0.55, 0}})},
      {{152, 4, 3, 100, 37500}, 0, 100, pieces({{100, 0, 0.75}})},
      {{153, 4, 3, 100, 60000}, 25, 100, pieces({{50, 0.25, 0.7}, {50, 0.7, 0.75}})},
      {{154, 50, 100}, 25, 50, along(2)},
      {{170, 100, 100, 0, 100}, 0, quarter, versine},
      {{171, 100, 100, 0, 100}, 0, quarter, sine},
      {{172, 100, 100, 0, 100}, 0, quarter, sine},
      {{173, 100, 100, 0, 100}, 0, quarter, versine},
      {{175, 100, 100, 0, 100}, 0, quarter, along(900 / quarter)},
      {{231, 100, 30}, 0, 100, pieces({{100, 0, 0.6, true}})},
      {{232, 100, 60}, 0, 100, pieces({{50, 0, 0.7, true}, {50, 0.7, 1, true}})},
      {{233, 100, 120}, 100, 100, pieces({{100, 1, 1.4, true}})},
      {{234, 100, 80}, 100, 100, pieces({{50, 1, 0.6, true}, {50, 0.6, 1, true}})},
      {{235, 100, 70}, 100, 100, pieces({{50, 1, 0.9, true}, {50, 0.9, 0, true}})},
      {{252, 4, 3, 100, 37500}, 0, 100, pieces({{100, 0, 0.75, true}})},
      {{253, 4, 3, 100, 60000}, 25, 100, pieces({{50, 0.25, 0.7, true}, {50, 0.7, 0.75, true}})},
      {{254, 50, 100}, 25, 50, along(2)},
  };
}

TEST_F(Camming4Sectors, MovementsFollowTheirClosedForms) {
  for (const SectorCase& expected : sector_cases()) {
    const int code = expected.row.front();
    SCOPED_TRACE(code);
    prepare();
    row(1, {154, 100, expected.entry, 0, 0});
    row(2, expected.row);
    row(3, {136, 0, 0, 0, 0});
    does("STARTCAM");
    for (const double u : {0.0, 0.1, 0.25, 0.5, 0.6, 0.75, 0.9, 0.99}) {
      const double m = std::round(u * expected.master * master_bits) / master_bits;
      master_to(100 + m);
      shows("rowex=2");
      EXPECT_NEAR(slave_um(), expected.entry + expected.slave(m), 0.00051) << m;
    }
    if (code >= 170 && code <= 175) {
      EXPECT_EQ(get("codeQma2"), static_cast<int>(expected.master * 0.99));
    }
    master_to(101 + expected.master);
    shows("!camex !error");
    EXPECT_NEAR(slave_um(), expected.entry + expected.slave(expected.master), 0.00051);
    covers(
        {"sector " + std::to_string(code), "sector 136", "codeG", "codeQm", "codeQs", "codeQma", "codeQsa"});
  }
}

TEST_F(Camming4Sectors, TheClockwiseTangentTurnsBackward) {
  prepare();
  rows({{154, 100, 1000}, {174, 100, 100, 0, 100}, {136}});
  does("STARTCAM");
  master_to(150);
  EXPECT_NEAR(slave_um(), 1000 - 900 * 50 / (50 * pi), 0.00051);
  master_to(300);
  EXPECT_NEAR(slave_um(), 1000 - 900, 0.00051);
  covers({"sector 174"});
}

TEST_F(Camming4Sectors, UpdatesChangeTheCountsAndNothingElse) {
  struct Case {
    int code;
    double master;  ///< at the boundary [Um]
    double slave;
  };
  for (const Case& expected :
       {Case{130, 300, 60}, Case{139, 180, 20}, Case{140, 120, 60}, Case{141, 300, 40}, Case{142, 120, 40},
        Case{143, 300 - 1.2, 60 - 0.04}, Case{144, 1.2, 60}, Case{145, 300, 0.04}, Case{146, 1.2, 0.04}}) {
    SCOPED_TRACE(expected.code);
    prepare();
    rows({{154, 300, 60}, {expected.code, 120, 40}, {154, 300, 60}, {136}});
    does("STARTCAM");
    master_to(310.5);
    shows("rowex=3");
    EXPECT_NEAR(slave_um(), 62.1, 0.00051);  // the axis has not noticed
    EXPECT_EQ(get("encoderm"), std::lround((expected.master + 10.5) * master_bits));
    EXPECT_EQ(get("positm"), static_cast<int>(expected.master + 10.5));
    // The slave has not moved: its count is the boundary's less the way to it.
    EXPECT_EQ(get("encoder"), std::lround((expected.slave - 60) * slave_bits));
    covers({"sector " + std::to_string(expected.code)});
  }
}

TEST_F(Camming4Sectors, JumpsGoWhereTheySay) {
  prepare();
  rows({{154, 10, 10}, {190, 1, 2}, {137, 5}, {77}, {154, 10, 20}, {138}});
  does("STARTCAM");
  std::vector<int> rows;
  std::vector<int> jumps;
  for (int m = 5; m <= 85; m += 10) {
    master_to(m);
    rows.push_back(get("rowex"));
    jumps.push_back(get("codeQma2"));
  }
  EXPECT_THAT(rows, ElementsAre(1, 1, 1, 5, 1, 1, 1, 5, 1));
  EXPECT_THAT(jumps, ElementsAre(0, 1, 2, 0, 0, 1, 2, 0, 0));
  shows("positm=5");  // each loop takes 40 Um off
  EXPECT_NEAR(slave_um(), 2 * 50 + 5, 0.00051);
  shows("posit=-100");
  covers({"sector 137", "sector 138", "sector 190", "rowex"});
}

TEST_F(Camming4Sectors, AStartClearsTheJumpCountersForTheProgramToo) {
  prepare();
  rows({{154, 10, 10}, {190, 1, 5}, {136}});
  does("STARTCAM");
  master_to(25);
  shows("codeQma2=2");
  after("STOPCAM until:still", "codeQma2=2");
  after("STARTCAM", "codeQma2=0");
  covers({"codeQma", "sector 190"});
}

TEST_F(Camming4Sectors, TheStartSyncWaitsForItsQuota) {
  prepare();
  rows({{160, 50, 0, 0, 0, 9}, {154, 100, 100, 0, 0, 10}, {136}});
  does("STARTCAM");
  master_to(49.5);
  shows("rowex=1 codeMex=9 camex");
  EXPECT_EQ(slave_um(), 0);
  master_to(60);
  shows("rowex=2 codeMex=10");
  EXPECT_NEAR(slave_um(), 10, 0.00051);
  shows("!warning");
  covers({"sector 160", "codeM"});
}

TEST_F(Camming4Sectors, AStartBeyondTheQuotaIsWarningNine) {
  prepare();
  master_to(51);
  rows({{160, 50}, {154, 100, 100}});
  after("STARTCAM", "wrncode=9 wrnvalue=1 camex");
  master_to(80);
  shows("rowex=1");
  for (int i = 0; i < 40; ++i) tick(-master_bits);
  shows("positm=40");
  for (int i = 0; i < 20; ++i) tick(master_bits);
  shows("rowex=2");
  EXPECT_NEAR(slave_um(), 10, 0.00051);
  covers({"warning 9"});
}

/// Each warning of the cam, alone in its table.
TEST_F(Camming4Sectors, TablesThatWarnGoOn) {
  struct Case {
    std::vector<std::vector<std::int32_t>> rows;
    int warning;
    int row;
  };
  const std::vector<Case> cases = {
      {{{154, 100, 100}, {133, 100, 40}, {136}}, 5, 2},
      {{{154, 100, 100}, {131, 100, 40}, {136}}, 6, 2},
      {{{154, 100, 100}, {134, 100, 40}, {136}}, 7, 2},
      {{{154, 100, 100, 1}, {130}, {154, 100, 50}, {136}}, 10, 3},
  };
  for (const Case& expected : cases) {
    SCOPED_TRACE(expected.warning);
    prepare();
    int number = 1;
    for (const auto& values : expected.rows) {
      row(number, {0, 0, 0, 0, 0});
      row(number++, values);
    }
    does("STARTCAM");
    master_to(150);
    shows("warning");
    EXPECT_EQ(get("wrncode"), expected.warning);
    EXPECT_EQ(get("wrnvalue"), expected.row);
    shows("!error camex");
    covers({"warning " + std::to_string(expected.warning), "st_warning", "wrncode", "wrnvalue"});
  }
}

TEST_F(Camming4Sectors, TheDecelerationLimitIsWarningTwo) {
  // 1 to 0 over 100 Um at 500 Um/s: 2500 Um/s2.
  prepare();
  does("unitvel=1 decpt=0 taccmax=999 tdecmax=999");
  rows({{154, 100, 100}, {135, 100, 50}, {136}});
  const auto run = [&](int maxvel) {
    write("maxvel", maxvel);
    does("RSWRN");
    for (int i = 0; i < 20; ++i) tick(master_bits);
    does("STARTCAM!");
    for (int i = 0; i < 150; ++i) tick(master_bits);
    shows("rowex=2");
    const int warning = get("wrncode");
    EXPECT_EQ(get("wrnvalue"), warning == 0 ? 0 : 2);
    for (int i = 0; i < 60; ++i) tick(master_bits);
    shows("!camex");
    return warning;
  };
  EXPECT_EQ(run(24975), 0);  // over 9.99 s
  EXPECT_EQ(run(24974), 2);
  covers({"tdecmax", "warning 2"});
}

}  // namespace
}  // namespace drycut::devices::camming4
