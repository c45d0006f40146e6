#include <fmt/format.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>

#include "renders/gltf.hpp"
#include "sim/commands/arguments.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/progress.hpp"
#include "sim/compare/scene_run.hpp"
#include "sim/controller_loader.hpp"
#include "sim/file.hpp"
#include "sim/gallery.hpp"
#include "sim/results.hpp"
#include "sim/simulation.hpp"

namespace drycut::sim {

namespace {

/// One scenario on its way from file to report.
struct Job {
  Scenario scenario;
  std::unique_ptr<Simulation> simulation;
  PartMeshes meshes;
  RunResult result;
  std::string trouble;          ///< a result could not be written
  std::filesystem::path scene;  ///< the glTF file, "" = none
};

/// A scene that compares some of the jobs.
struct Group {
  ComparisonScene scene;
  std::vector<Job*> members;
  std::vector<MemberNames> names;
  RunResult result;
  std::string trouble;
};

/// What is to be run: scenarios, and those of scenes that compare.
struct Work {
  std::vector<std::unique_ptr<Job>> jobs;
  std::vector<Group> groups;
};

/// Claims what the results of `file` are called; a problem if another file has claimed it.
class Claims {
 public:
  void results(const std::string& name, const std::filesystem::path& file, devices::Problems& problems) {
    claim(name, file, "its results would overwrite those of {}",
          "give the scenarios different file names or run them apart", problems);
  }
  void retentive(const std::filesystem::path& kept, const std::filesystem::path& file,
                 devices::Problems& problems) {
    claim("retentive " + kept.lexically_normal().string(), file,
          "it keeps its retentive values in the file of {}",
          "give each scenario a retentive file of its own or run them apart", problems);
  }

 private:
  void claim(const std::string& name, const std::filesystem::path& file, const char* what, const char* remedy,
             devices::Problems& problems) {
    const auto [other, fresh] = names_.emplace(name, file);
    if (fresh) return;
    problems.push_back(
        {file.string(), 1, 1, fmt::format(fmt::runtime(what), other->second.string()), remedy});
  }
  std::map<std::string, std::filesystem::path> names_;
};

/// Takes a scenario that was read; false if it has problems.
bool put_together(Job& job, const std::string& name, const RunOptions& options, Claims& claims,
                  devices::Problems& problems) {
  if (options.seed) job.scenario.scene.seed = *options.seed;
  if (const auto kept = retentive_file(job.scenario)) claims.retentive(*kept, job.scenario.file, problems);
  if (options.gltf) job.scenario.pictures.frames = true;
  if (job.scenario.buildable) {
    job.simulation = std::make_unique<Simulation>(job.scenario, problems);
    job.meshes = load_part_meshes(job.scenario, job.simulation->plants(), problems);
  } else if (problems.empty()) {
    throw std::logic_error("a scenario that cannot be built has no problem");
  }
  job.result.name = name;
  job.result.scenario = job.scenario.file;
  job.result.directory = options.out / name;
  return problems.empty();
}

/// The members of a comparing scene as jobs, in a folder of its own each inside the scene's.
void prepare_members(ComparisonScene scene, const std::vector<Override>& overrides, const RunOptions& options,
                     Claims& claims, Work& work, devices::Problems& problems) {
  auto& group = work.groups.emplace_back();
  const auto stem = scene.file.stem().string();
  bool sound = true;
  for (const auto& member : scene.members) {
    auto job = std::make_unique<Job>();
    devices::Problems own;
    job->scenario = read_member(scene, member, overrides, own);
    sound = put_together(*job, stem + "/" + member.name.text, options, claims, own) && sound;
    place_in_scene(scene, member, own);
    problems.insert(problems.end(), own.begin(), own.end());
    group.members.push_back(job.get());
    if (sound) group.names.push_back(names_of(*job->simulation));
    work.jobs.push_back(std::move(job));
  }
  if (sound) check_comparison(scene, group.names, problems);
  group.result.name = stem;
  group.result.scenario = scene.file;
  group.result.directory = options.out / stem;
  group.scene = std::move(scene);
}

/// Reads and puts together all scenarios; problems of all of them are told before anything runs.
Work prepare(const RunOptions& options, devices::Problems& problems) {
  const auto overrides = overrides_of(options.set, problems);
  Work work;
  Claims claims;
  for (const auto& file : options.scenarios) {
    claims.results(file.stem().string(), file, problems);
    devices::Problems own;
    if (auto scene = read_comparison(file, own)) {
      if (own.empty()) prepare_members(std::move(*scene), overrides, options, claims, work, own);
    } else {
      auto job = std::make_unique<Job>();
      job->scenario = read_scenario(file, overrides, own);
      put_together(*job, file.stem().string(), options, claims, own);
      work.jobs.push_back(std::move(job));
    }
    problems.insert(problems.end(), own.begin(), own.end());
  }
  return work;
}

void run_job(Job& job, const RunOptions& options, int threads,
             const std::function<void(const char*, double)>& progress) {
  const auto& directory = job.result.directory;
  const auto duration = static_cast<double>(job.scenario.scene.duration);
  if (options.pictures) job.simulation->follow_cams();
  job.result.outcome =
      job.simulation->run([&](Time now) { progress("running", static_cast<double>(now) / duration); });
  // What an earlier run left here must not be taken for this one's.
  remove_pictures(directory);
  const auto scene_file = directory / (directory.filename().string() + ".glb");
  std::filesystem::remove(scene_file);
  std::filesystem::create_directories(directory);
  write_trace(job.simulation->recording(), directory / "trace.csv");
  write_events(job.simulation->recording(), directory / "events.csv");
  write_checks(job.result.outcome, directory / "checks.json");
  write_scenario(job.scenario, directory / "scenario.yaml");
  if (const auto kept = retentive_file(job.scenario)) {
    OutputFile out(*kept);
    out.write(job.simulation->retentive_state());
    out.finish();
  }
  if (!options.pictures && !options.gltf) return;
  const auto film = job.simulation->snapshots().empty() ? renders::Film{}
                                                        : film_of(job.scenario, *job.simulation, job.meshes);
  if (options.gltf && !film.frames.empty()) {
    renders::write_gltf(film, scene_file, job.scenario.pictures.slow);
    job.scene = scene_file;
  }
  if (!options.pictures) return;
  write_pictures(job.scenario, *job.simulation, film, job.result.outcome, directory, threads, progress);
  job.result.has_report = true;
}

void run_all(std::vector<std::unique_ptr<Job>>& jobs, const RunOptions& options) {
  // Cores that no scenario runs on help to draw; the pictures are the same whoever draws them.
  const auto running = std::min<std::size_t>(static_cast<std::size_t>(options.jobs), jobs.size());
  const auto drawing_threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency() / running));
  Progress bar;
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (auto i = next++; i < jobs.size(); i = next++) {
      auto& job = *jobs[i];
      const auto show = [&](const char* doing, double done) {
        bar.show(fmt::format("{} {} ({} of {})", doing, job.result.name, i + 1, jobs.size()), done);
      };
      try {
        run_job(job, options, drawing_threads, show);
      } catch (const std::exception& error) {
        job.trouble = error.what();
      }
    }
  };
  std::vector<std::jthread> threads;
  for (std::size_t i = 1; i < running; ++i) threads.emplace_back(work);
  work();
}

