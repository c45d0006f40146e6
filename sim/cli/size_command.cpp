#include "sim/cli/size_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "plants/plant.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/progress.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/output_folder.hpp"
#include "sim/studies/size/report.hpp"
#include "sim/studies/sweep/report.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::cli {

namespace {

constexpr auto* size_file = "size.csv";
constexpr auto* runs_file = "points.cache";  // goes on where it ended
constexpr std::size_t most_told = 5;         // candidates

/// The command line, read and found sound.
struct SizePlan {
  studies::PointQuestion question;
  studies::SizeChoices choices;
  std::vector<studies::Candidate> candidates;
  std::vector<studies::Corner> corners;
};

/// Means over a run that has no cycles are told and not judged.
void check_cycle(const SizePlan& plan, const scenario::Scenario& scenario, Problems& problems) {
  const auto& drive = plan.choices.drive;
  const bool cuts = std::any_of(
      plan.question.events.begin(), plan.question.events.end(),
      [&](const auto& event) { return event.source == drive.plant && event.name == plants::cut_event; });
  if (scenario.drives.cycle == 0 && !cuts)
    problems.push_back(
        {"option.missing"_code, "--drive", 1, 1,
         fmt::format("nothing says what {} must bear for ever: {} does not cut, and the scenario names "
                     "no machine cycle",
                     drive.full_name(), drive.plant),
         "drives: {cycle: 2 s} in the scenario, or --set \"drives.cycle=2 s\""});
}

SizePlan read_size(const SizeOptions& options, Problems& problems) {
  SizePlan plan;
  auto& question = plan.question;
  question.file = options.scenario;
  question.set = overrides_of(options.set, problems);
  auto text = read_file(options.scenario, problems);
  if (!text) return plan;
  question.text = std::move(*text);
  const auto before = problems.size();
  studies::prepare(question, problems);
  if (problems.size() != before) return plan;
  const auto scenario = scenario::read_scenario_text(question.text, question.file, question.set, problems);
  plan.choices = studies::read_choices(
      {options.drive, options.motors, options.gears, options.resistors, options.inertia_ratio}, question,
      scenario, problems);
  const auto& drive = plan.choices.drive;
  std::vector<std::string> sized;
  if (!drive.plant.empty()) {
    sized.push_back(drive.path(drive.kind + "."));
    for (const auto& axis : plan.choices.gears) sized.push_back(axis.parameter.path);
  }
  plan.corners = studies::read_corners(options.at, options.corners, question, sized, problems);
  if (drive.plant.empty()) return plan;
  check_cycle(plan, scenario, problems);
  if (problems.empty()) plan.candidates = studies::candidates_of(plan.choices, question, scenario, problems);
  if (plan.candidates.size() > studies::most_points / std::max<std::size_t>(1, plan.corners.size()))
    problems.push_back(
        {"option.out-of-range"_code, "--motors", 1, 1,
         fmt::format("{} candidates at {} corners", plan.candidates.size(), plan.corners.size()),
         fmt::format("at most {} runs", studies::most_points)});
  studies::PointQuestion rated;
  rated.file = question.file;
  rated.text = question.text;
  rated.set = question.set;
  rated.rated = drive.full_name();
  if (problems.empty()) studies::prepare(rated, problems);
  question = std::move(rated);
  return plan;
}

void print_words(const studies::SizeResult& result) {
  const auto fitting = count_fitting(result);
  const auto best = printable(best_words(result));
  if (fitting > 0)
    fmt::print("{} of {} candidates fit at {}; {}\n", fitting, result.sized.size(),
               counted(std::ssize(result.corners), "corner"), best);
  else
    fmt::print("{}\n", best);
  for (std::size_t rank = 0; rank < std::min(result.order.size(), most_told); ++rank) {
    const auto which = result.order[rank];
    fmt::print("{:>3}. {}\n", rank + 1,
               printable(candidate_words(result.candidates[which], result.sized[which])));
  }
  for (const auto& note : size_notes(result)) fmt::print("note: {}\n", printable(to_string(note)));
}

}  // namespace

