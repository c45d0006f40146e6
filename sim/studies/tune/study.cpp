#include "sim/studies/tune/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace drycut::sim::studies {

namespace {

struct Gauge {
  std::string option;  ///< "--minimise", "--constraint"
  std::string text;
  Metric metric;
};

/// Metric first, then the constraints.
std::vector<Gauge> gauges(const Study& study, const Study::Case& scenario, Problems& problems) {
  std::vector<Gauge> made;
  const auto add = [&](const std::string& option, const std::string& text, Metric::Kind kind) {
    std::vector<scenario::ExpressionFault> faults;
    auto metric = Metric::compile(text, kind, scenario.events, faults,
                                  [&](const std::string& channel) -> std::optional<std::string> {
                                    const auto found = scenario.units.find(channel);
                                    if (found == scenario.units.end()) return {};
                                    return found->second;
                                  });
    for (auto& fault : faults)
      problems.push_back(
          {fault.code, option, 1, static_cast<int>(fault.offset) + 1, fault.what, fault.remedy});
    if (metric) made.push_back({option, text, std::move(*metric)});
  };
  add("--minimise", study.minimise, Metric::Kind::number);
  for (const auto& text : study.constraints) add("--constraint", text, Metric::Kind::limit);
  return made;
}

/// Records what the gauges look at; a channel that does not exist is told at its place in the gauge.
void record_names(scenario::Scenario& scenario, const std::vector<Gauge>& all) {
  for (const auto& gauge : all) {
    const auto source = static_cast<int>(scenario.sources.size());
    scenario.sources.push_back(gauge.option);
    for (const auto& name : gauge.metric.names()) {
      if (!name.event.empty()) continue;
      const scenario::ScenePlace place{1, static_cast<int>(name.offset) + 1, source};
      scenario.record.channels.push_back({name.text, place});
    }
  }
}

/// A scenario of the study, ready to run: only what is measured is recorded, nothing is drawn.
scenario::Scenario read_case(const Study& study, const Study::Case& scenario,
                             const std::vector<scenario::Override>& overrides, Problems& problems) {
  auto all = study.set;
  all.insert(all.end(), overrides.begin(), overrides.end());
  auto read = scenario::read_scenario_text(scenario.text, scenario.file, all, problems);
  read.pictures = {};
  read.record.channels.clear();
  return read;
}

/// How far beyond, between 0 and 1: units differ from limit to limit.
double beyond(double room) { return room < 0 ? -room / (1 - room) : 0; }

/// What a margin that could not be measured counts: a broken limit, half way between nearly kept and grossly
/// broken, for it may be either.
constexpr double unmeasured = 1.5;
/// A loop that is not stable is beyond every margin.
constexpr double grossly_broken = 2;

void stop(Verdict& verdict, std::string why) {
  verdict.stopped = true;
  if (verdict.note.empty()) verdict.note = std::move(why);
}

void judge_checks(const record::Outcome& outcome, Verdict& verdict) {
  for (const auto& check : outcome.checks) {
    if (check.passed) continue;
    ++verdict.failed_checks;
    verdict.violation += 1 + beyond(check.margin.value_or(-1));
    if (verdict.note.empty()) verdict.note = fmt::format("check '{}' fails", check.name);
  }
}

void judge_limit(const Gauge& gauge, double room, double& worst, Verdict& verdict) {
  worst = std::isnan(worst) ? room : std::min(worst, room);
  if (room >= 0) return;
  verdict.violation += 1 + beyond(room);
  if (!verdict.note.empty()) return;
  const auto unit = gauge.metric.unit();
  verdict.note = fmt::format("{} is missed by {:.4g}{}{}", gauge.text, -room, unit.empty() ? "" : " ", unit);
}

/// Takes what pushes have found: values that hunt after one are beyond every limit.
void judge_pushes(const std::optional<HuntingPoint>& hunting, Verdict& verdict) {
  if (!hunting) return;
  verdict.runs += 2;
  if (!hunting->failure.empty()) return;
  const double from = hunting->from.value_or(std::numeric_limits<double>::infinity());
  verdict.hunts_from = std::isnan(verdict.hunts_from) ? from : std::min(verdict.hunts_from, from);
  if (!hunting->hunts_now()) return;
  verdict.violation += grossly_broken;
  if (verdict.note.empty())
    verdict.note = fmt::format("it hunts after a push: {}, {:.2g} V", hertz_text(hunting->frequency),
                               hunting->amplitude);
}

/// True if other values would not help either: the machine's own motion or its play hides a quarter of the
/// answer. They may close a loop that is open, need less of the output, or make an answer heard here and
/// there.
bool is_hopeless(const LoopResult& result) {
  const auto& points = result.sweep.points;
  if (!result.sweep.failure.empty()) return false;
  if (result.sweep.loop == Sweep::Loop::open) return !result.play.empty();
  if (result.sweep.loop != Sweep::Loop::closed) return false;
  const auto hidden = std::count_if(points.begin(), points.end(), [](const BodePoint& point) {
    return !point.saturated && (point.silent || !(point.doubt() <= bode_error_limit));
  });
  return 4 * hidden > static_cast<std::ptrdiff_t>(points.size());
}

/// Measures the loop and judges the constraints on it.
void judge_loop(const Study& study, const scenario::Scenario& scenario, std::vector<Gauge>& all,
                const record::Recording& recording, Verdict& verdict) {
  Problems problems;
  const auto loop = measure_loop(scenario, study.loop, problems);
  if (!loop) return stop(verdict, to_string(problems.front()));
  verdict.runs += 2;
  judge_pushes(loop->hunting, verdict);
  if (!verdict.feasible()) return;
  const auto doubts = loop_doubts(*loop);
  if (!doubts.empty()) {
    const auto& sweep = loop->sweep;
    const bool always_at_limit =
        !sweep.points.empty() && std::all_of(sweep.points.begin(), sweep.points.end(),
                                             [](const BodePoint& point) { return point.saturated; });
    const bool wild =
        sweep.loop == Sweep::Loop::unstable || sweep.loop == Sweep::Loop::runaway || always_at_limit;
    verdict.violation += wild ? grossly_broken : unmeasured;
    verdict.doubtful = is_hopeless(*loop);
    verdict.note = to_string(doubts.front());
    return;
  }
  LoopFigures figures;
  const auto& margins = loop->margins;
  if (margins.phase) figures.phase_margin = margins.phase->value;
  if (const auto gain = loop->least_gain()) figures.gain_margin = gain->value;
  if (margins.sensitivity) figures.max_sensitivity = margins.sensitivity->value;
  for (std::size_t i = 0; i < verdict.room.size(); ++i) {
    auto& gauge = all[i + 1];
    if (!gauge.metric.needs_loop()) continue;
    const double room = gauge.metric.value(recording, study.from, figures);
    if (!std::isnan(room)) {
      judge_limit(gauge, room, verdict.room[i], verdict);
      continue;
    }
    verdict.violation += unmeasured;
    if (!verdict.note.empty()) continue;
    const bool untold = loop->hunting && !loop->hunting->failure.empty();
    verdict.note = untold ? fmt::format("{} with {}: {}", gauge.text, loop->play, loop->hunting->failure)
                          : "not met between the measured frequencies: " + gauge.text;
  }
}

void measure_case(const Study& study, const Study::Case& entry,
                  const std::vector<scenario::Override>& overrides, double to_beat, Verdict& verdict) {
  Problems problems;
  auto scenario = read_case(study, entry, overrides, problems);
  auto all = gauges(study, entry, problems);
  record_names(scenario, all);
  if (!scenario.buildable || !problems.empty())
    return stop(verdict, problems.empty() ? "cannot be built" : to_string(problems.front()));
  loop::Simulation simulation(scenario, problems);
  if (!problems.empty()) return stop(verdict, to_string(problems.front()));
  ++verdict.runs;
  std::vector<Metric*> metrics;
  for (auto& gauge : all) metrics.push_back(&gauge.metric);
  MetricSteps steps(simulation, metrics, study.from);
  const auto outcome = simulation.run();
  if (!outcome.failure.empty()) return stop(verdict, outcome.failure);
  const auto& recording = simulation.recording();
  const double metric = all[0].metric.value(recording, study.from);
  if (!std::isfinite(metric)) return stop(verdict, fmt::format("no number for {}", study.minimise));
  verdict.metric = std::isnan(verdict.metric) ? metric : std::max(verdict.metric, metric);
  for (std::size_t i = 0; i < verdict.room.size(); ++i) {
    auto& gauge = all[i + 1];
    if (gauge.metric.needs_loop()) continue;
    const double room = gauge.metric.value(recording, study.from);
    if (std::isnan(room)) return stop(verdict, fmt::format("no number for {}", gauge.text));
    judge_limit(gauge, room, verdict.room[i], verdict);
  }
  if (!study.ignore_checks) judge_checks(outcome, verdict);
  if (!verdict.feasible() || !(verdict.metric < to_beat)) return;
  if (study.needs_loop) return judge_loop(study, scenario, all, recording, verdict);
  if (study.loop.pushes) judge_pushes(push_loop(scenario, study.loop, 0, problems), verdict);
}

}  // namespace

