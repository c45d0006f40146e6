#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "renders/decimate.hpp"
#include "renders/lanes.hpp"
#include "renders/plot_script.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

// The curves' palette: dark for lines, light for the states of a lane with several.
constexpr std::array<const char*, 4> kLaneColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
constexpr std::array<const char*, 7> kStateColours = {"#cfe6f5", "#fbdcc4", "#c5ebdf", "#f3dcea",
                                                      "#fbe8b9", "#dadfe4", "#e3dcf6"};
constexpr const char* kMixedColour = "#8a8f98";
constexpr double kLow = 0.20;  ///< of a lane's height
constexpr double kHigh = 0.80;

/// A lane being written: its base line and names of its data blocks.
struct Place {
  std::size_t panel;
  std::size_t lane;
  double base;   ///< y of its lower end
  double pixel;  ///< [units of x]
};

void write_boxes(Script& script, const std::string& name, const std::vector<LaneState>& states,
                 const Place& place) {
  script.line("${} << END_OF_LANE", name);
  for (const LaneState& state : states) {
    script.line("{} {} {} {} {} {}", state.from, place.base + kLow, state.from, state.until,
                place.base + kLow, place.base + kHigh);
  }
  script.line("END_OF_LANE");
}

Place place_of(const Panel& panel, const PlotLayout& layout, std::size_t index, std::size_t lane) {
  const double width = layout.x_range.second - layout.x_range.first;
  return {index, lane, static_cast<double>(panel.lanes.size() - lane - 1),
          width / (layout.right - layout.left)};
}

void append(std::string& list, const std::string& what) { list += (list.empty() ? "" : ", ") + what; }

void write_digital(Script& script, const std::vector<LaneState>& states, const PixelGrid& grid,
                   const Place& place, std::string& list) {
  const char* const colour = kLaneColours[place.lane % kLaneColours.size()];
  const auto high = high_states(states, place.pixel);
  if (!high.empty()) {
    const auto name = fmt::format("high_{}_{}", place.panel, place.lane);
    write_boxes(script, name, high, place);
    append(list,
           fmt::format("${} using 1:2:3:4:5:6 with boxxyerror fillstyle transparent solid 0.30 noborder "
                       "lc rgb '{}'",
                       name, colour));
  }
  Curve steps;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i > 0 && states[i - 1].until != states[i].from) {
      steps.x.push_back(states[i].from);
      steps.y.push_back(std::nan(""));
    }
    const double level = place.base + (states[i].value == 0 ? kLow : kHigh);
    steps.x.insert(steps.x.end(), {states[i].from, states[i].until});
    steps.y.insert(steps.y.end(), {level, level});
  }
  const auto name = fmt::format("lane_{}_{}", place.panel, place.lane);
  write_points(script, name, decimated(steps, grid));
  append(list, fmt::format("${} using 1:2 with lines lw 1.7 lc rgb '{}'", name, colour));
}

void write_bands(Script& script, const std::vector<LaneState>& all, const Place& place, std::string& list) {
  const auto states = told_apart(all, place.pixel);
  std::set<double> values;
  for (const LaneState& state : all) values.insert(state.value);
  const auto colour_of = [&](double value) {
    const auto order = std::distance(values.begin(), values.find(value));
    return static_cast<std::size_t>(order) % kStateColours.size();
  };
  for (std::size_t colour = 0; colour <= kStateColours.size(); ++colour) {
    const bool mixed = colour == kStateColours.size();
    std::vector<LaneState> these;
    std::copy_if(states.begin(), states.end(), std::back_inserter(these), [&](const LaneState& state) {
      return mixed ? state.mixed : !state.mixed && colour_of(state.value) == colour;
    });
    if (these.empty()) continue;
    const auto name = fmt::format("band_{}_{}_{}", place.panel, place.lane, colour);
    write_boxes(script, name, these, place);
    append(list,
           fmt::format("${} using 1:2:3:4:5:6 with boxxyerror fillstyle solid 1.0 border lc rgb '#52606d' "
                       "lw 0.8 fillcolor rgb '{}'",
                       name, mixed ? kMixedColour : kStateColours[colour]));
  }
}

void write_state_labels(Script& script, const std::vector<LaneState>& states, const Place& place) {
  for (const LaneState& state : states) {
    const auto label = fmt::format("{:g}", state.value);
    if (state.mixed || text_width(label, PlotType::mark) + 6 > (state.until - state.from) / place.pixel)
      continue;
    script.line(
        "set label {} at first {}, first {} center front textcolor rgb '#1f2933' font "
        "'DejaVu Sans,{:.2f}'",
        gnuplot_string(label), (state.from + state.until) / 2, place.base + (kLow + kHigh) / 2,
        Script::points(PlotType::mark));
  }
}

}  // namespace

std::string write_lanes(Script& script, const Panel& panel, const PlotLayout& layout, std::size_t index) {
  const PanelLayout& here = layout.panels[index];
  const PixelGrid grid = {layout.x_range.first,
                          layout.x_range.second,
                          here.y_range.first,
                          here.y_range.second,
                          static_cast<int>(layout.right - layout.left),
                          static_cast<int>(here.bottom - here.top)};
  std::string list;
  for (std::size_t i = 0; i < panel.lanes.size(); ++i) {
    const auto states = lane_states(panel.lanes[i]);
    if (states.empty()) continue;
    const auto place = place_of(panel, layout, index, i);
    if (is_digital(panel.lanes[i])) {
      write_digital(script, states, grid, place, list);
    } else {
      write_bands(script, states, place, list);
    }
  }
  return list;
}

void write_lane_labels(Script& script, const Panel& panel, const PlotLayout& layout, std::size_t index) {
  for (std::size_t i = 0; i < panel.lanes.size(); ++i) {
    if (i > 0) {
      script.line(
          "set arrow from graph 0, first {0} to graph 1, first {0} nohead back lw 0.8 lc rgb '#dfe3e8'", i);
    }
    if (is_digital(panel.lanes[i])) continue;
    const auto place = place_of(panel, layout, index, i);
    write_state_labels(script, told_apart(lane_states(panel.lanes[i]), place.pixel), place);
  }
}

}  // namespace drycut::renders
