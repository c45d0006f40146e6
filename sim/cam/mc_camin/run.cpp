#include "sim/cam/mc_camin/run.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::sim {

namespace {

using devices::plcopen::CamMotion;
using devices::plcopen::CamSegment;

constexpr std::array orders = {CamOrder::position, CamOrder::velocity, CamOrder::acceleration,
                               CamOrder::jerk};

std::array<double, 4> numbers_of(const CamMotion& motion) {
  return {motion.position, motion.velocity, motion.acceleration, motion.jerk};
}

/// A segment at a master of its turn: an even cam meets its knots exactly.
CamMotion motion_at(const CamInRun& run, std::size_t segment, double x) {
  const CamSegment& piece = run.curve.segments[segment];
  const double u = run.curve.even ? x * static_cast<double>(run.curve.segments.size()) / run.curve.modulo -
                                        static_cast<double>(segment)
                                  : (x - piece.start) / piece.length;
  return at(piece, std::clamp(u, 0.0, 1.0));
}

CamPoint point_at(const CamInRun& run, int pass, std::size_t segment, double x) {
  const CamMotion motion = motion_at(run, segment, x);
  return {pass * run.curve.modulo + x,
          pass * run.advance() + motion.position,
          motion.velocity,
          motion.acceleration,
          motion.jerk,
          run.row_of(segment)};
}

}  // namespace

std::string increments_of(const std::string& unit) { return unit == "mm" ? "0.1 um" : "0.0001 deg"; }

int CamInRun::row_of(std::size_t segment) const {
  const std::size_t rows = cam.table.lines();
  // One segment more than rows: the first is the end of the last row's.
  const std::size_t split = curve.segments.size() - rows;
  return static_cast<int>((segment + rows - split) % rows) + 1;
}

double CamInRun::begin_of(std::size_t segment) const { return std::max(0.0, curve.segments[segment].start); }

double CamInRun::end_of(std::size_t segment) const {
  return segment + 1 < curve.segments.size() ? curve.segments[segment + 1].start : curve.modulo;
}

double CamInRun::peak(CamOrder order) const {
  double most = 0;
  for (const CamSegment& segment : curve.segments) {
    const Extremes extremes = extremes_of(segment, order);
    most = std::max({most, std::abs(extremes.low), std::abs(extremes.high)});
  }
  return most;
}

namespace {

std::vector<CamKnot> knots_of(const CamInRun& run) {
  const auto& segments = run.curve.segments;
  // Positions to a hundredth of an increment, derivatives to a millionth of their peak.
  std::array<double, 4> same{};
  for (const CamOrder order : orders)
    same[static_cast<std::size_t>(order)] = order == CamOrder::position ? 0.01 : 1e-6 * run.peak(order);
  std::vector<CamKnot> knots;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    // A turn that ends inside the last row's segment has no knot there.
    if (i == 0 && segments.front().start < 0) continue;
    auto before = numbers_of(at(segments[i == 0 ? segments.size() - 1 : i - 1], 1));
    if (i == 0) before[0] -= run.advance();
    const auto after = numbers_of(at(segments[i], 0));
    CamKnot knot{run.row_of(i), segments[i].start, run.row_of(i) == 1, {}, -1};
    for (std::size_t k = 0; k < after.size(); ++k) knot.jumps[k] = after[k] - before[k];
    for (std::size_t k = 0; k < after.size() && std::abs(knot.jumps[k]) <= same[k]; ++k)
      knot.smooth = static_cast<int>(k);
    knots.push_back(knot);
  }
  return knots;
}

}  // namespace

CamInRun run_cam_in(const devices::plcopen::CamFile& cam, const CamDuty& duty, int loops) {
  CamInRun run;
  run.cam = cam;
  run.loops = loops;
  run.refused = refusals(cam);
  if (duty.master_speed) run.master_speed = *duty.master_speed * increments_per_unit;
  run.curve.modulo = cam.master_modulo;
  if (run.refused.empty())
    run.curve = curve_of(cam.table, cam.interpolation, cam.master_modulo, cam.slave_modulo, cam.endless);
  run.knots = knots_of(run);
  return run;
}

std::vector<CamPoint> sample_cam_in(const CamInRun& run, bool both_sides) {
  constexpr int points_a_turn = 1000;
  const double grain = run.curve.modulo / (points_a_turn - 1);
  const double same = 1e-9 * grain;
  const std::size_t count = run.curve.segments.size();
  std::vector<CamPoint> points;
  for (int pass = 0; pass < run.loops; ++pass) {
    int next = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double end = run.end_of(i);
      points.push_back(point_at(run, pass, i, run.begin_of(i)));
      while (next * grain <= run.begin_of(i) + same) ++next;
      for (; next * grain < end - same; ++next) points.push_back(point_at(run, pass, i, next * grain));
      const CamPoint last = point_at(run, pass, i, end);
      const bool is_last = pass + 1 == run.loops && i + 1 == count;
      const CamPoint after = point_at(run, pass, (i + 1) % count, run.begin_of((i + 1) % count));
      const double onward = i + 1 == count ? run.advance() : 0;
      const bool jumps =
          std::abs(after.slave + onward - last.slave) > 0.01 ||
          std::abs(after.velocity - last.velocity) > 1e-9 * std::max(1.0, std::abs(last.velocity));
      if (is_last || both_sides || jumps) points.push_back(last);
      // A row that is held ends where the next one begins: the end of the run is the next turn's first.
      if (is_last && jumps && run.curve.segments[i].step)
        points.push_back(point_at(run, pass + 1, 0, run.begin_of(0)));
    }
  }
  return points;
}

std::vector<CamPoint> sample_cam_in_at(const CamInRun& run, std::vector<double> masters) {
  std::sort(masters.begin(), masters.end());
  std::vector<CamPoint> points;
  for (const double master : masters) {
    const int pass = std::clamp(static_cast<int>(std::floor(master / run.curve.modulo)), 0, run.loops - 1);
    const double x = master - pass * run.curve.modulo;
    if (x < run.curve.modulo)
      points.push_back(point_at(run, pass, segment_at(run.curve, x), x));
    else if (run.curve.segments.back().step)
      points.push_back(point_at(run, pass + 1, 0, run.begin_of(0)));
    else
      points.push_back(point_at(run, pass, run.curve.segments.size() - 1, x));
    points.back().master = master;
  }
  return points;
}

}  // namespace drycut::sim
