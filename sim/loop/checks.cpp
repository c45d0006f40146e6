#include "sim/loop/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/state_archive.hpp"
#include "sim/loop/statistics.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::loop {

namespace {

constexpr int shown_digits = 6;

std::string window_text(const scenario::CheckRequest& check) {
  std::string text;
  if (check.from > 0) text += fmt::format(", from {} s", record::seconds_text(check.from));
  if (check.until) text += fmt::format(", until {} s", record::seconds_text(*check.until));
  if (check.within) text += fmt::format(", within {} s", record::seconds_text(*check.within));
  if (check.every) text += fmt::format(", every {} s", record::seconds_text(*check.every));
  return text;
}

std::string expectation_text(const scenario::CheckRequest& check) {
  switch (check.kind) {
    case scenario::CheckRequest::Kind::each:
      return fmt::format("each {}: {}{}", check.event.text, check.expression.text, window_text(check));
    case scenario::CheckRequest::Kind::all:
      return fmt::format("all {}: {}{}", check.event.text, check.expression.text, window_text(check));
    case scenario::CheckRequest::Kind::always:
      return fmt::format("always {}{}", check.expression.text, window_text(check));
    case scenario::CheckRequest::Kind::eventually:
      return fmt::format("eventually {}{}", check.expression.text, window_text(check));
    case scenario::CheckRequest::Kind::never:
      return fmt::format("never {}{}", check.event.text, window_text(check));
  }
  return "";
}

Time last_instant(const scenario::CheckRequest& check) {
  if (check.within) return check.from + *check.within;
  return check.until.value_or(std::numeric_limits<Time>::max());
}

bool looks_at_instants(const scenario::CheckRequest& check) {
  return check.kind == scenario::CheckRequest::Kind::always ||
         check.kind == scenario::CheckRequest::Kind::eventually;
}

// Over one window, the whole of it.
bool is_judged_once(const scenario::CheckRequest& check) {
  return check.kind == scenario::CheckRequest::Kind::always && !check.every;
}

bool in_window(const scenario::CheckRequest& check, double at) {
  return at >= seconds(check.from) && (!check.until || at <= seconds(*check.until));
}

}  // namespace

Checks::Checks(const scenario::Scenario& scenario, Watch& watch, Names& names,
               const std::vector<KnownEvent>& events, Problems& problems)
    : watch_(watch), at_steps_(names) {
  auto known = names.reading_names();
  for (const auto& check : scenario.checks) {
    states_.emplace_back().check = check;
    if (problems.size() > most_suggestions) known.clear();
    bind(states_.back(), scenario, known, events, problems);
  }
}

/// Finds the event of a check and makes the slots of its values or statistics.
const KnownEvent* Checks::bind_event(State& state, const scenario::Scenario& scenario,
                                     const std::vector<KnownEvent>& events, Problems& problems) {
  const auto& check = state.check;
  const auto* found = find_event(events, check.event, scenario, problems);
  if (found == nullptr) return nullptr;
  for (const auto& [name, unit] : found->values) {
    if (check.kind == scenario::CheckRequest::Kind::all) {
      state.series.push_back({name, unit, {}});
      state.values.push_back({name, unit, 0.0});
      for (const auto* statistic : statistic_names) {
        state.slots.push_back({fmt::format("{}_{}", statistic, name), unit, 0.0});
      }
    } else {
      state.slots.push_back({name, unit, 0.0});
    }
  }
  if (check.kind == scenario::CheckRequest::Kind::all) state.slots.push_back({"count", "", 0.0});
  return found;
}

