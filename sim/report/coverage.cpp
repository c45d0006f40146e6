#include "sim/report/coverage.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "sim/report/results.hpp"

namespace drycut::sim::report {

namespace {

devices::Coverage counted(const loop::Simulation& simulation) {
  devices::Coverage coverage;
  if (simulation.controller() != nullptr) simulation.controller()->add_coverage(coverage);
  return coverage;
}

/// Rounded down, so that 100 % is all of them.
std::string percent(std::size_t part, std::size_t all) {
  return all == 0 ? "" : fmt::format("{} %", 100 * part / all);
}

}  // namespace

devices::Coverage coverage_of(const scenario::Scenario& scenario, const loop::Simulation& simulation) {
  devices::Coverage seen;
  for (auto& [name, file] : counted(simulation).files)
    seen.files[path_from_here(scenario.file.parent_path() / name)] = std::move(file);
  return seen;
}

renders::ReportTable coverage_table(const loop::Simulation& simulation) {
  renders::ReportTable table{
      "Coverage of the programs", {"file", "lines run", "of", "", "branches", "of", "", "never run"}, {}};
  for (const auto& [name, file] : counted(simulation).files) {
    const auto figures = devices::figures_of(file);
    table.rows.push_back(
        {{name, std::to_string(figures.lines_run), std::to_string(figures.lines),
          percent(figures.lines_run, figures.lines), std::to_string(figures.ways_taken),
          std::to_string(figures.ways), percent(figures.ways_taken, figures.ways), figures.never}});
  }
  return table;
}

std::string coverage_text(const devices::Coverage& coverage) {
  devices::CoverageFigures all;
  for (const auto& [name, file] : coverage.files) {
    const auto figures = devices::figures_of(file);
    all.lines += figures.lines;
    all.lines_run += figures.lines_run;
    all.ways += figures.ways;
    all.ways_taken += figures.ways_taken;
  }
  return fmt::format("{} of {} lines ran ({}), {} of {} branches", all.lines_run, all.lines,
                     percent(all.lines_run, all.lines), all.ways_taken, all.ways);
}

}  // namespace drycut::sim::report
