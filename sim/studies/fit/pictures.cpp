#include "sim/studies/fit/pictures.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace drycut::sim::studies {

namespace {

/// A line over time that breaks where instants are missing.
renders::Curve line_of(const std::string& label, const Replayed& one, const std::vector<double>& values) {
  renders::Curve curve;
  curve.label = label;
  for (std::size_t i = 0; i < one.times.size(); ++i) {
    if (i > 0 && one.times[i] - one.times[i - 1] > 1.5 * one.step) {
      curve.x.push_back((one.times[i] + one.times[i - 1]) / 2);
      curve.y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    curve.x.push_back(one.times[i]);
    curve.y.push_back(values[i]);
  }
  return curve;
}

renders::Panel unexplained(const Prose& title, const std::string& y_label, const std::vector<double>& x,
                           const std::vector<double>& left) {
  renders::Curve dots{"unexplained", x, left};
  dots.style = renders::Curve::Style::points;
  return {title, y_label, {std::move(dots)}, {{"", 0, 0}}, {}};
}

renders::Plot unexplained_over(const std::string& name, const Prose& title, const std::string& x_label,
                               const std::vector<double>& x, const Replayed& one) {
  renders::Plot plot;
  plot.name = name;
  plot.title = title;
  plot.x_label = x_label;
  plot.panels.push_back(unexplained("", "torque, model less recorded [N m]", x, one.torque_left));
  return plot;
}

}  // namespace

renders::Plot replay_over_time(const std::string& name, const Prose& title, const Replayed& one) {
  renders::Plot plot;
  plot.name = name;
  plot.title = title;
  plot.x_label = "time in the recording [s]";
  plot.panel_height = 240;
  auto recorded = line_of("recorded", one, one.torque);
  recorded.faint = true;  // seen on both sides of the model's, which lies on it
  auto with_left = one.torque;
  for (std::size_t i = 0; i < with_left.size(); ++i) with_left[i] += one.torque_left[i];
  plot.panels.push_back({"Torque of the motor, filtered",
                         "[N m]",
                         {std::move(recorded), line_of("model", one, with_left)},
                         {},
                         {}});
  plot.panels.push_back(unexplained("Unexplained: model less recorded", "[N m]", one.times, one.torque_left));
  plot.panels.push_back({"Speed of the motor", "[rpm]", {line_of("speed", one, one.speed)}, {}, {}});
  return plot;
}

renders::Plot unexplained_over_speed(const std::string& name, const Replayed& one) {
  return unexplained_over(name, "What is left unexplained, by speed and direction",
                          "speed of the motor [rpm]", one.speed, one);
}

renders::Plot unexplained_over_position(const std::string& name, const Replayed& one) {
  return unexplained_over(name, "What is left unexplained, by position",
                          fmt::format("position [{}]", one.position_unit), one.position, one);
}

}  // namespace drycut::sim::studies
