#include "renders/plot_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr double kTitleHeight = 46;
constexpr double kPanelHeader = 34;
constexpr double kLegendRow = 23;
constexpr double kPanelGap = 12;
constexpr double kXAxisHeight = 62;  ///< tick labels and axis label below the last panel
constexpr double kYLabelWidth = 40;
constexpr double kRightMargin = 26;
constexpr double kEntryGap = 24;
constexpr double kLaneHeight = 34;

class AxisSpan {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    const double bounded = std::clamp(value, -1e150, 1e150);  // so that the difference stays finite
    low_ = std::min(low_, bounded);
    high_ = std::max(high_, bounded);
  }
  /// Widened by a share of itself; made wide enough to draw if it is a point.
  Range range(double margin) const {
    if (low_ > high_) return {0, 1};
    const double size = std::max(std::abs(low_), std::abs(high_));
    if (high_ - low_ <= 1e-9 * size) {
      const double around = size > 0 ? 0.1 * size : 1;
      return {low_ - around, high_ + around};
    }
    const double border = margin * (high_ - low_);
    return {low_ - border, high_ + border};
  }

 private:
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

Range x_range(const Plot& plot) {
  AxisSpan span;
  for (const Panel& panel : plot.panels) {
    for (const Curve& curve : panel.curves) {
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        if (std::isfinite(curve.y[i])) span.add(curve.x[i]);
      }
    }
  }
  bool equal_scale = false;
  for (const Panel& panel : plot.panels) {
    equal_scale = equal_scale || panel.equal_scale;
    for (const Lane& lane : panel.lanes)
      std::for_each(lane.x.begin(), lane.x.end(), [&](double x) { span.add(x); });
    for (const NamedPoint& point : panel.points) span.add(point.x);
  }
  return span.range(equal_scale ? 0.06 : 0);
}

Range y_range(const Panel& panel) {
  if (panel.y_range) return *panel.y_range;
  AxisSpan span;
  for (const Curve& curve : panel.curves) {
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      if (std::isfinite(curve.x[i])) span.add(curve.y[i]);
    }
  }
  for (const Band& band : panel.bands) {
    span.add(band.low);
    span.add(band.high);
  }
  for (const NamedPoint& point : panel.points) span.add(point.y);
  return span.range(0.06);
}

/// Flags and counters have nothing between two whole numbers.
bool only_whole_numbers(const Panel& panel, std::vector<double> Curve::*numbers) {
  return std::any_of(panel.curves.begin(), panel.curves.end(),
                     [&](const Curve& curve) { return !(curve.*numbers).empty(); }) &&
         std::all_of(panel.curves.begin(), panel.curves.end(), [&](const Curve& curve) {
           return std::all_of((curve.*numbers).begin(), (curve.*numbers).end(), [](double number) {
             return !std::isfinite(number) || number == std::floor(number);
           });
         });
}

/// What has no unit and only whole numbers is counted: trials, pieces.
bool counts_x(const Plot& plot) {
  return plot.x_label.find('[') == std::string::npos && !plot.panels.empty() &&
         std::all_of(plot.panels.begin(), plot.panels.end(),
                     [](const Panel& panel) { return only_whole_numbers(panel, &Curve::x); });
}

/// Entries from the left, beside the title as far as they fit and in rows below it. Returns the rows used
/// below the title.
int lay_legend(const Panel& panel, double left, double right, double first_row,
               std::vector<LegendEntry>& legend) {
  const double title =
      panel.title.empty() ? 0 : text_width(one_line(panel.title), PlotType::panel_title, true) + 30;
  const double room = right - left - kLegendSample - kLegendGap;
  double x = left + title;
  int row = 0;
  const auto add = [&](bool band, std::size_t index, const std::string& label) {
    if (label.empty()) return;
    LegendEntry entry{band, index, fitted_text(one_line(label), PlotType::text, room), 0, 0};
    const double width = kLegendSample + kLegendGap + text_width(entry.label, PlotType::text);
    const bool row_is_empty = x == left && (row > 0 || title == 0);
    if (x + width > right && !row_is_empty) {
      ++row;
      x = left;
    }
    entry.left = x;
    entry.baseline = first_row + row * kLegendRow;
    x += width + kEntryGap;
    legend.push_back(entry);
  };
  for (std::size_t i = 0; i < panel.curves.size(); ++i) add(false, i, panel.curves[i].label);
  for (std::size_t i = 0; i < panel.bands.size(); ++i) add(true, i, panel.bands[i].label);
  return row;
}

