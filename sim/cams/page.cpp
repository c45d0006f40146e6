#include "sim/cams/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>

#include "base/shown_units.hpp"
#include "base/text.hpp"
#include "sim/cams/judged.hpp"
#include "sim/cams/overlay.hpp"

namespace drycut::sim::cams {

namespace {

/// "Y0 (DECAM D1000)" is "Y0_DECAM_D1000".
std::string file_name(const std::string& axis) {
  std::string name;
  for (const char c : axis) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "cam" : name;
}

renders::ReportRow row_of(const CamPeak& peak, const std::string& master_unit) {
  renders::ReportRow row{{peak.name,
                          fmt::format("{} {} at master {} {}", number(peak.value), peak.quantity.unit,
                                      number(peak.master), master_unit),
                          "", ""}};
  const auto& limits = peak.quantity.limits;
  if (limits.empty()) return row;
  const auto tightest = std::min_element(limits.begin(), limits.end(),
                                         [](const auto& a, const auto& b) { return a.value < b.value; });
  const double share = std::abs(peak.value) / tightest->value;
  row.cells[2] = fmt::format("{} {} {}", tightest->name, number(tightest->value), peak.quantity.unit);
  row.cells[3] = share <= within ? fmt::format("PASS {:.1f} % left", 100 * std::max(0.0, 1 - share))
                                 : fmt::format("FAIL {:.1f} % too much", 100 * (share - 1));
  return row;
}

renders::ReportTable feasibility(const CamStudy& study, const std::string& master_unit) {
  renders::ReportTable table{"Feasibility", {"what", "found", "limit or remedy", "verdict"}, {}, false, true};
  for (const auto& peak : study.peaks) table.rows.push_back(row_of(peak, master_unit));
  for (const auto& finding : study.findings) {
    const bool bad = is_unsound({finding}, false);
    const auto grade = grade_text(finding);
    table.rows.push_back({{finding.where.empty() ? "the cam" : finding.where, finding.text,
                           finding.remedy.text, bad ? "FAIL " + grade : grade}});
  }
  const bool unsound = is_unsound(study.findings, false);
  table.rows.push_back(
      {{"verdict", unsound ? "the cam is not sound" : "the cam is sound", "", unsound ? "FAIL" : "PASS"}});
  return table;
}

/// Columns of text as a table, in units that people read: names with their units, then the lines.
renders::ReportTable table_of(const std::string& title, const Columns& columns) {
  renders::ReportTable table{title, {}, {}, true};
  std::vector<double> factors;
  for (const auto& [name, unit, words] : columns.headings()) {
    const auto shown = shown_unit(unit);
    factors.push_back(shown.factor);
    table.headings.push_back(unit.empty() ? name : fmt::format("{} [{}]", name, shown.unit));
  }
  for (const auto& cells : columns.lines()) {
    auto& row = table.rows.emplace_back(renders::ReportRow{cells});
    for (std::size_t i = 0; i < row.cells.size() && i < factors.size(); ++i)
      if (factors[i] != 1 && !row.cells[i].empty())
        row.cells[i] = number_text(factors[i] * std::strtod(row.cells[i].c_str(), nullptr));
  }
  return table;
}

renders::ReportTable played_table(const IdealCam& ideal, const CamErrors& errors,
                                  const std::vector<PlayedCycle>& cycles) {
  renders::ReportTable table{
      "Cam tracking error", {"difference", "largest", "root mean square", "over"}, {}, false};
  const auto whole =
      std::count_if(cycles.begin(), cycles.end(), [](const auto& cycle) { return cycle.whole; });
  const auto add = [&](const std::string& name, const std::vector<double>& of) {
    const auto figures = figures_of(of);
    if (figures.count == 0) return;
    table.rows.push_back(
        {{name, fmt::format("{} {}", error_text(figures.largest, ideal.error_step), ideal.error_unit),
          fmt::format("{} {}", error_text(figures.rms, ideal.error_step), ideal.error_unit),
          fmt::format("{}, {}", counted(figures.count, "sample"), counted(whole, "whole cycle"))}});
  };
  add("set minus ideal position", errors.set);
  add("set minus measured position (following error)", errors.behind);
  return table;
}

/// One page, made step by step.
class PageMaker {
 public:
  PageMaker(const loop::PlayedCam& played, std::string title, const std::string& name)
      : played_(played), cam_(judged(played, name)) {
    page_.title = std::move(title);
    page_.name = name;
    page_.table = cam_.text;
  }

  CamPage make() {
    if (played_.samples.empty())
      page_.notes.emplace_back("No slave was on this cam in the run: only the cam is shown.");
    if (played_.left_out > 0)
      page_.notes.push_back(
          fmt::format("Shown and measured over the last {} samples, from {:.1f} s on; {} "
                      "before them are left out.",
                      played_.samples.size(), seconds(played_.samples.front().time), played_.left_out));
    draw_cam();
    if (!cam_.ideal.silence.empty())
      page_.notes.push_back(
          fmt::format("The ideal ends where the table alone does not say it: {}.", cam_.ideal.silence));
    draw_run();
    return std::move(page_);
  }

 private:
  void draw_cam() {
    if (!cam_.problems.empty()) {
      page_.notes.push_back(
          fmt::format("drycut cam does not take this table: {}", to_string(cam_.problems.front())));
      return;
    }
    auto& study = cam_.study;
    for (const auto line : split_lines(study.text.heading)) page_.notes.emplace_back(line);
    if (cam_.master_speed > 0)
      page_.notes.emplace_back("Judged at the fastest that the master was while the cam was played.");
    if (!study.plot.panels.empty()) page_.plots.push_back(std::move(study.plot));
    page_.tables.push_back(feasibility(study, cam_.ideal.master_unit));
    for (const auto& [name, columns] : study.text.tables) page_.tables.push_back(table_of(name, columns));
  }

  void draw_run() {
    const auto errors = errors_of(played_, cam_.ideal);
    const auto cycles = cycles_of(played_, cam_.ideal);
    const auto* shown = shown_cycle(cycles);
    if (shown == nullptr || shown->first == shown->last) return;
    page_.plots.push_back(
        overlay_plot(played_, cam_.ideal, errors, cycles, *shown, "cam_" + page_.name + "_played"));
    page_.tables.insert(page_.tables.begin(), played_table(cam_.ideal, errors, cycles));
  }

  const loop::PlayedCam& played_;
  JudgedCam cam_;
  CamPage page_;
};

}  // namespace

std::vector<CamPage> cam_pages(const std::vector<loop::PlayedCam>& played) {
  std::map<std::string, int> all;
  for (const auto& cam : played) ++all[cam.axis];
  std::map<std::string, int> told;
  std::vector<CamPage> pages;
  for (const auto& cam : played) {
    const int number = ++told[cam.axis];
    const bool alone = all[cam.axis] == 1;
    const auto title = alone ? fmt::format("Cam of {}", cam.axis)
                             : fmt::format("Cam of {}, table {} of {}", cam.axis, number, all[cam.axis]);
    const auto name = file_name(cam.axis) + (alone ? "" : fmt::format("_{}", number));
    pages.push_back(PageMaker(cam, title, name).make());
  }
  return pages;
}

}  // namespace drycut::sim::cams
