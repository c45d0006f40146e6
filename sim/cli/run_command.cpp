#include "sim/cli/run_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/plain_text.hpp"
#include "sim/cli/annotations.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/progress.hpp"
#include "sim/cli/run_cache.hpp"
#include "sim/cli/run_work.hpp"
#include "sim/cli/summary.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/interrupt.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/parallel.hpp"
#include "sim/report/coverage.hpp"
#include "sim/report/index.hpp"
#include "sim/report/results.hpp"
#include "sim/studies/compare/scene_run.hpp"

namespace drycut::sim::cli {

namespace {

/// Takes the folders of all results; what lies in them and is not ours is told before anything runs.
void open_folders(Work& work, const RunOptions& options, Problems& problems) {
  work.folder.emplace(options.out, "runs",
                      std::vector<std::string>{junit_file, report::index_file, report::coverage_file},
                      problems);
  std::set<std::filesystem::path> between;
  const auto add = [&](const std::filesystem::path& name) {
    for (auto above = name.parent_path(); !above.empty(); above = above.parent_path()) between.insert(above);
  };
  for (const auto& job : work.jobs) add(job->result.name);
  for (const auto& group : work.groups) add(group.result.name);
  for (const auto& group : work.groups) between.erase(group.result.name);
  for (const auto& name : between)
    work.between.emplace_back(options.out / name, "runs", std::vector<std::string>{}, problems);
  for (auto& group : work.groups)
    group.folder.emplace(group.result.directory, "compare", studies::comparison_files, problems);
  for (auto& job : work.jobs) job->folder.emplace(job->result.directory, problems);
}

/// What nothing has run for must not be taken for this call's: a verdict over all, which a machine reads.
void take_back_results(const std::filesystem::path& out) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(out, ignored)) return;
  Problems not_ours;
  OutputFolder folder(out, "runs", {junit_file}, not_ours);
  if (!not_ours.empty() || !folder.listed().contains(junit_file)) return;
  folder.take_back({junit_file});
  fmt::print(stderr, "{} of an earlier run is removed: nothing has run\n", (out / junit_file).string());
}

/// Old results go before new ones are made: what is killed half-way must not leave an old verdict.
void begin(Work& work) {
  work.folder->begin();
  for (auto& folder : work.between) folder.begin();
  for (auto& group : work.groups) group.folder->begin();
  for (auto& job : work.jobs) job->folder->begin(job->from && !job->branches);
}

/// Takes the results from the cache if it has them.
bool is_unchanged(Job& job, const RunCache& cache, const RunOptions& options) {
  job.inputs =
      inputs_of_run(job.scenario, job.files,
                    {job.result.name, options.pictures, options.gltf, options.verify_step, options.strict});
  auto kept = cache.take(job.inputs, job.folder->files());
  if (!kept) return false;
  job.result.outcome = std::move(kept->outcome);
  job.result.has_report = kept->has_report;
  if (!kept->scene.empty()) job.left.scene = job.result.directory / kept->scene;
  job.kept_notes = std::move(kept->notes);
  return true;
}

/// Keeps what the next run of the same would leave again. What it has left out it might not leave out then.
/// The verdict stands where it cannot be kept.
void keep(Job& job, const RunCache& cache) {
  if (!job.result.outcome.failure.empty() || !job.left.left_out.empty() || InterruptWatch::come() != 0)
    return;
  try {
    cache.keep(job.inputs, job.folder->files(),
               {job.result.outcome, job.result.has_report, job.simulation->notes(),
                job.left.scene.filename().string()});
  } catch (const std::exception& error) {
    job.notes.emplace_back("run.not-cached"_code,
                           fmt::format("not kept in the cache: {}", drycut::words_of(error)));
  }
}

void run_job(Job& job, const RunOptions& options, int threads,
             const std::function<void(const char*, double)>& progress) {
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  report::RunRequest request;
  request.pictures = options.pictures;
  request.gltf = options.gltf;
  request.strict = options.strict;
  request.coverage = options.coverage;
  request.half = job.half ? &*job.half : nullptr;
  request.threads = threads;
  request.states = options.every;
  request.most_states = static_cast<std::size_t>(options.most_states);
  request.from = job.from ? &*job.from : nullptr;
  request.branches = job.branches;
  request.then = job.then;
  request.progress = progress;
  request.is_interrupted = [] { return InterruptWatch::come() != 0; };
  job.left = job.folder->run(job.scenario, *job.simulation, job.meshes, request, job.result);
  if (!job.left.states_lost.empty()) job.notes.emplace_back("state.lost"_code, job.left.states_lost);
  job.took = std::chrono::duration<double>(Clock::now() - begun).count();
}