int size_drive(const SizeOptions& options) {
  Problems problems;
  auto plan = read_size(options, problems);
  std::optional<OutputFolder> folder;
  std::vector<std::string> files = {size_file, runs_file};
  files.insert(files.end(), studies::study_pages.begin(), studies::study_pages.end());
  if (problems.empty()) folder.emplace(options.out, "size", files, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  try {
    auto workers = workers_of(options.cluster, options.jobs, options.out, problems);
    if (!problems.empty()) {
      print_problems(problems);
      return bad_input;
    }
    folder->begin_aside({runs_file});
    studies::PointStore store(folder->add(runs_file), std::move(workers));
    ProgressBar bar;
    const auto sized = studies::size_drives(plan.question, plan.choices.drive, plan.candidates, plan.corners,
                                            store, [&](std::size_t done, std::size_t of) {
                                              bar.show(fmt::format("sizing, run {} of {}", done, of),
                                                       static_cast<double>(done) / static_cast<double>(of));
                                            });
    bar.clear();
    const auto order = studies::ranked(plan.candidates, sized);
    write_file(folder->add(size_file), studies::size_table(plan.candidates, sized, order).csv());
    const studies::SizeResult result{plan.question, plan.choices, plan.candidates,
                                     plan.corners,  sized,        order};
    const int status = finish(studies::write_size_report(result, *folder), store, *folder);
    print_words(result);
    fmt::print("{}: {}\nreport: {}\n{} simulated now\n", counted(std::ssize(sized), "candidate"),
               (options.out / size_file).string(), (options.out / "report.html").string(),
               counted(static_cast<std::int64_t>(store.simulated()), "run"));
    print_left_out(store.lost());
    return status;
  } catch (const std::exception& error) {
    return print_failure(fmt::format("{}: {}", options.out.string(), drycut::words_of(error)));
  }
}

namespace {

void size_options(CLI::App& size, int& status) {
  const auto chosen = std::make_shared<SizeOptions>();
  auto& options = *chosen;
  options.out = "out/size";

  size.add_option("scenario", options.scenario, "Scenario file (.yaml)")->required();
  size.add_option("--drive", options.drive,
                  "The drive, such as knife.servo; may be left out where there is one");
  size.add_option(
          "--motors", options.motors,
          "all, or names and patterns of the catalogue with commas between, such as \"HG-SR202,SGM7*\", "
          "with the amplifier of each: drycut plants --motors")
      ->capture_default_str();
  size.add_option(
      "--gears", options.gears,
      "Ratios: 5..20:16, that many from end to end, or 5,7,10; with the kind of the gear its efficiency goes "
      "along: \"5 planetary, 20 worm\"; it stays as it is if not given. So that the "
      "controller "
      "sees the same machine, the speed at 10 V or the electronic gear goes along, and the lines of a motor "
      "encoder "
      "that is counted; where what goes along is tied to a variable of the scenario: variables.gear=5,7,10");
  size.add_option(
      "--resistors", options.resistors,
      "Brake resistors: \"100,200 W\", \"13 ohm 100 W, 6.7 ohm 3 kW\", none; it stays as it is if not "
      "given");
  size.add_option(
      "--inertia-ratio", options.inertia_ratio,
      "The largest of load over rotor inertia, such as 15; a candidate with more is ruled out without "
      "a run. Without it what the motor's maker says in the catalogue, else 10, of servo motors; "
      "off: any");
  size.add_option(
          "--at", options.at,
          "A corner of what the line must do: \"variables.length=500 mm,plants.web.speed=120 m/min\"; may be "
          "repeated; the scenario as it is if there is none")
      ->allow_extra_args(false);
  size.add_option(
      "--corners", options.corners,
      "envelope.csv of drycut envelope: a corner at each of its points, at the largest value found");
  size.add_option("--jobs", options.jobs, "Runs at the same time; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  add_on(size, options.cluster);
  add_set(size, options.set, "scenario");
  add_out(size, options.out, "Directory for the results; runs in it are not run again");
  size.callback([chosen, &status] { status = size_drive(*chosen); });
}

}  // namespace

Verb size_verb() {
  return {
      "size",
      "Find the motor, the gear and the brake resistor of a drive: every candidate runs in closed loop at "
      "the "
      "corners of what the line must do. It fits where every check and every rating holds at each of them.\n"
      "size.csv: a row a candidate, ranked: 10 % of reserve or more before less, then the smallest motor by "
      "rated power, the smallest brake resistor, the largest reserve, the least energy; then what does not "
      "fit, "
      "why and where, what is short by the least first. Reserve: the least distance to a rating over all "
      "corners.\n"
      "What was interrupted goes on where it was. Status 1: none fits.",
      {"drycut size scenes/rotary_knife_mc_camin.yaml --drive knife.servo",
       "  --motors \"HG-SR*\" --gears 4..10:4 --jobs 2"},
      {"scenario", {FileKind::scenario}},
      size_options};
}

}  // namespace drycut::sim::cli
