// The cams of a run in its report.
#include <fmt/format.h>

#include <cstddef>

#include "sim/controllers/kinds.hpp"
#include "sim/report/gallery.hpp"

namespace drycut::sim::report {

std::vector<cams::CamPage> cams_of(const scenario::Scenario& scenario, const loop::Simulation& simulation) {
  if (simulation.cams() == nullptr) return {};
  auto played = simulation.cams()->played();
  const auto* plcopen = controllers::controller_of<controllers::PlcopenSection>(scenario);
  if (played.empty() && plcopen != nullptr) {
    Problems problems;
    for (const auto& table : plcopen->tables)
      if (auto text = controllers::read_named_table(table.file, scenario, problems))
        played.push_back({table.file.text, nullptr, {}, std::move(*text)});
  }
  auto pages = cams::cam_pages(played);
  if (const auto untold = simulation.cams()->untold(); untold > 0 && !pages.empty())
    pages.back().notes.push_back(
        fmt::format("{} more starts, with tables that came later, are not shown.", untold));
  return pages;
}

std::vector<renders::ReportSection> cam_sections(const std::vector<cams::CamPage>& cams,
                                                 std::vector<renders::ReportFigure>& plots) {
  std::size_t count = 0;
  for (const auto& cam : cams) count += cam.plots.size();
  auto figure = plots.end() - static_cast<std::ptrdiff_t>(count);
  std::vector<renders::ReportSection> sections;
  for (const auto& cam : cams) {
    auto& section = sections.emplace_back(renders::ReportSection{cam.title, cam.notes, {}, cam.tables});
    const auto end = figure + static_cast<std::ptrdiff_t>(cam.plots.size());
    section.plots.assign(figure, end);
    section.notes.push_back(fmt::format("The table, for drycut cam: cams/{}.csv", cam.name));
    figure = end;
  }
  plots.resize(plots.size() - count);
  return sections;
}

}  // namespace drycut::sim::report
