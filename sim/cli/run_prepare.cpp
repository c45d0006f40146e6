// What drycut run is given, read and put together.
#include <fmt/format.h>

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>

#include "sim/cli/arguments.hpp"
#include "sim/cli/run_work.hpp"
#include "sim/file.hpp"
#include "sim/live/session.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/studies/half_step.hpp"

namespace drycut::sim::cli {

namespace {

/// Claims what the results of `file` are called; a problem if another file has claimed it.
class Claims {
 public:
  void results(const std::string& name, const std::filesystem::path& file, Problems& problems) {
    if (name.empty() || name == "." || name == ".." || name == junit_file) {
      problems.push_back({file.string(), 1, 1, fmt::format("its results cannot be called '{}'", name),
                          "give the scenario another file name"});
    }
    claim(name, file, "its results would overwrite those of {}",
          "give the scenarios different file names or run them apart", problems);
  }
  void retentive(const std::filesystem::path& kept, const std::filesystem::path& file, Problems& problems) {
    claim("retentive " + kept.lexically_normal().string(), file,
          "it keeps its retentive values in the file of {}",
          "give each scenario a retentive file of its own or run them apart", problems);
  }

 private:
  void claim(const std::string& name, const std::filesystem::path& file, const char* what, const char* remedy,
             Problems& problems) {
    const auto [other, fresh] = names_.emplace(name, file);
    if (fresh) return;
    problems.push_back(
        {file.string(), 1, 1, fmt::format(fmt::runtime(what), other->second.string()), remedy});
  }
  std::map<std::string, std::filesystem::path> names_;
};

/// Takes a scenario that was read; false if it has problems.
bool put_together(Job& job, const std::string& name, const RunOptions& options, Claims& claims,
                  Problems& problems) {
  if (options.seed) job.scenario.scene.seed = *options.seed;
  if (const auto kept = loop::retentive_file(job.scenario); kept && job.scenario.controller->retains)
    claims.retentive(*kept, job.scenario.file, problems);
  if (options.gltf) job.scenario.pictures.frames = true;
  if (job.scenario.buildable) {
    job.simulation = std::make_unique<loop::Simulation>(job.scenario, problems);
    job.meshes = report::load_part_meshes(job.scenario, job.simulation->plants(), problems);
  } else if (problems.empty()) {
    throw std::logic_error("a scenario that cannot be built has no problem");
  }
  job.result.name = name;
  job.result.scenario = job.scenario.file;
  job.result.directory = options.out / name;
  job.result.title = job.scenario.scene.title;
  job.result.seed = job.scenario.scene.seed;
  job.result.places = report::places_of_checks(job.scenario);
  return problems.empty();
}

/// Reads a sound scenario once more, at half its step.
void read_half(Job& job, std::vector<scenario::Override> overrides, const RunOptions& options,
               const std::function<scenario::Scenario(const std::vector<scenario::Override>&)>& read,
               Problems& problems) {
  if (!options.verify_step || !problems.empty()) return;
  const auto half = studies::halved_step(job.scenario, problems);
  if (!half) return;
  overrides.push_back(*half);
  job.half = read(overrides);
  job.half->scene.seed = job.scenario.scene.seed;
}

/// The members of a comparing scene as jobs, in a folder of its own each inside the scene's.
void prepare_members(studies::ComparisonScene scene, const std::vector<scenario::Override>& overrides,
                     const RunOptions& options, Claims& claims, Work& work, Problems& problems) {
  auto& group = work.groups.emplace_back();
  const auto stem = scene.file.stem().string();
  bool sound = true;
  for (const auto& member : scene.members) {
    auto job = std::make_unique<Job>();
    const UseFiles use(job->files);
    Problems own;
    job->scenario = studies::read_member(scene, member, overrides, own);
    sound = put_together(*job, stem + "/" + member.name.text, options, claims, own) && sound;
    read_half(
        *job, overrides, options,
        [&](const auto& set) { return studies::read_member(scene, member, set, own); }, own);
    studies::place_in_scene(scene, member, own);
    problems.insert(problems.end(), own.begin(), own.end());
    group.members.push_back(job.get());
    if (sound) group.names.push_back(studies::names_of(*job->simulation));
    work.jobs.push_back(std::move(job));
  }
  if (sound) studies::check_comparison(scene, group.names, problems);
  group.result.name = stem;
  group.result.scenario = scene.file;
  group.result.directory = options.out / stem;
  group.result.title = scene.title;
  group.result.places = report::places_of_checks(scene);
  group.scene = std::move(scene);
}

}  // namespace

Work prepare(const RunOptions& options, Problems& problems) {
  const auto overrides = overrides_of(options.set, problems);
  Work work;
  Claims claims;
  for (const auto& file : options.scenarios) {
    claims.results(file.stem().string(), file, problems);
    Problems own;
    if (live::is_session(file)) {
      auto job = std::make_unique<Job>();
      const UseFiles use(job->files);
      if (!options.set.empty())
        own.push_back({"--set", 1, 1, fmt::format("{} is a session, which has its own", file.string()),
                       "drycut replay --to-scenario makes a scenario of it"});
      if (auto session = live::read_session(file, {}, job->notes, own)) {
        job->scenario = std::move(session->scenario);
        job->scenario.scene.duration = std::max(session->reached, job->scenario.scene.step);
      }
      put_together(*job, file.stem().string(), options, claims, own);
      work.jobs.push_back(std::move(job));
    } else if (auto scene = studies::read_comparison(file, own)) {
      if (own.empty()) prepare_members(std::move(*scene), overrides, options, claims, work, own);
    } else {
      auto job = std::make_unique<Job>();
      const UseFiles use(job->files);
      job->scenario = scenario::read_scenario(file, overrides, own);
      put_together(*job, file.stem().string(), options, claims, own);
      read_half(
          *job, overrides, options, [&](const auto& set) { return scenario::read_scenario(file, set, own); },
          own);
      work.jobs.push_back(std::move(job));
    }
    problems.insert(problems.end(), own.begin(), own.end());
  }
  return work;
}

}  // namespace drycut::sim::cli
