#include "renders/report_map.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/embedded.hpp"
#include "renders/html.hpp"
#include "renders/png_image.hpp"

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
  auto all = nlohmann::ordered_json::array();
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

}  // namespace drycut::renders
