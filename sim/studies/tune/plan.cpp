#include "sim/studies/tune/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/file.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/tune/patch.hpp"
#include "sim/studies/tune/trials.hpp"

namespace drycut::sim::studies {

namespace {

void read_cases(const TuneRequest& request, Study& study, Problems& problems) {
  for (const auto& file : request.scenarios)
    if (auto text = read_file(file, problems)) study.cases.push_back({file, std::move(*text), {}});
}

void read_from(const TuneRequest& request, Study& study, Problems& problems) {
  const auto from = scenario::parse_quantity(request.from);
  if (!from || !(from->number >= 0) || !scenario::is_unit(from->unit) ||
      !scenario::same_dimension(from->unit, "s") || scenario::to_si(from->number, from->unit) > 1e9) {
    problems.push_back(
        {"option.value"_code, "--from", 1, 1, fmt::format("'{}' is no time", request.from), "such as 3 s"});
  } else {
    study.from = std::llround(scenario::to_si(from->number, from->unit) * 1e9);
  }
}

void read_parameters(const std::vector<std::string>& texts, const std::string& option, bool relative,
                     TunedParameters& parameters, Problems& problems) {
  const auto add = [&](TunedParameter parameter) {
    const bool twice = std::any_of(parameters.begin(), parameters.end(),
                                   [&](const TunedParameter& p) { return p.path == parameter.path; });
    if (twice) {
      problems.push_back({"study.twice"_code, option, 1, 1, parameter.path + " is given twice", "keep one"});
    } else {
      parameters.push_back(std::move(parameter));
    }
  };
  for (const auto& text : texts) {
    if (relative && names_fit(text)) {
      for (auto& limit : limits_of_fit(text, option, given_paths(texts), problems)) add(std::move(limit));
    } else if (auto parameter = parse_parameter(text, option, relative, problems)) {
      add(std::move(*parameter));
    }
  }
}

/// --spread PATH=±30% around what the scenario says.
bool place_relative(TunedParameter& parameter, std::optional<double> present, Problems& problems) {
  if (!parameter.relative) return true;
  if (!present || *present == 0) {
    problems.push_back({"study.argument"_code, parameter.option, 1, parameter.low_column,
                        fmt::format("{} has no value to spread around", parameter.path),
                        "give a range LO..HI, or a quantity that is not 0"});
    return false;
  }
  const double size = std::abs(*present) * *parameter.relative;
  parameter.low = *present - size;
  parameter.high = *present + size;
  if (parameter.integer) {
    parameter.low = std::rint(parameter.low);
    parameter.high = std::rint(parameter.high);
  }
  return true;
}

/// Both ends of the range must be values that the scenario takes.
void try_bounds(const TunedParameter& parameter, const Study& study, const Study::Case& entry,
                Problems& problems) {
  for (const bool upper : {false, true}) {
    auto overrides = study.set;
    overrides.push_back({parameter.path, value_text(parameter, upper ? parameter.high : parameter.low)});
    Problems own;
    const auto scenario = scenario::read_scenario_text(entry.text, entry.file, overrides, own);
    if (own.empty()) const loop::Simulation probe(scenario, own);
    for (auto& problem : own) {
      problem.file = parameter.option;
      problem.line = 1;
      problem.column = upper ? parameter.high_column : parameter.low_column;
      if (!problem.what.starts_with(parameter.path)) problem.what = parameter.path + ": " + problem.what;
      const bool told = std::any_of(problems.begin(), problems.end(), [&](const Problem& other) {
        return other.what == problem.what && other.file == problem.file;
      });
      if (!told) problems.push_back(std::move(problem));
    }
  }
}

void check_parameter(TunedParameter& parameter, const Study& study, PresentValue& present,
                     Problems& problems) {
  const auto told = problems.size();
  for (const auto& entry : study.cases) {
    const auto before = problems.size();
    Problems ignored;
    const auto scenario = scenario::read_scenario_text(entry.text, entry.file, study.set, ignored);
    if (!ignored.empty()) return;
    const bool bare = parameter.unit.empty() && !parameter.relative;
    auto value = present_of(parameter, study, entry, scenario);
    if (bare && scenario::needs_unit(parameter.unit)) {
      problems.push_back({"study.wrong-unit"_code, parameter.option, 1, parameter.low_column,
                          fmt::format("{} is {}, and no unit is given", parameter.path,
                                      scenario::dimension_name(parameter.unit)),
                          fmt::format("such as {}..{} {}", parameter.low, parameter.high, parameter.unit)});
      return;
    }
    if (!place_relative(parameter, value.value, problems)) return;
    if (&entry == &study.cases.front()) present = std::move(value);
    try_bounds(parameter, study, entry, problems);
    if (problems.size() == before) check_against_controller(parameter, scenario, problems);
  }
  if (problems.size() == told && parameter.integer &&
      (parameter.low != std::rint(parameter.low) || parameter.high != std::rint(parameter.high)))
    problems.push_back({"study.argument"_code, parameter.option, 1, parameter.low_column,
                        parameter.path + " is a whole number", "end the range at whole numbers"});
}

/// A program may leave a value alone only where another one is given: each is tried with the others.
void refuse_without_effect(const TunedParameters& parameters, const Study& study, Problems& problems) {
  Point low;
  for (const auto& parameter : parameters) low.push_back(parameter.low);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto scenario_with = [&](const std::string& value) {
      Problems ignored;
      auto overrides = study.set;
      for (auto& other : overrides_of(parameters, low)) overrides.push_back(std::move(other));
      overrides.push_back({parameters[i].path, value});
      return scenario::read_scenario_text(study.cases.front().text, study.cases.front().file, overrides,
                                          ignored);
    };
    refuse_overwritten(parameters[i], value_text(parameters[i], parameters[i].low),
                       value_text(parameters[i], parameters[i].high), scenario_with, problems);
  }
}

/// The present values, where all are known.
std::optional<Point> start_of(const TunePlan& plan) {
  Point point;
  for (const auto& present : plan.present) {
    if (!present.value) return {};
    point.push_back(*present.value);
  }
  return point;
}

/// Values that the program sets are known once it has run. Given to it from the start they should come to the
/// same: else it does something else where they are given, and no trial is a comparison.
void place_present(const TunePlan& plan, Trials& trials, Tuning& tuning) {
  constexpr double alike = 0.01;
  const auto point = set_by_program(plan.study, plan.vary, plan.present);
  if (!point) return;
  for (std::size_t i = 0; i < point->size(); ++i) tuning.present[i].value = (*point)[i];
  const auto& given = trials.at(trials.run("present", {*point})[0]).verdict;
  if (given.stopped || tuning.before.stopped) return;
  if (std::abs(given.metric - tuning.before.metric) > alike * std::abs(tuning.before.metric)) {
    tuning.unlike = given.metric;
    return;
  }
  tuning.start = point;
  tuning.before = given;
}

void check_budget(const TuneRequest& request, const TunePlan& plan, Problems& problems) {
  const auto split = split_of(request, plan);
  if (split.sum() <= request.budget) return;
  problems.push_back(
      {"option.out-of-range"_code, "--budget", 1, 1,
       fmt::format("{} simulated runs are too few", request.budget),
       fmt::format("at least {}: present values {}, one set of values {}{}, pictures {}", split.sum(),
                   split.present, split.search,
                   split.spread > 0 ? fmt::format(", one machine of the spread {}", split.spread) : "",
                   split.pictures)});
}

}  // namespace

