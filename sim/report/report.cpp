#include "sim/report/report.hpp"

#include <fmt/format.h>

#include <set>

#include "renders/report_data.hpp"
#include "sim/report/results.hpp"

namespace drycut::sim::report {

renders::Report page_of(const record::Verdict& verdict) {
  renders::Report report;
  report.title = verdict.title;
  report.passed = verdict.verdict != record::Verdict::Came::failed;
  report.word = verdict.word;
  report.verdict = verdict.sentence;
  return report;
}

void add_checks(const std::vector<record::CheckResult>& checks, renders::Report& report) {
  for (const auto& check : checks)
    report.checks.push_back({check.name, check.expectation, check.passed, margin_text(check), check.detail,
                             check.used, check.judged_nothing(), check.so_far});
}

void add_overrides(const std::vector<scenario::Override>& overrides, renders::Report& report) {
  for (const auto& [path, value] : overrides)
    report.facts.push_back({{"--set", fmt::format("{} = {}", path, value)}});
}

void add_plots(std::vector<renders::Plot> plots, OutputFolder& folder, renders::Report& report) {
  if (plots.empty()) return;
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (auto& plot : plots) {
    while (!taken.insert(plot.name).second) plot.name += '_';
    names.push_back(plot.name + ".png");
  }
  const auto pictures = renders::draw_plots(plots, folder.add(plots_folder, names));
  for (std::size_t i = 0; i < plots.size(); ++i)
    report.plots.push_back({pictures[i], "", renders::plot_words(plots[i])});
  report.live = std::move(plots);
}

void write_report(renders::Report report, std::vector<renders::Plot> plots, OutputFolder& folder) {
  add_plots(std::move(plots), folder, report);
  renders::write_report(report, folder.add(report_file));
}

void draw_png(renders::Plot plot, const std::filesystem::path& png) {
  plot.name = png.stem().string();
  renders::draw_plots({plot}, png.has_parent_path() ? png.parent_path() : std::filesystem::path("."));
}

}  // namespace drycut::sim::report
