#include "renders/plot_painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "renders/cairo_image.hpp"
#include "renders/decimate.hpp"
#include "renders/lanes.hpp"
#include "renders/paper.hpp"
#include "renders/plot_area.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

// Okabe and Ito's palette: told apart with any colour vision. After its end the lines are dashed.
constexpr std::array kCurveInks = {ink(0x0072b2), ink(0xd55e00), ink(0x009e73), ink(0xcc79a7),
                                   ink(0xe69f00), ink(0x56b4e9), ink(0x333333)};
constexpr std::array kBandInks = {ink(0xe8c400), ink(0x56b4e9), ink(0x8a8f98)};
// Light, for the states of a lane with several.
constexpr std::array kStateInks = {ink(0xcfe6f5), ink(0xfbdcc4), ink(0xc5ebdf), ink(0xf3dcea),
                                   ink(0xfbe8b9), ink(0xdadfe4), ink(0xe3dcf6)};
constexpr std::size_t kLaneInks = 4;  ///< of the curves' palette: those that are dark enough
constexpr Ink kZone = ink(0xf0f3f6);
constexpr Ink kStrongZone = ink(0xd3efe2);
constexpr Ink kFaint = ink(0xb9c2cc);
constexpr Ink kMixed = ink(0x8a8f98);

constexpr double kBandShade = 0.22;  ///< opacity
constexpr double kCurveWidth = 2;    // of lines and radii of dots [pixels]
constexpr double kLimitWidth = 1.6;
constexpr double kDot = 2.8;
constexpr double kFaintDot = 1.8;
constexpr double kLonelyDot = 2.5;
constexpr double kNamedDot = 4.5;
constexpr double kLaneLow = 0.20;  ///< of a lane's height
constexpr double kLaneHigh = 0.80;

const Dash kLimitDash = {7, 5};
const Dash kMarkDash = {2, 4};

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

bool is_limit(const Band& band) { return band.low == band.high; }

class Painter : Paper {
 public:
  Painter(cairo_t* pen, const Plot& plot, const PlotLayout& layout)
      : Paper(pen), plot_(plot), layout_(layout) {}

  void paint() const {
    blank();
    text(layout_.left, 24, fitted(plot_.title, PlotType::title, width(), true), Align::left, PlotType::title,
         true);
    for (std::size_t i = 0; i < plot_.panels.size(); ++i) panel(i);
    const double middle = (layout_.left + layout_.right) / 2;
    const double below = plot_.second_x ? kSecondScale : 0;
    text(middle, layout_.height - below - 18, fitted(plot_.x_label, PlotType::text, width()), Align::middle,
         PlotType::text);
    if (plot_.second_x) second_scale(middle);
  }

 private:
  [[nodiscard]] double width() const { return layout_.right - layout_.left; }

