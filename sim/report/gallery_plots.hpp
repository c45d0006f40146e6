#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "sim/loop/recorder.hpp"
#include "sim/report/statistics.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::report {

/// Rows of a recording.
struct Rows {
  std::size_t first = 0;
  std::size_t end = 0;
  [[nodiscard]] std::size_t count() const { return end - first; }
};
/// Those from one time to another, both included.
Rows rows_between(const loop::Recording& recording, Time from, const std::optional<Time>& until);
/// The numbers of an event's value in the window of a plot.
EventNumbers event_numbers(const loop::EventLog& events, const std::string& event, const std::string& value,
                           const scenario::PlotRequest& plot);
/// A channel over time [s]; of many rows a thinned one (renders/decimate.hpp).
renders::Curve channel_curve(const loop::Recording& recording, const loop::Recording::Column& column,
                             Rows rows);
/// "time [s]", with how the curves over it are thinned, if they are.
std::string time_label(const loop::Recording& recording, Rows rows);

// Plots whose x is not time, for plots_of.

/// "following error [counts]": a title with the units of what is shown.
std::string axis_label(const std::string& title, const std::vector<std::string>& units);

/// How often each value of the panel's event came, with its limits, mean and capability (Cp and Cpk from the
/// sample's standard deviation).
void draw_histogram(const loop::Recording& recording, const scenario::PlotRequest& request,
                    renders::Plot& plot);

/// Torque over speed of a plant's servo motor at every record instant, with the limits of its data sheet:
/// peak torque as the drive gives it, rated torque up to rated speed.
void draw_motor(const scenario::Scenario& scenario, const loop::Recording& recording,
                const scenario::PlotRequest& request, renders::Plot& plot);

/// What of a motor is recorded for that: speed, then torque.
std::vector<std::string> motor_channels(const std::string& plant);
/// True if the plant of that name has the parameters of a servo motor.
bool has_motor_limits(const scenario::Scenario& scenario, const std::string& plant);

}  // namespace drycut::sim::report
