// A run that goes on from a kept moment: of the same run, or of one from which it branches.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/cli/arguments.hpp"
#include "sim/cli/run_work.hpp"
#include "sim/live/session.hpp"
#include "sim/loop/names.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/format.hpp"
#include "sim/studies/why/differences.hpp"

namespace drycut::sim::cli {

namespace {

namespace fs = std::filesystem;

std::optional<Time> read_span(const std::string& text, int column, const std::string& name,
                              scenario::Sign sign, Problems& problems) {
  scenario::Findings findings({name});
  const auto time = scenario::read_time({text, {1, column, 0}, {}}, name, sign, findings);
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  return time;
}

/// "out/x@12.5 s": a run's folder and a time; without one its end.
struct Branch {
  fs::path run;
  Time at = never;
};

/// The folder of a run, or a problem of `option`.
bool is_run(const fs::path& run, const std::string& name, const std::string& option, Problems& problems) {
  if (file_exists(run / report::scenario_file) || folder_exists(run / loop::states_folder)) return true;
  const auto inside = run / name;
  problems.push_back({"record.no-run"_code, option, 1, 1,
                      folder_exists(run) ? fmt::format("{} is not the folder of a run", run.string())
                                         : fmt::format("there is no folder {}", run.string()),
                      !name.empty() && file_exists(inside / report::scenario_file)
                          ? fmt::format("did you mean {}?", inside.string())
                          : "name a folder that drycut run made, such as out/rotary_knife"});
  return false;
}

std::optional<Branch> read_branch(const std::string& text, Problems& problems) {
  const auto mark = text.rfind('@');
  if (mark == std::string::npos || fs::exists(text)) return Branch{text};
  if (mark + 1 == text.size()) {
    problems.push_back({"option.value"_code, "--from", 1, static_cast<int>(mark) + 2,
                        "there is no time behind @", fmt::format("such as --from \"{}12.5 s\"", text)});
    return {};
  }
  const auto at = read_span(text.substr(mark + 1), static_cast<int>(mark) + 2, "--from",
                            scenario::Sign::not_negative, problems);
  if (!at) return {};
  return Branch{text.substr(0, mark), *at};
}

std::optional<loop::KeptMoment> moment_of(const fs::path& run, Time until, std::vector<Finding>& notes) {
  std::vector<std::string> damaged;
  auto moment = loop::kept_moment(run, until, damaged);
  for (auto& text : damaged) notes.emplace_back("state.damaged"_code, std::move(text));
  return moment;
}

std::string at(Time time) { return record::seconds_text(time) + " s"; }

/// The moment as the simulation has it, with what it has recorded since.
loop::KeptMoment moment_now(loop::Simulation& simulation, const StateArchive::Bytes& journal) {
  auto next = StateArchive::going_on(journal);
  loop::KeptMoment moment;
  moment.state = simulation.save(&next);
  moment.head = loop::open_state(moment.state).head;
  moment.journal = journal;
  moment.journal.insert(moment.journal.end(), next.bytes.begin(), next.bytes.end());
  return moment;
}

/// Steps the run that was, from that moment or from zero, until `until`; nothing where it is no longer what
/// it was, or ended before.
std::optional<loop::KeptMoment> stepped_to(const scenario::Scenario& scenario, bool pictures,
                                           const loop::KeptMoment* from, Time until) {
  Problems problems;
  loop::Simulation was(scenario, problems);
  if (!problems.empty()) return {};
  if (from != nullptr && !from->head.origin.differs_from(loop::StateOrigin(scenario)).empty()) return {};
  was.follow_cams({}, pictures);
  if (from != nullptr) was.restore(from->state, from->journal);
  while (was.time() < until)
    if (!was.advance()) return {};
  return moment_now(was, from != nullptr ? from->journal : StateArchive::Bytes());
}

/// The scenario of a run that kept a moment, or is to run again: as it ran, else as its file is now.
std::optional<scenario::Scenario> scenario_of(const fs::path& run, const loop::StateOrigin& origin) {
  std::vector<scenario::Override> overrides;
  for (const auto& [path, value] : origin.overrides) overrides.push_back({path, value});
  Problems problems;
  const auto ran = run / report::scenario_file;
  const auto text = file_exists(ran) ? read_file(ran, problems) : std::nullopt;
  auto scenario = text ? scenario::read_scenario_text(*text, origin.file, {}, problems)
                       : scenario::read_scenario(origin.file, overrides, problems);
  scenario.overrides = std::move(overrides);
  scenario.scene.seed = origin.seed;
  if (!problems.empty()) return {};
  return scenario;
}

/// What the machine and the controller take while they run is set there; of all else it is told that it
/// counts only where the run has not come to it yet.
void set_there(Job& job, const scenario::Scenario& was, Time when, Problems& problems) {
  constexpr std::string_view plants = "plants.";
  constexpr std::size_t most_told = 6;
  std::vector<std::string> set;
  std::vector<std::string> others;
  for (const auto& difference : studies::differences_between(was, job.scenario)) {
    const auto& where = difference.where;
    const auto preset = difference.preset();
    const auto name = !preset.empty()             ? preset
                      : where.starts_with(plants) ? where.substr(plants.size())
                                                  : where;
    if (difference.kind != studies::Difference::Kind::value || difference.failed.empty() ||
        !job.simulation->names().target(name)) {
      others.push_back(where);
      continue;
    }
    auto act =
        live::read_act(fmt::format("set: {{{}: {}}}", name, difference.failed), "--from", when, problems);
    if (!act) continue;
    set.push_back(fmt::format("{} = {}", name, difference.failed));
    job.then.push_back(std::move(*act));
  }
  const auto tell = [&](const std::string& what, std::vector<std::string>& list) {
    if (list.empty()) return;
    const auto more = list.size() > most_told ? list.size() - most_told : 0;
    list.resize(list.size() - more);
    job.notes.emplace_back("state.went-on"_code,
                           fmt::format("{}: {}{}", what, fmt::join(list, ", "),
                                       more > 0 ? fmt::format(" and {} more", more) : ""));
  };
  tell(fmt::format("set at {}", at(when)), set);
  tell(
      "other differences, which count from there on, where the run does not hold what has come of them "
      "already",
      others);
}

void branch_off(Job& job, const RunOptions& options, Problems& problems) {
  const auto branch = read_branch(options.from, problems);
  if (!branch || !is_run(branch->run, job.result.name, "--from", problems)) return;
  std::error_code ignored;
  if (fs::equivalent(branch->run, options.out / job.result.name, ignored)) {
    problems.push_back({"state.refused"_code, "--from", 1, 1,
                        fmt::format("the results would replace those of {}", branch->run.string()),
                        "name another folder with --out"});
    return;
  }
  if (branch->at != never && branch->at % job.scenario.scene.step != 0) {
    problems.push_back({"scenario.time-grid"_code, "--from", 1, 1,
                        fmt::format("{} is no whole number of steps", at(branch->at)),
                        "a multiple of " + scenario::format_time(job.scenario.scene.step)});
    return;
  }
  auto kept = moment_of(branch->run, branch->at, job.notes);
  const bool from_zero = !kept;
  if (from_zero && branch->at == never) {
    problems.push_back({"state.none"_code, "--from", 1, 1,
                        fmt::format("{} keeps no state", branch->run.string()),
                        R"(run it with --states "1 s", or name the time: --from "DIR@12.5 s")"});
    return;
  }
  const auto begun = from_zero ? 0 : kept->head.time;
  auto until = branch->at == never ? begun : branch->at;
  loop::StateOrigin now(job.scenario);
  now.overrides.clear();
  const auto was = scenario_of(branch->run, from_zero ? now : kept->head.origin);
  auto moment = was ? stepped_to(*was, options.pictures, from_zero ? nullptr : &*kept, until) : std::nullopt;
  if (!moment && from_zero) {
    problems.push_back({"state.none"_code, "--from", 1, 1,
                        fmt::format("{} keeps no state at {} or before, and the scenario does not run to it",
                                    branch->run.string(), at(until)),
                        "run it with --states \"1 s\""});
    return;
  }
  if (moment) {
    job.notes.emplace_back("state.went-on"_code,
                           from_zero
                               ? fmt::format("{} keeps no state at {} or before: it ran from zero to there",
                                             branch->run.string(), at(until))
                               : fmt::format("branched at {} of {}, from the state at {}", at(until),
                                             branch->run.string(), at(begun)));
  } else {
    job.notes.emplace_back("state.went-on"_code,
                           fmt::format("branched at {} of {}: its scenario or programs have changed since, "
                                       "so that it cannot be stepped on from that state to {}",
                                       at(begun), branch->run.string(), at(until)));
    moment = std::move(kept);
    until = begun;
  }
  if (until >= job.scenario.scene.duration) {
    problems.push_back({"state.refused"_code, "--from", 1, 1,
                        fmt::format("the run ends at {}", at(job.scenario.scene.duration)),
                        fmt::format("name a time before, --from \"{}@12.5 s\", or --set scene.duration",
                                    branch->run.string())});
    return;
  }
  if (was) set_there(job, *was, until, problems);
  job.from = std::move(moment);
  job.branches = true;
}

}  // namespace

void read_again(RunOptions& options, Problems& problems) {
  if (!options.states.empty())
    options.every = read_span(options.states, 1, "--states", scenario::Sign::positive, problems);
  if (options.resume.empty()) {
    if (options.scenarios.empty())
      problems.push_back({"option.missing"_code, "drycut run", 1, 1, "no scenario is named",
                          "drycut run SCENARIO.yaml, or drycut run --resume DIR"});
    if (!options.from.empty() && options.scenarios.size() > 1)
      problems.push_back({"option.does-not-apply"_code, "--from", 1, 1, "several scenarios are named",
                          "name the one that branches"});
    return;
  }
  if (!options.scenarios.empty() || !options.set.empty() || options.seed || !options.from.empty()) {
    problems.push_back({"option.does-not-apply"_code, "--resume", 1, 1,
                        "a run that goes on has its scenario, values and seed",
                        "leave them away, or branch: --from \"DIR@12.5 s\" --set ..."});
    return;
  }
  if (const auto mark = options.resume.string().rfind('@');
      mark != std::string::npos && !folder_exists(options.resume)) {
    problems.push_back(
        {"option.does-not-apply"_code, "--resume", 1, 1, "a run goes on from its last moment",
         fmt::format("leave away the time, or branch: --from \"{}\"", options.resume.string())});
    return;
  }
  if (!is_run(options.resume, "", "--resume", problems)) return;
  std::vector<Finding> ignored;  // told with the run
  const auto moment = moment_of(options.resume, never, ignored);
  if (!moment) {
    problems.push_back({"state.none"_code, "--resume", 1, 1,
                        fmt::format("{} keeps no state", options.resume.string()),
                        "name the folder of a run with --states: out/NAME"});
    return;
  }
  const auto folder = (options.resume / "").lexically_normal().parent_path();
  const auto& origin = moment->head.origin;
  options.out = folder.parent_path().empty() ? fs::path(".") : folder.parent_path();
  options.scenarios = {report::path_from_here(origin.file)};
  if (moment->head.plain) options.pictures = false;
  for (const auto& [path, value] : origin.overrides) options.set.push_back(fmt::format("{}={}", path, value));
  options.seed = origin.seed;
  if (!options.every && moment->head.every != never) options.every = moment->head.every;
  if (result_names(options.scenarios).front() != folder.filename())
    problems.push_back({"state.refused"_code, "--resume", 1, 1,
                        fmt::format("{} is not the folder of {}", options.resume.string(), origin.file),
                        "give it its name again"});
}

namespace {

/// Why a machine does not take a moment.
std::string refusal(const loop::KeptMoment& moment, const scenario::Scenario& scenario,
                    const std::string& why) {
  const auto differs = moment.head.origin.differs_from(loop::StateOrigin(scenario));
  return differs.empty() ? fmt::format("the moment at {}: {}", at(moment.head.time), why)
                         : fmt::format("the moment at {} is of another machine or program; not the same: {}",
                                       at(moment.head.time), differs);
}

}  // namespace

void go_on(Job& job, const RunOptions& options, Problems& problems) {
  if (!options.resume.empty()) {
    job.from = moment_of(options.resume, never, job.notes);
    if (job.from)
      job.notes.emplace_back("state.went-on"_code,
                             fmt::format("it went on from {}", at(job.from->head.time)));
  } else if (!options.from.empty()) {
    branch_off(job, options, problems);
  }
  if (!job.from || !problems.empty()) return;
  try {
    // Now, for to refuse it later would be too late for the results that are there.
    job.simulation->restore(job.from->state, job.from->journal, job.branches);
    for (const auto& stimulus : job.then) job.simulation->act(stimulus, problems);
  } catch (const BadState& bad) {
    problems.push_back({"state.refused"_code, options.resume.empty() ? "--from" : "--resume", 1, 1,
                        refusal(*job.from, job.scenario, bad.what()),
                        job.branches ? "branch off a run of this machine, or run from zero"
                                     : "branch, --from \"DIR@TIME\", or run from zero"});
  }
}

}  // namespace drycut::sim::cli