void Checks::bind(State& state, const scenario::Scenario& scenario, std::vector<std::string>& known,
                  const std::vector<KnownEvent>& events, Problems& problems) {
  const auto& check = state.check;
  if (!check.event.text.empty() && bind_event(state, scenario, events, problems) == nullptr) return;
  if (check.kind == scenario::CheckRequest::Kind::never) return;

  // The values of the event come before channels of the same name.
  std::set<std::string> units;
  const auto note = [&](const std::string& name, const double* number, const std::string& unit) {
    for (const auto& operand : state.operands)
      if (operand.name == name) return;
    state.operands.push_back({name, number, unit});
  };
  const auto resolve = [&](const std::string& name) -> scenario::Expression::Operand {
    for (const auto& slot : state.slots) {
      if (slot.name != name) continue;
      units.insert(slot.unit);
      note(name, &slot.number, slot.unit);
      return {&slot.number, slot.unit};
    }
    auto operand = watch_.operand(name);
    if (operand.number != nullptr) {
      units.insert(*operand.unit);
      note(name, operand.number, *operand.unit);
    }
    return operand;
  };
  const auto inside = [&](const std::string& name) -> scenario::Expression::Operand {
    for (const auto& slot : check.kind == scenario::CheckRequest::Kind::all ? state.values : state.slots) {
      if (slot.name != name) continue;
      if (check.kind == scenario::CheckRequest::Kind::all) return {&slot.number, slot.unit};
      return scenario::Expression::Operand::refused(
          "expression.not-here"_code, fmt::format("{} is a value of the event, and a cycle has one", name),
          fmt::format("write all: {} for statistics over the events", check.event.text));
    }
    return check.kind == scenario::CheckRequest::Kind::all ? watch_.operand(name) : at_steps_.operand(name);
  };
  const auto of_all = known.size();
  for (const auto& slot : state.slots) known.push_back(slot.name);
  state.expression =
      scenario::Expression::compile(check.expression, scenario, resolve, known, problems, inside);
  known.resize(of_all);
  if (state.expression && !state.expression->statistics().empty()) {
    state.windowed = true;
    for (const auto& statistic : state.expression->statistics()) {
      units.insert(statistic.unit);
      note(statistic.text, &statistic.value, statistic.unit);
    }
    if (check.kind != scenario::CheckRequest::Kind::all) {
      stepped_.push_back(&state);
      state.rate =
          fmt::format(", at each step of {} ({:.4g} kHz)", scenario::format_time(scenario.scene.step),
                      static_cast<double>(millisecond) / static_cast<double>(scenario.scene.step));
    }
    state.begin = check.from;
    start_window(state, seconds(check.from));
  }
  units.erase("");
  if (units.size() == 1) state.unit = *units.begin();
}

void Checks::start_window(State& state, double at) {
  state.expression->start(at);
  state.began = at;
  state.taken = false;
}

void Checks::judge_window(State& state, double at) {
  watch_.update();  // a window may end between two record instants
  state.expression->finish();
  note_operands(state);
  const auto values = operands_text(state);
  state.last_window = fmt::format("{:.4f} s to {:.4f} s: {}", state.began, at, values);
  evaluate(state, at, state.last_window);
}

void Checks::close_windows(State& state, Time now) {
  const auto& check = state.check;
  const Time last = last_instant(check);
  while (!state.done && !state.held_at) {
    const Time end = check.every ? state.begin + *check.every : last;
    state.done = check.every && end > last;
    if (state.done || (check.every ? end > now : end >= now)) return;
    if (state.taken) judge_window(state, seconds(end));
    state.begin = end;
    state.done = !check.every;
    start_window(state, seconds(end));
  }
}

void Checks::take_into_window(State& state, Time now) {
  const auto& check = state.check;
  if (check.kind == scenario::CheckRequest::Kind::each) {
    if (!state.open) return;
  } else {
    close_windows(state, now);
    if (state.done || now < check.from || now > last_instant(check)) return;
  }
  state.expression->take(seconds(now));
  state.taken = true;
}

bool Checks::concerns(const State& state, const record::RecordedEvent& event) {
  return !state.check.event.text.empty() && names_event(state.check.event.text, event.source, event.event) &&
         in_window(state.check, event.at_seconds());
}

void Checks::note_operands(State& state) {
  for (auto& operand : state.operands) operand.noted = *operand.number;
}

std::string Checks::operands_text(const State& state, double Operand::*number) {
  std::string text;
  for (const auto& operand : state.operands)
    text += fmt::format("{}{}={:.{}g}{}{}", text.empty() ? "" : "; ", operand.name,
                        record::without_noise(operand.*number), shown_digits, operand.unit.empty() ? "" : " ",
                        operand.unit);
  return text;
}

/// How often it did not hold, from when to when, and what it was then.
std::string Checks::failed_text(const State& state) {
  if (state.failed == 0) return "";
  auto text = fmt::format(", {} failed", state.failed);
  if (!state.worst) text += fmt::format(", first at {:.4f} s: {}", state.worst_at, state.worst_values);
  if (state.failed == 1) return text;
  if (state.worst) text += fmt::format(", first at {:.4f} s", state.first_failed_at);
  return text +
         fmt::format(", last at {:.4f} s: {}", state.last_failed_at, operands_text(state, &Operand::failed));
}

