#include "sim/cam/mc_camin/run.hpp"

#include <cmath>

namespace drycut::sim {

namespace {

using devices::CamMotion;
using devices::CamOrder;

constexpr std::array orders = {CamOrder::position, CamOrder::velocity, CamOrder::acceleration,
                               CamOrder::jerk};

std::array<double, 4> numbers_of(const CamMotion& motion) {
  return {motion.position, motion.velocity, motion.acceleration, motion.jerk};
}

std::vector<CamKnot> knots_of(const CamInRun& run) {
  const auto& pieces = run.law.pieces;
  // Positions to a hundredth of an increment, derivatives to a millionth of their peak.
  std::array<double, 4> same{};
  for (const CamOrder order : orders)
    same[static_cast<std::size_t>(order)] = order == CamOrder::position ? 0.01 : 1e-6 * run.peak(order);
  std::vector<CamKnot> knots;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    // A turn that ends inside the last row's segment has no knot there.
    if (i == 0 && pieces.front().master < 0) continue;
    auto before = numbers_of(pieces[i == 0 ? pieces.size() - 1 : i - 1].end());
    if (i == 0) before[0] -= run.law.slave_length;
    const auto after = numbers_of(pieces[i].begin());
    CamKnot knot{pieces[i].row, pieces[i].master, pieces[i].row == 1, {}, -1};
    for (std::size_t k = 0; k < after.size(); ++k) knot.jumps[k] = after[k] - before[k];
    for (std::size_t k = 0; k < after.size() && std::abs(knot.jumps[k]) <= same[k]; ++k)
      knot.smooth = static_cast<int>(k);
    knots.push_back(knot);
  }
  return knots;
}

}  // namespace

std::string increments_of(const std::string& unit) { return unit == "mm" ? "0.1 um" : "0.0001 deg"; }

CamInRun run_cam_in(const devices::plcopen::CamFile& cam, const CamDuty& duty, int loops) {
  CamInRun run;
  run.cam = cam;
  run.loops = loops;
  run.refused = refusals(cam);
  if (duty.master_speed) run.master_speed = *duty.master_speed * increments_per_unit;
  run.law.master_length = cam.master_modulo;
  if (!run.refused.empty()) return run;
  const auto curve = curve_of(cam.table, cam.interpolation, cam.master_modulo, cam.slave_modulo, cam.endless);
  run.law = curve;
  run.turns = curve.turns;
  run.holds = cam.interpolation == devices::plcopen::Interpolation::step_direct;
  run.knots = knots_of(run);
  return run;
}

}  // namespace drycut::sim
