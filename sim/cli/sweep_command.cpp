#include "sim/cli/sweep_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <memory>
#include <optional>

#include "base/plain_text.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/progress.hpp"
#include "sim/file.hpp"
#include "sim/output_folder.hpp"
#include "sim/studies/sweep/report.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::cli {

namespace {

constexpr auto* sweep_file = "sweep.csv";
constexpr auto* envelope_file = "envelope.csv";
constexpr auto* points_file = "points.cache";  // goes on where it ended

std::vector<std::string> files_of(const std::string& table) {
  std::vector<std::string> files = {table, points_file};
  files.insert(files.end(), studies::study_pages.begin(), studies::study_pages.end());
  return files;
}

/// The command line, read and found sound.
struct StudyPlan {
  studies::PointQuestion question;
  studies::SweepAxes axes;
  std::vector<studies::SweepPoint> points;
};

void read_figures(const StudyOptions& options, studies::PointQuestion& question, Problems& problems) {
  for (const auto& text : options.figures) {
    const auto equals = text.find('=');
    const auto name = text.substr(0, equals);
    const bool twice = std::any_of(question.figures.begin(), question.figures.end(),
                                   [&](const auto& figure) { return figure.name == name; });
    if (equals == std::string::npos || equals == 0 || name.find('(') != std::string::npos)
      problems.push_back({"--figure", 1, 1, fmt::format("'{}' is no NAME=TERM", text),
                          "such as peak=max(abs(knife.motor.torque))"});
    else if (twice)
      problems.push_back(
          {"--figure", 1, 1, fmt::format("there are two figures named '{}'", name), "rename one"});
    else
      question.figures.push_back({name, text.substr(equals + 1)});
  }
}

StudyPlan read_plan(const StudyOptions& options, bool sampled, Problems& problems) {
  StudyPlan plan;
  auto text = read_file(options.scenario, problems);
  plan.question.file = options.scenario;
  plan.question.set = overrides_of(options.set, problems);
  read_figures(options, plan.question, problems);
  for (const auto& over : options.over)
    if (auto axis = studies::parse_axis(over, "--over", sampled, problems))
      plan.axes.push_back(std::move(*axis));
  if (!text) return plan;
  plan.question.text = std::move(*text);
  studies::prepare(plan.question, problems);
  return plan;
}

/// "sobol:1000"
std::optional<std::size_t> read_sample(const std::string& text, Problems& problems) {
  if (text.empty()) return {};
  constexpr std::string_view kind = "sobol:";
  std::size_t count = 0;
  const auto* const end = text.data() + text.size();
  if (text.starts_with(kind)) {
    const auto read = std::from_chars(text.data() + kind.size(), end, count);
    if (read.ec == std::errc() && read.ptr == end && count > 0 && count <= studies::most_points) return count;
  }
  problems.push_back({"--sample", 1, 1, fmt::format("'{}' is no sample", text),
                      fmt::format("sobol:N, N from 1 to {}", studies::most_points)});
  return {};
}

/// A bar that says how long it will still take.
class Countdown {
 public:
  explicit Countdown(std::string doing) : doing_(std::move(doing)) {}
  void show(std::size_t done, std::size_t of) {
    using namespace std::chrono;
    const double elapsed = duration<double>(steady_clock::now() - begin_).count();
    const double left = elapsed / static_cast<double>(done) * static_cast<double>(of - std::min(of, done));
    const auto text = left < 90 ? fmt::format("{:.0f} s", left) : fmt::format("{:.0f} min", left / 60);
    bar_.show(fmt::format("{}, {} left", doing_, text), static_cast<double>(done) / static_cast<double>(of));
  }
  void clear() { bar_.clear(); }

