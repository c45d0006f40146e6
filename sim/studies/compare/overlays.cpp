#include "sim/studies/compare/overlays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "sim/loop/known_events.hpp"
#include "sim/report/gallery.hpp"
#include "sim/studies/compare/pieces.hpp"

namespace drycut::sim::studies {

namespace {

/// When the event of that number happened [s].
std::optional<double> time_of(const ComparedRun& run, const scenario::PicturesSection::Around& around) {
  int number = 0;
  for (const auto& event : run.recording.events())
    if (loop::names_event(around.event.text, event.source, event.event) && ++number == around.number)
      return event.at_seconds();
  return {};
}

Time to_time(double seconds_) { return std::max<Time>(0, static_cast<Time>(seconds_ * second)); }

/// The request as this run can show it: without the channels that it has not.
scenario::PlotRequest request_for(const ComparedRun& run, const OverlayRequest& request,
                                  std::optional<double> origin) {
  auto plot = request.plot;
  for (auto& panel : plot.panels) {
    const auto lacking = [&](const scenario::Text& name) {
      return run.recording.column(name.text) == nullptr;
    };
    std::erase_if(panel.channels, lacking);
    std::erase_if(panel.lanes, lacking);
  }
  if (origin) {
    plot.from = to_time(*origin - seconds(request.around->before));
    plot.until = to_time(*origin + seconds(request.around->after));
  }
  if (!request.behind_start.empty()) {
    const auto window = window_of(run, request.behind_start, "", request.from);
    plot.from = to_time(window.from);
    if (std::isfinite(window.until)) plot.until = to_time(window.until);
  }
  return plot;
}

/// The first event is number 1, whatever came before it.
void count_from_first(renders::Plot& plot) {
  double first = HUGE_VAL;
  for (const auto& panel : plot.panels)
    for (const auto& curve : panel.curves)
      if (!curve.x.empty()) first = std::min(first, curve.x.front());
  for (auto& panel : plot.panels)
    for (auto& curve : panel.curves)
      for (auto& x : curve.x) x -= first - 1;
}

renders::Plot plot_of(const ComparedRun& run, const OverlayRequest& request) {
  const auto origin = request.around ? time_of(run, *request.around) : std::nullopt;
  scenario::Scenario view;
  view.pictures.plots.push_back(request_for(run, request, origin));
  auto plot = report::plots_of(view, run.recording, {}, report::Flat::kept).front();
  if (request.around && !origin)
    for (auto& panel : plot.panels) panel.curves.clear();
  if (!request.behind_start.empty()) count_from_first(plot);
  if (!origin) return plot;
  for (auto& panel : plot.panels)
    for (auto& curve : panel.curves)
      for (auto& x : curve.x) x -= *origin;
  for (auto& mark : plot.marks) mark.x -= *origin;
  return plot;
}

void add_panel(renders::Panel& to, renders::Panel from, const std::string& label) {
  const bool alone = from.curves.size() == 1;
  for (auto& curve : from.curves) {
    curve.label = alone ? label : fmt::format("{}: {}", label, curve.label);
    if (to.curves.empty()) to.y_label = from.y_label;
    to.curves.push_back(std::move(curve));
  }
  for (auto& lane : from.lanes) {
    lane.label = fmt::format("{}: {}", label, lane.label);
    to.lanes.push_back(std::move(lane));
  }
}

void add_marks(renders::Plot& to, const renders::Plot& from, const std::string& label) {
  for (auto mark : from.marks) {
    mark.label = fmt::format("{}: {}", label, mark.label);
    to.marks.push_back(std::move(mark));
  }
  std::stable_sort(to.marks.begin(), to.marks.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
}

renders::Plot overlay(const std::vector<ComparedRun>& runs, const OverlayRequest& request) {
  std::vector<renders::Plot> plots;
  plots.reserve(runs.size());
  for (const auto& run : runs) plots.push_back(plot_of(run, request));
  // What is 0 in one run may move in another.
  report::leave_out_flat(plots);
  auto whole = plots.front();
  whole.marks.clear();
  for (auto& panel : whole.panels) {
    panel.curves.clear();
    panel.lanes.clear();
  }
  if (!request.behind_start.empty()) whole.x_label += ", counted from the first behind the start-up";
  if (request.around)
    whole.x_label = fmt::format("time from {} {} [s]", request.around->event.text, request.around->number);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    for (std::size_t i = 0; i < whole.panels.size(); ++i)
      add_panel(whole.panels[i], std::move(plots[k].panels[i]), runs[k].label);
    add_marks(whole, plots[k], runs[k].label);
  }
  return whole;
}

/// What stands before the first dot: the plant, the device.
std::string part_of(const std::string& channel) {
  const auto dot = channel.find('.');
  return dot == std::string::npos ? "controller" : channel.substr(0, dot);
}

OverlayRequest& request_of(std::vector<OverlayRequest>& requests, const std::string& name,
                           std::string title) {
  const auto found = std::find_if(requests.begin(), requests.end(), [&](const OverlayRequest& request) {
    return request.plot.name.text == name;
  });
  if (found != requests.end()) return *found;
  auto& made = requests.emplace_back();
  made.plot.name.text = name;
  made.plot.title = std::move(title);
  return made;
}

/// The limits if all runs state the same ones.
const Tolerance* common_tolerance(const std::vector<ComparedRun>& runs, const record::RecordedEvent& event,
                                  const std::string& value) {
  const Tolerance* common = nullptr;
  for (const auto& run : runs) {
    const auto* found = run.tolerance(event.source, event.event, value);
    if (found == nullptr) return nullptr;
    if (common != nullptr && (common->low != found->low || common->high != found->high)) return nullptr;
    common = found;
  }
  return common;
}

void add_event(std::vector<OverlayRequest>& requests, const Comparison& comparison,
               const record::RecordedEvent& event) {
  const auto name = event.source + "." + event.event;
  auto& request = request_of(requests, "events_" + as_file_name(name),
                             fmt::format("Every {} of {}, side by side", event.event, event.source));
  request.behind_start = name;
  request.from = comparison.from;
  auto& plot = request.plot;
  plot.against_number = true;
  for (const auto& value : event.values) {
    const bool there = std::any_of(plot.panels.begin(), plot.panels.end(),
                                   [&](const auto& panel) { return panel.title == value.name; });
    if (there || value.name == "number") continue;
    auto& panel = plot.panels.emplace_back();
    panel.title = value.name;
    panel.event.text = name;
    panel.values.push_back({value.name, {}});
    if (const auto* tolerance = common_tolerance(comparison.runs, event, value.name))
      panel.limits = {tolerance->low, tolerance->high};
  }
}

}  // namespace

std::string as_file_name(const std::string& name) {
  std::string text;
  for (const char c : name) text += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return text;
}

std::vector<renders::Plot> overlay(const std::vector<ComparedRun>& runs,
                                   const std::vector<OverlayRequest>& requests) {
  std::vector<renders::Plot> plots;
  plots.reserve(requests.size());
  for (const auto& request : requests) plots.push_back(overlay(runs, request));
  return plots;
}

std::vector<OverlayRequest> usual_overlays(const Comparison& comparison) {
  std::vector<OverlayRequest> requests;
  for (const auto& run : comparison.runs) {
    std::map<std::string, int> times;  // one point alone is no curve
    for (const auto& event : run.recording.events())
      if (!event.values.empty() && ++times[event.source + "." + event.event] == 2)
        add_event(requests, comparison, event);
  }
  for (const auto& row : comparison.channels) {
    const auto part = part_of(row.name);
    auto& plot = request_of(requests, "overlay_" + as_file_name(part), "Channels of " + part).plot;
    plot.panels.emplace_back().title = row.name;
    plot.panels.back().channels.push_back({row.name, {}});
  }
  return requests;
}

}  // namespace drycut::sim::studies