bool Verdict::unmeasured() const {
  return !stopped && violation > 0 && failed_checks == 0 && !(hunts_from <= 1) &&
         std::none_of(room.begin(), room.end(), [](double left) { return left < 0; });
}

double Verdict::rank() const {
  if (stopped) return std::numeric_limits<double>::max();
  if (violation > 0) return 2 + violation;
  return metric / (1 + std::abs(metric));  // monotone, in (-1, 1)
}

Verdict measure(const Study& study, const std::vector<scenario::Override>& overrides, double to_beat) {
  Verdict verdict;
  verdict.metric = std::numeric_limits<double>::quiet_NaN();
  verdict.room.assign(study.constraints.size(), std::numeric_limits<double>::quiet_NaN());
  for (const auto& scenario : study.cases) measure_case(study, scenario, overrides, to_beat, verdict);
  return verdict;
}

KeptRun keep_run(const Study& study, const Study::Case& entry,
                 const std::vector<scenario::Override>& overrides) {
  Problems problems;
  auto scenario = read_case(study, entry, overrides, problems);
  record_names(scenario, gauges(study, entry, problems));
  if (!problems.empty() || !scenario.buildable)
    throw std::runtime_error(problems.empty() ? "cannot be built" : to_string(problems.front()));
  loop::Simulation simulation(scenario, problems);
  if (!problems.empty()) throw std::runtime_error(to_string(problems.front()));
  KeptRun kept;
  kept.outcome = simulation.run();
  kept.recording = simulation.take_recording();
  kept.expanded = scenario::expand(scenario);
  return kept;
}

