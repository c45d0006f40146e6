#include "renders/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "renders/decimate.hpp"
#include "renders/gnuplot.hpp"
#include "renders/plot_layout.hpp"
#include "renders/plot_script.hpp"
#include "renders/png_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

// Okabe and Ito's palette: told apart with any colour vision. After its end the lines are dashed.
constexpr std::array<const char*, 7> kCurveColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#e69f00", "#56b4e9", "#333333"};
constexpr std::array<const char*, 3> kBandColours = {"#e8c400", "#56b4e9", "#8a8f98"};
constexpr const char* kLimitColour = "#b3261e";
constexpr const char* kMarkColour = "#7b8794";
constexpr const char* kMarkTextColour = "#52606d";
constexpr const char* kStrongColour = "#b3261e";
constexpr const char* kPointColour = "#1f2933";
constexpr double kBandOpacity = 0.22;
constexpr const char* kZoneColour = "#f0f3f6";
constexpr const char* kStrongZoneColour = "#d3efe2";
constexpr const char* kFaintColour = "#b9c2cc";

std::string curve_colour(const Curve& curve, std::size_t index) {
  return curve.faint ? kFaintColour : kCurveColours[index % kCurveColours.size()];
}
std::size_t dash_type(std::size_t index) { return 1 + (index / kCurveColours.size()) % 5; }
bool is_limit(const Band& band) { return band.low == band.high; }

/// A line needs two points: what stands alone between gaps is drawn as a dot.
Points isolated(const Points& points) {
  Points alone;
  const std::size_t count = points.x.size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool joined =
        (i > 0 && std::isfinite(points.y[i - 1])) || (i + 1 < count && std::isfinite(points.y[i + 1]));
    if (joined || !std::isfinite(points.y[i])) continue;
    alone.x.push_back(points.x[i]);
    alone.y.push_back(points.y[i]);
  }
  return alone;
}

/// Writes the points of all curves, thinned, and returns what to plot in each panel.
std::vector<std::string> write_data(Script& script, const Plot& plot, const PlotLayout& layout) {
  std::vector<std::string> lists(plot.panels.size());
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    const PanelLayout& place = layout.panels[p];
    if (!plot.panels[p].lanes.empty()) {
      lists[p] = write_lanes(script, plot.panels[p], layout, p);
      continue;
    }
    const PixelGrid grid = {layout.x_range.first,
                            layout.x_range.second,
                            place.y_range.first,
                            place.y_range.second,
                            static_cast<int>(layout.right - layout.left),
                            static_cast<int>(place.bottom - place.top)};
    const auto plot_block = [&](const char* kind, std::size_t curve, const Points& points,
                                const std::string& look) {
      if (points.x.empty()) return;
      const std::string name = fmt::format("{}_{}_{}", kind, p, curve);
      write_points(script, name, points);
      lists[p] += fmt::format("{}${} using 1:2 {} lc rgb '{}'", lists[p].empty() ? "" : ", ", name, look,
                              curve_colour(plot.panels[p].curves[curve], curve));
    };
    for (std::size_t c = 0; c < plot.panels[p].curves.size(); ++c) {
      const Curve& curve = plot.panels[p].curves[c];
      const bool path = plot.panels[p].equal_scale && curve.style != Curve::Style::points;
      const Points points = path ? thinned_path(curve, grid) : decimated(curve, grid);
      if (curve.style == Curve::Style::points) {
        plot_block("points", c, points,
                   fmt::format("with points pointtype 7 pointsize {}", curve.faint ? 0.35 : 0.7));
        continue;
      }
      if (curve.style == Curve::Style::area)
        plot_block("area", c, points, "with filledcurves y1=0 fillstyle transparent solid 0.35 noborder");
      plot_block("curve", c, points,
                 fmt::format("with {} lw 1.7 dashtype {}",
                             curve.style == Curve::Style::steps ? "steps" : "lines", dash_type(c)));
      plot_block("dots", c, isolated(points), "with points pointtype 7 pointsize 0.5");
    }
  }
  return lists;
}

std::string tick_list(const std::vector<Tick>& ticks, bool labels) {
  std::string list;
  for (const Tick& tick : ticks) {
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", gnuplot_string(labels ? tick.label : ""),
                        tick.value);
  }
  return list;
}