/// What the names of a check were that never held.
std::string Checks::throughout(const State& state) {
  constexpr int many = 100;  // instants: of few it says nothing
  if (state.windowed || state.check.kind != scenario::CheckRequest::Kind::always ||
      state.failed < state.count || state.count < many)
    return "";
  std::string text;
  for (const auto& operand : state.operands) {
    const auto low = record::without_noise(operand.low);
    const auto high = record::without_noise(operand.high);
    text += fmt::format("{}{} {:.6g}", text.empty() ? "" : ", ", operand.name, low);
    if (high != low) text += fmt::format(" to {:.6g}", high);
    if (!operand.unit.empty()) text += " " + operand.unit;
  }
  return text;
}

void Checks::evaluate(State& state, double at, std::string_view values) {
  ++state.count;
  const auto evaluation = state.expression->evaluate();
  state.last_at = at;
  if (!evaluation.holds) {
    if (++state.failed == 1) state.first_failed_at = at;
    state.last_failed_at = at;
    const bool never_held = state.failed == state.count;
    for (auto& operand : state.operands) {
      operand.failed = *operand.number;
      if (!never_held) continue;
      operand.low = std::min(operand.low, *operand.number);
      operand.high = std::max(operand.high, *operand.number);
    }
  }
  const bool eventually = state.check.kind == scenario::CheckRequest::Kind::eventually;
  if (eventually && evaluation.holds && !state.held_at) state.held_at = at;
  // For "eventually" the moment that counts is the best one, for the others the worst. Without margins it is
  // the first that decided.
  bool decisive = false;
  if (evaluation.margin) {
    decisive =
        !state.worst || (eventually ? *evaluation.margin > *state.worst : *evaluation.margin < *state.worst);
    if (decisive) {
      state.worst = evaluation.margin;
      state.used = state.expression->used(evaluation.term);
    }
  } else {
    decisive = state.failed == 1 && !evaluation.holds && !eventually;
  }
  if (decisive) {
    state.worst_at = at;
    if (eventually)
      for (auto& operand : state.operands) operand.worst = *operand.number;
    state.worst_values = values;
    if (state.check.kind == scenario::CheckRequest::Kind::always && !evaluation.margin && !state.windowed) {
      note_operands(state);
      state.worst_values = operands_text(state);
    }
  }
  if (eventually) note_operands(state);
}

void Checks::stepped(Time now) {
  at_steps_.update();
  for (auto* state : stepped_) take_into_window(*state, now);
}

void Checks::sample(Time now) {
  const double at = seconds(now);
  for (auto& state : states_) {
    const auto kind = state.check.kind;
    if (state.windowed) continue;
    if (kind == scenario::CheckRequest::Kind::always && in_window(state.check, at)) evaluate(state, at);
    if (kind == scenario::CheckRequest::Kind::eventually && now >= state.check.from && !state.held_at &&
        (!state.check.within || now <= state.check.from + *state.check.within)) {
      evaluate(state, at);
    }
  }
}

void Checks::happened(const record::RecordedEvent& event) {
  for (auto& state : states_) {
    if (!concerns(state, event)) continue;
    switch (state.check.kind) {
      case scenario::CheckRequest::Kind::each:
        for (auto& slot : state.slots) {
          if (const auto* value = event.find(slot.name)) slot.number = value->number;
        }
        if (!state.windowed) {
          evaluate(state, event.at_seconds(), values_text(event, shown_digits));
          break;
        }
        if (state.open) judge_window(state, event.at_seconds());
        state.open = true;
        start_window(state, event.at_seconds());
        break;
      case scenario::CheckRequest::Kind::all:
        ++state.count;
        for (auto& series : state.series) {
          if (const auto* value = event.find(series.value)) series.numbers.push_back(value->number);
        }
        for (auto& slot : state.values) {
          if (const auto* value = event.find(slot.name)) slot.number = value->number;
        }
        if (state.windowed) state.expression->take(event.at_seconds());
        break;
      case scenario::CheckRequest::Kind::never:
        if (state.count++ == 0) {
          state.worst_at = event.at_seconds();
          state.worst_values = values_text(event, shown_digits);
        }
        break;
      case scenario::CheckRequest::Kind::always:
      case scenario::CheckRequest::Kind::eventually:
        break;
    }
  }
}

