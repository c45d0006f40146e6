#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "renders/plots.hpp"
#include "sim/loop/drive_judge.hpp"
#include "sim/loop/statistics.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::report {

/// What is known of the machine besides what was recorded.
struct MachineFacts {
  std::vector<record::DriveVerdict> drives;
  std::vector<plants::Recurrence> recurrences;  ///< named with their plants: "web.wheel"
};

/// Rows of a recording.
struct Rows {
  std::size_t first = 0;
  std::size_t end = 0;
  [[nodiscard]] std::size_t count() const { return end - first; }
};
/// Those from one time to another, both included.
Rows rows_between(const record::Recording& recording, Time from, const std::optional<Time>& until);
/// The numbers of an event's value in the window of a plot.
loop::EventNumbers event_numbers(const record::EventLog& events, const std::string& event,
                                 const std::string& value, const scenario::PlotRequest& plot);
/// A channel over time [s]; of many rows a thinned one (renders/decimate.hpp).
renders::Curve channel_curve(const record::Recording& recording, const record::Recording::Column& column,
                             Rows rows);
/// "time [s]", with how the curves over it are thinned, if they are.
std::string time_label(const record::Recording& recording, Rows rows);

// Plots whose x is not time, for plots_of.

/// "following error [counts]": a title with the units of what is shown.
std::string axis_label(const std::string& title, const std::vector<std::string>& units);

/// How often each value of the panel's event came, with its limits, mean and capability (Cp and Cpk from the
/// sample's standard deviation).
void draw_histogram(const record::Recording& recording, const scenario::PlotRequest& request,
                    renders::Plot& plot);

/// Torque over speed of a plant's drive at every record instant, with its ratings.
void draw_motor(const MachineFacts& machine, const record::Recording& recording,
                const scenario::PlotRequest& request, renders::Plot& plot);

/// The amplitudes of the sines in the panel's event values over the way of the web, or over the events where
/// they have no length; the peaks with their periods and what turns as often.
void draw_spectrum(const MachineFacts& machine, const record::Recording& recording,
                   const scenario::PlotRequest& request, renders::Plot& plot);

}  // namespace drycut::sim::report