void write_bands(Script& script, const Panel& panel, const PanelLayout& place) {
  const auto [low, high] = place.y_range;
  for (std::size_t i = 0; i < panel.bands.size(); ++i) {
    const Band& band = panel.bands[i];
    const double bottom = std::max(low, std::min(band.low, band.high));
    const double top = std::min(high, std::max(band.low, band.high));
    if (bottom > top) continue;
    if (is_limit(band)) {
      script.line(
          "set arrow from graph 0, first {} to graph 1, first {} nohead back lw 1.6 dashtype 2 lc rgb '{}'",
          bottom, top, kLimitColour);
    } else {
      script.line(
          "set object rectangle from graph 0, first {} to graph 1, first {} behind fillcolor rgb '{}' "
          "fillstyle transparent solid {} noborder",
          bottom, top, kBandColours[i % kBandColours.size()], kBandOpacity);
    }
  }
}

void write_zones(Script& script, const Plot& plot, const PlotLayout& layout) {
  const auto [low, high] = layout.x_range;
  bool shaded = false;
  for (const Zone& zone : plot.zones) {
    shaded = !shaded;
    const double left = std::max(zone.from, low);
    const double right = std::min(zone.to, high);
    if (!(left < right) || !(shaded || zone.strong)) continue;
    script.line(
        "set object rectangle from first {}, graph 0 to first {}, graph 1 behind fillcolor rgb '{}' "
        "fillstyle "
        "solid 1 noborder",
        left, right, zone.strong ? kStrongZoneColour : kZoneColour);
  }
}

/// The second scale below the first: ticks on a line of its own, with their numbers.
void write_second_scale(Script& script, const Plot& plot, const PlotLayout& layout) {
  if (!plot.second_x) return;
  const double line = layout.height - kSecondTicks;
  const auto [low, high] = layout.x_range;
  script.line("set arrow from {} to {} nohead front lw 1 lc rgb '{}'", script.at(layout.left, line),
              script.at(layout.right, line), kMarkColour);
  for (const Tick& tick : layout.second_ticks) {
    const double x = layout.left + (tick.value - low) / (high - low) * (layout.right - layout.left);
    script.line("set arrow from {} to {} nohead front lw 1 lc rgb '{}'", script.at(x, line),
                script.at(x, line - 5), kMarkColour);
    script.text(x, layout.height - kSecondNumbers, tick.label, "center", PlotType::text);
  }
  script.text((layout.left + layout.right) / 2, layout.height - 18, plot.second_x->label, "center",
              PlotType::text);
}

void write_legend(Script& script, const Panel& panel, const PanelLayout& place) {
  for (const LegendEntry& entry : place.legend) {
    const double right = entry.left + kLegendSample;
    const double y = entry.baseline;
    if (entry.band && !is_limit(panel.bands[entry.index])) {
      script.line(
          "set object rectangle from {} to {} front fillcolor rgb '{}' fillstyle transparent solid {} "
          "noborder",
          script.at(entry.left, y + 6), script.at(right, y - 6),
          kBandColours[entry.index % kBandColours.size()], 2 * kBandOpacity);
    } else if (entry.band) {
      script.line("set arrow from {} to {} nohead front lw 1.6 dashtype 2 lc rgb '{}'",
                  script.at(entry.left, y), script.at(right, y), kLimitColour);
    } else if (panel.curves[entry.index].style == Curve::Style::points) {
      script.line("set label '' at {} point pointtype 7 pointsize 0.9 lc rgb '{}' front",
                  script.at((entry.left + right) / 2, y),
                  curve_colour(panel.curves[entry.index], entry.index));
    } else {
      script.line("set arrow from {} to {} nohead front lw 2.4 dashtype {} lc rgb '{}'",
                  script.at(entry.left, y), script.at(right, y), dash_type(entry.index),
                  curve_colour(panel.curves[entry.index], entry.index));
    }
    script.text(right + kLegendGap, y, entry.label, "left", PlotType::text);
  }
}

