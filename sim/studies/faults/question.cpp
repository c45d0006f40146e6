#include "sim/studies/faults/question.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/text.hpp"
#include "sim/loop/guests.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/faults/bench.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double unsteady = 0.2;  ///< a cycle that differs more from the one before is none

Problem of_file(const FaultQuestion& question, Code code, std::string what, std::string remedy) {
  return {code, question.file.string(), 1, 1, std::move(what), std::move(remedy)};
}

/// The checks that say what good product is; nothing else is left of the scenario that takes time.
void keep_product(scenario::Scenario& scenario) {
  const auto& named = scenario.faults.product;
  std::erase_if(scenario.checks, [&](const scenario::CheckRequest& check) {
    const auto& event = check.event.text;
    if (named.empty())
      return check.kind != scenario::CheckRequest::Kind::each ||
             (event != plants::cut_event && !event.ends_with(fmt::format(".{}", plants::cut_event)));
    return std::ranges::none_of(named, [&](const auto& name) { return name.text == check.name.text; });
  });
  for (auto& check : scenario.checks) check.at_least = 0;  // a branch has few
  scenario.scene.title.clear();
  scenario.pictures = {};
  scenario.record.channels.clear();
  scenario.drives.judge = false;
}

/// A steady cycle of the machine, late in the run, so that its branches end before the run does if they can.
class CycleSearch {
 public:
  CycleSearch(FaultQuestion& question, const std::vector<FaultBench::Happened>& seen)
      : question_(question), scenario_(*question.scenario), seen_(seen) {
    for (const auto& check : scenario_.checks) from_ = std::max(from_, check.from);
  }

  void run() {
    std::map<std::string, std::vector<double>> cuts;
    for (const auto& event : seen_)
      if (event.event == plants::cut_event) cuts[event.source].push_back(event.at);
    // The slowest, so that all that goes on is in one of its cycles.
    double longest = 0;
    for (const auto& [source, times] : cuts) {
      const double mean = (times.back() - times.front()) / static_cast<double>(times.size());
      if (question_.cutter.empty() || mean > longest) question_.cutter = source;
      longest = std::max(longest, mean);
    }
    const Time step = scenario_.scene.step;
    if (scenario_.drives.cycle > 0)
      named(scenario_.drives.cycle);
    else if (!question_.cutter.empty())
      between_cuts(cuts[question_.cutter]);
    question_.begin -= question_.begin % step;
    question_.cycle -= question_.cycle % step;
  }

 private:
  [[nodiscard]] Time behind(Time cycle) const { return scenario_.faults.within + cycles_behind * cycle; }

  void named(Time cycle) {
    const Time end = scenario_.scene.duration;
    question_.cycle = cycle;
    question_.begin = std::max({from_, end / 2, end - behind(cycle) - cycle});
    if (question_.begin + cycle > end) question_.begin = std::max(from_, end - cycle);
  }

  void between_cuts(const std::vector<double>& cuts) {
    const auto time = [](double at) { return static_cast<Time>(std::llround(at * 1e9)); };
    bool whole = false;  // its branches end before the run
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double length = cuts[i + 1] - cuts[i];
      const bool even = i == 0 || std::abs(length - (cuts[i] - cuts[i - 1])) <= unsteady * length;
      if (!even || time(cuts[i]) < from_) continue;
      const bool fits = time(cuts[i + 1]) + behind(time(length)) <= scenario_.scene.duration;
      if (whole && !fits) continue;
      whole = fits;
      question_.begin = time(cuts[i]);
      question_.cycle = time(length);
    }
  }

  FaultQuestion& question_;
  const scenario::Scenario& scenario_;
  const std::vector<FaultBench::Happened>& seen_;
  Time from_ = 0;  ///< product is not looked at before
};

void spread(FaultQuestion& question) {
  const auto& scene = question.scenario->scene;
  const bool cycles = question.cycle > 0;
  const Time begin = cycles ? question.begin : scene.duration / 2 / scene.step * scene.step;
  const Time length = cycles
                          ? question.cycle
                          : std::max(scene.duration - question.scenario->faults.within - begin, scene.step);
  for (int i = 0; i < question.moments; ++i) {
    FaultMoment moment;
    moment.at = begin + length / scene.step * i / question.moments * scene.step;
    if (cycles) {
      moment.phase = 100.0 * i / question.moments;
      moment.name = fmt::format("{:.4g} %", *moment.phase);
    } else {
      moment.name = record::seconds_text(moment.at) + " s";
    }
    question.when.push_back(std::move(moment));
  }
}

