#include "sim/records/run_files.hpp"

#include <fmt/format.h>

#include <memory>

#include "sim/records/hdf5_file.hpp"
#include "sim/report/results.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::records {

namespace {

About about(const scenario::Scenario& scenario) {
  std::string set;
  for (const auto& [path, value] : scenario.overrides) set += fmt::format("{}={}\n", path, value);
  return {{"drycut", DRYCUT_VERSION},
          {"step", scenario::format_time(scenario.scene.step)},
          {"set", set},
          {"scenario", report::scenario_text(scenario)}};
}

}  // namespace

RunFiles::RunFiles(const scenario::Scenario& scenario, loop::Simulation& simulation, OutputFolder& folder) {
  if (scenario.record.format == scenario::RecordSection::Format::csv) {
    simulation.write_to(folder.add(report::trace_file), folder.add(report::events_file));
    return;
  }
  hdf5_ = folder.add(report::hdf5_file);
  simulation.write_to(std::make_unique<Hdf5File>(simulation.recording(), hdf5_, about(scenario)),
                      hdf5_.parent_path());
}

void RunFiles::finish(const loop::Outcome& outcome) const {
  if (!hdf5_.empty() && outcome.failure.empty()) add_checks(hdf5_, outcome.checks);
}

}  // namespace drycut::sim::records
