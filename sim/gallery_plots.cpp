// The plots of a run: curves, lanes, paths, marks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sim/gallery_plots.hpp"

#include "sim/gallery.hpp"

namespace drycut::sim {

namespace {

renders::Curve event_curve(const Recording& recording, const PlotRequest& plot, const std::string& event,
                           const std::string& value) {
  renders::Curve curve;
  curve.label = value;
  curve.style = renders::Curve::Style::points;
  double number = 0;
  for (const auto& happened : recording.events()) {
    if (!names_event(event, happened.source, happened.event)) continue;
    const auto* found = happened.find(value);
    ++number;
    const double at = happened.at_seconds();
    if (found == nullptr || at < seconds(plot.from) || (plot.until && at > seconds(*plot.until))) continue;
    curve.x.push_back(plot.against_number ? number : at);
    curve.y.push_back(found->number);
  }
  return curve;
}

std::string event_unit(const Recording& recording, const std::string& event, const std::string& value) {
  for (const auto& happened : recording.events()) {
    if (!names_event(event, happened.source, happened.event)) continue;
    if (const auto* found = happened.find(value)) return found->unit;
  }
  return "";
}

renders::Curve channel_curve(const Recording& recording, const Recording::Column& column, Time from,
                             const std::optional<Time>& until) {
  renders::Curve curve;
  curve.label = column.name;
  for (std::size_t row = 0; row < recording.times().size(); ++row) {
    const auto time = recording.times()[row];
    if (time < from || (until && time > *until)) continue;
    curve.x.push_back(seconds(time));
    curve.y.push_back(column.values[row]);
  }
  return curve;
}

renders::Lane lane_of(const Recording& recording, const PlotRequest& plot, const std::string& name) {
  auto samples = channel_curve(recording, *recording.column(name), plot.from, plot.until);
  return {std::move(samples.label), std::move(samples.x), std::move(samples.y)};
}

/// A path in a plane: one curve, or one for each whole value of the split channel.
renders::Panel path_panel(const Recording& recording, const PlotRequest& plot,
                          const PlotRequest::Panel& request) {
  const auto& x = *recording.column(request.x.text);
  const auto& y = *recording.column(request.y.text);
  const auto* split = request.split.text.empty() ? nullptr : recording.column(request.split.text);
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  std::map<double, renders::Curve> curves;
  double before = 0;
  for (std::size_t row = 0; row < recording.times().size(); ++row) {
    const auto time = recording.times()[row];
    if (time < plot.from || (plot.until && time > *plot.until)) continue;
    const double part = split == nullptr ? 1 : split->values[row];
    if (part >= 1) {
      auto& curve = curves[part];
      if (part != before && !curve.x.empty()) {
        curve.x.push_back(gap);
        curve.y.push_back(gap);
      }
      curve.x.push_back(x.values[row]);
      curve.y.push_back(y.values[row]);
    }
    before = part;
  }
  renders::Panel panel;
  panel.title = request.title;
  panel.y_label = axis_label(y.name, {y.unit});
  panel.equal_scale = true;
  for (auto& [part, curve] : curves) {
    if (split != nullptr) {
      curve.label = fmt::format("{:g}", part);
      if (part <= static_cast<double>(request.labels.size()))
        curve.label = request.labels[static_cast<std::size_t>(part) - 1].text;
    }
    panel.curves.push_back(std::move(curve));
  }
  for (const auto& point : request.points) panel.points.push_back({point.label.text, point.x, point.y});
  return panel;
}

renders::Panel panel_of(const Recording& recording, const PlotRequest& plot,
                        const PlotRequest::Panel& request) {
  renders::Panel panel;
  for (const auto& name : request.lanes) panel.lanes.push_back(lane_of(recording, plot, name.text));
  if (!panel.lanes.empty()) {
    panel.title = request.title;
    return panel;
  }
  std::vector<std::string> units;
  for (const auto& name : request.channels) {
    const auto* column = recording.column(name.text);
    panel.curves.push_back(channel_curve(recording, *column, plot.from, plot.until));
    units.push_back(column->unit);
  }
  for (const auto& value : request.values) {
    panel.curves.push_back(event_curve(recording, plot, request.event.text, value.text));
    units.push_back(event_unit(recording, request.event.text, value.text));
  }
  panel.y_label = axis_label(request.title, units);
  if (request.limits) {
    panel.bands.push_back({fmt::format("{:g} to {:g}", request.limits->first, request.limits->second),
                           request.limits->first, request.limits->second});
  }
  return panel;
}

/// What is written at the mark of an event: "cut 3", "power off", "lose_counts = 200".
std::string mark_label(const RecordedEvent& event, int number) {
  if (event.source != "timeline") {
    return event.values.empty() ? event.event : fmt::format("{} {}", event.event, number);
  }
  if (event.event == "power") return "power " + event.text;
  const auto name_end = event.text.find(' ');
  const auto dot = event.text.rfind('.', name_end);
  return dot == std::string::npos ? event.text : event.text.substr(dot + 1);
}

/// The events asked for, or faults and power changes, as marks in the plot's time.
std::vector<renders::Mark> marks_of(const Recording& recording, const PlotRequest& plot) {
  static const std::vector<Text> usual = {{"timeline.fault", {}}, {"timeline.power", {}}};
  std::vector<renders::Mark> marks;
  for (const auto& wanted : plot.marks ? *plot.marks : usual) {
    int number = 0;
    for (const auto& event : recording.events()) {
      if (!names_event(wanted.text, event.source, event.event)) continue;
      ++number;
      const double at = event.at_seconds();
      if (at < seconds(plot.from) || (plot.until && at > seconds(*plot.until))) continue;
      marks.push_back({at, mark_label(event, number), event.source == "timeline"});
    }
  }
  std::stable_sort(marks.begin(), marks.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return marks;
}

/// A plot of one panel whose x is not time.
void draw_own_x(const Scenario& scenario, const Recording& recording, const PlotRequest& request,
                renders::Plot& plot) {
  const auto& panel = request.panels.front();
  if (panel.histogram) {
    draw_histogram(recording, request, plot);
  } else if (panel.is_path()) {
    const auto& x = *recording.column(panel.x.text);
    plot.x_label = axis_label(x.name, {x.unit});
    plot.width = 960;
    plot.panel_height = 900;
    plot.panels.push_back(path_panel(recording, request, panel));
  } else {
    draw_motor(scenario, recording, request, plot);
  }
}

/// Without a request: every recorded channel, channels of one unit together.
renders::Plot overview(const Recording& recording) {
  renders::Plot plot{"recorded", "Recorded channels", "time [s]", {}, 1200, 260};
  for (const auto& column : recording.columns()) {
    const auto label = axis_label("", {column.unit});
    auto found = std::find_if(plot.panels.begin(), plot.panels.end(),
                              [&](const auto& p) { return p.y_label == label; });
    if (found == plot.panels.end()) {
      plot.panels.push_back({"", label, {}, {}, {}});
      found = std::prev(plot.panels.end());
    }
    found->curves.push_back(channel_curve(recording, column, 0, {}));
  }
  plot.marks = marks_of(recording, {});
  return plot;
}

}  // namespace

std::string axis_label(const std::string& title, const std::vector<std::string>& units) {
  std::vector<std::string> distinct;
  for (const auto& unit : units) {
    const auto shown = unit.empty() ? std::string("-") : unit;
    if (std::find(distinct.begin(), distinct.end(), shown) == distinct.end()) distinct.push_back(shown);
  }
  // Of pure numbers a title may say more than [-]: "distance in pulses".
  if (!title.empty() && distinct == std::vector<std::string>{"-"}) return title;
  std::string text;
  for (const auto& unit : distinct) text += (text.empty() ? "" : ", ") + unit;
  return fmt::format("{}{}[{}]", title, title.empty() ? "" : " ", text);
}

std::vector<renders::Plot> plots_of(const Scenario& scenario, const Recording& recording) {
  std::vector<renders::Plot> plots;
  for (const auto& request : scenario.pictures.plots) {
    renders::Plot plot;
    plot.name = request.name.text;
    plot.title = request.title.empty() ? request.name.text : request.title;
    plot.x_label = "time [s]";
    if (request.against_number) plot.x_label = request.panels.front().event.text + " number";
    if (!request.panels.empty() && request.panels.front().has_own_x()) {
      draw_own_x(scenario, recording, request, plot);
    } else {
      if (!request.against_number) plot.marks = marks_of(recording, request);
      for (const auto& panel : request.panels) plot.panels.push_back(panel_of(recording, request, panel));
    }
    plots.push_back(std::move(plot));
  }
  if (plots.empty() && !recording.columns().empty()) plots.push_back(overview(recording));
  return plots;
}

}  // namespace drycut::sim