void write_marks(Script& script, const PlotLayout& layout, const PanelLayout& place, bool labels) {
  for (const MarkLayout& mark : layout.marks) {
    const char* const colour = mark.strong ? kStrongColour : kMarkColour;
    const char* const text_colour = mark.strong ? kStrongColour : kMarkTextColour;
    script.line("set arrow from {} to {} nohead {} dashtype 3 lc rgb '{}'",
                script.at(mark.line, place.bottom), script.at(mark.line, place.top),
                mark.strong ? "front lw 1.4" : "back lw 0.8", colour);
    if (!labels || mark.label.empty()) continue;
    if (!layout.marks_across) {
      script.text(mark.text, layout.marks_bottom - PlotType::mark / 2, mark.label, "left", PlotType::mark,
                  false, text_colour);
      continue;
    }
    script.line("set arrow from {} to {} nohead front lw 0.8 lc rgb '{}'", script.at(mark.line, place.top),
                script.at(mark.text, layout.marks_bottom - kMarkLeader + 2), colour);
    script.text(mark.text, layout.marks_bottom - kMarkLeader, mark.label, "left rotate by 90", PlotType::mark,
                false, text_colour);
  }
}

void write_points_named(Script& script, const Panel& panel, const PlotLayout& layout,
                        const PanelLayout& place) {
  constexpr double aside = 9;  // of the label from its dot [pixels]
  const auto share = [](double value, const Range& range) {
    return (value - range.first) / (range.second - range.first);
  };
  for (const NamedPoint& point : panel.points) {
    const double x = share(point.x, layout.x_range);
    const double y = share(point.y, place.y_range);
    if (!(x >= 0 && x <= 1 && y >= 0 && y <= 1)) continue;
    const double left = layout.left + x * (layout.right - layout.left);
    const double down = place.bottom - y * (place.bottom - place.top);
    script.line("set label '' at {} point pointtype 7 pointsize 1.2 lc rgb '{}' front", script.at(left, down),
                kPointColour);
    script.text(left + aside, down - aside, one_line(point.label), "left", PlotType::panel_title, true);
  }
}

void write_panel(Script& script, const Plot& plot, const PlotLayout& layout, std::size_t index,
                 const std::string& curves) {
  const Panel& panel = plot.panels[index];
  const PanelLayout& place = layout.panels[index];
  const bool last = index + 1 == plot.panels.size();
  const double middle = (place.top + place.bottom) / 2;

  script.line("unset label; unset arrow; unset object");
  script.line("set tmargin at screen {:.6f}; set bmargin at screen {:.6f}", script.screen_y(place.top),
              script.screen_y(place.bottom));
  script.line("set yrange [{}:{}]", place.y_range.first, place.y_range.second);
  script.line("set ytics ({})", tick_list(place.y_ticks, true));
  script.line("set xtics ({})", tick_list(layout.x_ticks, last));
  if (index == 0) {
    const double room = layout.right - layout.left;
    script.text(layout.left, 24, fitted_text(one_line(plot.title), PlotType::title, room, true), "left",
                PlotType::title, true);
  }
  const double title_room = layout.right - layout.left;
  script.text(layout.left, place.title_y,
              fitted_text(one_line(panel.title), PlotType::panel_title, title_room, true), "left",
              PlotType::panel_title, true);
  const double label_room = place.bottom - place.top + 20;
  script.text(18, middle, fitted_text(one_line(panel.y_label), PlotType::text, label_room),
              "center rotate by 90", PlotType::text);
  if (last) {
    const double below = plot.second_x ? kSecondScale : 0;
    script.text((layout.left + layout.right) / 2, layout.height - below - 18, plot.x_label, "center",
                PlotType::text);
    write_second_scale(script, plot, layout);
  }
  if (curves.empty()) {
    script.text((layout.left + layout.right) / 2, middle, "no data", "center", PlotType::text, false,
                "#7b8794");
  }
  script.line("set grid {}ytics", panel.lanes.empty() ? "" : "no");
  write_zones(script, plot, layout);
  write_bands(script, panel, place);
  write_marks(script, layout, place, index == 0);
  write_points_named(script, panel, layout, place);
  write_legend(script, panel, place);
  write_lane_labels(script, panel, layout, index);
  script.line("plot {}", curves.empty() ? "NaN" : curves);
}

/// The plot over log10(x), for an axis in decades.
Plot in_decades(Plot plot) {
  const auto shrink = [](double& x) { x = std::log10(x); };
  for (Panel& panel : plot.panels) {
    for (Curve& curve : panel.curves) std::for_each(curve.x.begin(), curve.x.end(), shrink);
    for (NamedPoint& point : panel.points) shrink(point.x);
    for (Lane& lane : panel.lanes) std::for_each(lane.x.begin(), lane.x.end(), shrink);
  }
  for (Mark& mark : plot.marks) shrink(mark.x);
  return plot;
}

