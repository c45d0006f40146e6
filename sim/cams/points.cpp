#include "sim/cams/points.hpp"

#include <fmt/format.h>

#include <iterator>

#include "sim/cams/findings.hpp"
#include "sim/cams/report.hpp"

namespace drycut::sim::cams {

std::string cam_csv(const std::vector<CamPoint>& points, std::optional<double> master_per_s) {
  std::string text(cam_csv_header);
  if (master_per_s) text += ",time,velocity_t,acceleration_t,jerk_t";
  text += '\n';
  const auto out = std::back_inserter(text);
  for (const auto& p : points) {
    // Adding 0 turns -0 into 0.
    fmt::format_to(out, "{},{},{},{},{},{}", p.master + 0.0, p.position + 0.0, p.velocity + 0.0,
                   p.acceleration + 0.0, p.jerk + 0.0, p.row);
    if (master_per_s) {
      const double v = *master_per_s;
      fmt::format_to(out, ",{},{},{},{}", p.master / v + 0.0, p.velocity * v + 0.0,
                     p.acceleration * v * v + 0.0, p.jerk * v * v * v + 0.0);
    }
    text += '\n';
  }
  return text;
}

std::string cam_samples_text(const std::vector<CamPoint>& points) {
  Columns columns({{"master"}, {"slave"}, {"velocity"}, {"acceleration"}, {"jerk"}, {"sector"}});
  for (const auto& p : points)
    columns.add({number_text(p.master), number_text(p.position), number_text(p.velocity),
                 number_text(p.acceleration), number_text(p.jerk), std::to_string(p.row)},
                points.size());
  return columns.text();
}

}  // namespace drycut::sim::cams
