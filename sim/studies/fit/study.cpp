#include "sim/studies/fit/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/scenario/units.hpp"
#include "sim/studies/fit/ladder.hpp"
#include "sim/studies/fit/search.hpp"
#include "sim/studies/fit/words.hpp"

namespace drycut::sim::studies {

namespace {

/// An offset of the torque may as well be dry friction that differs by direction: both are told.
void tell_offset(FitFound& found) {
  const auto& offset = found.torque_offset;
  if (!offset.value || *offset.low * *offset.high <= 0) return;
  for (const auto& value : found.parameters) {
    if (!value.value || !value.path.ends_with(".coulomb")) continue;
    found.tell(
        {"fit.offset-or-direction"_code,
         fmt::format("the recorded torque is {:.3g} N m too much in both directions: an offset of what "
                     "was measured, or dry friction of {} that is so much more one way; the recording "
                     "cannot tell which. With --vary ...backward it is taken for friction",
                     *offset.value, value.path.substr(0, value.path.rfind('.')))});
    return;
  }
}

/// Values as people have them, with the reasons of those that are not known.
void tell_values(const FitBench& bench, const Solved& solved, FitFound& found) {
  const auto& chosen = solved.chosen();
  const auto before = bench.start();
  const auto value_of = [&](std::size_t i) {
    const bool is_offset = i == bench.torque_offset();
    const auto& estimate = chosen.solution.estimates[i];
    FittedValue value;
    value.unit = is_offset ? "N m" : bench.unit(i);
    const auto shown = [&](double si) { return scenario::from_si(si, value.unit); };
    value.path = is_offset ? bench.question().plant + ".motor.torque" : bench.question().vary[i].text();
    value.known = estimate.known;
    value.before = shown(before[i]);
    value.used = shown(estimate.value);
    if (estimate.alone.size() > 1)
      for (const double alone : estimate.alone) value.alone.push_back(shown(alone));
    if (estimate.known == FitKnown::yes) {
      value.value = value.used;
      const auto& range = bench.unknowns()[i];
      value.low = shown(is_offset ? estimate.low : std::max(estimate.low, range.low));
      value.high = shown(is_offset ? estimate.high : std::min(estimate.high, range.high));
      const auto of = [&](std::size_t other) -> std::optional<double> {
        if (other >= solved.tried.size()) return {};
        return shown(solved.tried[other].values[i]);
      };
      value.coarser = solved.best > 0 ? of(solved.best - 1) : std::nullopt;
      value.finer = of(solved.best + 1);
      return value;
    }
    std::vector<FitPath> with;
    for (const auto other : estimate.with)
      if (other < bench.values()) with.push_back(bench.question().vary[other]);
    const bool with_offset = std::ranges::find(estimate.with, bench.torque_offset()) != estimate.with.end();
    value.why = why_not_known(is_offset ? FitPath{} : bench.question().vary[i], with, with_offset,
                              bench.recordings());
    return value;
  };
  for (std::size_t i = 0; i < bench.values(); ++i) found.parameters.push_back(value_of(i));
  found.torque_offset = value_of(bench.torque_offset());
}

/// A channel of a recording, where there are several with its name.
std::string name_in(const FitBench& bench, std::size_t recording, const std::string& channel) {
  const auto& all = bench.recordings();
  return all.size() > 1 ? all[recording].name() + ": " + channel : channel;
}

/// A force that was recorded may be in the torque already.
void tell_shares(const FitBench& bench, const AtCutoff& chosen, FitFound& found) {
  for (std::size_t i = 0; i < bench.recordings().size(); ++i) {
    const auto& inputs = bench.recordings()[i].inputs;
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      const auto share = bench.share(i, j);
      if (!share) continue;
      const auto& estimate = chosen.solution.estimates[*share];
      auto& told = found.inputs.emplace_back();
      told.path = name_in(bench, i, inputs[j].channel);
      told.known = estimate.known;
      told.before = 1;
      told.used = estimate.value;
      if (estimate.known != FitKnown::yes) {
        told.why = "it hardly changes, or as another value does";
        continue;
      }
      told.value = estimate.value;
      told.low = estimate.low;
      told.high = estimate.high;
      constexpr double near = 0.05;
      if (estimate.low <= 1 + near && estimate.high >= 1 - near) continue;
      found.tell({"fit.disturbance"_code,
                  fmt::format("{} acts by {:.3g} of what was recorded ({:.3g} .. {:.3g}){}", told.path,
                              estimate.value, estimate.low, estimate.high,
                              estimate.low <= near && estimate.high >= -near
                                  ? ": not at all, or it is in the recorded torque already"
                                  : ": its scale or sign is another, or some of it is in the torque already"),
                  Finding::Role::warning});
    }
  }
}

void tell_delays(const FitBench& bench, const AtCutoff& chosen, FitFound& found) {
  for (std::size_t i = 0; i < bench.recordings().size(); ++i) {
    const auto& one = bench.recordings()[i];
    const auto key = [&](const std::string& channel) { return name_in(bench, i, channel); };
    found.delays[key(one.plant + ".motor.torque")] = chosen.values[bench.torque_delay(i)];
    if (const auto load = bench.load_delay(i)) found.delays[key(one.load->channel)] = chosen.values[*load];
  }
}

/// Limits hold what each recording alone says, where they know the value too.
void widen(FitFound& found) {
  for (auto& value : found.parameters) {
    if (!value.value || value.alone.size() < 2) continue;
    const auto [least, most] = std::ranges::minmax(value.alone);
    if (least < *value.low || most > *value.high)
      found.tell({"fit.differs"_code,
                  fmt::format("{}: the recordings alone say {:.5g} to {:.5g} {}, their limits together were "
                              "{:.5g} to {:.5g}; the limits hold both now",
                              value.path, least, most, value.unit, *value.low, *value.high),
                  Finding::Role::warning});
    value.low = std::min(*value.low, least);
    value.high = std::max(*value.high, most);
  }
}

void tell_unknown(FitFound& found) {
  const auto tell = [&](const FittedValue& value, const std::string& what) {
    if (value.value) return;
    const bool joined = value.known == FitKnown::joined;
    found.tell({joined ? "fit.joined"_code : "fit.not-known"_code,
                fmt::format("{} is {}: {}", what,
                            joined ? "known only together with another value" : "not known", value.why),
                Finding::Role::warning});
  };
  for (const auto& value : found.parameters) tell(value, value.path);
  tell(found.torque_offset, "The offset of " + found.torque_offset.path);
  found.passed =
      std::ranges::all_of(found.parameters, [](const auto& value) { return value.value.has_value(); });
}

}  // namespace

