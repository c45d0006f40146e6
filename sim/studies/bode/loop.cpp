#include "sim/studies/bode/loop.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "plants/power_stage.hpp"
#include "sim/loop/names.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

namespace {

void check_number(const char* option, const std::optional<double>& value, double least, double most,
                  const char* unit, Problems& problems) {
  if (!value || (*value >= least && *value <= most)) return;  // not NaN either
  problems.push_back({"option.out-of-range"_code, option, 1, 1, fmt::format("{} is out of range", *value),
                      fmt::format("give {} to {} {}", least, most, unit)});
}

/// The time of --at; nullopt if it is not given, or no time from 0 to 1e6 s.
std::optional<Time> time_of(const LoopRequest& request) {
  if (!request.at) return {};
  auto at = scenario::parse_quantity(*request.at);
  if (at && at->unit.empty()) at->unit = "s";
  if (!at || !scenario::is_unit(at->unit) || !scenario::same_dimension(at->unit, "s")) return {};
  const double time = scenario::to_si(at->number, at->unit);
  if (!(time >= 0 && time <= 1e6)) return {};
  return std::llround(time * 1e9);
}

/// The wire to measure at; nullopt and a problem if it is not clear which.
std::optional<std::size_t> choose_wire(const LoopRequest& request, const scenario::Scenario& scenario,
                                       loop::Simulation& simulation, Problems& problems) {
  const auto& wires = simulation.bus().analogue_wires();
  std::vector<std::string> plugs;
  std::string all;
  for (const auto& wire : wires) {
    plugs.push_back(wire.plug);
    all += (all.empty() ? "" : ", ") + wire.plug;
  }
  if (wires.empty()) {
    problems.push_back({"bode.no-loop"_code, scenario.file.string(), 1, 1, "no analogue output is wired",
                        "a position loop needs one, such as 2.AN01: knife.servo.reference"});
    return {};
  }
  if (request.wire.empty()) {
    if (wires.size() == 1) return 0;
    problems.push_back({"option.missing"_code, "--wire", 1, 1,
                        "the scenario has more than one analogue reference", "give one of: " + all});
    return {};
  }
  const auto found = std::find(plugs.begin(), plugs.end(), request.wire);
  if (found != plugs.end()) return static_cast<std::size_t>(found - plugs.begin());
  problems.push_back({"option.unknown-choice"_code, "--wire", 1, 1,
                      fmt::format("there is no analogue reference '{}'", request.wire),
                      "give one of: " + all});
  return {};
}

/// The channel of the motor's speed: the one asked for, or what the plant at the wire calls so.
std::string choose_speed(const LoopRequest& request, const std::string& plug, loop::Simulation& simulation,
                         Problems& problems) {
  auto& names = simulation.names();
  if (!request.speed.empty()) {
    if (names.reading(request.speed)) return request.speed;
    problems.push_back({"option.unknown-choice"_code, "--speed", 1, 1,
                        fmt::format("there is no channel '{}'", request.speed),
                        names.suggest_reading(request.speed)});
    return "";
  }
  const auto plant = plug.substr(0, plug.find('.'));
  for (const auto* channel : {".motor.speed", ".speed"})
    if (names.reading(plant + channel)) return plant + channel;
  return "";
}

/// Where and how to measure; nullopt and problems if the options do not fit the scenario.
std::optional<SweepPlan> plan_of(const LoopRequest& request, const scenario::Scenario& scenario,
                                 loop::Simulation& simulation, Problems& problems) {
  const auto before = problems.size();
  const auto wire = choose_wire(request, scenario, simulation, problems);
  if (!wire) return {};
  const auto& at_wire = simulation.bus().analogue_wires()[*wire];
  SweepPlan plan;
  plan.wire = *wire;
  plan.speed = choose_speed(request, at_wire.plug, simulation, problems);
  plan.at = start_of(scenario, request);
  plan.step = scenario.scene.step;
  plan.sampling = std::max(simulation.output_period(at_wire.terminal), plan.step);
  plan.amplitude = request.sine();
  plan.settle = request.settle.value_or(LoopRequest::usual_settle);
  const double highest = 0.5 / seconds(plan.sampling);
  const double to = request.to.value_or(highest);
  const double from = request.from.value_or(std::min(1.0, to / 100));
  check_range(from, to, plan.sampling, problems);
  const int points = request.points.value_or(LoopRequest::usual_points);
  constexpr double window = 2;     // long enough for tens of periods where a loop crosses over [s]
  constexpr double lowest = 0.02;  // a crossover below it takes minutes to measure [Hz]
  if (!request.from) plan.lowest = lowest;
  if (problems.size() == before) plan.tones = plan_tones(from, to, points, plan.sampling, window);
  return plan;
}

/// Of the oscillation that more gain would make [s], 0 = not known.
double period_of(const Margins& margins) {
  if (margins.gain) return 1 / margins.gain->frequency;
  return margins.phase ? 1 / margins.phase->frequency : 0;
}

/// What a margin in times of the gain is of.
std::string gains_of(loop::Simulation& simulation) {
  constexpr std::size_t most = 12;
  std::vector<std::string> gains;
  auto& names = simulation.names();
  for (const auto& name : names.reading_names())
    for (const auto* gain : {".pgain", ".integt", ".derivt", ".feedfw", ".kv"})
      if (name.ends_with(gain) && gains.size() < most)
        gains.push_back(fmt::format("{} {:g}", name, names.reading(name)->read()));
  return fmt::format("{}", fmt::join(gains, ", "));
}

/// The two runs and the plan for them.
struct Preparation {
  std::unique_ptr<loop::Simulation> excited;
  std::unique_ptr<loop::Simulation> still;
  std::optional<SweepPlan> plan;
};
Preparation prepare(const scenario::Scenario& scenario, const LoopRequest& request, Problems& problems) {
  const auto before = problems.size();
  Preparation prepared;
  prepared.excited = std::make_unique<loop::Simulation>(scenario, problems);
  if (problems.size() == before) prepared.plan = plan_of(request, scenario, *prepared.excited, problems);
  if (problems.size() == before) prepared.still = std::make_unique<loop::Simulation>(scenario, problems);
  for (auto* simulation : {prepared.excited.get(), prepared.still.get()})
    if (simulation != nullptr) disarm(*simulation);
  return prepared;
}

}  // namespace