 private:
  std::string doing_;
  Progress bar_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// The largest first, equal ones by name.
void print_counts(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> all(counts.begin(), counts.end());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  for (const auto& [name, count] : all) fmt::print("{:>8} {}\n", count, printable(name));
}

int bad(const Problems& problems) {
  print_problems(problems);
  return bad_input;
}

/// Runs `work` on the folder's store; what it throws is told.
template <typename Work>
int in_folder(const StudyOptions& options, OutputFolder& folder, const Work& work) {
  try {
    Problems problems;
    auto workers = workers_of(options.cluster, options.jobs, options.out, problems);
    if (!problems.empty()) return bad(problems);
    folder.begin({points_file});
    studies::PointStore store(folder.add(points_file), std::move(workers));
    work(store);
    fmt::print("{} runs simulated now\n", store.simulated());
    for (const auto& lost : store.lost()) fmt::print(stderr, "{}\n", printable(lost));
    return store.lost().empty() ? all_passed : simulation_failed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", options.out.string(), error.what());
    return simulation_failed;
  }
}

void add_study(CLI::App& command, StudyOptions& options, const char* over_help) {
  command.add_option("scenario", options.scenario, "Scenario file (.yaml)")->required();
  command.add_option("--over", options.over, over_help)->allow_extra_args(false);
  command
      .add_option(
          "--figure", options.figures,
          "NAME=TERM, a column more, such as \"peak=max(abs(knife.motor.torque))\"; terms as of tune; "
          "may be repeated")
      ->allow_extra_args(false);
  command.add_option("--jobs", options.jobs, "Runs at the same time; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  add_on(command, options.cluster);
  add_set(command, options.set, "scenario");
  add_out(command, options.out, "Directory for the results; runs in it are not run again");
}

}  // namespace

int sweep_scenario(const SweepOptions& options) {
  Problems problems;
  const auto sampled = read_sample(options.sample, problems);
  auto plan = read_plan(options, !options.sample.empty(), problems);
  if (sampled && plan.axes.size() > studies::sobol_axes)
    problems.push_back({"--sample", 1, 1, fmt::format("{} axes", plan.axes.size()),
                        fmt::format("a Sobol sequence is over {} at most", studies::sobol_axes)});
  if (problems.empty() && !sampled && !studies::grid_size(plan.axes, studies::most_points))
    studies::points_of(plan.axes, {}, problems);  // before axes of a million values are made
  if (problems.empty()) studies::check_axes(plan.axes, plan.question, problems);
  if (problems.empty()) plan.points = studies::points_of(plan.axes, sampled, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(options.out, "sweep", files_of(sweep_file), problems);
  if (!problems.empty()) return bad(problems);
  return in_folder(options, *folder, [&](studies::PointStore& store) {
    Countdown bar("sweeping");
    const auto rows = studies::sweep(plan.question, plan.axes, plan.points, store,
                                     [&](std::size_t done, std::size_t of) { bar.show(done, of); });
    bar.clear();
    write_file(folder->add(sweep_file), studies::sweep_csv(plan.question, plan.axes, plan.points, rows));
    studies::write_sweep_report(plan.question, plan.axes, plan.points, rows, *folder);
    std::map<std::string, std::size_t> verdicts;
    for (const auto& row : rows)
      ++verdicts[row.limit.empty() ? std::string(name_of(row.verdict))
                                   : fmt::format("{}: {}", name_of(row.verdict), row.limit)];
    print_counts(verdicts);
    fmt::print("{} points: {}\nreport: {}\n", rows.size(), (options.out / sweep_file).string(),
               (options.out / "report.html").string());
  });
}

int envelope_scenario(const EnvelopeOptions& options) {
  Problems problems;
  auto request = studies::parse_bound(options.find_max, "--find-max", problems);
  auto plan = read_plan(options, false, problems);
  if (problems.empty() && !studies::grid_size(plan.axes, studies::most_points))
    studies::points_of(plan.axes, {}, problems);
  if (problems.empty()) {
    auto all = plan.axes;
    all.push_back({request->parameter, {}});
    studies::check_axes(all, plan.question, problems);
    request->parameter = all.back().parameter;
    all.pop_back();
    plan.axes = std::move(all);
  }
  if (problems.empty()) plan.points = studies::points_of(plan.axes, {}, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(options.out, "envelope", files_of(envelope_file), problems);
  if (!problems.empty()) return bad(problems);
  return in_folder(options, *folder, [&](studies::PointStore& store) {
    Countdown bar("seeking");
    const auto bounds = studies::envelope(plan.question, plan.axes, plan.points, *request, store,
                                          [&](std::size_t done, std::size_t of) { bar.show(done, of); });
    bar.clear();
    write_file(folder->add(envelope_file),
               studies::envelope_csv(plan.question, plan.axes, plan.points, *request, bounds));
    studies::write_envelope_report(plan.question, plan.axes, plan.points, *request, bounds, *folder);
    std::map<std::string, std::size_t> limits;
    for (const auto& bound : bounds)
      ++limits[bound.limit.empty() ? std::string(name_of(bound.kind))
                                   : fmt::format("{}: {}", name_of(bound.kind), bound.limit)];
    print_counts(limits);
    fmt::print("{} points, {} to {:.6g} {}: {}\nreport: {}\n", bounds.size(), request->parameter.path,
               request->tolerance, request->parameter.unit, (options.out / envelope_file).string(),
               (options.out / "report.html").string());
  });
}

void add_sweep(CLI::App& app, int& status) {
  const auto chosen = std::make_shared<SweepOptions>();
  auto& options = *chosen;
  options.out = "out/sweep";
  auto* sweep = app.add_subcommand("sweep",
                                   "Run a scenario at every point of a grid or a sample: sweep.csv, a row a "
                                   "point with its verdict, what gave "
                                   "way first, and figures.\nWhat was interrupted goes on where it was.");
  add_study(
      *sweep, options,
      "PATH=A..B UNIT:N, N values from end to end (PATH=A..B UNIT:N:log, each so many times the one before), "
      "or PATH=1,2,5 UNIT; may be repeated");
  sweep->get_option("--over")->required();
  sweep->add_option("--sample", options.sample,
                    "sobol:N, N points that fill the ranges evenly, in place of the grid; ranges need no :N");
  sweep->callback([chosen, &status] { status = sweep_scenario(*chosen); });
}

void add_envelope(CLI::App& app, int& status) {
  const auto chosen = std::make_shared<EnvelopeOptions>();
  auto& options = *chosen;
  options.out = "out/envelope";
  auto* envelope = app.add_subcommand(
      "envelope",
      "Find the largest value of a parameter at which every check and every rating holds, and what gives way "
      "there: envelope.csv, a row a point.\nNine values from end to end are looked at, up to 33 where none "
      "of them holds; where what held first gives way, the interval is halved down to the tolerance. That it "
      "holds again beyond is told.");
  add_study(*envelope, options, "PATH=A..B UNIT:N[:log] or PATH=1,2,5 UNIT; may be repeated");
  envelope
      ->add_option(
          "--find-max", options.find_max,
          "PATH=LO..HI UNIT[:TOLERANCE], such as \"plants.web.speed=20..300 m/min:1\"; a two-hundredth of "
          "the range unless given")
      ->required();
  envelope->callback([chosen, &status] { status = envelope_scenario(*chosen); });
}

}  // namespace drycut::sim::cli
