#include "renders/plot_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "renders/axes.hpp"
#include "renders/cairo_image.hpp"
#include "renders/decimate.hpp"
#include "renders/paper.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr double kLonelyDot = 2.5;  // radii [pixels]
constexpr double kNamedDot = 4.5;
constexpr double kSampleDot = 3.5;
constexpr double kLaneLow = 0.20;  ///< of a lane's height
constexpr double kLaneHigh = 0.80;

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

  using Paper::line;
  void line(double from_x, double from_y, double to_x, double to_y, const PlotLook& look) const {
    line(from_x, from_y, to_x, to_y, look.tone, look.size, look.dash);
  }

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
    for (std::size_t i = 0; i < plot_.zones.size(); ++i) {
      const Zone& zone = plot_.zones[i];
      const PlotLook look = look_of(zone, i);
      const double left = std::max(area.x(zone.from), area.left);
      const double right = std::min(area.x(zone.to), area.right);
      if (left < right && look.opacity > 0) box(left, area.top, right, area.bottom, look.tone);
    }
  }

  void bands(const Panel& shown, const PlotArea& area) const {
    for (std::size_t i = 0; i < shown.bands.size(); ++i) {
      const Band& band = shown.bands[i];
      const double top = std::max(area.y(std::max(band.low, band.high)), area.top);
      const double bottom = std::min(area.y(std::min(band.low, band.high)), area.bottom);
      const PlotLook look = look_of(band, i);
      if (top < bottom) box(area.left, top, area.right, bottom, look.tone, look.opacity);
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
      line(area.left, area.y(band.low), area.right, area.y(band.low), look_of(band, 0));
    }
  }

  void marks(const PlotArea& area, bool strong) const {
    const PlotLook look = look_of(Mark{0, "", strong});
    for (const MarkLayout& mark : layout_.marks)
      if (mark.strong == strong) line(crisp(mark.line), area.bottom, crisp(mark.line), area.top, look);
  }

  void mark_labels(const PlotArea& area) const {
    for (const MarkLayout& mark : layout_.marks) {
      if (mark.label.empty()) continue;
      const Ink colour = mark.strong ? kStrong : kSoftText;
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
      if (entry.band) {
        const PlotLook look = look_of(shown.bands[entry.index], entry.index);
        if (look.size > 0)
          line(entry.left, y, right, y, look);
        else
          box(entry.left, y - 6, right, y + 6, look.tone, 2 * look.opacity);
      } else {
        const Curve& curve = shown.curves[entry.index];
        const PlotLook look = look_of(curve, entry.index);
        if (curve.style == Curve::Style::points)
          dot((entry.left + right) / 2, y, kSampleDot, look.tone);
        else
          line(entry.left, y, right, y, look.tone, 1.2 * look.size, look.dash);
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
      const PlotLook look = look_of(curve, i);
      const bool loose = curve.style == Curve::Style::points;
      const auto points =
          shown.equal_scale && !loose ? thinned_path(curve, grid_of(area)) : decimated(curve, grid_of(area));
      any = any || !points.x.empty();
      if (loose) {
        dots(area, points, look.size, look.tone);
        continue;
      }
      clipped(area, [&] {
        if (curve.style == Curve::Style::area) fill_to_zero(area, points, look);
        curve_line(area, points, curve.style == Curve::Style::steps, look);
      });
      dots(area, isolated(points), kLonelyDot, look.tone);
    }
    return any;
  }

  /// In stretches, which their round ends join: a path that often crosses itself takes cairo the square of
  /// its length. Dashes run on, so that a line of them is one stretch.
  void curve_line(const PlotArea& area, const Points& points, bool steps, const PlotLook& look) const {
    const std::span<const double> x = points.x;
    const std::span<const double> y = points.y;
    const std::size_t stretch = look.dash.empty() ? 200 : x.size();
    cairo_set_line_cap(pen(), look.dash.empty() ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    for (std::size_t first = 0; first + 1 < x.size(); first += stretch) {
      const std::size_t count = std::min(stretch + 1, x.size() - first);
      trace(pen(), area, x.subspan(first, count), y.subspan(first, count), steps);
      stroke(look.tone, look.size, look.dash);
    }
    cairo_set_line_cap(pen(), CAIRO_LINE_CAP_BUTT);
  }

  void fill_to_zero(const PlotArea& area, const Points& points, const PlotLook& look) const {
    cairo_new_path(pen());
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      if (!std::isfinite(points.y[i])) continue;
      const double x = area.x(points.x[i]);
      if (i == 0 || !std::isfinite(points.y[i - 1])) cairo_move_to(pen(), x, area.y(0));
      cairo_line_to(pen(), x, area.y(points.y[i]));
      if (i + 1 == points.x.size() || !std::isfinite(points.y[i + 1])) cairo_line_to(pen(), x, area.y(0));
    }
    set_ink(pen(), look.tone, look.opacity);
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
          digital_lane(states, area, base, look_of(shown.lanes[i], i));
        else
          state_lane(states, area, base, state_tones(shown.lanes[i]));
      });
    }
    return any;
  }

  static double pixel_of(const PlotArea& area) {
    return (area.x_range.second - area.x_range.first) / (area.right - area.left);
  }

  void digital_lane(const std::vector<LaneState>& states, const PlotArea& area, double base,
                    const PlotLook& look) const {
    const double low = base + kLaneLow;
    const double high = base + kLaneHigh;
    for (const LaneState& state : high_states(states, pixel_of(area)))
      box(area.x(state.from), area.y(high), area.x(state.until), area.y(low), look.tone, look.opacity);
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
    curve_line(area, points, false, look);
  }

  /// A band for each state, with its number where there is room.
  void state_lane(const std::vector<LaneState>& states, const PlotArea& area, double base,
                  const std::map<double, Tone>& tones) const {
    const double top = area.y(base + kLaneHigh);
    const double bottom = area.y(base + kLaneLow);
    for (const LaneState& state : told_apart(states, pixel_of(area))) {
      const double left = area.x(state.from);
      const double right = area.x(state.until);
      box(left, top, right, bottom, state.mixed ? kMixed : tones.at(state.value));
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
