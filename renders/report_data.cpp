#include "renders/report_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>

#include "renders/html.hpp"
#include "renders/lanes.hpp"
#include "renders/plot_layout.hpp"
#include "renders/png_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

static_assert(std::endian::native == std::endian::little, "the columns are little-endian");

/// A JSON string. Signs that could end the script element are escaped as well.
std::string json_text(const std::string& text) {
  std::string json = "\"";
  for (const char c : one_line(text)) {
    if (c == '"' || c == '\\' || c == '<' || c == '>' || c == '&') {
      json += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      json += c;
    }
  }
  return json + "\"";
}

std::string joined(const std::vector<std::string>& items) {
  std::string list = "[";
  for (const std::string& item : items) list += (list.size() > 1 ? "," : "") + item;
  return list + "]";
}

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
class Columns {
 public:
  std::size_t x(const std::vector<double>& numbers) { return index(numbers, true); }
  std::size_t y(const std::vector<double>& numbers) { return index(numbers, false); }

  std::string json() const {
    std::vector<std::string> items;
    for (const auto& [numbers, wide] : columns_) {
      items.push_back(fmt::format(R"({{"type":"{}","base64":"{}"}})", wide ? "f8" : "f4",
                                  base64(wide ? bytes_of<double>(*numbers) : bytes_of<float>(*numbers))));
    }
    return joined(items);
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

std::string panel_json(const Panel& panel, Columns& columns) {
  std::vector<std::string> curves, bands, lanes;
  for (const Curve& curve : panel.curves) {
    const char* const style = curve.style == Curve::Style::points  ? "points"
                              : curve.style == Curve::Style::steps ? "steps"
                                                                   : "line";
    curves.push_back(fmt::format(R"({{"label":{},"style":"{}","faint":{},"x":{},"y":{}}})",
                                 json_text(curve.label), style, curve.faint, columns.x(curve.x),
                                 columns.y(curve.y)));
  }
  for (const Band& band : panel.bands) {
    bands.push_back(
        fmt::format(R"({{"label":{},"low":{},"high":{}}})", json_text(band.label), band.low, band.high));
  }
  for (const Lane& lane : panel.lanes) {
    lanes.push_back(fmt::format(R"({{"label":{},"digital":{},"x":{},"y":{}}})", json_text(lane.label),
                                is_digital(lane), columns.x(lane.x), columns.y(lane.y)));
  }
  const std::string range =
      panel.y_range ? fmt::format("[{},{}]", panel.y_range->first, panel.y_range->second) : "[]";
  return fmt::format(R"({{"title":{},"yLabel":{},"least":{},"curves":{},"bands":{},"lanes":{}}})",
                     json_text(panel.title), json_text(panel.y_label), range, joined(curves), joined(bands),
                     joined(lanes));
}

std::string plot_json(const Plot& plot, Columns& columns) {
  std::vector<std::string> marks, zones, panels;
  for (const Mark& mark : plot.marks) {
    marks.push_back(
        fmt::format(R"({{"x":{},"label":{},"strong":{}}})", mark.x, json_text(mark.label), mark.strong));
  }
  for (const Zone& zone : plot.zones)
    zones.push_back(fmt::format(R"({{"from":{},"to":{},"strong":{}}})", zone.from, zone.to, zone.strong));
  const std::string second = plot.second_x
                                 ? fmt::format(R"({{"label":{},"factor":{}}})",
                                               json_text(plot.second_x->label), plot.second_x->factor)
                                 : "null";
  for (const Panel& panel : plot.panels) panels.push_back(panel_json(panel, columns));
  const auto [low, high] = laid_out(plot).x_range;
  const bool points = std::any_of(plot.panels.begin(), plot.panels.end(), [](const Panel& panel) {
    return std::any_of(panel.curves.begin(), panel.curves.end(),
                       [](const Curve& curve) { return curve.style == Curve::Style::points; });
  });
  const double border = points ? 0.015 * (high - low) : 0;  // so that no dot is cut in half
  return fmt::format(
      R"({{"title":{},"xLabel":{},"range":[{},{}],"second":{},"marks":{},"zones":{},"panels":{}}})",
      json_text(plot.title), json_text(plot.x_label), low - border, high + border, second, joined(marks),
      joined(zones), joined(panels));
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
  Columns columns;
  std::vector<std::string> items;
  for (const Plot& plot : plots) items.push_back(can_be_live(plot) ? plot_json(plot, columns) : "null");
  return fmt::format("{{\"plots\":{},\n\"columns\":{}}}", joined(items), columns.json());
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
      "<script>\"use strict\";\n(function () {{{}{}{}}})();</script>\n",
      read_file(style), read_file(library), plot_data(plots), kReportSamples, kReportUnderlay, kReportPlots);
}

}  // namespace drycut::renders