/// One of each kind of event: in the cycle, else the last before it, else the first behind it. The fault
/// comes in the step behind it.
void add_events(FaultQuestion& question, const std::vector<FaultBench::Happened>& seen) {
  const Time begin = question.begin;
  const Time end = question.begin + question.cycle;
  std::map<std::string, Time> kinds;
  for (const auto& event : seen) {
    if (event.source == "timeline") continue;
    const auto name = event.source + "." + event.event;
    const auto [known, fresh] = kinds.emplace(name, event.time);
    const bool later_is_better = known->second < begin && event.time < end;
    if (!fresh && later_is_better) known->second = event.time;
  }
  for (const auto& [name, time] : kinds) {
    FaultMoment moment;
    moment.name = "at " + name;
    moment.at = time + question.scenario->scene.step;
    question.when.push_back(std::move(moment));
  }
}

void set_ends(FaultQuestion& question) {
  const auto& scenario = *question.scenario;
  for (auto& moment : question.when)
    moment.until = question.cycle > 0 ? std::max(moment.at, question.begin) + scenario.faults.within +
                                            cycles_behind * question.cycle
                                      : std::max(moment.at + scenario.faults.within, scenario.scene.duration);
}

/// Whether something is wired to what a fault acts at; what is no plug is there anyway.
bool acts_at_something(loop::Simulation& simulation, const scenario::Scenario& scenario,
                       const std::string& component) {
  const bool is_plug = std::ranges::any_of(simulation.plants(), [&](const loop::NamedPlant& named) {
    return std::ranges::any_of(named.plant->ports(), [&](const plants::Port& port) {
      return component == named.name + "." + port.name;
    });
  });
  return !is_plug || std::ranges::any_of(scenario.wiring, [&](const scenario::Wire& wire) {
    return wire.plug.text == component || wire.plug.text.starts_with(component + ".");
  });
}

void find_faults(FaultQuestion& question, loop::Simulation& simulation, Problems& problems) {
  std::vector<std::string> names;
  std::vector<std::string> idle;
  const auto matches = [&](const std::string& name) {
    return question.only.empty() || std::ranges::any_of(question.only, [&](const std::string& pattern) {
             return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
           });
  };
  for (const auto* list : {&simulation.names().faults(), &simulation.names().faults_of_wires()})
    for (const auto& [component, fault] : *list) {
      if (fault.strong == 0) continue;
      TriedFault tried{component, fault.name, fault.strong, std::string(fault.unit)};
      names.push_back(tried.full());
      if (!matches(tried.full())) continue;
      if (acts_at_something(simulation, *question.scenario, component))
        question.faults.push_back(std::move(tried));
      else
        idle.push_back(tried.full());
    }
  if (!idle.empty())
    question.notes.emplace_back(
        "faults.not-tried"_code,
        fmt::format("not tried, for nothing is wired there: {}", fmt::join(idle, ", ")));
  for (const auto& pattern : question.only)
    if (std::ranges::none_of(
            names, [&](const std::string& name) { return fnmatch(pattern.c_str(), name.c_str(), 0) == 0; }))
      problems.push_back({"study.unknown-name"_code, "--only", 1, 1,
                          fmt::format("no fault of the line matches '{}'", pattern),
                          did_you_mean(pattern, names, "such as \"knife.encoder.*\" or \"wire.*\"")});
  if (question.faults.empty() && problems.empty())
    problems.push_back(of_file(question, "faults.not-tried"_code,
                               "the line offers no fault that could be tried",
                               "wire its plants, or see drycut plants"));
}

