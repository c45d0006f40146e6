#include "sim/cam/lx3vp/run.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::sim {

namespace {

using devices::lx3vp::CamProfile;
using devices::lx3vp::RatioPiece;
using devices::lx3vp::Transition;

constexpr double ticks_per_second = 10000;

/// The pieces between given rows; empty if they do not ascend.
CamProfile straight_pieces(const EcamTable& table) {
  CamProfile law;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const double length = static_cast<double>(table.rows[i].master) - table.rows[i - 1].master;
    const double rise = static_cast<double>(table.rows[i].slave) - table.rows[i - 1].slave;
    if (length <= 0) return {};
    const double ratio = rise / length;
    law.pieces.push_back({law.master_length, length, law.slave_length, ratio, ratio, Transition::constant});
    law.master_length += length;
    law.slave_length += rise;
  }
  return law;
}

/// Position of the run's master within its cycle.
struct Place {
  int pass = 0;
  double master = 0;
};

CamPoint point_at(const EcamRun& run, const Place& place, std::size_t piece) {
  const auto& law = run.law;
  // Asked of the one piece, so that its end is its own and not the next one's beginning.
  CamProfile alone;
  alone.pieces.push_back(law.pieces[piece]);
  const auto point = at(alone, place.master);
  return {run.first_master + place.pass * law.master_length + place.master,
          run.first_slave + place.pass * law.slave_length + point.position,
          point.ratio,
          point.gradient,
          point.jerk,
          static_cast<int>(piece) + 1};
}

bool steps(double before, double after) {
  return std::abs(after - before) > 1e-9 * std::max({1.0, std::abs(before), std::abs(after)});
}

}  // namespace

EcamRun run_ecam(const EcamTable& table, const CamDuty& duty, int loops) {
  EcamRun run;
  run.loops = loops;
  run.master_speed = duty.master_speed;
  if (table.time_axis > 0) run.master_speed = ticks_per_second / table.time_axis;
  if (table.is_made()) {
    if (table.made.ok()) run.law = table.made.profile;
  } else if (!table.rows.empty()) {
    run.law = straight_pieces(table);
    run.first_master = table.rows.front().master;
    run.first_slave = table.rows.front().slave;
  }
  return run;
}

std::vector<CamPoint> sample_ecam(const EcamRun& run, bool both_sides) {
  constexpr int points_a_cycle = 1000;
  std::vector<CamPoint> points;
  const auto& pieces = run.law.pieces;
  const double grain = run.cycle() / (points_a_cycle - 1);
  for (int pass = 0; pass < run.loops; ++pass) {
    int next = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const double end = pieces[i].master + pieces[i].length;
      points.push_back(point_at(run, {pass, pieces[i].master}, i));
      const double same = 1e-9 * grain;
      while (next * grain <= pieces[i].master + same) ++next;
      for (; next * grain < end - same; ++next) points.push_back(point_at(run, {pass, next * grain}, i));
      const bool is_last = pass + 1 == run.loops && i + 1 == pieces.size();
      const auto& after = pieces[(i + 1) % pieces.size()];
      if (is_last || both_sides || steps(pieces[i].r1, after.r0))
        points.push_back(point_at(run, {pass, end}, i));
    }
  }
  return points;
}

std::vector<CamPoint> sample_ecam_at(const EcamRun& run, std::vector<double> masters) {
  std::sort(masters.begin(), masters.end());
  std::vector<CamPoint> points;
  for (const double master : masters) {
    const double along = master - run.first_master;
    const int pass = std::clamp(static_cast<int>(std::floor(along / run.cycle())), 0, run.loops - 1);
    const double inside = std::max(0.0, along - pass * run.cycle());
    points.push_back(point_at(run, {pass, inside}, piece_at(run.law, inside)));
    points.back().master = master;
  }
  return points;
}

}  // namespace drycut::sim
