#include "sim/gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "renders/pictures.hpp"
#include "sim/results.hpp"
#include "sim/scenario/parameter_text.hpp"

namespace drycut::sim {

namespace {

renders::SolidPart solid(const std::string& plant, const plants::Part& part) {
  const auto shape = part.shape == plants::Part::Shape::box        ? renders::SolidPart::Shape::box
                     : part.shape == plants::Part::Shape::cylinder ? renders::SolidPart::Shape::cylinder
                                                                   : renders::SolidPart::Shape::wedge;
  return {plant + "." + part.name, shape, part.size, part.colour, part.material};
}

/// A caption's number with as many digits as an operator's panel would show.
std::string caption_number(double number, const std::string& unit) {
  const double size = std::abs(number);
  const int digits = size >= 1000 ? 0 : size >= 10 ? 1 : 2;
  const bool whole = unit.empty() || unit == "counts" || unit == "bits x4";
  auto text = fmt::format("{:.{}f}", number, whole && number == std::round(number) ? 0 : digits);
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-')
    text.erase(0, 1);  // no "-0.00"
  return unit.empty() ? text : text + " " + unit;
}

renders::Curve event_curve(const Recording& recording, const PlotRequest& plot, const std::string& event,
                           const std::string& value) {
  renders::Curve curve;
  curve.label = value;
  curve.style = renders::Curve::Style::points;
  double number = 0;
  for (const auto& happened : recording.events()) {
    if (happened.event != event && happened.source + "." + happened.event != event) continue;
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
    if (happened.event != event && happened.source + "." + happened.event != event) continue;
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

/// "following error [counts]": the panel's title with the units of what it shows.
std::string axis_label(const std::string& title, const std::vector<std::string>& units) {
  std::vector<std::string> distinct;
  for (const auto& unit : units) {
    const auto shown = unit.empty() ? std::string("-") : unit;
    if (std::find(distinct.begin(), distinct.end(), shown) == distinct.end()) distinct.push_back(shown);
  }
  std::string text;
  for (const auto& unit : distinct) text += (text.empty() ? "" : ", ") + unit;
  return fmt::format("{}{}[{}]", title, title.empty() ? "" : " ", text);
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
  return plot;
}

renders::ReportTable event_table(const Recording& recording, const KnownEvent& known) {
  renders::ReportTable table{fmt::format("{} of {}", known.name, known.source), {"time [s]"}, {}, true};
  for (const auto& [name, unit] : known.values) {
    table.headings.push_back(unit.empty() ? name : fmt::format("{} [{}]", name, unit));
  }
  for (const auto& event : recording.events()) {
    if (event.source != known.source || event.event != known.name) continue;
    renders::ReportRow row{{fmt::format("{:.6f}", event.at_seconds())}};
    for (const auto& [name, unit] : known.values) {
      const auto* value = event.find(name);
      row.cells.push_back(value == nullptr ? "" : fmt::format("{:.6g}", value->number));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

renders::ReportTable parameter_table(const PlantEntry& entry) {
  renders::ReportTable table{fmt::format("Parameters of {} ({})", entry.name.text, entry.type.text),
                             {"parameter", "value", "meaning", "from"},
                             {},
                             true};
  const auto given = [&](const std::string& name) {
    return std::any_of(entry.places.begin(), entry.places.end(),
                       [&](const auto& p) { return p.first == name; });
  };
  for (const auto& parameter : entry.definition->parameters()) {
    table.rows.push_back({{parameter.name, value_text(parameter), std::string(parameter.meaning),
                           given(parameter.name) ? "the scenario" : std::string(parameter.source)}});
  }
  return table;
}

/// What the controller holds at the end: device parameters, states, program variables.
renders::ReportTable controller_table(Simulation& simulation) {
  renders::ReportTable table{"Controller at the end of the run", {"value", "", "unit"}, {}, true};
  for (const auto& reading : simulation.controller_values()) {
    table.rows.push_back({{reading.name, fmt::format("{:.10g}", reading.read()), reading.unit}});
  }
  return table;
}

std::string units_note(double simulated) { return fmt::format("{:g} s", simulated); }

/// Six frames from the last full cycle between two cuts, or from the whole run: what the machine does, at a
/// glance.
std::vector<std::size_t> chosen_frames(const std::vector<Snapshot>& snapshots, const Recording& recording) {
  constexpr std::size_t wanted = 6;
  if (snapshots.size() <= wanted) {
    std::vector<std::size_t> all(snapshots.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
  }
  double from = seconds(snapshots.front().time);
  double until = seconds(snapshots.back().time);
  std::vector<double> cuts;
  for (const auto& event : recording.events()) {
    if (event.event == "cut" && event.at_seconds() >= from && event.at_seconds() <= until)
      cuts.push_back(event.at_seconds());
  }
  if (cuts.size() >= 2) {
    until = cuts.back();
    from = cuts[cuts.size() - 2];
  }
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < wanted; ++i) {
    const double at = from + (until - from) * static_cast<double>(i) / (wanted - 1);
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < snapshots.size(); ++k) {
      if (std::abs(seconds(snapshots[k].time) - at) < std::abs(seconds(snapshots[nearest].time) - at))
        nearest = k;
    }
    if (chosen.empty() || chosen.back() != nearest) chosen.push_back(nearest);
  }
  return chosen;
}

/// The film as the camera sees it: of one plant only its own parts, unless it shows the whole line.
renders::Film shown(const renders::Film& film, const std::string& camera) {
  auto view = film;
  if (camera == "operator") return view;
  for (std::size_t i = 0; i < view.parts.size(); ++i) {
    if (view.parts[i].name.starts_with(camera + ".")) continue;
    for (auto& frame : view.frames) frame.placements[i].visible = false;
  }
  return view;
}

}  // namespace

renders::Film film_of(const Scenario& scenario, const Simulation& simulation) {
  renders::Film film;
  film.title = scenario.scene.title;
  film.width = scenario.pictures.width;
  film.height = scenario.pictures.height;
  for (const auto& [name, plant] : simulation.plants()) {
    for (const auto& part : plant->parts()) film.parts.push_back(solid(name, part));
  }
  for (const auto& shot : simulation.snapshots()) {
    renders::Frame frame;
    frame.time_s = seconds(shot.time);
    for (const auto& pose : shot.poses) {
      frame.placements.push_back({pose.pose.position, pose.pose.rotation, pose.scale, pose.visible});
    }
    for (std::size_t i = 0; i < shot.caption.size(); ++i) {
      frame.caption.push_back({scenario.pictures.caption[i].text,
                               caption_number(shot.caption[i], simulation.caption_units()[i])});
    }
    film.frames.push_back(std::move(frame));
  }
  film.camera = renders::operator_camera(shown(film, scenario.pictures.camera));
  return film;
}

std::vector<renders::Plot> plots_of(const Scenario& scenario, const Recording& recording) {
  std::vector<renders::Plot> plots;
  for (const auto& request : scenario.pictures.plots) {
    renders::Plot plot;
    plot.name = request.name.text;
    plot.title = request.title.empty() ? request.name.text : request.title;
    plot.x_label = "time [s]";
    if (request.against_number) plot.x_label = request.panels.front().event.text + " number";
    for (const auto& panel : request.panels) {
      if (!panel.is_path()) {
        plot.panels.push_back(panel_of(recording, request, panel));
        continue;
      }
      const auto& x = *recording.column(panel.x.text);
      plot.x_label = axis_label(x.name, {x.unit});
      plot.width = 960;
      plot.panel_height = 900;
      plot.panels.push_back(path_panel(recording, request, panel));
    }
    plots.push_back(std::move(plot));
  }
  if (plots.empty() && !recording.columns().empty()) plots.push_back(overview(recording));
  return plots;
}

renders::Report report_of(const Scenario& scenario, Simulation& simulation, const Outcome& outcome,
                          const std::vector<std::filesystem::path>& frames,
                          const std::vector<std::filesystem::path>& plots) {
  renders::Report report;
  report.title = scenario.scene.title.empty() ? scenario.file.stem().string() : scenario.scene.title;
  report.scenario = scenario.file.filename().string();
  report.passed = outcome.passed();
  report.verdict = verdict_text(outcome);
  report.facts = {{{"simulated", units_note(seconds(outcome.end))}},
                  {{"physics step", fmt::format("{:g} us", static_cast<double>(scenario.scene.step) / 1e3)}},
                  {{"seed", fmt::format("{}", scenario.scene.seed)}},
                  {{"drycut", DRYCUT_VERSION}}};
  for (const auto& override : scenario.overrides) {
    report.facts.push_back({{"--set", fmt::format("{} = {}", override.path, override.value)}});
  }
  for (const auto& note : simulation.notes()) report.facts.push_back({{"note", note}});
  for (const auto& check : outcome.checks) {
    report.checks.push_back({check.name, check.expectation, check.passed, margin_text(check), check.detail});
  }
  if (!frames.empty()) {
    for (const auto index : chosen_frames(simulation.snapshots(), simulation.recording())) {
      report.frames.push_back(
          {frames.at(index), fmt::format("{} s", seconds_text(simulation.snapshots()[index].time))});
    }
  }
  for (const auto& plot : plots) report.plots.push_back({plot, "plots/" + plot.filename().string()});
  for (const auto& known : simulation.known_events()) {
    auto table = event_table(simulation.recording(), known);
    if (!table.rows.empty()) report.tables.push_back(std::move(table));
  }
  renders::ReportTable others{"Other events", {"time [s]", "source", "event", "what"}, {}, false};
  for (const auto& event : simulation.recording().events()) {
    const auto is_known = [&](const KnownEvent& k) {
      return k.source == event.source && k.name == event.event;
    };
    if (std::any_of(simulation.known_events().begin(), simulation.known_events().end(), is_known)) continue;
    others.rows.push_back(
        {{fmt::format("{:.6f}", event.at_seconds()), event.source, event.event, values_text(event)}});
  }
  if (!others.rows.empty()) report.tables.push_back(std::move(others));
  if (auto table = controller_table(simulation); !table.rows.empty())
    report.tables.push_back(std::move(table));
  for (const auto& entry : scenario.plants) report.tables.push_back(parameter_table(entry));
  report.scenario_expanded = expand(scenario);
  return report;
}

}  // namespace drycut::sim