void Checks::finish_statistics(State& state) {
  const auto set = [&](const std::string& name, double number) {
    for (auto& slot : state.slots) {
      if (slot.name == name) slot.number = number;
    }
  };
  set("count", state.count);
  std::string values;
  for (const auto& series : state.series) {
    const auto numbers = statistics(series.numbers);
    for (std::size_t i = 0; i < statistic_names.size(); ++i) {
      set(fmt::format("{}_{}", statistic_names[i], series.value), numbers[i]);
      const auto name = fmt::format("{}_{}", statistic_names[i], series.value);
      if (state.check.expression.text.find(name) == std::string::npos) continue;
      values += fmt::format("{}{}={:.6g}{}{}", values.empty() ? "" : "; ", name,
                            record::without_noise(numbers[i]), series.unit.empty() ? "" : " ", series.unit);
    }
  }
  state.expression->finish();
  for (const auto& statistic : state.expression->statistics())
    values += fmt::format("{}{}={:.6g}{}{}", values.empty() ? "" : "; ", statistic.text,
                          record::without_noise(statistic.value), statistic.unit.empty() ? "" : " ",
                          statistic.unit);
  const int events = state.count;
  evaluate(state, 0, values);
  state.count = events;
}

std::string Checks::looked_at(const State& state) {
  const auto& check = state.check;
  if (looks_at_instants(check)) return state.windowed ? "periods" : "instants";
  return state.windowed && check.kind == scenario::CheckRequest::Kind::each
             ? fmt::format("cycles from {0} to {0}", check.event.text)
             : check.event.text + (state.count == 1 ? " event" : " events");
}

std::vector<record::CheckResult> Checks::results(Time end, bool stopped) {
  std::vector<record::CheckResult> all;
  for (auto& state : states_) {
    if (state.windowed && looks_at_instants(state.check)) close_windows(state, end);
    const Tally so_far = state;
    all.push_back(result(state, end));
    if (state.count > 0) all.back().tolerances = tolerances_of(state);
    const bool judged_whole = state.held_at || (state.check.until && *state.check.until <= end);
    all.back().so_far = stopped && all.back().passed && !judged_whole;
    static_cast<Tally&>(state) = so_far;
  }
  return all;
}

std::vector<std::pair<std::string, record::Tolerance>> Checks::stated() const {
  std::vector<std::pair<std::string, record::Tolerance>> stated;
  for (const auto& state : states_)
    for (auto& tolerance : tolerances_of(state))
      stated.emplace_back(state.check.name.text, std::move(tolerance));
  return stated;
}

std::vector<record::Tolerance> Checks::tolerances_of(const State& state) {
  std::vector<record::Tolerance> tolerances;
  const auto& check = state.check;
  if (check.kind != scenario::CheckRequest::Kind::each || !state.expression) return tolerances;
  for (const auto& slot : state.slots) {
    const auto [low, high] = state.expression->range_of(&slot.number);
    if (std::isinf(low) && std::isinf(high)) continue;
    tolerances.push_back({check.event.text, slot.name, low, high, seconds(check.from),
                          check.until ? seconds(*check.until) : std::numeric_limits<double>::infinity()});
  }
  return tolerances;
}

std::vector<std::string> Checks::names_of(const State& state) {
  std::vector<std::string> names;
  for (const auto& operand : state.operands) names.push_back(operand.name);
  if (state.expression)
    for (const auto& statistic : state.expression->statistics())
      for (const auto& name : statistic.names)
        if (std::ranges::find(names, name.text) == names.end()) names.push_back(name.text);
  return names;
}

