#include "sim/cli/run_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>

#include "base/plain_text.hpp"
#include "renders/gltf.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/progress.hpp"
#include "sim/cli/run_work.hpp"
#include "sim/file.hpp"
#include "sim/interrupt.hpp"
#include "sim/live/session.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/parallel.hpp"
#include "sim/records/run_files.hpp"
#include "sim/report/film.hpp"
#include "sim/report/gallery.hpp"
#include "sim/report/index.hpp"
#include "sim/report/results.hpp"
#include "sim/studies/compare/scene_run.hpp"
#include "sim/studies/half_step.hpp"

namespace drycut::sim::cli {

namespace {

constexpr auto* junit_file = "junit.xml";

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
  group.scene = std::move(scene);
}

/// Reads and puts together all scenarios; problems of all of them are told before anything runs.
Work prepare(const RunOptions& options, Problems& problems) {
  const auto overrides = overrides_of(options.set, problems);
  Work work;
  Claims claims;
  for (const auto& file : options.scenarios) {
    claims.results(file.stem().string(), file, problems);
    Problems own;
    if (live::is_session(file)) {
      auto job = std::make_unique<Job>();
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

std::string scene_file_of(const Job& job) { return job.result.directory.filename().string() + ".glb"; }

/// Takes the folders of all results; what lies in them and is not ours is told before anything runs.
void open_folders(Work& work, const RunOptions& options, Problems& problems) {
  work.folder.emplace(options.out, "runs", std::vector<std::string>{junit_file, report::index_file},
                      problems);
  for (auto& group : work.groups)
    group.folder.emplace(group.result.directory, "compare", studies::comparison_files, problems);
  for (auto& job : work.jobs) {
    auto names = report::picture_files;
    for (const auto* name : {report::trace_file, report::events_file, report::hdf5_file, report::checks_file,
                             report::scenario_file})
      names.emplace_back(name);
    names.push_back(scene_file_of(*job));
    job->folder.emplace(job->result.directory, "run", names, problems);
  }
}

/// Old results go before new ones are made: what is killed half-way must not leave an old verdict.
void begin(Work& work) {
  work.folder->begin();
  for (auto& group : work.groups) group.folder->begin();
  for (auto& job : work.jobs) {
    job->folder->begin();
    report::write_checks(report::outcome_to_come(), job->folder->add(report::checks_file));
  }
}

void run_job(Job& job, const RunOptions& options, int threads,
             const std::function<void(const char*, double)>& progress) {
  auto& folder = *job.folder;
  using Clock = std::chrono::steady_clock;
  const auto since = [begun = Clock::now()] {
    return std::chrono::duration<double>(Clock::now() - begun).count();
  };
  const auto duration = static_cast<double>(job.scenario.scene.duration);
  if (options.pictures) job.simulation->follow_cams();
  if (!options.pictures && !options.gltf) job.simulation->keep_nothing();
  records::RunFiles files(job.scenario, *job.simulation, folder);
  job.result.outcome = job.simulation->run([&](Time now) {
    progress("running", static_cast<double>(now) / duration);
    if (InterruptWatch::come() != 0)
      job.simulation->stop(
          fmt::format("interrupted at {} s; what was recorded until then is kept", loop::seconds_text(now)));
  });
  job.simulating = since();
  if (job.half && InterruptWatch::come() == 0)
    job.result.outcome.half_step = studies::run_half_step(std::move(*job.half), [&](Time now) {
      progress("at half the step", static_cast<double>(now) / duration);
    });
  report::write_scenario(job.scenario, folder.add(report::scenario_file));
  loop::keep_retentive(job.scenario, job.simulation->retentive_state());
  files.finish(job.result.outcome);
  const auto finished = [&] {
    report::write_checks(job.result.outcome, folder.add(report::checks_file));
    job.took = since();
  };
  if (!options.pictures && !options.gltf) return finished();
  const auto film = job.simulation->snapshots().empty()
                        ? renders::Film{}
                        : report::film_of(job.scenario, *job.simulation, job.meshes);
  if (options.gltf && !film.frames.empty()) {
    job.scene = folder.add(scene_file_of(job));
    renders::write_gltf(film, job.scene, job.scenario.pictures.slow);
  }
  if (!options.pictures) return finished();
  job.left_out = report::write_pictures(job.scenario, *job.simulation, film, job.result.outcome, folder,
                                        threads, progress);
  job.result.has_report = true;
  finished();
}

void run_all(std::vector<std::unique_ptr<Job>>& jobs, const RunOptions& options) {
  // Cores that no scenario runs on help to draw; the pictures are the same whoever draws them.
  const auto running = std::min<std::size_t>(static_cast<std::size_t>(options.jobs), jobs.size());
  const auto drawing_threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency() / running));
  Progress bar(options.say != Say::failures);
  for_each_index(jobs.size(), static_cast<int>(running), [&](std::size_t i) {
    auto& job = *jobs[i];
    const auto show = [&](const char* doing, double done) {
      bar.show(fmt::format("{} {} ({} of {})", doing, job.result.name, i + 1, jobs.size()), done);
    };
    if (InterruptWatch::come() != 0) {
      job.trouble = "not run: interrupted before";
      return;
    }
    try {
      run_job(job, options, drawing_threads, show);
    } catch (const std::exception& error) {
      job.trouble = error.what();
    }
  });
}

/// Compares the members of a scene from the files that they left.
void run_group(Group& group, bool pictures) {
  Problems problems;
  std::vector<studies::RunFolder> runs;
  for (std::size_t i = 0; i < group.members.size(); ++i) {
    runs.push_back(studies::read_run(group.members[i]->result.directory, problems));
    runs.back().label = group.scene.members[i].name.text;
    if (!problems.empty()) throw std::runtime_error(to_string(problems.front()));
    group.result.outcome.end = std::max(group.result.outcome.end, group.members[i]->result.outcome.end);
  }
  auto compared = studies::compare_members(group.scene, group.names, std::move(runs));
  group.result.outcome.checks = compared.page.checks;
  studies::write_comparison(compared.comparison, compared.page, *group.folder, pictures);
  group.result.has_report = pictures;
}

void run_groups(std::vector<Group>& groups, bool pictures) {
  for (auto& group : groups) {
    try {
      if (InterruptWatch::come() != 0) throw std::runtime_error("interrupted before");
      run_group(group, pictures);
    } catch (const std::exception& error) {
      group.trouble = fmt::format("not compared: {}", error.what());
    }
  }
}

int status_of(const Work& work) {
  int status = all_passed;
  const auto take = [&](const std::string& trouble, const loop::Outcome& outcome) {
    if (!trouble.empty() || !outcome.failure.empty()) {
      status = simulation_failed;
    } else if (!outcome.passed() && status == all_passed) {
      status = check_failed;
    }
  };
  for (const auto& job : work.jobs) take(job->trouble, job->result.outcome);
  for (const auto& group : work.groups) take(group.trouble, group.result.outcome);
  return status;
}

}  // namespace

void print_problems(const Problems& problems) {
  for (const auto& problem : problems) fmt::print(stderr, "{}\n", printable(to_string(problem)));
}

int run_scenarios(const RunOptions& options) {
  Problems problems;
  auto work = prepare(options, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  open_folders(work, options, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  begin(work);
  const InterruptWatch watch;
  run_all(work.jobs, options);
  run_groups(work.groups, options.pictures);
  std::vector<report::RunResult> results;
  const auto keep = [&](const report::RunResult& result, const std::string& trouble) {
    results.push_back(result);
    if (!trouble.empty()) results.back().outcome.failure = trouble;
  };
  for (const auto& job : work.jobs) {
    print_result(*job, options.say);
    keep(job->result, job->trouble);
  }
  for (const auto& group : work.groups) {
    print_group(group, options.say);
    keep(group.result, group.trouble);
  }
  try {
    report::write_junit(results, work.folder->add(junit_file));
    report::write_index(options.out, *work.folder);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return simulation_failed;
  }
  return InterruptWatch::come() == 0 ? status_of(work) : interrupted_status;
}

void add_run(CLI::App& app, int& status) {
  const auto chosen = std::make_shared<RunOptions>();
  auto& options = *chosen;
  auto* run =
      app.add_subcommand("run", "Run scenarios: traces, events, checks, pictures and a report for each");
  run->add_option("scenarios", options.scenarios, "Scenario files (.yaml)")->required();
  add_out(*run, options.out, "Directory for the results");
  run->add_option("--jobs", options.jobs, "Scenarios run at the same time")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  run->add_option("--seed", options.seed, "Seed of every random source, in place of the scenarios'");
  add_no_pictures(*run, options.pictures, "No frames, plots or report");
  run->add_flag("--gltf", options.gltf, "The run as an animated glTF file (.glb) for any 3D viewer");
  run->add_flag("--verify-step", options.verify_step,
                "Run again at half scene.step and tell how far every check's margin moved");
  add_set(*run, options.set, "scenarios");
  auto* quiet = run->add_flag_callback(
      "-q,--quiet", [&options] { options.say = Say::failures; }, "Tell only what failed");
  run->add_flag_callback(
         "-v,--verbose", [&options] { options.say = Say::more; }, "Tell how long it took, too")
      ->excludes(quiet);
  run->callback([chosen, &status] { status = run_scenarios(*chosen); });
}

}  // namespace drycut::sim::cli
