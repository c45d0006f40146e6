#include "sim/studies/design/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drycut::sim::studies {

void fit_with_room(const DesignJob& job, const std::function<bool(const DesignedCam&)>& fit,
                   const DesignGrid& grid) {
  for (const double room : {1.0, 0.998, 0.99, 0.97, 0.94, 0.9}) {
    auto narrower = job;
    for (const auto limit : {&DesignJob::max_velocity, &DesignJob::max_acceleration, &DesignJob::max_travel})
      if (narrower.*limit) narrower.*limit = room * *(narrower.*limit);
    if (!hindrances(narrower).empty()) return;
    const auto cam = design_cam(narrower, grid);
    if (!cam || fit(*cam)) return;
    const bool limited = job.max_velocity || job.max_acceleration || job.max_travel;
    if (!limited) return;
  }
}

bool keeps_limits(const DesignJob& job, const CamFigures& figures) {
  constexpr double rounding = 1 + 1e-9;
  if (job.max_velocity && figures.ratio * *job.speed > *job.max_velocity * rounding) return false;
  if (job.max_acceleration && figures.gradient * *job.speed * *job.speed > *job.max_acceleration * rounding)
    return false;
  return !job.max_travel || figures.high - figures.low <= *job.max_travel * rounding;
}

std::optional<double> whole_units(const char* option, double metres, double unit, const char* name,
                                  Problems& problems) {
  const double number = metres / unit;
  const double whole = std::round(number);
  if (std::abs(number - whole) <= 1e-7 * std::max(1.0, std::abs(number))) return whole;
  problems.push_back(
      {"design.impossible"_code, option, 1, 1,
       fmt::format("{} is no whole number of {}: what is left would add up", length_text(metres), name),
       fmt::format("the nearest is {}", length_text(whole * unit))});
  return {};
}

}  // namespace drycut::sim::studies