/// Compares the members of a scene from the files that they left.
void run_group(Group& group, bool pictures) {
  devices::Problems problems;
  std::vector<RunFolder> runs;
  for (std::size_t i = 0; i < group.members.size(); ++i) {
    runs.push_back(read_run(group.members[i]->result.directory, problems));
    runs.back().label = group.scene.members[i].name.text;
    if (!problems.empty()) throw std::runtime_error(to_string(problems.front()));
    group.result.outcome.end = std::max(group.result.outcome.end, group.members[i]->result.outcome.end);
  }
  auto compared = compare_members(group.scene, group.names, std::move(runs));
  group.result.outcome.checks = compared.page.checks;
  write_comparison(compared.comparison, compared.page, group.result.directory, pictures);
  group.result.has_report = pictures;
}

void run_groups(std::vector<Group>& groups, bool pictures) {
  for (auto& group : groups) {
    try {
      run_group(group, pictures);
    } catch (const std::exception& error) {
      group.trouble = fmt::format("not compared: {}", error.what());
    }
  }
}

void print_checks(const std::vector<CheckResult>& checks) {
  for (const auto& check : checks) {
    const auto margin = margin_text(check);
    fmt::print("  {} {}: {}{}{}\n", check.passed ? "ok  " : "FAIL", check.name, check.detail,
               margin.empty() ? "" : "; ", margin);
  }
}

void print_place(const RunResult& result) {
  fmt::print("  {}: {}\n", result.has_report ? "report" : "results",
             (result.has_report ? result.directory / "report.html" : result.directory).string());
}

void print_group(const Group& group) {
  const auto& outcome = group.result.outcome;
  fmt::print("{}: {}\n", group.result.name,
             !group.trouble.empty() ? group.trouble
             : outcome.checks.empty()
                 ? fmt::format("compared {} runs", group.members.size())
                 : fmt::format("{}, {}", outcome.passed() ? "passed" : "FAILED", verdict_text(outcome)));
  print_checks(outcome.checks);
  if (group.trouble.empty()) print_place(group.result);
}

void print_result(const Job& job) {
  const auto& result = job.result;
  const auto word = !job.trouble.empty() || !result.outcome.failure.empty() ? "STOPPED"
                    : result.outcome.passed()                               ? "passed"
                                                                            : "FAILED";
  fmt::print("{}: {}, {} ({} s simulated)\n", result.name, word, verdict_text(result.outcome),
             seconds_text(result.outcome.end));
  print_checks(result.outcome.checks);
  for (const auto& note : job.simulation->notes()) fmt::print("  note {}\n", note);
  if (!job.trouble.empty()) fmt::print("  {}\n", job.trouble);
  if (!job.scene.empty()) fmt::print("  3D scene: {}\n", job.scene.string());
  print_place(result);
}

int status_of(const Work& work) {
  int status = all_passed;
  const auto take = [&](const std::string& trouble, const Outcome& outcome) {
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

void print_problems(const devices::Problems& problems) {
  for (const auto& problem : problems) fmt::print(stderr, "{}\n", to_string(problem));
}

int run_scenarios(const RunOptions& options) {
  devices::Problems problems;
  auto work = prepare(options, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  for (const auto& job : work.jobs) make_folder(job->result.directory, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  run_all(work.jobs, options);
  run_groups(work.groups, options.pictures);
  std::vector<RunResult> results;
  const auto keep = [&](const RunResult& result, const std::string& trouble) {
    results.push_back(result);
    if (!trouble.empty()) results.back().outcome.failure = trouble;
  };
  for (const auto& job : work.jobs) {
    print_result(*job);
    keep(job->result, job->trouble);
  }
  for (const auto& group : work.groups) {
    print_group(group);
    keep(group.result, group.trouble);
  }
  try {
    std::filesystem::create_directories(options.out);
    write_junit(results, options.out / "junit.xml");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return simulation_failed;
  }
  return status_of(work);
}

}  // namespace drycut::sim
