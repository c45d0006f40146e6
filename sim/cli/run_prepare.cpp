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
#include "sim/loop/guests.hpp"
#include "sim/report/index.hpp"
#include "sim/studies/half_step.hpp"

namespace drycut::sim::cli {

namespace {

/// Claims what the results of `file` are called; a problem if another file has claimed it.
class Claims {
 public:
  void results(const std::string& name, const std::filesystem::path& file, Problems& problems) {
    if (name.empty() || name == "." || name == ".." || name == junit_file || name == report::index_file) {
      problems.push_back({"file.bad-name"_code, file.string(), 1, 1,
                          fmt::format("its results cannot be called '{}'", name),
                          "give the scenario another file name"});
    }
    claim(name, file, "its results would overwrite those of {}",
          "name each once, and no two of one folder alike", problems);
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
    problems.push_back({"file.bad-name"_code, file.string(), 1, 1,
                        fmt::format(fmt::runtime(what), other->second.string()), remedy});
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
    if (options.every) loop::refuse_guests_without_state(job.scenario, "without --states it runs", problems);
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
void prepare_members(studies::ComparisonScene scene, const std::string& name,
                     const std::vector<scenario::Override>& overrides, const RunOptions& options,
                     Claims& claims, Work& work, Problems& problems) {
  auto& group = work.groups.emplace_back();
  bool sound = true;
  for (const auto& member : scene.members) {
    auto job = std::make_unique<Job>();
    const UseFiles use(job->files);
    Problems own;
    job->scenario = studies::read_member(scene, member, overrides, own);
    const auto full_name = name + "/" + member.name.text;
    claims.results(full_name, scene.file, own);
    sound = put_together(*job, full_name, options, claims, own) && sound;
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
  group.result.name = name;
  group.result.scenario = scene.file;
  group.result.directory = options.out / name;
  group.result.title = scene.title;
  group.result.places = report::places_of_checks(scene);
  group.scene = std::move(scene);
}

void prepare_scenario(const std::filesystem::path& file, const std::string& name,
                      const std::vector<scenario::Override>& overrides, const RunOptions& options,
                      Claims& claims, Work& work, Problems& problems) {
  if (!live::is_session(file)) {
    if (auto scene = studies::read_comparison(file, problems)) {
      if (problems.empty())
        prepare_members(std::move(*scene), name, overrides, options, claims, work, problems);
      return;
    }
  }
  auto& job = *work.jobs.emplace_back(std::make_unique<Job>());
  const UseFiles use(job.files);
  if (!live::is_session(file)) {
    const auto read = [&](const auto& set) { return scenario::read_scenario(file, set, problems); };
    job.scenario = read(overrides);
    if (put_together(job, name, options, claims, problems)) go_on(job, options, problems);
    return read_half(job, overrides, options, read, problems);
  }
  if (!options.set.empty())
    problems.push_back({"option.does-not-apply"_code, "--set", 1, 1,
                        fmt::format("{} is a session, which has its own", file.string()),
                        "drycut replay --to-scenario makes a scenario of it"});
  if (auto session = live::read_session(file, {}, job.notes, problems)) {
    job.scenario = std::move(session->scenario);
    job.scenario.scene.duration = std::max(session->reached, job.scenario.scene.step);
  }
  put_together(job, name, options, claims, problems);
}

}  // namespace

std::vector<std::string> result_names(const std::vector<std::filesystem::path>& scenarios) {
  std::vector<std::filesystem::path> whole;
  for (const auto& file : scenarios) whole.push_back(std::filesystem::absolute(file).lexically_normal());
  // With so many of its folders.
  const auto name_of = [&](std::size_t i, std::size_t folders) {
    auto name = whole[i].stem();
    auto folder = whole[i].parent_path();
    for (; folders > 0 && folder.has_relative_path(); --folders, folder = folder.parent_path())
      name = folder.filename() / name;
    return name.string();
  };
  std::vector<std::string> names;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const auto is_alone = [&](std::size_t folders) {
      for (std::size_t k = 0; k < whole.size(); ++k)
        if (whole[k].parent_path() != whole[i].parent_path() && name_of(k, folders) == name_of(i, folders))
          return false;
      return true;
    };
    std::size_t folders = 0;
    while (!is_alone(folders)) ++folders;
    names.push_back(name_of(i, folders));
  }
  return names;
}

Work prepare(const RunOptions& options, Problems& problems) {
  const auto overrides = overrides_of(options.set, problems);
  const auto names = result_names(options.scenarios);
  Work work;
  Claims claims;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& file = options.scenarios[i];
    const auto jobs = work.jobs.size();
    const auto groups = work.groups.size();
    claims.results(names[i], file, problems);
    Problems own;
    prepare_scenario(file, names[i], overrides, options, claims, work, own);
    if (own.empty()) continue;
    work.groups.resize(groups);
    work.jobs.resize(jobs);
    Refused refused;
    refused.result.name = names[i];
    refused.result.scenario = file;
    refused.problems = std::move(own);
    refused.result.ran = false;
    refused.result.outcome.failure = fmt::format(
        "not run: {}{}", to_string(refused.problems.front()),
        refused.problems.size() == 1 ? "" : fmt::format(", and {} more", refused.problems.size() - 1));
    work.refused.push_back(std::move(refused));
  }
  return work;
}

}  // namespace drycut::sim::cli