void run_all(std::vector<std::unique_ptr<Job>>& jobs, const RunOptions& options) {
  // Cores that no scenario runs on help to draw; the pictures are the same whoever draws them.
  const auto running = std::min<std::size_t>(static_cast<std::size_t>(options.jobs), jobs.size());
  const auto drawing_threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency() / running));
  ProgressBar bar(options.say != Say::failures);
  Problems ignored;  // it is there
  const auto cache =
      options.cache.empty() ? std::nullopt : std::optional<RunCache>(std::in_place, options.cache, ignored);
  for_each_index(jobs.size(), static_cast<int>(running), [&](std::size_t i) {
    auto& job = *jobs[i];
    const auto show = [&](const char* doing, double done) {
      bar.show(fmt::format("{} {} ({} of {})", doing, job.result.name, i + 1, jobs.size()), done);
    };
    if (InterruptWatch::come() != 0) {
      job.trouble = "not run: interrupted before";
      job.result.ran = false;
      return;
    }
    // What a run leaves in a retentive file is a result too, and the next one's input.
    const bool may_be_kept =
        cache && !loop::retentive_file(job.scenario) && !job.from && !options.every && !options.coverage;
    try {
      if (may_be_kept && is_unchanged(job, *cache, options)) return;
      run_job(job, options, drawing_threads, show);
      if (may_be_kept) keep(job, *cache);
    } catch (const std::exception& error) {
      // What stopped the run came first: a full disk takes none of the files behind the one that filled it.
      const auto& failure = job.result.outcome.failure;
      job.trouble = failure.empty() ? drycut::words_of(error)
                                    : fmt::format("{}; then {}", failure, drycut::words_of(error));
    }
  });
}

/// Compares the members of a scene from the files that they left.
void run_group(Group& group, bool pictures) {
  Problems problems;
  std::vector<studies::ComparedRun> runs;
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
      group.trouble = fmt::format("not compared: {}", drycut::words_of(error));
    }
  }
}