void disarm(loop::Simulation& simulation) {
  for (const auto& [name, plant] : simulation.plants())
    for (const auto& drive : plant->drives()) drive.stage->disarm();
}

Time start_of(const scenario::Scenario& scenario, const LoopRequest& request) {
  return time_of(request).value_or(scenario.scene.duration);
}

std::string hertz_text(double frequency) { return fmt::format("{:.4g} Hz", frequency); }

void check_request(const LoopRequest& request, Problems& problems) {
  if (request.at && !time_of(request))
    problems.push_back({"option.out-of-range"_code, "--at", 1, 1,
                        fmt::format("'{}' is no time from 0 to 1e6 s", *request.at), "such as 6 s"});
  check_number("--settle", request.settle, 0, 1000, "s", problems);
  check_number("--amplitude", request.amplitude, 0.001, 10, "V", problems);
  check_number("--from", request.from, 0.001, 1e6, "Hz", problems);
  check_number("--to", request.to, 0.001, 1e6, "Hz", problems);
  if (request.points && (*request.points < 2 || *request.points > 1000))
    problems.push_back({"option.out-of-range"_code, "--points", 1, 1,
                        fmt::format("{} is out of range", *request.points), "give 2 to 1000"});
}

void check_range(double from, double to, Time sampling, Problems& problems) {
  const double highest = 0.5 / seconds(sampling);
  if (to > highest)
    problems.push_back(
        {"option.out-of-range"_code, "--to", 1, 1,
         fmt::format("{} Hz is above half the sampling frequency of {} ms", to, seconds(sampling) * 1000),
         fmt::format("give at most {} Hz", highest)});
  if (from >= to)
    problems.push_back({"option.out-of-range"_code, "--from", 1, 1,
                        fmt::format("{} Hz is not below --to, {} Hz", from, to), "give a lower frequency"});
}

void check_loop(const scenario::Scenario& scenario, const LoopRequest& request, Problems& problems) {
  (void)prepare(scenario, request, problems);
}

std::optional<LoopResult> measure_loop(const scenario::Scenario& scenario, const LoopRequest& request,
                                       Problems& problems, const std::function<void(double)>& progress) {
  const auto prepared = prepare(scenario, request, problems);
  if (!prepared.still) return {};
  LoopResult result;
  result.scenario = scenario.file.stem().string();
  result.file = scenario.file.filename().string();
  result.plan = *prepared.plan;
  const auto& wire = prepared.excited->bus().analogue_wires()[result.plan.wire];
  result.wire = wire.plug;
  result.terminal = wire.terminal_name;
  result.speed = result.plan.speed;
  if (!result.speed.empty()) result.speed_unit = prepared.excited->names().reading(result.speed)->unit;
  result.sweep = measure(*prepared.excited, *prepared.still, result.plan, progress);
  result.margins = margins_of(result.sweep.points);
  result.gains = gains_of(*prepared.still);
  result.play = play_of(scenario, result.wire);
  if (request.pushes && !result.play.empty() && result.sweep.failure.empty())
    result.hunting = push_loop(scenario, request, period_of(result.margins), problems);
  return result;
}

std::optional<HuntingPoint> push_loop(const scenario::Scenario& scenario, const LoopRequest& request,
                                      double period, Problems& problems) {
  const auto prepared = prepare(scenario, request, problems);
  if (!prepared.still) return {};
  const auto& plan = *prepared.plan;
  return find_hunting(*prepared.excited, *prepared.still, plan.wire, plan.at, plan.sampling, period);
}

