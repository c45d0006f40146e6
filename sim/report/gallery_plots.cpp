// The plots of a run: curves, lanes, paths, marks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "renders/decimate.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/report/gallery.hpp"
#include "sim/report/gallery_plots.hpp"

namespace drycut::sim::report {

loop::EventNumbers event_numbers(const record::EventLog& events, const std::string& event,
                                 const std::string& value, const scenario::PlotRequest& plot) {
  return plot.until ? loop::event_numbers(events, event, value, seconds(plot.from), seconds(*plot.until))
                    : loop::event_numbers(events, event, value, seconds(plot.from));
}

Rows rows_between(const record::Recording& recording, Time from, const std::optional<Time>& until) {
  const auto& times = recording.times();
  const auto first = std::lower_bound(times.begin(), times.end(), from);
  const auto end = until ? std::upper_bound(first, times.end(), *until) : times.end();
  return {static_cast<std::size_t>(first - times.begin()), static_cast<std::size_t>(end - times.begin())};
}

renders::Curve channel_curve(const record::Recording& recording, const record::Recording::Column& column,
                             Rows rows) {
  renders::Extremes envelope(rows.count());
  for (auto row = rows.first; row < rows.end; ++row)
    envelope.add(seconds(recording.times()[row]), column.values[row]);
  auto kept = envelope.take();
  return {column.name, std::move(kept.x), std::move(kept.y)};
}

std::string time_label(const record::Recording& recording, Rows rows) {
  const renders::Extremes envelope(rows.count());
  if (envelope.stretch() == 1) return "time [s]";
  const auto& times = recording.times();
  const double every =
      seconds(times[rows.end - 1] - times[rows.first]) / static_cast<double>(rows.count() - 1);
  return fmt::format("time [s], thinned: the lowest and the highest of {} samples, {:.4g} s",
                     envelope.stretch(), every * static_cast<double>(envelope.stretch()));
}

namespace {

/// Every change of a state, and its last instant; of a short run every instant.
renders::Lane lane_of(const record::Recording& recording, const scenario::PlotRequest& plot,
                      const std::string& name) {
  const auto& values = recording.column(name)->values;
  const auto rows = rows_between(recording, plot.from, plot.until);
  renders::Lane lane{name, {}, {}};
  for (auto row = rows.first; row < rows.end; ++row) {
    const double state = values[row];
    const bool same = rows.count() > renders::kMostSamples && !lane.y.empty() && lane.y.back() == state;
    if (same && row + 1 < rows.end) continue;
    lane.x.push_back(seconds(recording.times()[row]));
    lane.y.push_back(state);
  }
  renders::thin(lane.x, lane.y);
  return lane;
}

/// The corners of all that two channels ever were together.
renders::PixelGrid bounds_of(const record::Series<double>& x, const record::Series<double>& y) {
  renders::PixelGrid bounds;
  const auto spread = [](const record::Series<double>& of, double& low, double& high) {
    if (of.empty()) return;
    low = high = of.front();
    for (const double number : of) {
      low = std::min(low, number);
      high = std::max(high, number);
    }
    if (low == high) high = low + 1;
  };
  spread(x, bounds.x_low, bounds.x_high);
  spread(y, bounds.y_low, bounds.y_high);
  return bounds;
}

/// A path in a plane: one curve, or one for each whole value of the split channel.
void draw_path(const record::Recording& recording, const scenario::PlotRequest& wanted, renders::Plot& plot) {
  const auto& request = wanted.panels.front();
  const auto& x = *recording.column(request.x.text);
  const auto& y = *recording.column(request.y.text);
  const auto* split = request.split.text.empty() ? nullptr : recording.column(request.split.text);
  const auto rows = rows_between(recording, wanted.from, wanted.until);
  const auto bounds = bounds_of(x.values, y.values);
  std::map<double, renders::Cloud> paths;
  double before = 0;
  for (auto row = rows.first; row < rows.end; ++row) {
    const double part = split == nullptr ? 1 : split->values[row];
    if (part >= 1) {
      auto& path = paths.try_emplace(part, rows.count(), bounds, true).first->second;
      if (part != before) path.gap();
      path.add(x.values[row], y.values[row]);
    }
    before = part;
  }
  plot.x_label = axis_label(x.name, {x.unit});
  plot.width = 960;
  plot.panel_height = 900;
  auto& panel = plot.panels.emplace_back();
  panel.title = request.title;
  panel.y_label = axis_label(y.name, {y.unit});
  panel.equal_scale = true;
  for (auto& [part, path] : paths) {
    auto points = path.take();
    renders::Curve curve{"", std::move(points.x), std::move(points.y)};
    if (split != nullptr) {
      curve.label = fmt::format("{:g}", part);
      if (part <= static_cast<double>(request.labels.size()))
        curve.label = request.labels[static_cast<std::size_t>(part) - 1].text;
    }
    panel.curves.push_back(std::move(curve));
  }
  for (const auto& point : request.points) panel.points.push_back({point.label.text, point.x, point.y});
}

/// Nothing but zeros, in which there is nothing to see; limits beside them would be.
bool is_flat_zero(const renders::Panel& panel) {
  const auto silent = [](const renders::Curve& curve) {
    return std::all_of(curve.y.begin(), curve.y.end(),
                       [](double y) { return !(std::abs(record::without_noise(y)) > 0); });
  };
  return panel.bands.empty() && panel.lanes.empty() && !panel.curves.empty() &&
         std::all_of(panel.curves.begin(), panel.curves.end(), silent);
}

renders::Panel panel_of(const record::Recording& recording, const scenario::PlotRequest& plot,
                        const scenario::PlotRequest::Panel& request) {
  renders::Panel panel;
  for (const auto& name : request.lanes) panel.lanes.push_back(lane_of(recording, plot, name.text));
  if (!panel.lanes.empty()) {
    panel.title = request.title;
    return panel;
  }
  std::vector<std::string> units;
  for (const auto& name : request.channels) {
    const auto* column = recording.column(name.text);
    panel.curves.push_back(channel_curve(recording, *column, rows_between(recording, plot.from, plot.until)));
    units.push_back(column->unit);
  }
  for (const auto& value : request.values) {
    auto found = event_numbers(recording.events(), request.event.text, value.text, plot);
    auto& x = plot.against_number ? found.order : found.times;
    renders::thin(x, found.numbers);
    panel.curves.push_back(
        {value.text, std::move(x), std::move(found.numbers), renders::Curve::Style::points});
    units.push_back(found.unit);
  }
  panel.y_label = axis_label(request.title, units);
  if (request.limits) {
    panel.bands.push_back({fmt::format("{:g} to {:g}", request.limits->first, request.limits->second),
                           request.limits->first, request.limits->second});
  }
  return panel;
}

/// What is written at the mark of an event: "cut 3", "power off", "lose_counts = 200".
std::string mark_label(const record::RecordedEvent& event, int number) {
  if (event.source != "timeline") {
    return event.values.empty() ? event.event : fmt::format("{} {}", event.event, number);
  }
  if (event.event == "power") return "power " + event.text;
  const auto name_end = event.text.find(' ');
  const auto dot = event.text.rfind('.', name_end);
  return dot == std::string::npos ? event.text : event.text.substr(dot + 1);
}

/// Of a thousand marks of a kind and more every second one, every third one ...: the others would hide them.
void thin(std::vector<renders::Mark>& marks) {
  constexpr std::size_t most = 1000;
  for (const bool strong : {false, true}) {
    const auto count = static_cast<std::size_t>(
        std::count_if(marks.begin(), marks.end(), [&](const auto& mark) { return mark.strong == strong; }));
    const auto step = count / most + 1;
    std::size_t number = 0;
    std::erase_if(marks, [&](const auto& mark) { return mark.strong == strong && number++ % step != 0; });
  }
}

/// The events asked for, or faults and power changes, as marks in the plot's time.
std::vector<renders::Mark> marks_of(const record::Recording& recording, const scenario::PlotRequest& plot) {
  static const std::vector<scenario::Text> usual = {{"timeline.fault", {}}, {"timeline.power", {}}};
  std::vector<renders::Mark> marks;
  for (const auto& wanted : plot.marks ? *plot.marks : usual) {
    int number = 0;
    for (const auto& event : recording.events()) {
      if (!loop::names_event(wanted.text, event.source, event.event)) continue;
      ++number;
      const double at = event.at_seconds();
      if (at < seconds(plot.from) || (plot.until && at > seconds(*plot.until))) continue;
      marks.push_back({at, mark_label(event, number), event.source == "timeline"});
    }
  }
  std::stable_sort(marks.begin(), marks.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  thin(marks);
  return marks;
}

/// A plot of one panel whose x is not time.
void draw_own_x(const MachineFacts& machine, const record::Recording& recording,
                const scenario::PlotRequest& request, renders::Plot& plot) {
  using Kind = scenario::PlotRequest::Panel::Kind;
  switch (request.panels.front().kind()) {
    case Kind::histogram:
      return draw_histogram(recording, request, plot);
    case Kind::spectrum:
      return draw_spectrum(machine, recording, request, plot);
    case Kind::path:
      return draw_path(recording, request, plot);
    case Kind::motor:
      return draw_motor(machine, recording, request, plot);
    case Kind::curves:
    case Kind::lanes:
    case Kind::points:
      return;  // over time
  }
}

/// Without a request: every recorded channel, channels of one unit together.
renders::Plot overview(const record::Recording& recording) {
  const Rows all{0, recording.times().size()};
  renders::Plot plot{"recorded", "Recorded channels", time_label(recording, all), {}, 1200, 260};
  for (const auto& column : recording.columns()) {
    const auto label = axis_label("", {column.unit});
    auto found = std::find_if(plot.panels.begin(), plot.panels.end(),
                              [&](const auto& p) { return p.y_label == label; });
    if (found == plot.panels.end()) {
      plot.panels.push_back({"", label, {}, {}, {}});
      found = std::prev(plot.panels.end());
    }
    found->curves.push_back(channel_curve(recording, column, all));
  }
  plot.marks = marks_of(recording, {});
  leave_out_flat({&plot, 1});
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

void leave_out_flat(std::span<renders::Plot> alike) {
  std::string names;
  auto& first = alike.front();
  for (std::size_t i = 0; i < first.panels.size() && first.panels.size() > 1;) {
    const auto tells = [i](const renders::Plot& plot) {
      return !plot.panels[i].curves.empty() && !is_flat_zero(plot.panels[i]);
    };
    const auto flat =
        std::ranges::find_if(alike, [i](const auto& plot) { return is_flat_zero(plot.panels[i]); });
    if (flat == alike.end() || std::ranges::any_of(alike, tells)) {
      ++i;
      continue;
    }
    for (const auto& curve : flat->panels[i].curves) names += (names.empty() ? "" : ", ") + curve.label;
    for (auto& plot : alike) plot.panels.erase(plot.panels.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (!names.empty()) first.title += fmt::format(" (0 all the time: {})", names);
}

std::vector<renders::Plot> plots_of(const scenario::Scenario& scenario, const record::Recording& recording,
                                    const MachineFacts& machine, Flat flat) {
  std::vector<renders::Plot> plots;
  for (const auto& request : scenario.pictures.plots) {
    renders::Plot plot;
    plot.name = request.name.text;
    plot.title = request.title.empty() ? request.name.text : request.title;
    plot.x_label = time_label(recording, rows_between(recording, request.from, request.until));
    if (request.against_number) plot.x_label = request.panels.front().event.text + " number";
    if (!request.panels.empty() && request.panels.front().has_own_x()) {
      draw_own_x(machine, recording, request, plot);
    } else {
      if (!request.against_number) plot.marks = marks_of(recording, request);
      for (const auto& panel : request.panels) plot.panels.push_back(panel_of(recording, request, panel));
      if (flat == Flat::left_out) leave_out_flat({&plot, 1});
    }
    plots.push_back(std::move(plot));
  }
  if (plots.empty() && !recording.columns().empty()) plots.push_back(overview(recording));
  return plots;
}

}  // namespace drycut::sim::report
