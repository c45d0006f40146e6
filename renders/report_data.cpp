#include "renders/report_data.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "base/embedded.hpp"
#include "base/json.hpp"
#include "renders/decimate.hpp"
#include "renders/html.hpp"
#include "renders/palette.hpp"
#include "renders/plot_layout.hpp"
#include "renders/png_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {

std::string map_figure(const ReportMap& map, std::size_t number) {
  return fmt::format(
      "<figure class=\"map\" data-map=\"{}\"><div class=\"ground\"><img alt=\"{}\" "
      "src=\"data:image/png;base64,{}\"></div><div class=\"map-point\"></div>"
      "<figcaption>{}</figcaption></figure>\n",
      number, html_text(map.map.title), base64(read_file(map.png)), html_text(map.caption));
}

std::string live_maps(const std::vector<ReportMap>& maps) {
  if (maps.empty()) return "";
  auto all = Json::array();
  for (const ReportMap& shown : maps) {
    const PlotArea area = map_area(shown.map);
    const double width = shown.map.width;
    const double height = shown.map.height;
    all.push_back({{"x", shown.map.x.values},
                   {"y", shown.map.y.values},
                   {"xRange", {area.x_range.first, area.x_range.second}},
                   {"yRange", {area.y_range.first, area.y_range.second}},
                   {"left", area.left / width},
                   {"right", area.right / width},
                   {"top", area.top / height},
                   {"bottom", area.bottom / height},
                   {"headings", shown.headings},
                   {"cells", shown.cells},
                   {"command", shown.command}});
  }
  return fmt::format("<script type=\"application/json\" id=\"map-data\">{}</script>\n<script>{}</script>\n",
                     safe_in_script(all), embedded_file("report_map.js"));
}

namespace {

static_assert(std::endian::native == std::endian::little, "the columns are little-endian");

template <typename Number>
std::string bytes_of(const std::vector<double>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = static_cast<Number>(numbers[i]);
    std::memcpy(bytes.data() + i * sizeof(Number), &number, sizeof(Number));
  }
  return bytes;
}

/// Columns of numbers; the same column is kept once, however many curves it belongs to.
class DataColumns {
 public:
  std::size_t x(const std::vector<double>& numbers) { return index(numbers, true); }
  std::size_t y(const std::vector<double>& numbers) { return index(numbers, false); }

  [[nodiscard]] Json json() const {
    auto list = Json::array();
    for (const auto& [numbers, wide] : columns_)
      list.push_back({{"type", wide ? "f8" : "f4"},
                      {"base64", base64(wide ? bytes_of<double>(*numbers) : bytes_of<float>(*numbers))}});
    return list;
  }

 private:
  std::size_t index(const std::vector<double>& numbers, bool wide) {
    const auto same = [&](const auto& column) {
      // As bytes: a gap (NaN) is equal to itself.
      return column.second == wide && column.first->size() == numbers.size() && !numbers.empty() &&
             std::memcmp(column.first->data(), numbers.data(), numbers.size() * sizeof(double)) == 0;
    };
    const auto found = std::find_if(columns_.begin(), columns_.end(), same);
    if (found != columns_.end()) return static_cast<std::size_t>(found - columns_.begin());
    columns_.emplace_back(&numbers, wide);
    return columns_.size() - 1;
  }

  std::vector<std::pair<const std::vector<double>*, bool>> columns_;
};

/// Of each item and its number, an object.
template <typename Item, typename Object>
Json list_of(const std::vector<Item>& items, const Object& object) {
  auto list = Json::array();
  for (std::size_t i = 0; i < items.size(); ++i) list.push_back(object(items[i], i));
  return list;
}

/// By day and by night.
Json tone_json(const Tone& tone) {
  return {fmt::format("#{:06x}", tone.light), fmt::format("#{:06x}", tone.dark)};
}

Json look_json(const PlotLook& look) {
  return {
      {"tone", tone_json(look.tone)}, {"opacity", look.opacity}, {"size", look.size}, {"dash", look.dash}};
}

std::string_view style_name(Curve::Style style) {
  if (style == Curve::Style::points) return "points";
  return style == Curve::Style::steps ? "steps" : "line";
}