std::optional<std::string> wire_of(const scenario::Scenario& scenario, const LoopRequest& request) {
  Problems problems;
  const auto prepared = prepare(scenario, request, problems);
  if (!prepared.plan) return {};
  return prepared.excited->bus().analogue_wires()[prepared.plan->wire].plug;
}

namespace {

/// `margin`, if the loop is sound and all answers up to `times` its frequency are to be trusted.
std::optional<AtFrequency> if_known(const Sweep& sweep, const std::optional<AtFrequency>& margin,
                                    double times) {
  if (!margin || !sweep.failure.empty() || sweep.loop != Sweep::Loop::closed) return {};
  const auto is_doubtful = [&](const BodePoint& point) {
    return point.frequency <= times * margin->frequency &&
           (point.silent || point.saturated || !(point.doubt() <= bode_error_limit));
  };
  return std::ranges::any_of(sweep.points, is_doubtful) ? std::nullopt : margin;
}

}  // namespace

std::optional<AtFrequency> LoopResult::known_phase() const { return if_known(sweep, margins.phase, 2); }
std::optional<AtFrequency> LoopResult::known_gain() const { return if_known(sweep, margins.gain, 1.1); }

std::optional<AtFrequency> LoopResult::least_gain() const {
  if (play.empty()) return margins.gain;
  if (!hunting || !hunting->failure.empty()) return {};
  std::optional<AtFrequency> least = margins.gain;
  if (!hunting->from) return least;
  const double gain = 20 * std::log10(*hunting->from);
  if (!least || gain < least->value) least = {hunting->frequency, gain};
  return least;
}

std::optional<LoopResult> measure_both(scenario::Scenario& scenario, const LoopRequest& request,
                                       Problems& problems, const std::function<void(double)>& progress) {
  auto result = measure_loop(scenario, request, problems, progress);
  if (!result || !scenario.controller || scenario.controller->compute_time == 0) return result;
  const auto computing = std::exchange(scenario.controller->compute_time, 0);
  if (const auto without = measure_loop(scenario, request, problems, progress))
    result->without_computing = without->margins;
  scenario.controller->compute_time = computing;
  return result;
}

std::vector<Finding> loop_doubts(const LoopResult& result) {
  std::vector<Finding> doubts;
  if (!result.sweep.failure.empty())
    doubts.emplace_back("run.failed"_code, "the simulation stopped: " + result.sweep.failure);
  if (result.sweep.loop == Sweep::Loop::open)
    doubts.emplace_back(
        "bode.no-answer"_code,
        fmt::format("{} does not answer to {} V at {} s: either the loop is open there (let the program do "
                    "REGON before, or choose another --at), or the axis sits in play or stiction (a larger "
                    "--amplitude would answer, but it hides the play: see drycut bode --limit-cycle)",
                    result.terminal, result.plan.amplitude, record::seconds_text(result.plan.at)));
  if (result.sweep.loop == Sweep::Loop::restless)
    doubts.emplace_back(
        "bode.restless"_code,
        fmt::format("the loop has not come to rest within {} s after the push: wait longer (--settle) or "
                    "push harder (--amplitude)",
                    result.sweep.waited));
  if (result.sweep.loop == Sweep::Loop::runaway)
    doubts.emplace_back(
        "bode.runaway"_code,
        fmt::format("the loop runs away to the limit of {} after a push: look at the directions of count and "
                    "reference",
                    result.terminal));
  if (result.sweep.loop == Sweep::Loop::unstable)
    doubts.emplace_back("bode.unstable"_code,
                        "the loop is not stable: after a push it swings on; lower the gain");
  const auto tell = [&](Code code, const std::string& what, const auto& doubted) {
    int count = 0;
    const BodePoint* first = nullptr;
    for (const auto& point : result.sweep.points) {
      if (!doubted(point)) continue;
      if (first == nullptr) first = &point;
      ++count;
    }
    if (count == 0) return;
    doubts.emplace_back(code, fmt::format("at {} of {} frequencies, the first {}, {}", count,
                                          result.sweep.points.size(), hertz_text(first->frequency), what));
  };
  tell("bode.at-limit"_code, result.terminal + " stood at its limit of 10 V: take less --amplitude",
       [](const BodePoint& point) { return point.saturated; });
  tell("bode.no-answer"_code,
       result.terminal +
           " does not answer: the motion stays in play or stiction; a larger --amplitude would answer, but "
           "it hides the play" +
           (result.hunting ? ", for which the pushes count" : ": see drycut bode --limit-cycle"),
       [](const BodePoint& point) { return point.silent; });
  tell("bode.lost"_code,
       fmt::format(
           "the answer is lost in what else moves (error above {:.0f} %): measure while the axis stands or "
           "runs evenly (--at); a line that never stands: a scenario of its own that extends this one, with "
           "timeline: []; else another --amplitude",
           bode_error_limit * 100),
       [](const BodePoint& point) { return !point.silent && !(point.doubt() <= bode_error_limit); });
  return doubts;
}

}  // namespace drycut::sim::studies
