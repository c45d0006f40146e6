#include "sim/studies/why/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "base/text.hpp"
#include "sim/studies/compare/run_folder.hpp"
#include "sim/studies/why/mixed_run.hpp"

namespace drycut::sim::studies {

namespace {

using Progress = std::function<void(const char*, double)>;

/// What failed, as it is told: by the run's folder, or by running it.
struct FailedRun {
  record::Outcome outcome;
  record::Recording recording;
  scenario::Scenario scenario;
};

/// The check that is asked about; nothing after a problem.
std::optional<FailedCheck> check_of(const WhyRequest& request, const record::Outcome& outcome, bool ran_again,
                                    Problems& problems) {
  const auto refuse = [&](Code code, const std::string& what, const std::string& remedy) {
    problems.push_back({code, request.run.string(), 1, 1, what, remedy});
  };
  if (outcome.passed()) {
    refuse("why.passed"_code, ran_again ? "run as it is now, all its checks hold" : "all its checks held",
           ran_again ? "its programs have changed since; name the folder or scenario of one that fails"
                     : "name the folder of a run that failed");
    return {};
  }
  if (request.check.empty()) return first_failed(outcome);
  std::vector<std::string> failed;
  for (const auto& check : outcome.checks)
    if (!check.passed) failed.push_back(check.name);
  if (std::ranges::find(failed, request.check) != failed.end()) return FailedCheck{request.check};
  problems.push_back({"scenario.unknown-name"_code, "--check", 1, 1,
                      fmt::format("no check '{}' failed", request.check),
                      did_you_mean(request.check, failed)});
  return {};
}

/// What the run says of itself: check, cause, chain, slide.
void tell_run(const FailedRun& run, const FailedCheck& check, const loop::Signs* good, WhyFound& found) {
  found.check = check.name;
  // That nothing else is amiss is no answer.
  const bool told = std::ranges::none_of(run.outcome.findings, [](const Finding& finding) {
    return finding.role == Finding::Role::cause &&
           (finding.code == "check.alone-fails" || finding.code == "check.first-fails");
  });
  if (told) found.because = run.outcome.cause();
  if (const auto* result = find_check(run.outcome, check.name)) {
    found.failed_at = result->failed_at;
    found.unit = result->unit;
    found.detail = result->detail;
  } else {
    found.failed_at = seconds(run.outcome.end);
    found.detail = run.outcome.failure;
  }
  const auto until = found.failed_at.value_or(seconds(run.outcome.end));
  const auto in_good = [&](const loop::Sign& sign) {
    return good != nullptr && std::ranges::any_of(good->all(), [&](const loop::Sign& other) {
             return other.source == sign.source && other.event == sign.event && other.at <= until;
           });
  };
  loop::Signs own;  // what the good run has, too, announces nothing
  const auto signs = signs_of(run.recording);
  for (const auto& sign : signs.all())
    if (sign.at <= until) found.chain.push_back({sign, in_good(sign)});
  std::ranges::stable_sort(found.chain, {}, [](const ChainLink& link) { return link.sign.at; });
  for (const auto& event : run.recording.events())
    if (!in_good({0, event.source, event.event, "", event.severity, 1})) own.take(event);
  if (const auto* first = own.first(until)) {
    found.sign_at = first->at;
    found.sign = text_of(*first);
  }
  found.slide = slide_of(room_over_time(run.scenario, check.name, run.recording));
  if (found.slide && !found.sign_at) {
    found.sign_at = found.slide->at;
    found.sign = fmt::format("the room of the check began to shrink, from {:.4g}{}{}", found.slide->room,
                             found.unit.empty() ? "" : " ", found.unit);
  }
}

std::string in_words(TrialCame came) {
  return came == TrialCame::passed ? "passed" : came == TrialCame::failed ? "failed" : "unresolved";
}

Subset all_of(const Mixture& mixture) {
  Subset all(mixture.differences().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

/// The good run with the cause alone: recorded, with moments to branch off from.
struct CauseRun {
  KeptBranches kept;
  double failed_at = 0;
};
std::optional<CauseRun> run_cause(const Mixture& mixture, const Subset& cause, const FailedCheck& check,
                                  const std::vector<std::string>& channels, WhyCurves& curves) {
  MixedRun with(mixture.with(cause), &channels);
  if (!with.problems().empty()) return {};
  auto& simulation = with.simulation();
  CauseRun run;
  const auto keep = [&] { run.kept.moments.push_back({seconds(simulation.time()), simulation.save()}); };
  run.kept.members = members_of(simulation);
  keep();
  const auto& scene = with.scenario().scene;
  const auto every = std::max<Time>(1, scene.duration / kept_branches / scene.step) * scene.step;
  simulation.keep_states(every, true, keep);
  const auto outcome = with.run();
  const auto* result = find_check(outcome, check.name);
  run.failed_at = result != nullptr && result->failed_at ? *result->failed_at : seconds(outcome.end);
  curves.failed_room = room_over_time(with.scenario(), check.name, simulation.recording());
  curves.failed = simulation.take_recording();
  return run;
}

bool judges_events(const scenario::Scenario& scenario, const std::string& check) {
  return std::ranges::any_of(scenario.checks, [&](const auto& one) {
    return one.name.text == check && one.kind == scenario::CheckRequest::Kind::each;
  });
}

void run_good(const Mixture& mixture, const FailedCheck& check, const std::vector<std::string>& channels,
              WhyCurves& curves) {
  MixedRun good(mixture.with({}), &channels);
  good.run();
  curves.good_room = room_over_time(good.scenario(), check.name, good.simulation().recording());
  curves.by_event = judges_events(good.scenario(), check.name);
  curves.good = good.simulation().take_recording();
}

void weigh(const Mixture& mixture, const Subset& cause, const MixedTrials& trials, WhyFound& found) {
  const auto& all = mixture.differences();
  for (std::size_t i = 0; i < all.size(); ++i) {
    WeighedDifference one{all[i].where, all[i].good, all[i].failed, std::ranges::binary_search(cause, i)};
    if (const auto* trial = trials.find({i})) {
      one.alone = in_words(trial->came);
      one.note = trial->note;
    }
    found.differences.push_back(std::move(one));
  }
}

/// What the differences come to.
void compare_with_good(const WhyRequest& request, const Mixture& mixture, const FailedRun& run,
                       const FailedCheck& check, MixedTrials& trials, WhyFound& found,
                       const Progress& progress) {
  const auto all = all_of(mixture);
  const auto least = least_failing(all.size(), [&](const auto& sets) { return trials.run(sets); });
  found.minimal = least.minimal;
  if (least.minimal && least.set.size() < all.size()) {
    Subset rest;
    std::ranges::set_difference(all, least.set, std::back_inserter(rest));
    const auto came = trials.run({rest});
    found.other_causes = !came.empty() && came.front() == TrialCame::failed;
  }
  weigh(mixture, least.set, trials, found);
  std::vector<std::string> looked_at;
  if (const auto* result = find_check(run.outcome, check.name)) looked_at = result->names;
  auto channels = mixture.channels();
  channels.insert(channels.end(), looked_at.begin(), looked_at.end());
  auto& curves = found.curves.emplace();
  progress("comparing", static_cast<double>(trials.runs()) / request.budget);
  const auto with = run_cause(mixture, least.set, check, channels, curves);
  run_good(mixture, check, channels, curves);
  const auto good = signs_of(curves.good);
  tell_run(run, check, &good, found);
  found.parting = first_parting(curves.good, curves.failed);
  if (const auto& part = found.parting; part && (!found.sign_at || part->at < *found.sign_at)) {
    found.sign_at = part->at;
    found.sign = fmt::format("{} left that of the good run: {:.6g} instead of {:.6g}{}{}", part->channel,
                             part->failed, part->good, part->unit.empty() ? "" : " ", part->unit);
  }
  for (const auto& name : looked_at)
    if (curves.good.column(name) != nullptr) curves.channels.push_back(name);
  if (found.parting && std::ranges::find(curves.channels, found.parting->channel) == curves.channels.end())
    curves.channels.push_back(found.parting->channel);
  if (with && least.minimal)
    found.point_of_return =
        point_of_return(mixture, least.set, with->kept, channels, with->failed_at, check, trials);
}

void add_findings(WhyFound& found) {
  const auto add = [&](Code code, std::string text) { found.findings.emplace_back(code, std::move(text)); };
  if (!found.sign.empty()) add("why.sign"_code, fmt::format("at {:.6g} s: {}", *found.sign_at, found.sign));
  for (const auto& one : found.differences) {
    if (one.is_cause) add("why.cause"_code, one.where);
    if (one.alone == in_words(TrialCame::unresolved) && !one.note.empty())
      add("why.not-tried"_code, fmt::format("{}: {}", one.where, one.note));
  }
  if (!found.differences.empty() && !found.minimal)
    add("why.budget"_code, fmt::format("{} of {} runs were used", found.runs, found.budget));
  if (const auto& point = found.point_of_return)
    add("why.return"_code,
        point->saved ? fmt::format("until {:.6g} s", *point->saved) : "it cannot be told: " + point->unknown);
}

/// What a run tells without a good one beside it.
void tell_alone(FailedRun& run, const FailedCheck& check, WhyFound& found) {
  tell_run(run, check, nullptr, found);
  add_findings(found);
  auto& curves = found.curves.emplace();
  curves.failed_room = room_over_time(run.scenario, check.name, run.recording);
  curves.by_event = judges_events(run.scenario, check.name);
  if (const auto* result = find_check(run.outcome, check.name))
    for (const auto& name : result->names)
      if (run.recording.column(name) != nullptr) curves.channels.push_back(name);
  curves.failed = std::move(run.recording);
}

}  // namespace

std::vector<const WeighedDifference*> WhyFound::cause() const {
  std::vector<const WeighedDifference*> all;
  for (const auto& one : differences)
    if (one.is_cause) all.push_back(&one);
  return all;
}

bool WhyFound::is_found() const {
  return differences.empty() ? !because.empty() || !sign.empty() : minimal && !cause().empty();
}

std::optional<WhyFound> find_why(const WhyRequest& request, Problems& problems, const Progress& progress) {
  auto side = read_side(request.run, problems);
  auto good = request.good.empty() ? std::nullopt : read_side(request.good, problems);
  if (!problems.empty()) return {};
  WhyFound found;
  found.run = request.run.string();
  found.good = request.good.string();
  found.budget = request.budget;
  FailedRun run;
  const bool from_folder = side->is_folder();
  const auto scenario_file = side->file;
  if (from_folder) {
    auto told = read_run(request.run, problems);
    if (!problems.empty() || !check_of(request, told.outcome, false, problems)) return {};
    run.outcome = std::move(told.outcome);
    run.recording = std::move(told.recording);
    run.scenario = scenario::read_scenario_text(side->text, side->file, {}, problems);
  }
  if (from_folder && !good) {
    tell_alone(run, *check_of(request, run.outcome, false, problems), found);
    return found;
  }
  if (!good) good = *side;
  const Mixture mixture(std::move(*good), std::move(*side));
  if (!request.good.empty() && mixture.differences().empty()) {
    problems.push_back({"why.no-difference"_code, "--good", 1, 1,
                        "the two do not differ in what they are made of",
                        "name a run or scenario that passes; programs are read as they are now"});
    return {};
  }
  progress("running what failed", 0);
  {
    const auto channels = mixture.channels();
    MixedRun again(mixture.with(all_of(mixture)), &channels);
    if (!again.problems().empty()) {
      problems.insert(problems.end(), again.problems().begin(), again.problems().end());
      return {};
    }
    auto outcome = again.run();
    if (!check_of(request, outcome, from_folder, problems)) return {};
    run.outcome = std::move(outcome);
    run.recording = again.simulation().take_recording();
    Problems none_new;  // it has just been run
    run.scenario =
        scenario::read_scenario_text(mixture.with(all_of(mixture)).text, scenario_file, {}, none_new);
  }
  const auto check = check_of(request, run.outcome, from_folder, problems).value();
  if (request.good.empty()) {
    found.runs = 1;
    tell_alone(run, check, found);
    return found;
  }
  MixedTrials trials(mixture, check, request.budget, request.jobs, [&](int runs) {
    progress("looking for the difference", static_cast<double>(runs) / request.budget);
  });
  trials.take();  // the run above
  if (const auto came = trials.run({{}}); came.empty() || came.front() != TrialCame::passed) {
    const auto* trial = trials.find({});
    problems.push_back({"why.not-good"_code, request.good.string(), 1, 1,
                        fmt::format("it fails, too{}{}", trial == nullptr || trial->note.empty() ? "" : ": ",
                                    trial == nullptr ? "" : trial->note),
                        "name a run or scenario that passes"});
    return {};
  }
  compare_with_good(request, mixture, run, check, trials, found, progress);
  found.runs = trials.runs();
  add_findings(found);
  return found;
}

}  // namespace drycut::sim::studies