Json panel_json(const Panel& panel, DataColumns& columns) {
  const auto curve = [&](const Curve& one, std::size_t i) -> Json {
    return {{"label", one_line(one.label)},       {"style", style_name(one.style)}, {"faint", one.faint},
            {"look", look_json(look_of(one, i))}, {"x", columns.x(one.x)},          {"y", columns.y(one.y)}};
  };
  const auto band = [](const Band& one, std::size_t i) -> Json {
    return {{"label", one_line(one.label)},
            {"look", look_json(look_of(one, i))},
            {"low", std::min(one.low, one.high)},
            {"high", std::max(one.low, one.high)}};
  };
  const auto lane = [&](const Lane& one, std::size_t i) -> Json {
    auto states = Json::array();  // none: it is high or low
    if (!is_digital(one))
      for (const auto& [value, tone] : state_tones(one)) states.push_back({value, tone_json(tone)});
    return {{"label", one_line(one.label)},
            {"look", look_json(look_of(one, i))},
            {"states", std::move(states)},
            {"x", columns.x(one.x)},
            {"y", columns.y(one.y)}};
  };
  auto range = Json::array();
  if (panel.y_range) range = {panel.y_range->first, panel.y_range->second};
  return {{"title", one_line(panel.title)},      {"yLabel", one_line(panel.y_label)},
          {"least", std::move(range)},           {"curves", list_of(panel.curves, curve)},
          {"bands", list_of(panel.bands, band)}, {"lanes", list_of(panel.lanes, lane)}};
}

Json plot_json(const Plot& plot, DataColumns& columns) {
  const auto mark = [](const Mark& one, std::size_t /*i*/) -> Json {
    return {{"x", one.x}, {"label", one_line(one.label)}, {"strong", one.strong}};
  };
  const auto zone = [](const Zone& one, std::size_t i) -> Json {
    return {{"from", one.from}, {"to", one.to}, {"look", look_json(look_of(one, i))}};
  };
  Json second;
  if (plot.second_x) second = {{"label", one_line(plot.second_x->label)}, {"factor", plot.second_x->factor}};
  const auto [low, high] = laid_out(plot).x_range;
  const bool points = std::any_of(plot.panels.begin(), plot.panels.end(), [](const Panel& panel) {
    return std::any_of(panel.curves.begin(), panel.curves.end(),
                       [](const Curve& curve) { return curve.style == Curve::Style::points; });
  });
  const double border = points ? 0.015 * (high - low) : 0;  // so that no dot is cut in half
  return {{"title", one_line(plot.title)},
          {"xLabel", one_line(plot.x_label)},
          {"range", {low - border, high + border}},
          {"second", std::move(second)},
          {"marks", list_of(plot.marks, mark)},
          {"markLooks", {look_json(look_of(Mark{})), look_json(look_of(Mark{0, "", true}))}},
          {"zones", list_of(plot.zones, zone)},
          {"panels", list_of(plot.panels,
                             [&](const Panel& one, std::size_t /*i*/) { return panel_json(one, columns); })}};
}

}  // namespace

bool can_be_live(const Plot& plot) {
  const auto plain = [](const Curve& curve) {
    return curve.style != Curve::Style::area && std::is_sorted(curve.x.begin(), curve.x.end());
  };
  const auto fits = [&](const Panel& panel) {
    return !panel.equal_scale && std::all_of(panel.curves.begin(), panel.curves.end(), plain);
  };
  return !plot.log_x && std::all_of(plot.panels.begin(), plot.panels.end(), fits);
}

std::string plot_data(const std::vector<Plot>& plots) {
  DataColumns columns;
  auto list = list_of(plots, [&](const Plot& plot, std::size_t /*i*/) -> Json {
    return can_be_live(plot) ? plot_json(plot, columns) : nullptr;
  });
  return safe_in_script({{"plots", std::move(list)}, {"columns", columns.json()}});
}

std::string plot_words(const Plot& plot) {
  std::string text = plot.title;
  const char* sign = ": ";
  for (const Panel& panel : plot.panels) {
    std::string names;
    const auto name = [&](const std::string& label) {
      if (!label.empty()) names += (names.empty() ? "" : ", ") + label;
    };
    for (const Curve& curve : panel.curves) name(curve.label);
    for (const Lane& lane : panel.lanes) name(lane.label);
    std::string what = panel.title;
    if (!panel.y_label.empty()) what += (what.empty() ? "" : " ") + panel.y_label;
    if (!names.empty()) what += (what.empty() ? "" : " of ") + names;
    if (!what.empty()) text += sign + what;
    sign = "; ";
  }
  return plot.x_label.empty() ? text : text + " over " + plot.x_label;
}

std::string live_plots(const std::vector<Plot>& plots, const std::string& folder) {
  const std::filesystem::path library = std::filesystem::path(folder) / "dygraph.min.js";
  const std::filesystem::path style = std::filesystem::path(folder) / "dygraph.min.css";
  if (std::none_of(plots.begin(), plots.end(), can_be_live)) return "";
  if (!std::filesystem::is_regular_file(library) || !std::filesystem::is_regular_file(style)) {
    return "<p class=\"remark\">The plots cannot be zoomed: they need libjs-dygraphs, which was not "
           "installed.</p>\n";
  }
  return fmt::format(
      "<style>{}</style>\n<script>{}</script>\n<script type=\"application/json\" "
      "id=\"plot-data\">{}</script>\n"
      "<script>{}</script>\n",
      read_file(style), read_file(library), plot_data(plots), embedded_file("report.js"));
}

}  // namespace drycut::renders