std::string script_for(const Plot& given) {
  const Plot plot = given.log_x ? in_decades(given) : given;
  const PlotLayout layout = laid_out(plot);
  Script script(layout);
  script.line("set encoding utf8");
  script.line("set terminal pngcairo noenhanced size {},{} font 'DejaVu Sans,{:.2f}' background '#ffffff'",
              layout.width, layout.height, Script::points(PlotType::text));
  const std::vector<std::string> curves = write_data(script, plot, layout);
  script.line("unset key");
  script.line("set border 3 back lc rgb '#7b8794' lw 1");
  script.line("set tics nomirror scale 0.6 textcolor rgb '#1f2933'");
  script.line("set grid back linetype 1 lc rgb '#dfe3e8' lw 0.8");
  script.line("set lmargin at screen {:.6f}; set rmargin at screen {:.6f}", script.screen_x(layout.left),
              script.screen_x(layout.right));
  script.line("set xrange [{}:{}]", layout.x_range.first, layout.x_range.second);
  script.line("set multiplot");
  for (std::size_t p = 0; p < plot.panels.size(); ++p) write_panel(script, plot, layout, p, curves[p]);
  script.line("unset multiplot");
  return script.str();
}

void require_drawable(const Plot& plot) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("plot '" + one_line(plot.name) + "': " + why);
  };
  if (plot.name.empty() || plot.name.find('/') != std::string::npos || plot.name == "." ||
      plot.name == "..") {
    refuse("its name must be a file name without extension");
  }
  if (plot.panels.empty()) refuse("it has no panel");
  if (plot.width < 400 || plot.width > 10000 || plot.panel_height < 120 || plot.panel_height > 5000) {
    refuse(
        fmt::format("width {} and panel height {} cannot be drawn; 400 to 10000 and 120 to 5000 pixels can",
                    plot.width, plot.panel_height));
  }
  const auto above_zero = [](double x) { return x > 0; };
  for (const Panel& panel : plot.panels) {
    for (const Curve& curve : panel.curves) {
      if (plot.log_x && !std::all_of(curve.x.begin(), curve.x.end(), above_zero))
        refuse(fmt::format("curve '{}' has x that a logarithmic axis cannot show", one_line(curve.label)));
      if (curve.x.size() == curve.y.size()) continue;
      refuse(fmt::format("curve '{}' has {} x and {} y values", one_line(curve.label), curve.x.size(),
                         curve.y.size()));
    }
    for (const Lane& lane : panel.lanes) {
      if (lane.x.size() != lane.y.size())
        refuse(fmt::format("lane '{}' has {} x and {} states", one_line(lane.label), lane.x.size(),
                           lane.y.size()));
      if (!std::is_sorted(lane.x.begin(), lane.x.end()))
        refuse(fmt::format("lane '{}' does not run from left to right", one_line(lane.label)));
    }
    const bool ordered =
        !panel.y_range || (std::isfinite(panel.y_range->first) && std::isfinite(panel.y_range->second) &&
                           panel.y_range->first < panel.y_range->second);
    if (!ordered)
      refuse(fmt::format("panel '{}': the y range must go from low to high", one_line(panel.title)));
    for (const NamedPoint& point : panel.points) {
      if (std::isfinite(point.x) && std::isfinite(point.y)) continue;
      refuse(fmt::format("point '{}' is not at a finite place", one_line(point.label)));
    }
  }
}

}  // namespace

void write_points(Script& script, const std::string& name, const Points& points) {
  script.line("${} << END_OF_CURVE", name);
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    if (std::isfinite(points.y[i])) {
      script.line("{} {}", points.x[i], points.y[i]);
    } else {
      script.line("");  // interrupts the curve
    }
  }
  script.line("END_OF_CURVE");
}

std::vector<std::filesystem::path> draw_plots(const std::vector<Plot>& plots,
                                              const std::filesystem::path& directory) {
  for (const Plot& plot : plots) require_drawable(plot);
  std::vector<std::filesystem::path> files;
  if (plots.empty()) return files;
  std::filesystem::create_directories(directory);
  for (const Plot& plot : plots) {
    files.push_back(directory / (plot.name + ".png"));
    write_file(files.back(), run_gnuplot(script_for(plot)));
  }
  return files;
}

}  // namespace drycut::renders
