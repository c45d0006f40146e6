#include "sim/report/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>

#include "base/output_file.hpp"
#include "renders/gltf.hpp"
#include "sim/cams/judged.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/shutter.hpp"
#include "sim/record/hdf5_file.hpp"
#include "sim/report/coverage.hpp"
#include "sim/report/film.hpp"
#include "sim/report/gallery.hpp"
#include "sim/report/torque.hpp"
#include "sim/scenario/format.hpp"
#include "sim/studies/half_step.hpp"

namespace drycut::sim::report {

namespace {

std::vector<std::string> files_of_run(const std::string& scene_file) {
  auto names = picture_files;
  names.insert(names.end(), {trace_file, events_file, hdf5_file, checks_file, scenario_file, scene_file,
                             coverage_file, record::verdict_file, loop::states_folder});
  return names;
}

record::About about(const scenario::Scenario& scenario) {
  std::string set;
  for (const auto& [path, value] : scenario.overrides) set += fmt::format("{}={}\n", path, value);
  return {{"drycut", DRYCUT_VERSION},
          {"step", scenario::format_time(scenario.scene.step)},
          {"set", set},
          {"scenario", scenario_text(scenario)}};
}

}  // namespace

RunFolder::RunFolder(const std::filesystem::path& folder, Problems& problems)
    : scene_file_((folder / "").lexically_normal().parent_path().filename().string() + ".glb"),
      files_(folder, "run", files_of_run(scene_file_), problems) {}

void RunFolder::begin(bool keeps_states) {
  std::vector<std::string> kept;
  if (keeps_states)
    std::ranges::copy_if(files_.listed(), std::back_inserter(kept),
                         [](const auto& name) { return name.starts_with(loop::states_folder); });
  files_.begin(kept);
  write_checks(outcome_to_come(), files_.add(checks_file));
  record::write_verdict(record::verdict_of(outcome_to_come()), files_);
}

RunLeft RunFolder::run(const scenario::Scenario& scenario, loop::Simulation& simulation,
                       const PartMeshes& meshes, const RunRequest& request, RunResult& result) {
  const bool is_drawn = request.pictures || request.gltf;
  if (request.coverage && simulation.controller() != nullptr) simulation.controller()->count_programs();
  simulation.follow_cams(cams::cam_judgement, request.pictures);
  if (request.pictures) follow_torques(scenario, simulation);
  if (!is_drawn && !request.in_memory && !request.states) simulation.keep_nothing();
  std::filesystem::path hdf5;
  if (scenario.record.format == scenario::RecordSection::Format::csv) {
    simulation.write_to(files_.add(trace_file), files_.add(events_file));
  } else {
    hdf5 = files_.add(hdf5_file);
    simulation.write_to(record::hdf5_writer(simulation.recording(), hdf5, about(scenario)),
                        hdf5.parent_path());
  }

  RunLeft left;
  auto& outcome = result.outcome;
  if (request.from != nullptr) {
    simulation.restore(request.from->state, request.from->journal, request.branches);
    Problems none;  // they were tried
    for (const auto& stimulus : request.then) simulation.act(stimulus, none);
  }
  std::optional<loop::KeptStates> states;
  if (request.states) {
    states.emplace(files_, *request.states, request.most_states, request.from);
    simulation.keep_states(*request.states, !is_drawn, [&] { states->keep(simulation); });
  }
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  const auto duration = static_cast<double>(scenario.scene.duration);
  outcome = simulation.run([&](Time now) {
    request.progress("running", static_cast<double>(now) / duration);
    if (request.is_interrupted())
      simulation.stop(fmt::format("interrupted at {} s; what was recorded until then is kept",
                                  record::seconds_text(now)));
  });
  if (states) left.states_lost = states->finish();
  if (request.strict && !outcome.warnings().empty() && outcome.failure.empty())
    outcome.checks.push_back(no_warnings(outcome));
  left.simulating = std::chrono::duration<double>(Clock::now() - begun).count();
  if (request.half != nullptr && !request.is_interrupted())
    outcome.half_step = studies::run_half_step(std::move(*request.half), [&](Time now) {
      request.progress("at half the step", static_cast<double>(now) / duration);
    });

  write_scenario(scenario, files_.add(scenario_file));
  if (request.coverage) {
    left.coverage = coverage_of(scenario, simulation);
    write_file(files_.add(coverage_file), devices::lcov_text(left.coverage));
  }
  loop::keep_retentive(scenario, simulation.retentive_state());
  if (!hdf5.empty() && outcome.failure.empty()) record::add_outcome(hdf5, outcome);
  if (is_drawn) {
    const auto film =
        simulation.snapshots().empty() ? renders::Film{} : film_of(scenario, simulation, meshes);
    if (request.gltf && !film.frames.empty()) {
      left.scene = files_.add(scene_file_);
      renders::write_gltf(film, left.scene, scenario.pictures.slow);
    }
    if (request.pictures) {
      left.left_out =
          write_pictures(scenario, simulation, film, outcome, files_, request.threads, request.progress);
      result.has_report = true;
    }
  }
  write_checks(outcome, files_.add(checks_file));
  auto verdict = record::verdict_of(outcome);
  if (!outcome.failure.empty() && request.is_interrupted()) verdict.stopped(record::interrupted_status);
  verdict.title = scenario.scene.title;
  verdict.scenarios = {scenario.file.generic_string()};
  record::write_verdict(std::move(verdict), files_);
  return left;
}

}  // namespace drycut::sim::report