/// A run of 10 s that was recorded up to 9.998 s still ends at a mark.
Range up_to_marks(const Range& range, int wanted) {
  const std::vector<Tick> ticks = axis_ticks(range.first, range.second, wanted);
  if (ticks.size() < 2) return range;
  const double step = ticks[1].value - ticks[0].value;
  const double near = 0.01 * (range.second - range.first);
  const double before = ticks.front().value - step;
  const double after = ticks.back().value + step;
  return {range.first - before < near ? before : range.first,
          after - range.second < near ? after : range.second};
}

Range grown_to(const Range& range, double size) {
  const double add = std::max(0.0, (size - (range.second - range.first)) / 2);
  return {range.first - add, range.second + add};
}

/// Lets the ranges of panels of equal scale grow until a unit is as long in x as in y. The other panels
/// share the x axis and grow with it.
void equalise(const Plot& plot, PlotLayout& layout, double width, double height) {
  if (!(width > 0 && height > 0)) return;
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    if (!plot.panels[i].equal_scale) continue;
    const auto [low, high] = layout.panels[i].y_range;
    layout.x_range = grown_to(layout.x_range, (high - low) * width / height);
  }
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    if (!plot.panels[i].equal_scale) continue;
    const double x_size = layout.x_range.second - layout.x_range.first;
    layout.panels[i].y_range = grown_to(layout.panels[i].y_range, x_size * height / width);
  }
}

/// Lanes stand one below the other, a unit of y high each; their names stand where other panels have numbers.
void lay_lanes(const std::vector<Lane>& lanes, double widest_name, PanelLayout& here) {
  const auto count = static_cast<double>(lanes.size());
  here.y_range = {0, count};
  here.y_ticks.clear();
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    here.y_ticks.push_back({count - static_cast<double>(i) - 0.5,
                            fitted_text(one_line(lanes[i].label), PlotType::text, widest_name)});
  }
}

double widest_label(const std::vector<Tick>& ticks) {
  double widest = 0;
  for (const Tick& tick : ticks) widest = std::max(widest, text_width(tick.label, PlotType::text));
  return widest;
}

/// Moves labels that stand across apart until they no longer touch; leaves labels out if there is no room for
/// all, first those with the least room of their own.
void spread(std::vector<MarkLayout>& marks, double left, double right) {
  constexpr double pitch = PlotType::mark + 3;
  const auto most = static_cast<std::size_t>(std::max(1.0, std::floor((right - left) / pitch)));
  std::vector<std::size_t> order(marks.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto room = [&](std::size_t i) {
    return (i + 1 < marks.size() ? marks[i + 1].line : right) - marks[i].line;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return room(a) > room(b); });
  for (std::size_t i = most; i < order.size(); ++i) marks[order[i]].label.clear();

  double next = left;
  for (MarkLayout& mark : marks) {
    if (mark.label.empty()) continue;
    mark.text = std::max(mark.line, next);
    next = mark.text + pitch;
  }
  double limit = right;
  for (auto mark = marks.rbegin(); mark != marks.rend(); ++mark) {
    if (mark->label.empty()) continue;
    mark->text = std::min(mark->text, limit);
    limit = mark->text - pitch;
  }
}