FitFound fit(const FitQuestion& question, const std::vector<ReplaySeries>& recordings, int jobs,
             const std::function<void(const char* doing)>& progress) {
  const auto doing = [&](const char* what) {
    if (progress) progress(what);
  };
  FitFound found;
  for (auto& doubt : doubts_of(recordings)) found.tell(std::move(doubt));
  doing("search");
  FitBench bench(question, recordings, jobs);
  const bool by_direction =
      std::ranges::any_of(question.vary, [](const FitPath& path) { return path.row.ends_with(".backward"); });
  if (by_direction) bench.fix(bench.torque_offset(), 0);
  const auto solved = search_fit(bench);
  doing("other models");
  climb_ladder(bench, solved.chosen(), jobs, found);
  found.cutoff = solved.chosen().cutoff;
  found.condition = solved.chosen().solution.condition;
  found.replayed = replayed_with(bench, solved.chosen());
  found.relative_error = error_of(found.replayed);
  tell_values(bench, solved, found);
  tell_delays(bench, solved.chosen(), found);
  tell_shares(bench, solved.chosen(), found);
  widen(found);
  tell_unknown(found);
  constexpr double much = 0.1;
  if (found.relative_error > much)
    found.tell(
        {"fit.unexplained"_code,
         fmt::format(
             "{:.3g} % of the torque is left unexplained: {}", found.relative_error * 100,
             found.relative_error > 1
                 ? "that is more than was recorded. What is not looked for, such as inertia and friction "
                   "of rotor, screw and gear, takes it, or a unit, a sign or the gear is another"
                 : "something acts on the machine that the model or the recording does not have, and "
                   "the limits know nothing of it"),
         Finding::Role::warning});
  if (by_direction)
    found.tell(
        {"fit.offset-or-direction"_code,
         "the torque was taken to have no offset: an offset and dry friction that differs by direction "
         "are the same torque"});
  else
    tell_offset(found);
  found.runs += bench.runs();
  return found;
}

void cross_test(const FitQuestion& question, const std::vector<ReplaySeries>& tests,
                std::optional<double> limit, int jobs, FitFound& found) {
  constexpr double percent = 100;
  for (const auto& test : tests) {
    const std::vector<ReplaySeries> one = {test};
    FitBench bench(question, one, jobs);
    for (std::size_t i = 0; i < found.parameters.size(); ++i)
      bench.fix(i, scenario::to_si(found.parameters[i].used, found.parameters[i].unit));
    bench.fix(bench.torque_offset(), found.torque_offset.used);
    for (std::size_t i = 0; i < test.inputs.size(); ++i)
      for (const auto& input : found.inputs)
        if (bench.share(0, i) && input.path == test.inputs[i].channel)
          bench.fix(*bench.share(0, i), input.used);
    const auto solved = solve_at(bench, found.cutoff, starts_of(bench));
    auto replayed = replayed_with(bench, solved);
    found.cross_error = std::max(found.cross_error.value_or(0), error_of(replayed));
    for (auto& whole : replayed) found.tested.push_back(std::move(whole));
    found.runs += bench.runs();
  }
  if (!limit || !found.cross_error || *found.cross_error * percent <= *limit) return;
  found.passed = false;
  found.tell(
      {"fit.cross-test"_code,
       fmt::format("the values leave {:.3g} % of the torque of another recording unexplained, more than "
                   "{:.3g} %",
                   *found.cross_error * percent, *limit),
       Finding::Role::warning});
}

}  // namespace drycut::sim::studies