std::vector<MetricName> names_of(const Study& study, const Study::Case& scenario) {
  Problems ignored;
  std::vector<MetricName> names;
  for (const auto& gauge : gauges(study, scenario, ignored))
    for (const auto& name : gauge.metric.names())
      if (std::none_of(names.begin(), names.end(), [&](const MetricName& n) { return n.text == name.text; }))
        names.push_back(name);
  return names;
}

void prepare(Study& study, Problems& problems) {
  study.loop.pushes = false;
  for (auto& entry : study.cases) {
    // As it stands first: everything that is wrong with the scenario itself.
    const auto before = problems.size();
    const auto scenario = scenario::read_scenario_text(entry.text, entry.file, study.set, problems);
    if (!scenario.buildable) continue;
    const loop::Simulation simulation(scenario, problems);
    entry.events = simulation.known_events();
    if (problems.size() != before) continue;
    if (study.from >= scenario.scene.duration)
      problems.push_back(
          {"option.out-of-range"_code, "--from", 1, 1,
           fmt::format("{} s is not before the end of {}", seconds(study.from), entry.file.string()),
           fmt::format("the scenario lasts {} s", seconds(scenario.scene.duration))});
    auto measured = read_case(study, entry, {}, problems);
    Problems of_gauges;
    const auto all = gauges(study, entry, of_gauges);
    record_names(measured, all);
    const loop::Simulation probe(measured, of_gauges);
    for (const auto& column : probe.recording().columns()) entry.units[column.name] = column.unit;
    if (of_gauges.empty()) {  // now that units are known
      const auto known = gauges(study, entry, of_gauges);
      if (of_gauges.empty() && &entry == &study.cases.front()) {
        study.metric_unit = known.front().metric.unit();
        for (auto gauge = known.begin() + 1; gauge != known.end(); ++gauge)
          study.room_units.push_back(gauge->metric.unit());
      }
    }
    study.needs_loop = study.needs_loop || std::any_of(all.begin(), all.end(), [](const Gauge& gauge) {
                         return gauge.metric.needs_loop();
                       });
    if (study.needs_loop && of_gauges.empty()) check_loop(measured, study.loop, of_gauges);
    if (const auto wire = wire_of(measured, study.loop)) entry.play = play_of(measured, *wire);
    study.loop.pushes = study.loop.pushes || !entry.play.empty();
    for (auto& problem : of_gauges)
      if (std::none_of(problems.begin(), problems.end(),
                       [&](const auto& told) { return to_string(told) == to_string(problem); }))
        problems.push_back(std::move(problem));
  }
}

}  // namespace drycut::sim::studies