/// Places the marks and returns the height of their strip of labels.
double lay_marks(const Plot& plot, PlotLayout& layout) {
  constexpr double widest_label = 150;
  const auto [low, high] = layout.x_range;
  for (const Mark& mark : plot.marks) {
    if (!(mark.x >= low && mark.x <= high)) continue;
    const double x = layout.left + (mark.x - low) / (high - low) * (layout.right - layout.left);
    layout.marks.push_back(
        {fitted_text(one_line(mark.label), PlotType::mark, widest_label), x, x + 4, mark.strong});
  }
  double widest = 0;
  for (std::size_t i = 0; i < layout.marks.size(); ++i) {
    const MarkLayout& mark = layout.marks[i];
    const double end = i + 1 < layout.marks.size() ? layout.marks[i + 1].line : layout.right + kRightMargin;
    const double width = text_width(mark.label, PlotType::mark);
    if (mark.text + width > end) layout.marks_across = true;
    widest = std::max(widest, width);
  }
  if (widest == 0) return 0;
  if (!layout.marks_across) return PlotType::mark + 6;
  spread(layout.marks, layout.left, layout.right);
  return widest + 6 + kMarkLeader;
}

}  // namespace

PlotLayout laid_out(const Plot& plot) {
  PlotLayout layout;
  layout.width = plot.width;
  layout.right = plot.width - kRightMargin;
  layout.x_range = x_range(plot);

  const int y_ticks = std::clamp(plot.panel_height / 48, 2, 12);
  double widest = 0;
  for (const Panel& panel : plot.panels) {
    PanelLayout here;
    here.y_range = y_range(panel);
    const double least = only_whole_numbers(panel, &Curve::y) ? 1 : 0;
    here.y_ticks = axis_ticks(here.y_range.first, here.y_range.second, y_ticks, least);
    if (!panel.lanes.empty()) lay_lanes(panel.lanes, plot.width / 4.0, here);
    widest = std::max(widest, widest_label(here.y_ticks));
    layout.panels.push_back(here);
  }
  layout.left = std::min(kYLabelWidth + widest + 12, 0.5 * plot.width);
  const int x_ticks = std::clamp(static_cast<int>((layout.right - layout.left) / 110), 2, 16);
  const double axes_height = plot.panel_height - kPanelHeader - kPanelGap;
  if (std::any_of(plot.panels.begin(), plot.panels.end(), [](const Panel& p) { return p.equal_scale; })) {
    equalise(plot, layout, layout.right - layout.left, axes_height);
    for (PanelLayout& here : layout.panels)
      here.y_ticks = axis_ticks(here.y_range.first, here.y_range.second, y_ticks);
  } else if (!plot.log_x) {
    layout.x_range = up_to_marks(layout.x_range, x_ticks);
  }
  layout.x_ticks =
      plot.log_x ? decade_ticks(layout.x_range.first, layout.x_range.second)
                 : axis_ticks(layout.x_range.first, layout.x_range.second, x_ticks, counts_x(plot) ? 1 : 0);

  if (plot.second_x) {
    const double factor = plot.second_x->factor;
    layout.second_ticks = axis_ticks(layout.x_range.first * factor, layout.x_range.second * factor, x_ticks);
    for (Tick& tick : layout.second_ticks) tick.value /= factor;
  }

  const double strip = lay_marks(plot, layout);
  double y = plot.title.empty() ? 10 : kTitleHeight;
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    PanelLayout& here = layout.panels[i];
    here.title_y = y + kPanelHeader / 2;
    const int rows = lay_legend(plot.panels[i], layout.left, layout.right, here.title_y, here.legend);
    here.top = y + kPanelHeader + rows * kLegendRow + (i == 0 ? strip : 0);
    const auto lanes = static_cast<double>(plot.panels[i].lanes.size());
    here.bottom = here.top + (lanes > 0 ? lanes * kLaneHeight : axes_height);
    if (i == 0) layout.marks_bottom = here.top - 3;
    y = here.bottom + kPanelGap;
  }
  const double second = plot.second_x ? kSecondScale : 0;
  layout.height = static_cast<int>(std::ceil(y - kPanelGap + kXAxisHeight + second));
  return layout;
}

}  // namespace drycut::renders
