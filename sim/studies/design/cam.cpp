#include "sim/studies/design/cam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace drycut::sim::studies {

namespace {

using devices::CamLaw;
using devices::CamMotion;
using devices::CamPiece;
using devices::CamPolynomial;

std::vector<MoveStep> steady(int steps) { return std::vector<MoveStep>(2 * static_cast<std::size_t>(steps)); }

/// The synchronous way of a blade that swings through the material: cubics along the law, which leave it by
/// less than a micrometre.
void add_swing(const DesignJob& job, int pieces, CamLaw& law) {
  const double radius = job.radius();
  const double width = job.sync / pieces;
  const auto along = [&](int i) { return (i * width - job.sync / 2) / radius; };
  const auto slave = [&](int i) { return radius * std::asin(along(i)) + job.sync_slave() / 2; };
  const auto rise = [&](int i) { return width / std::sqrt(1 - along(i) * along(i)); };
  for (int i = 0; i < pieces; ++i) {
    const double way = slave(i + 1) - slave(i);
    const CamPolynomial cubic{
        {slave(i), rise(i), 3 * way - 2 * rise(i) - rise(i + 1), rise(i) + rise(i + 1) - 2 * way}};
    law.pieces.push_back({i * width, width, 0, i + 1, cubic});
  }
}

CamLaw law_of(const DesignJob& job, const std::vector<MoveStep>& steps, int swing) {
  CamLaw law;
  law.master_length = job.length;
  law.slave_length = job.slave;
  const double width = job.way() / static_cast<double>(steps.size());
  double slave = job.sync_slave();
  double ratio = job.ratio();
  if (job.thickness > 0)
    add_swing(job, swing, law);
  else if (job.sync > 0)
    law.pieces.push_back({0, job.sync, 0, 1, CamPolynomial{{0, slave}}});
  const int row = law.pieces.empty() ? 1 : law.pieces.back().row;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto& [begin, end] = steps[i];
    const double rise = end - begin;
    CamPolynomial cubic{{slave, ratio * width, begin * width * width / 2, rise * width * width / 6}};
    law.pieces.push_back(
        {job.sync + static_cast<double>(i) * width, width, 0, row + static_cast<int>(i) + 1, cubic});
    slave += cubic.c[1] + cubic.c[2] + cubic.c[3];
    ratio += width * (begin + end) / 2;
  }
  return law;
}

/// Where the slave turns round: from the end of the move, the first place at which it stands.
double turning_point(const DesignJob& job, const CamLaw& law) {
  for (std::size_t i = law.pieces.size(); i-- > 0;) {
    const auto& piece = law.pieces[i];
    if (piece.begin().velocity > 0) continue;
    double stands = 0;
    double runs = piece.length;
    for (int k = 0; k < 60; ++k) {
      const double middle = (stands + runs) / 2;
      (piece.at(middle).velocity > 0 ? runs : stands) = middle;
    }
    return piece.master + stands;
  }
  return job.sync + job.way() / 2;
}

double home_of(const DesignJob& job, const CamLaw& law) {
  switch (job.kind) {
    case DesignKind::feed:
      return 0;
    case DesignKind::flying_saw:
      return turning_point(job, law);
    default:
      return job.sync + job.way() / 2;
  }
}

}  // namespace

const ClassicalMove quintic = {"quintic", 120.0 / 7, 15.0 / 8, 10 / std::numbers::sqrt3, 60};
const ClassicalMove cycloid = {"cycloid", 2 * std::numbers::pi* std::numbers::pi, 2, 2 * std::numbers::pi,
                               4 * std::numbers::pi* std::numbers::pi};

CamMotion DesignedCam::at(double master) const {
  const double cycle = std::floor(master / law.master_length);
  auto motion = devices::at(law, master - cycle * law.master_length);
  motion.position += cycle * law.slave_length;
  return motion;
}