  /// Those inside of the area; at its border they are whole.
  void dots(const PlotArea& area, const Points& points, double radius, const Ink& colour) const {
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      const double x = area.x(points.x[i]);
      const double y = area.y(points.y[i]);
      if (is_inside(area, x, y)) dot(x, y, radius, colour);
    }
  }

  static bool is_inside(const PlotArea& area, double x, double y) {
    constexpr double hair = 1e-6;
    return x >= area.left - hair && x <= area.right + hair && y >= area.top - hair && y <= area.bottom + hair;
  }

  // ---- a panel, from the ground up ----

  void panel(std::size_t index) const {
    const Panel& shown = plot_.panels[index];
    const PanelLayout& place = layout_.panels[index];
    const PlotArea area = {layout_.left, place.top,       layout_.right,
                           place.bottom, layout_.x_range, place.y_range};
    zones(area);
    bands(shown, area);
    axes(shown, place, area, index + 1 == plot_.panels.size());
    limits(shown, area);
    marks(area, false);
    const bool any = shown.lanes.empty() ? curves(shown, area) : lanes(shown, area);
    const double middle = (place.top + place.bottom) / 2;
    if (!any)
      text((area.left + area.right) / 2, middle, "no data", Align::middle, PlotType::text, false, kAxis);
    marks(area, true);
    if (index == 0) mark_labels(area);
    named_points(shown, area);
    text(area.left, place.title_y, fitted(shown.title, PlotType::panel_title, width(), true), Align::left,
         PlotType::panel_title, true);
    legend(shown, place);
    const double room = place.bottom - place.top + 20;
    text(18, middle, fitted(shown.y_label, PlotType::text, room), Align::middle, PlotType::text, false, kText,
         true);
  }

  void zones(const PlotArea& area) const {
    bool shaded = false;
    for (const Zone& zone : plot_.zones) {
      shaded = !shaded;
      const double left = std::max(area.x(zone.from), area.left);
      const double right = std::min(area.x(zone.to), area.right);
      if (left < right && (shaded || zone.strong))
        box(left, area.top, right, area.bottom, zone.strong ? kStrongZone : kZone);
    }
  }

  void bands(const Panel& shown, const PlotArea& area) const {
    for (std::size_t i = 0; i < shown.bands.size(); ++i) {
      const Band& band = shown.bands[i];
      const double top = std::max(area.y(std::max(band.low, band.high)), area.top);
      const double bottom = std::min(area.y(std::min(band.low, band.high)), area.bottom);
      if (top < bottom) box(area.left, top, area.right, bottom, kBandInks[i % kBandInks.size()], kBandShade);
    }
  }

  void axes(const Panel& shown, const PanelLayout& place, const PlotArea& area, bool last) const {
    const double left = crisp(area.left);
    const double bottom = crisp(area.bottom);
    for (const Tick& tick : layout_.x_ticks)
      line(crisp(area.x(tick.value)), area.top, crisp(area.x(tick.value)), bottom, kGrid, kGridWidth);
    if (shown.lanes.empty()) {
      for (const Tick& tick : place.y_ticks)
        line(left, crisp(area.y(tick.value)), area.right, crisp(area.y(tick.value)), kGrid, kGridWidth);
    }
    for (std::size_t i = 1; i < shown.lanes.size(); ++i) {
      const double between = crisp(area.y(static_cast<double>(i)));
      line(left, between, area.right, between, kGrid, kGridWidth);
    }
    line(left, area.top, left, bottom, kAxis, kGridWidth);
    line(left, bottom, area.right, bottom, kAxis, kGridWidth);
    for (const Tick& tick : layout_.x_ticks) {
      const double x = crisp(area.x(tick.value));
      line(x, bottom, x, bottom - kTickLength, kAxis, kGridWidth);
      if (last) text(x, bottom + 16, tick.label, Align::middle, PlotType::text);
    }
    for (const Tick& tick : place.y_ticks) {
      const double y = crisp(area.y(tick.value));
      line(left, y, left + kTickLength, y, kAxis, kGridWidth);
      text(left - 8, y, tick.label, Align::right, PlotType::text);
    }
  }

  void limits(const Panel& shown, const PlotArea& area) const {
    for (const Band& band : shown.bands) {
      if (!is_limit(band) || band.low < area.y_range.first || band.low > area.y_range.second) continue;
      line(area.left, area.y(band.low), area.right, area.y(band.low), kStrong, kLimitWidth, kLimitDash);
    }
  }

  void marks(const PlotArea& area, bool strong) const {
    for (const MarkLayout& mark : layout_.marks) {
      if (mark.strong == strong)
        line(crisp(mark.line), area.bottom, crisp(mark.line), area.top, strong ? kStrong : kAxis,
             strong ? 1.4 : 0.7, kMarkDash);
    }
  }

  void mark_labels(const PlotArea& area) const {
    for (const MarkLayout& mark : layout_.marks) {
      if (mark.label.empty()) continue;
      const Ink& colour = mark.strong ? kStrong : kSoftText;
      if (!layout_.marks_across) {
        text(mark.text, layout_.marks_bottom - PlotType::mark / 2, mark.label, Align::left, PlotType::mark,
             false, colour);
        continue;
      }
      const double end = layout_.marks_bottom - kMarkLeader;
      line(mark.line, area.top, mark.text, end + 2, mark.strong ? kStrong : kAxis, 0.8);
      text(mark.text, end, mark.label, Align::left, PlotType::mark, false, colour, true);
    }
  }

  void named_points(const Panel& shown, const PlotArea& area) const {
    constexpr double aside = 9;  // of the label from its dot
    for (const NamedPoint& point : shown.points) {
      const double x = area.x(point.x);
      const double y = area.y(point.y);
      if (!is_inside(area, x, y)) continue;
      dot(x, y, kNamedDot, kText);
      text(x + aside, y - aside, one_line(point.label), Align::left, PlotType::panel_title, true);
    }
  }

  void legend(const Panel& shown, const PanelLayout& place) const {
    for (const LegendEntry& entry : place.legend) {
      const double right = entry.left + kLegendSample;
      const double y = entry.baseline;
      if (entry.band && is_limit(shown.bands[entry.index])) {
        line(entry.left, y, right, y, kStrong, kLimitWidth, kLimitDash);
      } else if (entry.band) {
        box(entry.left, y - 6, right, y + 6, kBandInks[entry.index % kBandInks.size()], 2 * kBandShade);
      } else if (const Curve& curve = shown.curves[entry.index]; curve.style == Curve::Style::points) {
        dot((entry.left + right) / 2, y, 1.25 * kDot, ink_of(curve, entry.index));
      } else {
        line(entry.left, y, right, y, ink_of(curve, entry.index), 2.4, dash_of(entry.index));
      }
      text(right + kLegendGap, y, entry.label, Align::left, PlotType::text);
    }
  }

  /// The second scale below the first: ticks on a line of its own, with their numbers.
  void second_scale(double middle) const {
    const double height = layout_.height;
    const PlotArea area = {layout_.left, 0, layout_.right, height, layout_.x_range, {0, 1}};
    const double y = crisp(height - kSecondTicks);
    line(area.left, y, area.right, y, kAxis, kGridWidth);
    for (const Tick& tick : layout_.second_ticks) {
      const double x = crisp(area.x(tick.value));
      line(x, y, x, y - kTickLength, kAxis, kGridWidth);
      text(x, height - kSecondNumbers, tick.label, Align::middle, PlotType::text);
    }
    text(middle, height - 18, fitted(plot_.second_x->label, PlotType::text, width()), Align::middle,
         PlotType::text);
  }

  // ---- curves: true if there was something to draw ----

  static const Ink& ink_of(const Curve& curve, std::size_t index) {
    return curve.faint ? kFaint : kCurveInks[index % kCurveInks.size()];
  }
  static const Dash& dash_of(std::size_t index) {
    static const std::array<Dash, 5> dashes = {Dash{}, {7, 5}, {2, 4}, {9, 4, 2, 4}, {9, 4, 2, 4, 2, 4}};
    return dashes[index / kCurveInks.size() % dashes.size()];
  }
  static PixelGrid grid_of(const PlotArea& area) {
    return {area.x_range.first,
            area.x_range.second,
            area.y_range.first,
            area.y_range.second,
            static_cast<int>(area.right - area.left),
            static_cast<int>(area.bottom - area.top)};
  }

  bool curves(const Panel& shown, const PlotArea& area) const {
    bool any = false;
    for (std::size_t i = 0; i < shown.curves.size(); ++i) {
      const Curve& curve = shown.curves[i];
      const Ink& colour = ink_of(curve, i);
      const bool loose = curve.style == Curve::Style::points;
      const auto points =
          shown.equal_scale && !loose ? thinned_path(curve, grid_of(area)) : decimated(curve, grid_of(area));
      any = any || !points.x.empty();
      if (loose) {
        dots(area, points, curve.faint ? kFaintDot : kDot, colour);
        continue;
      }
      clipped(area, [&] {
        if (curve.style == Curve::Style::area) fill_to_zero(area, points, colour);
        curve_line(area, points, curve.style == Curve::Style::steps, colour, dash_of(i));
      });
      dots(area, isolated(points), kLonelyDot, colour);
    }
    return any;
  }

  /// In stretches, which their round ends join: a path that often crosses itself takes cairo the square of
  /// its length. Dashes run on, so that a line of them is one stretch.
  void curve_line(const PlotArea& area, const Points& points, bool steps, const Ink& colour,
                  const Dash& dash) const {
    const std::span<const double> x = points.x;
    const std::span<const double> y = points.y;
    const std::size_t stretch = dash.empty() ? 200 : x.size();
    cairo_set_line_cap(pen(), dash.empty() ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    for (std::size_t first = 0; first + 1 < x.size(); first += stretch) {
      const std::size_t count = std::min(stretch + 1, x.size() - first);
      trace(pen(), area, x.subspan(first, count), y.subspan(first, count), steps);
      stroke(colour, kCurveWidth, dash);
    }
    cairo_set_line_cap(pen(), CAIRO_LINE_CAP_BUTT);
  }

  void fill_to_zero(const PlotArea& area, const Points& points, const Ink& colour) const {
    cairo_new_path(pen());
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      if (!std::isfinite(points.y[i])) continue;
      const double x = area.x(points.x[i]);
      if (i == 0 || !std::isfinite(points.y[i - 1])) cairo_move_to(pen(), x, area.y(0));
      cairo_line_to(pen(), x, area.y(points.y[i]));
      if (i + 1 == points.x.size() || !std::isfinite(points.y[i + 1])) cairo_line_to(pen(), x, area.y(0));
    }
    set_ink(pen(), colour, 0.35);
    cairo_fill(pen());
  }

  // ---- lanes: likewise ----

  bool lanes(const Panel& shown, const PlotArea& area) const {
    bool any = false;
    for (std::size_t i = 0; i < shown.lanes.size(); ++i) {
      const auto states = lane_states(shown.lanes[i]);
      any = any || !states.empty();
      const auto base = static_cast<double>(shown.lanes.size() - i - 1);
      clipped(area, [&] {
        if (is_digital(shown.lanes[i]))
          digital_lane(states, area, base, kCurveInks[i % kLaneInks]);
        else
          state_lane(states, area, base);
      });
    }
    return any;
  }

  static double pixel_of(const PlotArea& area) {
    return (area.x_range.second - area.x_range.first) / (area.right - area.left);
  }

  void digital_lane(const std::vector<LaneState>& states, const PlotArea& area, double base,
                    const Ink& colour) const {
    const double low = base + kLaneLow;
    const double high = base + kLaneHigh;
    for (const LaneState& state : high_states(states, pixel_of(area)))
      box(area.x(state.from), area.y(high), area.x(state.until), area.y(low), colour, 0.30);
    Curve steps;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (i > 0 && states[i - 1].until != states[i].from) {
        steps.x.push_back(states[i].from);
        steps.y.push_back(std::nan(""));
      }
      const double level = states[i].value == 0 ? low : high;
      steps.x.insert(steps.x.end(), {states[i].from, states[i].until});
      steps.y.insert(steps.y.end(), {level, level});
    }
    const auto points = decimated(steps, grid_of(area));
    curve_line(area, points, false, colour, {});
  }

  /// A band for each state, with its number where there is room.
  void state_lane(const std::vector<LaneState>& states, const PlotArea& area, double base) const {
    std::set<double> values;
    for (const LaneState& state : states) values.insert(state.value);
    const double top = area.y(base + kLaneHigh);
    const double bottom = area.y(base + kLaneLow);
    for (const LaneState& state : told_apart(states, pixel_of(area))) {
      const double left = area.x(state.from);
      const double right = area.x(state.until);
      const auto order = static_cast<std::size_t>(std::distance(values.begin(), values.find(state.value)));
      box(left, top, right, bottom, state.mixed ? kMixed : kStateInks[order % kStateInks.size()]);
      cairo_rectangle(pen(), left, top, right - left, bottom - top);
      stroke(kSoftText, 0.8);
      const auto label = fmt::format("{:g}", state.value);
      if (!state.mixed && text_width(label, PlotType::mark) + 6 <= right - left)
        text((left + right) / 2, (top + bottom) / 2, label, Align::middle, PlotType::mark);
    }
  }

  const Plot& plot_;
  const PlotLayout& layout_;
};

}  // namespace

Image painted(const Plot& plot, const PlotLayout& layout) {
  constexpr int slice = 8192;  // [rows]: cairo takes no picture higher than 32767
  Image image(layout.width, layout.height);
  for (int first = 0; first < layout.height; first += slice) {
    const int rows = std::min(slice, layout.height - first);
    const CairoSurface surface = cairo_surface(layout.width, rows);
    const Cairo pen = cairo_pen(surface.get());
    cairo_translate(pen.get(), 0, -first);
    Painter(pen.get(), plot, layout).paint();
    copy_rows(surface.get(), rows, image, first);
  }
  return image;
}

}  // namespace drycut::renders