TunePlan plan_tuning(const TuneRequest& request, std::vector<scenario::Override> set, Problems& problems) {
  TunePlan plan;
  plan.study.set = std::move(set);
  read_cases(request, plan.study, problems);
  read_from(request, plan.study, problems);
  plan.study.minimise = request.minimise;
  plan.study.constraints = request.constraints;
  plan.study.ignore_checks = request.ignore_checks;
  plan.study.loop = request.loop;
  check_request(plan.study.loop, problems);
  prepare(plan.study, problems);
  if (problems.empty() && !plan.study.needs_loop && !plan.study.loop.pushes && !request.loop.wire.empty())
    problems.push_back({"option.does-not-apply"_code, "--wire", 1, 1, "no constraint is on the loop",
                        "add --constraint \"phase_margin >= 45\", or leave it out"});
  read_parameters(request.vary, "--vary", false, plan.vary, problems);
  read_parameters(request.spread, "--spread", true, plan.spread, problems);
  for (const auto& parameter : plan.spread)
    for (const auto& varied : plan.vary)
      if (varied.path == parameter.path)
        problems.push_back({"option.does-not-apply"_code, "--spread", 1, 1,
                            parameter.path + " is what --vary tunes", "spread something else"});
  for (auto& parameter : plan.vary)
    check_parameter(parameter, plan.study, plan.present.emplace_back(), problems);
  for (auto& parameter : plan.spread) {
    PresentValue ignored;
    check_parameter(parameter, plan.study, ignored, problems);
  }
  if (problems.empty()) refuse_without_effect(plan.vary, plan.study, problems);
  if (problems.empty()) check_budget(request, plan, problems);
  return plan;
}