/// Runs on without a fault to the end of the last branch: what fails there fails on its own.
void judge_base(FaultQuestion& question, FaultBench& bench, scenario::Scenario& scenario,
                Problems& problems) {
  Time end = 0;
  for (const auto& moment : question.when) end = std::max(end, moment.until);
  if (!bench.run_to(end)) {
    problems.push_back(of_file(question, "faults.failed-before"_code,
                               "the simulation fails without a fault: " + bench.simulation().failure(),
                               "make the scenario run first"));
    return;
  }
  std::vector<double> cuts;
  for (const auto& event : bench.seen()) {
    if (event.severity == Severity::damage) question.known_damage.insert(event.source + "." + event.event);
    if (event.source == question.cutter && event.event == plants::cut_event) cuts.push_back(event.at);
  }
  for (const auto& name : question.known_damage)
    question.notes.emplace_back("faults.failed-before"_code,
                                fmt::format("{} happens without a fault: it is not counted", name));
  for (auto& moment : question.when)
    moment.cuts = std::ranges::any_of(cuts, [&](double at) {
      return at > seconds(moment.until - cycles_behind * question.cycle) && at < seconds(moment.until);
    });
  std::vector<std::string> failed;
  for (const auto& check : bench.product())
    if (!check.passed && check.failed_at) {
      failed.push_back(check.name);
      question.notes.emplace_back(
          "faults.failed-before"_code,
          fmt::format("check '{}' fails without a fault, at {:.6g} s: it says nothing here", check.name,
                      *check.failed_at));
    }
  std::erase_if(scenario.checks, [&](const scenario::CheckRequest& check) {
    return std::ranges::find(failed, check.name.text) != failed.end();
  });
  if (scenario.checks.empty())
    problems.push_back(of_file(question, "faults.failed-before"_code,
                               "every check of the product fails without a fault: " + listed(failed),
                               "make the scenario pass first, or name other checks under faults.product"));
}

void keep_states(FaultQuestion& question, Problems& problems) {
  FaultBench bench(*question.scenario, problems);
  std::vector<std::size_t> order(question.when.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return question.when[i].at; });
  for (const auto i : order) {
    bench.run_to(question.when[i].at);
    question.when[i].state = bench.simulation().save();
  }
}

}  // namespace

std::string TriedFault::quantity() const {
  return fmt::format("{:.12g}{}{}", scenario::from_si(value, unit), unit.empty() ? "" : " ", unit);
}

void prepare(FaultQuestion& question, Problems& problems) {
  auto read = std::make_shared<scenario::Scenario>(
      scenario::read_scenario_text(question.text, question.file, question.set, problems));
  loop::refuse_guests_without_state(
      *read, "drycut faults goes on from moments; put a fault into the timeline of a run", problems);
  if (!problems.empty()) return;
  keep_product(*read);
  question.scenario = read;
  if (read->checks.empty()) {
    problems.push_back(of_file(question, "faults.no-product"_code, "no check looks at each cut",
                               "write one, or name checks: faults: {product: [cut length]}"));
    return;
  }
  {
    FaultBench bench(*read, problems);
    if (!problems.empty()) return;
    find_faults(question, bench.simulation(), problems);
    if (!problems.empty()) return;
    bench.run_to(read->scene.duration);
    CycleSearch(question, bench.seen()).run();
    if (question.cycle == 0)
      question.notes.emplace_back("faults.no-cycle"_code,
                                  "the line has no steady cycle from cut to cut and drives.cycle is not "
                                  "named: moments are spread over "
                                  "the last half of the run, and a line that stands still is not noticed");
    else if (question.cycle / read->scene.step < question.moments)
      problems.push_back({"study.out-of-range"_code, "--moments", 1, 1,
                          fmt::format("{} moments in a cycle of {} steps", question.moments,
                                      question.cycle / read->scene.step),
                          "at most as many as steps"});
    spread(question);
    if (question.at_events) add_events(question, bench.seen());
    set_ends(question);
    if (question.cells() > most_cells)
      problems.push_back({"study.out-of-range"_code, "--moments", 1, 1,
                          fmt::format("{} faults at {} moments are {} cells", question.faults.size(),
                                      question.when.size(), question.cells()),
                          fmt::format("at most {}: fewer --moments, or --only some faults", most_cells)});
    if (problems.empty()) judge_base(question, bench, *read, problems);
  }
  if (problems.empty()) keep_states(question, problems);
}

}  // namespace drycut::sim::studies
