#include <fmt/format.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>

#include "sim/commands/arguments.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/progress.hpp"
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
  RunResult result;
  std::string trouble;  ///< a result could not be written
};

/// Reads and puts together all scenarios; problems of all of them are told before anything runs.
std::vector<std::unique_ptr<Job>> prepare(const RunOptions& options, devices::Problems& problems) {
  const auto overrides = overrides_of(options.set, problems);
  std::vector<std::unique_ptr<Job>> jobs;
  std::map<std::string, std::filesystem::path> names;
  for (const auto& file : options.scenarios) {
    auto job = std::make_unique<Job>();
    const auto before = problems.size();
    job->scenario = read_scenario(file, overrides, problems);
    if (options.seed) job->scenario.scene.seed = *options.seed;
    const auto name = file.stem().string();
    if (const auto [other, fresh] = names.emplace(name, file); !fresh) {
      problems.push_back({file.string(), 1, 1,
                          fmt::format("its results would overwrite those of {}", other->second.string()),
                          "give the scenarios different file names or run them apart"});
    }
    if (const auto kept = retentive_file(job->scenario)) {
      if (const auto [other, fresh] = names.emplace("retentive " + kept->lexically_normal().string(), file);
          !fresh) {
        problems.push_back(
            {file.string(), 1, 1,
             fmt::format("it keeps its retentive values in the file of {}", other->second.string()),
             "give each scenario a retentive file of its own or run them apart"});
      }
    }
    if (job->scenario.buildable) {
      job->simulation = std::make_unique<Simulation>(job->scenario, problems);
    } else if (problems.size() == before) {
      throw std::logic_error("a scenario that cannot be built has no problem");
    }
    job->result.name = name;
    job->result.scenario = file;
    job->result.directory = options.out / name;
    jobs.push_back(std::move(job));
  }
  return jobs;
}

void run_job(Job& job, bool pictures, int threads, const std::function<void(const char*, double)>& progress) {
  const auto& directory = job.result.directory;
  const auto duration = static_cast<double>(job.scenario.scene.duration);
  job.result.outcome =
      job.simulation->run([&](Time now) { progress("running", static_cast<double>(now) / duration); });
  // What an earlier run left here must not be taken for this one's.
  remove_pictures(directory);
  std::filesystem::create_directories(directory);
  write_trace(job.simulation->recording(), directory / "trace.csv");
  write_events(job.simulation->recording(), directory / "events.csv");
  write_checks(job.result.outcome, directory / "checks.json");
  if (const auto kept = retentive_file(job.scenario)) {
    OutputFile out(*kept);
    out.write(job.simulation->retentive_state());
    out.finish();
  }
  if (!pictures) return;
  write_pictures(job.scenario, *job.simulation, job.result.outcome, directory, threads, progress);
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
        run_job(job, options.pictures, drawing_threads, show);
      } catch (const std::exception& error) {
        job.trouble = error.what();
      }
    }
  };
  std::vector<std::jthread> threads;
  for (std::size_t i = 1; i < running; ++i) threads.emplace_back(work);
  work();
}

void print_result(const Job& job) {
  const auto& result = job.result;
  const auto word = !job.trouble.empty() || !result.outcome.failure.empty() ? "STOPPED"
                    : result.outcome.passed()                               ? "passed"
                                                                            : "FAILED";
  fmt::print("{}: {}, {} ({} s simulated)\n", result.name, word, verdict_text(result.outcome),
             seconds_text(result.outcome.end));
  for (const auto& check : result.outcome.checks) {
    const auto margin = margin_text(check);
    fmt::print("  {} {}: {}{}{}\n", check.passed ? "ok  " : "FAIL", check.name, check.detail,
               margin.empty() ? "" : "; ", margin);
  }
  for (const auto& note : job.simulation->notes()) fmt::print("  note {}\n", note);
  if (!job.trouble.empty()) fmt::print("  {}\n", job.trouble);
  fmt::print("  {}: {}\n", result.has_report ? "report" : "results",
             (result.has_report ? result.directory / "report.html" : result.directory).string());
}

int status_of(const std::vector<std::unique_ptr<Job>>& jobs) {
  int status = all_passed;
  for (const auto& job : jobs) {
    if (!job->trouble.empty() || !job->result.outcome.failure.empty()) return simulation_failed;
    if (!job->result.outcome.passed()) status = check_failed;
  }
  return status;
}

}  // namespace

void print_problems(const devices::Problems& problems) {
  for (const auto& problem : problems) fmt::print(stderr, "{}\n", to_string(problem));
}

int run_scenarios(const RunOptions& options) {
  devices::Problems problems;
  auto jobs = prepare(options, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  for (const auto& job : jobs) make_folder(job->result.directory, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  run_all(jobs, options);
  std::vector<RunResult> results;
  for (const auto& job : jobs) {
    print_result(*job);
    results.push_back(job->result);
    if (!job->trouble.empty()) results.back().outcome.failure = job->trouble;
  }
  try {
    std::filesystem::create_directories(options.out);
    write_junit(results, options.out / "junit.xml");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return simulation_failed;
  }
  return status_of(jobs);
}

}  // namespace drycut::sim