RunSplit split_of(const TuneRequest& request, const TunePlan& plan) {
  const int set = plan.study.runs_of_a_trial();
  RunSplit split;
  split.present = start_of(plan) ? set : 2 * set + 1;
  split.pictures = 2 * static_cast<int>(plan.study.cases.size());
  const int left = std::max(0, request.budget - split.present - split.pictures);
  if (!plan.spread.empty()) split.spread = std::clamp(left * 3 / 10 / set, 1, request.spread_runs) * set;
  const int pair =
      2 * static_cast<int>(plan.vary.size()) * set;  // each value a little less and a little more
  split.around = std::min(left / 5 / pair, 3) * pair;
  split.search = std::max(set, left - split.spread - split.around);
  return split;
}

std::vector<std::string> Tuned::lost() const {
  auto lost = trials->lost();
  if (spread) lost.insert(lost.end(), spread->lost().begin(), spread->lost().end());
  return lost;
}

Tuned tune(const TunePlan& plan, const TuneRequest& request, const cluster::Workers& workers,
           OutputFolder& folder, const TuneProgress& progress) {
  folder.begin_aside({evaluations_file, spread_file});
  const auto& study = plan.study;
  const auto split = split_of(request, plan);
  auto trials = std::make_unique<Trials>(
      study, plan.vary, std::vector<scenario::Override>{}, folder.add(evaluations_file), workers,
      [&](int runs) { progress("tuning", std::min(1.0, static_cast<double>(runs) / request.budget)); });
  Tuning tuning{.study = study,
                .trials = *trials,
                .present = plan.present,
                .start = start_of(plan),
                .budget = request.budget,
                .spread_asked = request.spread_runs};

  // The present values first: nothing worse is to take their place.
  const bool known = tuning.start.has_value();
  tuning.before = known ? trials->at(trials->run("present", {*tuning.start})[0]).verdict : measure(study, {});
  const int aside = known ? 0 : tuning.before.runs + 1;  // runs that `trials` do not count
  if (!known) place_present(plan, *trials, tuning);
  const int in_present = aside + trials->runs();
  tuning.settled = search(*trials, trials->runs() + split.search, request.seed);
  const int in_search = trials->runs() + aside - in_present;
  tuning.unmeasurable = is_unmeasurable(*trials);
  tuning.best = trials->best();
  const auto stays = [&] { return tuning.before.rank() <= trials->at(tuning.best).verdict.rank(); };
  const bool has_centre = tuning.start || !stays();
  if (has_centre && !tuning.unmeasurable)
    tuning.slices = look_around(*trials, tuning.best, request.budget - aside - split.spread - split.pictures);
  tuning.stays = stays();
  tuning.used = {{"present values", in_present},
                 {"search", in_search},
                 {"surroundings", trials->runs() + aside - in_present - in_search}};

  const auto answer = tuning.answer();
  const auto overrides = answer ? overrides_of(plan.vary, *answer) : std::vector<scenario::Override>{};
  std::unique_ptr<Trials> spread;
  if (!plan.spread.empty() && !tuning.unmeasurable) {
    const int left = request.budget - aside - trials->runs() - split.pictures;
    const int machines = std::min(request.spread_runs, left / study.runs_of_a_trial());
    spread = std::make_unique<Trials>(
        study, plan.spread, overrides, folder.add(spread_file), workers,
        [&](int runs) { progress("spreading", std::min(1.0, static_cast<double>(runs) / left)); });
    spread->run("spread",
                latin_hypercube(plan.spread, machines, plants::Random(request.seed, "drycut tune spread")));
    tuning.spread = spread.get();
    tuning.used.emplace_back("spread", spread->runs());
  }
  const bool has_report = request.pictures && !tuning.after().stopped && !tuning.unmeasurable;
  if (has_report) tuning.used.emplace_back("pictures", split.pictures);
  write_file(folder.add(patch_file), patch_text(tuning));
  if (has_report) {
    for (const auto& entry : study.cases) {
      tuning.runs_before.push_back(keep_run(study, entry, {}));
      tuning.runs_after.push_back(keep_run(study, entry, overrides));
    }
    write_tuning_report(tuning, folder);
  }
  Tuned tuned{std::move(trials), std::move(spread), has_report, std::move(tuning)};
  auto verdict = verdict_of(tuned.found);
  if (!tuned.lost().empty()) verdict.stopped();
  tuned.exit = verdict.exit;
  record::write_verdict(std::move(verdict), folder);
  folder.finish();
  return tuned;
}

}  // namespace drycut::sim::studies