int status_of(const Work& work) {
  if (!work.refused.empty()) return bad_input;
  int status = all_passed;
  const auto take = [&](const std::string& trouble, const record::Outcome& outcome) {
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

/// That of all scenarios, counts added up.
void write_coverage(Work& work, Say say) {
  devices::Coverage all;
  for (const auto& job : work.jobs) all.add(job->left.coverage);
  const auto file = work.folder->add(report::coverage_file);
  write_file(file, devices::lcov_text(all));
  if (say != Say::failures) fmt::print("coverage: {}, {}\n", report::coverage_text(all), file.string());
}

/// What came of all of them, told on the terminal.
std::vector<report::RunResult> tell_results(const Work& work, Say say) {
  std::vector<report::RunResult> results;
  const auto keep = [&](const report::RunResult& result, const std::string& trouble) {
    results.push_back(result);
    if (!trouble.empty()) results.back().outcome.failure = trouble;
  };
  for (const auto& job : work.jobs) {
    print_result(*job, say);
    keep(job->result, job->trouble);
  }
  for (const auto& group : work.groups) {
    print_group(group, say);
    keep(group.result, group.trouble);
  }
  for (const auto& refused : work.refused) print_refused(refused);
  return results;
}

/// All that is wrong, once: several scenarios may have it from the same file or --set.
Problems problems_of(const Problems& of_call, const Work& work) {
  auto all = of_call;
  std::set<std::string> told;
  for (const auto& refused : work.refused)
    for (const auto& problem : refused.problems)
      if (told.insert(to_string(problem)).second) all.push_back(problem);
  return all;
}

/// The summary can be written. Its folder may be that of the results, which is made yet.
void check_summary(const RunOptions& options, Problems& problems) {
  const auto whole = [](const std::filesystem::path& folder) {
    return (std::filesystem::absolute(folder) / "").lexically_normal();
  };
  const auto into_results =
      whole(std::filesystem::absolute(options.summary).parent_path()) == whole(options.out);
  if (into_results && !std::filesystem::exists(options.out)) return;
  for (const auto& file : options.scenarios) {
    Problems own;
    check_output("--summary", options.summary.string(), {file, "scenario"}, {options.force, summary_header},
                 own);
    if (own.empty()) continue;
    problems.insert(problems.end(), own.begin(), own.end());
    return;
  }
}

}  // namespace

int run_scenarios(const RunOptions& given) {
  Problems problems;
  auto options = given;
  read_again(options, problems);
  check_annotate(options.annotate, problems);
  auto work = prepare(options, problems);
  const auto before = problems.size();
  if (!options.summary.empty()) check_summary(options, problems);
  const bool has_summary = !options.summary.empty() && problems.size() == before;
  if (problems.empty() && !options.cache.empty()) const RunCache made(options.cache, problems);
  const bool any = !work.jobs.empty();
  if (problems.empty() && any) open_folders(work, options, problems);
  const auto all_problems = problems_of(problems, work);
  print_problems(all_problems);
  if (!problems.empty() || !any) {
    work.folder.reset();  // and its lock
    take_back_results(options.out);
    annotate(options.annotate, annotations_of(all_problems));
    if (has_summary &&
        std::filesystem::is_directory(std::filesystem::absolute(options.summary).parent_path()))
      write_file(options.summary, summary_text(all_problems));
    return bad_input;
  }
  begin(work);
  const InterruptWatch watch;
  run_all(work.jobs, options);
  run_groups(work.groups, options.pictures);
  auto results = tell_results(work, options.say);
  auto annotations = annotations_of(all_problems);
  for (auto& annotation : annotations_of(results)) annotations.push_back(std::move(annotation));
  for (const auto& refused : work.refused) results.push_back(refused.result);
  try {
    report::write_junit(results, work.folder->add(junit_file));
    report::write_index(options.out, *work.folder);
    if (options.coverage) write_coverage(work, options.say);
    annotate(options.annotate, annotations);
    if (!options.summary.empty())
      write_file(
          options.summary,
          summary_text(results, {options.out, links_from(options.summary, options.out, options.links)}));
  } catch (const std::exception& error) {
    return print_failure(drycut::words_of(error));
  }
  return InterruptWatch::come() == 0 ? status_of(work) : interrupted_status;
}

namespace {

void run_options(CLI::App& run, int& status) {
  const auto chosen = std::make_shared<RunOptions>();
  auto& options = *chosen;
  run.add_option("scenarios", options.scenarios, "Scenario files (.yaml)");
  add_out(run, options.out, "Directory for the results");
  run.add_option("--jobs", options.jobs, "Scenarios run at the same time")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  run.add_option("--seed", options.seed, "Seed of every random source, in place of the scenarios'");
  add_no_pictures(run, options.pictures, "No frames, plots or report");
  run.add_flag("--gltf", options.gltf, "The run as an animated glTF file (.glb) for any 3D viewer");
  run.add_flag("--verify-step", options.verify_step,
               "Run again at half scene.step and tell how far every check's margin moved");
  run.add_flag("--strict", options.strict, "Warnings fail it, too: exit status 1");
  auto* coverage = run.add_flag("--coverage", options.coverage,
                                "Count which lines and branches of the controllers' programs run: "
                                "coverage.info for lcov and genhtml");
  run.add_option("--states", options.states,
                 "Keep the run's moments so often, \"1 s\": to come back to them, and to go on after a kill");
  run.add_option("--keep", options.most_states, "With --states: so many moments, evenly over the run")
      ->check(CLI::Range(4, 100000))
      ->capture_default_str();
  run.add_option("--resume", options.resume, "Go on with a run that was stopped: the folder of its results")
      ->excludes(run.get_option("--out"))
      ->excludes(coverage);
  run.add_option(
      "--from", options.from,
      "Branch off a run at a time, \"out/line@12.5 s\": from there on with this scenario and --set");
  run.add_option("--cache", options.cache,
                 "Folder that keeps results: what would come out the same is taken from there, and not run");
  run.add_option("--summary", options.summary,
                 "Write a summary in Markdown, for pull requests: verdicts, failed checks, pictures");
  run.add_option("--links", options.links,
                 "With --summary: where the results will be found, https://host/page");
  run.add_flag("--force", options.force, "With --summary: replace a file, too, that drycut did not write");
  add_annotate(run, options.annotate);
  add_set(run, options.set, "scenarios");
  auto* quiet = run.add_flag_callback(
      "-q,--quiet", [&options] { options.say = Say::failures; }, "Tell only what failed");
  run.add_flag_callback(
         "-v,--verbose", [&options] { options.say = Say::more; }, "Tell how long it took, too")
      ->excludes(quiet);
  run.callback([chosen, &status] { status = run_scenarios(*chosen); });
}

}  // namespace

Verb run_verb() {
  return {"run",
          "Run scenarios: traces, events, checks, pictures and a report for each",
          {"drycut run scenes/rotary_knife.yaml", "drycut run scenes/*.yaml --jobs 2 --out results",
           "drycut run my_line.yaml --set variables.length=\"1 m\" --no-pictures",
           "drycut run my_line.yaml --states \"1 s\"", "drycut run --resume out/my_line",
           "drycut run my_line.yaml --from \"out/my_line@4 s\" --out branch",
           "  --set plants.web.speed=\"80 m/min\"",
           "drycut run scenes/*.yaml --cache .drycut-cache --annotate github", "  --summary out/summary.md"},
          {"scenarios", {FileKind::scenario, FileKind::comparison, FileKind::session}},
          run_options};
}

}  // namespace drycut::sim::cli
