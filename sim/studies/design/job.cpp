#include "sim/studies/design/job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "sim/cams/report.hpp"

namespace drycut::sim::studies {

namespace {

constexpr int coarse = 32;  // steps of half the way, to see whether there is a move at all

/// A limit of the job.
struct JobBound {
  const char* option;
  std::optional<double> DesignJob::*value;
  MoveGoal least;
  std::string (*text)(double);
};
constexpr JobBound bounds[] = {
    {"--max-velocity", &DesignJob::max_velocity, MoveGoal::ratio, velocity_text},
    {"--max-acceleration", &DesignJob::max_acceleration, MoveGoal::gradient, acceleration_text},
    {"--max-travel", &DesignJob::max_travel, MoveGoal::excursion, length_text},
};

std::optional<Move> coarse_move(const DesignJob& job, MoveGoal goal) {
  auto problem = move_of(job);
  problem.smooth = job.goal == MoveGoal::jerk;
  problem.goal = goal;
  problem.steps = coarse;
  return best_move(problem);
}

bool is_possible(const DesignJob& job) {
  constexpr double rounding = 1e-5;
  // In the synchronous way the slave has the master's speed, whatever it does behind it.
  if (job.max_velocity && *job.max_velocity < job.ratio() * *job.speed) return false;
  if (job.max_travel && *job.max_travel < job.sync) return false;
  const auto move = coarse_move(job, MoveGoal::violation);
  return move && move->value < rounding;
}

/// The least that a limit must be, in its own unit; nothing if the job is impossible without it too.
std::optional<double> least(const DesignJob& job, const JobBound& bound) {
  auto without = job;
  (without.*bound.value).reset();
  if (!is_possible(without)) return {};
  const auto move = coarse_move(without, bound.least);
  if (!move) return {};
  switch (bound.least) {
    case MoveGoal::ratio:
      return std::max(move->value, job.ratio()) * *job.speed;
    case MoveGoal::gradient:
      return move->value * *job.speed * *job.speed;
    default:
      return job.sync + 2 * std::max(0.0, move->value);
  }
}

/// The largest speed of the master at which the job is possible, 0 if there is none.
double most_speed(DesignJob job) {
  double possible = 0;
  double impossible = *job.speed;
  constexpr int halvings = 14;
  for (int i = 0; i < halvings; ++i) {
    job.speed = (possible + impossible) / 2;
    (is_possible(job) ? possible : impossible) = *job.speed;
  }
  return possible;
}

/// A number that a message names as the least: a little more than what was found coarsely, four digits.
double roomy(double least) {
  const double more = least * 1.005;
  const double digit = std::pow(10, std::floor(std::log10(more)) - 3);
  return std::ceil(more / digit) * digit;
}

void add_limits(const DesignJob& job, Problems& problems) {
  const bool any = job.max_velocity || job.max_acceleration || job.max_travel;
  if (!any || job.is_steady()) {
    if (job.max_velocity && job.ratio() * *job.speed > *job.max_velocity)
      problems.push_back({"design.impossible"_code, "--max-velocity", 1, 1,
                          fmt::format("{} is less than the web's speed", velocity_text(*job.max_velocity)),
                          fmt::format("give {} at least", velocity_text(*job.speed))});
    return;
  }
  if (is_possible(job)) return;
  const double speed = job.speed && (job.max_velocity || job.max_acceleration) ? most_speed(job) : 0;
  const auto slower =
      speed > 0 ? fmt::format(", or run the master at {} at most", velocity_text(0.995 * speed)) : "";
  bool told = false;
  for (const auto& bound : bounds) {
    const auto& given = job.*bound.value;
    if (!given) continue;
    const auto needed = least(job, bound);
    if (!needed) continue;
    told = true;
    problems.push_back({"design.impossible"_code, bound.option, 1, 1,
                        fmt::format("{} is too little for this job", bound.text(*given)),
                        fmt::format("give {} at least{}", bound.text(roomy(*needed)), slower)});
  }
  if (told) return;
  problems.push_back({"design.impossible"_code, "--max-velocity", 1, 1,
                      "no one of the limits alone keeps the job from being done",
                      "raise several of them" + slower});
}

/// Beyond this the blade would have to be twice as fast as the web.
constexpr double most_along = 0.866;

void add_thickness(const DesignJob& job, Problems& problems) {
  const double least = job.contact();
  const double most = 2 * most_along * job.radius();
  if (job.thickness > job.radius() / 2) {
    problems.push_back(
        {"design.impossible"_code, "--thickness", 1, 1,
         fmt::format("{} are too much for blades on a radius of {}", length_text(job.thickness),
                     length_text(std::round(job.radius() * 1e4) / 1e4)),
         fmt::format("give {} at most", length_text(std::floor(job.radius() * 5e3) / 1e4))});
  } else if (job.sync < least - 1e-9) {
    problems.push_back(
        {"design.impossible"_code, "--sync", 1, 1,
         fmt::format("{} is less than the way on which the blade is in {} of material", length_text(job.sync),
                     length_text(job.thickness)),
         fmt::format("give {} at least, or leave it out", length_text(std::ceil(least * 1e4) / 1e4))});
  } else if (job.sync > most || job.sync_slave() >= job.slave) {
    problems.push_back({"design.impossible"_code, "--sync", 1, 1,
                        fmt::format("on {} the blade would swing too far out of the web to keep its speed",
                                    length_text(job.sync)),
                        fmt::format("leave it out for the {} on which the blade is in the material",
                                    length_text(std::ceil(least * 1e4) / 1e4))});
  }
}

}  // namespace

// A blade on a circle is as far along the web as the sine of its angle; its speed along it is the cosine's
// share.
double DesignJob::ratio() const {
  if (kind == DesignKind::feed) return 0;
  const double along = thickness > 0 ? sync / 2 / radius() : 0;
  return 1 / std::sqrt(1 - along * along);
}

double DesignJob::sync_slave() const {
  if (kind == DesignKind::feed) return 0;
  return thickness > 0 ? 2 * radius() * std::asin(sync / 2 / radius()) : sync;
}

double DesignJob::radius() const { return slave * blades / units::turn; }

double DesignJob::contact() const {
  return thickness > 0 ? 2 * std::sqrt(thickness * (2 * radius() - thickness)) : 0;
}

bool DesignJob::is_steady() const {
  constexpr double rounding = 1e-9;
  return std::abs(distance()) <= rounding * length;
}

MoveFriction DesignJob::friction() const {
  if (goal != MoveGoal::energy) return {};
  return {viscous / (inertia * *speed), coulomb / (inertia * *speed * *speed)};
}

MoveProblem move_of(const DesignJob& job) {
  constexpr double just_inside = 1 - 1e-7;
  MoveProblem problem;
  problem.way = job.way();
  problem.distance = job.distance();
  problem.ratio = job.ratio();
  problem.goal = job.goal;
  problem.friction = job.friction();
  if (job.max_velocity) problem.limits.ratio = just_inside * *job.max_velocity / *job.speed;
  if (job.max_acceleration)
    problem.limits.gradient = just_inside * *job.max_acceleration / (*job.speed * *job.speed);
  if (job.max_travel) problem.limits.excursion = just_inside * (*job.max_travel - job.sync) / 2;
  problem.limits.no_reverse = job.no_reverse;
  return problem;
}

Problems hindrances(const DesignJob& job) {
  Problems problems;
  if (job.sync >= job.length)
    problems.push_back({"design.impossible"_code, "--sync", 1, 1,
                        fmt::format("{} leaves nothing of the {} of a piece", length_text(job.sync),
                                    length_text(job.length)),
                        fmt::format("give less than {}", length_text(job.length))});
  if (job.kind == DesignKind::rotary_knife && job.sync >= job.slave)
    problems.push_back({"design.impossible"_code, "--sync", 1, 1,
                        fmt::format("{} is longer than the way of {} from blade to blade",
                                    length_text(job.sync), length_text(job.slave)),
                        fmt::format("give less than {}", length_text(job.slave))});
  if (job.thickness > 0 && problems.empty()) add_thickness(job, problems);
  if (problems.empty()) add_limits(job, problems);
  return problems;
}

std::string length_text(double metres) {
  return fmt::format("{} mm", cams::number_text(metres * units::millimetres, 9));
}
std::string velocity_text(double metres_a_second) {
  return fmt::format("{} m/s", cams::number_text(metres_a_second, 6));
}
std::string acceleration_text(double metres_a_second_squared) {
  return fmt::format("{} m/s2", cams::number_text(metres_a_second_squared, 6));
}

}  // namespace drycut::sim::studies