record::CheckResult Checks::result(State& state, Time end) {
  const auto& check = state.check;
  record::CheckResult result{
      check.name.text, expectation_text(check) + state.rate, false, {}, state.unit, {}, ""};
  result.names = names_of(state);
  const bool by_event =
      check.kind == scenario::CheckRequest::Kind::each || check.kind == scenario::CheckRequest::Kind::all;
  if (by_event && state.count < check.at_least) {
    const bool cycles = state.windowed && check.kind == scenario::CheckRequest::Kind::each;
    const auto what = cycles ? fmt::format("cycle from {0} to {0}", check.event.text) : check.event.text;
    result.detail =
        fmt::format("{} between {} s and {} s, at least {} expected",
                    state.count == 0 ? "no " + what : fmt::format("only {} x {}", state.count, what),
                    record::seconds_text(check.from),
                    record::seconds_text(std::min(end, check.until.value_or(end))), check.at_least);
    result.idle = state.count == 0;
    result.too_few = seconds(check.from);
    return result;
  }
  const auto never_looked_at = [&] {
    return fmt::format("never looked at: the run ended at {} s", record::seconds_text(end));
  };
  if (check.kind == scenario::CheckRequest::Kind::never && check.from > end) {
    result.detail = never_looked_at();
    return result;
  }
  if (check.kind == scenario::CheckRequest::Kind::never) {
    result.passed = state.count == 0;
    result.detail = state.count == 0
                        ? "none"
                        : fmt::format("{}, first at {:.4f} s: {}",
                                      state.count == 1 ? "once" : fmt::format("{} times", state.count),
                                      state.worst_at, state.worst_values);
    if (state.count > 0) result.at = result.failed_at = state.worst_at;
    return result;
  }
  if (check.kind == scenario::CheckRequest::Kind::all) finish_statistics(state);
  if (state.windowed && is_judged_once(check) && state.taken) judge_window(state, seconds(end));
  if (state.count == 0) {
    result.detail = never_looked_at();
    return result;
  }
  result.margin = state.worst;
  result.used = state.used;
  if (check.kind == scenario::CheckRequest::Kind::eventually) {
    result.passed = state.held_at.has_value();
    result.at = state.held_at ? *state.held_at : state.worst ? state.worst_at : state.last_at;
    const auto nearest =
        state.worst && !state.windowed && state.worst_at != state.last_at
            ? fmt::format(", nearest at {:.4f} s: {}", state.worst_at, operands_text(state, &Operand::worst))
            : "";
    result.detail = state.held_at
                        ? fmt::format("first true at {:.4f} s", *state.held_at)
                        : fmt::format("not true at any of {} {}{}, the last at {:.4f} s: {}", state.count,
                                      looked_at(state), nearest, state.last_at, operands_text(state));
    // Once it held, what is left is time.
    result.margin.reset();
    result.used.reset();
    const auto given_up = check.within ? check.from + *check.within : end;
    result.deadline = check.within.has_value();
    if (!state.held_at && given_up < end) result.failed_at = seconds(given_up);
    if (state.held_at && check.within) {
      result.margin = seconds(check.from + *check.within) - *state.held_at;
      if (*check.within > 0) result.used = (*state.held_at - seconds(check.from)) / seconds(*check.within);
      result.unit = "s";
    }
    return result;
  }
  result.passed = state.failed == 0;
  const auto unmet = result.passed && !state.windowed ? state.expression->unmet() : "";
  if (!unmet.empty()) {
    result.doubt = fmt::format("check '{}' judged nothing: {} was 0 at all {} {}", check.name.text, unmet,
                               state.count, looked_at(state));
    // What is left of a limit that nothing was held against is no figure.
    result.margin.reset();
    result.used.reset();
    result.detail = fmt::format("judged nothing in {} {}", state.count, looked_at(state));
    return result;
  }
  // Its unit may be a slip.
  constexpr double far_off = 0.001;
  constexpr double rounding = 1e-7;
  if (result.passed && result.used && *result.used > rounding && *result.used < far_off)
    result.doubt = fmt::format(
        "check '{}' would notice no less than {:.0f} times what came: does its limit "
        "have the right unit",
        check.name.text, 1 / *result.used);
  if (!result.passed && check.kind != scenario::CheckRequest::Kind::all)
    result.failed_at = state.first_failed_at;
  if (!result.passed) result.throughout = throughout(state);
  if (state.windowed && is_judged_once(check)) {
    result.detail = state.last_window;
    return result;
  }
  if (check.kind != scenario::CheckRequest::Kind::all && (state.worst || state.failed > 0))
    result.at = state.worst_at;
  if (!state.worst && state.failed > 0 && check.kind != scenario::CheckRequest::Kind::all) {
    result.detail = fmt::format("{} {}{}", state.count, looked_at(state), failed_text(state));
    return result;
  }
  result.detail = fmt::format(
      "{} {}{}{}", state.count, looked_at(state),
      check.kind != scenario::CheckRequest::Kind::all ? failed_text(state) : "",
      state.worst_values.empty()
          ? ""
          : (check.kind == scenario::CheckRequest::Kind::all ? ": " : ", worst: ") + state.worst_values);
  return result;
}

void Checks::visit(StateArchive& archive) {
  STATE(archive, at_steps_);
  archive.each("states_", states_, [&](State& state) { visit(archive, state); });
}

void Checks::visit(StateArchive& archive, State& state) {
  STATE(archive, state.count, state.failed, state.worst, state.used, state.worst_at, state.worst_values,
        state.first_failed_at, state.last_failed_at, state.last_at, state.held_at, state.last_window,
        state.begin, state.began, state.open, state.done, state.taken);
  archive.each("operands", state.operands,
               [&](Operand& of) { STATE(archive, of.noted, of.failed, of.worst, of.low, of.high); });
  for (auto* slots : {&state.slots, &state.values})
    archive.each("slots", *slots, [&](Slot& slot) { STATE(archive, slot.number); });
  if (state.expression) STATE(archive, *state.expression);
  archive.each("series", state.series, [&](Series& series) { STATE(archive, series.numbers); });
}

}  // namespace drycut::sim::loop