std::optional<DesignedCam> design_cam(const DesignJob& job, const DesignGrid& grid) {
  auto problem = move_of(job);
  problem.steps = grid.steps;
  const auto made = [&]() -> std::optional<DesignedCam> {
    const auto move = job.is_steady() ? std::optional(Move{steady(grid.steps), 0}) : best_move(problem);
    if (!move) return {};
    DesignedCam cam{job, law_of(job, move->steps, grid.swing), 0, 2 * grid.steps};
    cam.home = home_of(job, cam.law);
    return cam;
  };
  auto cam = made();
  // The limit holds where the steps meet; a turning point lies within one, a little beyond.
  for (int i = 0; i < 3 && cam && job.max_travel; ++i) {
    const auto figures = figures_of(*cam);
    const double beyond = figures.high - figures.low - *job.max_travel;
    if (beyond <= 0) break;
    *problem.limits.excursion -= beyond;
    cam = made();
  }
  if (!cam || !grid.stands_at_step) return cam;
  // The nearest step on this side of the middle; the move is the same backwards.
  const double width = job.way() / cam->steps;
  const int behind = static_cast<int>(std::lround((job.length - cam->home) / width));
  problem.still = std::clamp(behind, 1, grid.steps - 1);
  cam = made();
  if (cam) cam->home = job.length - *problem.still * width;
  return cam;
}

CamFigures figures_of(const CamLaw& law, double from, double length, double master_unit, double slave_unit,
                      const DesignJob& job) {
  constexpr double points[] = {0.04691007703066802, 0.23076534494715845, 0.5, 0.7692346550528415,
                               0.953089922969332};
  constexpr double shares[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                               0.23931433524968324, 0.11846344252809454};
  constexpr int parts = 16;
  const auto friction = job.friction();
  CamFigures figures{.low = std::numeric_limits<double>::infinity(),
                     .high = -std::numeric_limits<double>::infinity()};
  const auto look = [&](const CamMotion& motion) {
    const double per = slave_unit / master_unit;
    figures.ratio = std::max(figures.ratio, std::abs(motion.velocity) * per);
    figures.gradient = std::max(figures.gradient, std::abs(motion.acceleration) * per / master_unit);
    figures.jerk = std::max(figures.jerk, std::abs(motion.jerk) * per / (master_unit * master_unit));
    figures.low = std::min(figures.low, motion.position * slave_unit);
    figures.high = std::max(figures.high, motion.position * slave_unit);
  };
  for (const auto& piece : law.pieces) {
    const double begin = std::max(0.0, from - piece.master);
    const double end = std::min(piece.length, from + length - piece.master);
    if (end <= begin) continue;
    const double width = (end - begin) / parts;
    for (int i = 0; i < parts; ++i) {
      look(piece.at(begin + i * width));
      for (int k = 0; k < 5; ++k) {
        const auto motion = piece.at(begin + (i + points[k]) * width);
        const double gradient = motion.acceleration * slave_unit / (master_unit * master_unit);
        const double ratio = motion.velocity * slave_unit / master_unit;
        const double force = gradient + friction.viscous * ratio +
                             (ratio > 0   ? 1
                              : ratio < 0 ? -1
                                          : 0) *
                                 friction.coulomb;
        figures.squares += shares[k] * width * master_unit * gradient * gradient;
        figures.forces += shares[k] * width * master_unit * force * force;
      }
    }
    look(piece.at(end));
    // A place where the slave turns round lies between the points.
    if (begin > 0 || end < piece.length) continue;
    const auto reached = piece.extremes(devices::CamOrder::position);
    figures.low = std::min(figures.low, reached.low * slave_unit);
    figures.high = std::max(figures.high, reached.high * slave_unit);
  }
  return figures;
}

CamFigures figures_of(const ClassicalMove& move, const DesignJob& job) {
  const double way = job.way();
  const double distance = job.distance();
  CamFigures figures;
  figures.squares = move.squares * distance * distance / std::pow(way, 3);
  figures.ratio = std::max(job.ratio(), std::abs(job.ratio() + move.speed * distance / way));
  figures.gradient = move.gradient * std::abs(distance) / (way * way);
  figures.jerk = move.jerk * std::abs(distance) / std::pow(way, 3);
  return figures;
}

double factor_of(const CamFigures& figures, const DesignJob& job) {
  if (job.is_steady()) return 0;
  return figures.squares * std::pow(job.way(), 3) / (job.distance() * job.distance());
}

}  // namespace drycut::sim::studies
