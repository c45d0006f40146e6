#include "sim/loop/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/state_archive.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/loop/live_parameters.hpp"
#include "sim/loop/quantities.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::loop {

namespace {

std::string text_of(const std::string& name, const scenario::Quantity& quantity, std::string_view sign) {
  return fmt::format("{} {} {}{}{}", name, sign, quantity.number, quantity.unit.empty() ? "" : " ",
                     quantity.unit);
}

/// Converts stimuli of one file and says what does not fit.
class Binder {
 public:
  Binder(Names& names, const scenario::Scenario& scenario, Problems& problems)
      : names_(names), scenario_(scenario), problems_(problems) {}

  void problem(Code code, const scenario::ScenePlace& place, std::string what, std::string remedy) {
    problems_.push_back(scenario::problem_at(code, scenario_, place, std::move(what), std::move(remedy)));
  }

  /// The quantity as a setting or fault with `unit` and `range` takes it (SI); nullopt after a problem.
  std::optional<double> value(const std::string& name, std::string_view unit,
                              const std::optional<devices::ValueRange>& range,
                              const scenario::Quantity& quantity) {
    const auto si = in_si(scenario_, problems_, name, unit, quantity, bare_number(name));
    if (!si || !range) return si;
    // Another unit's conversion may miss a limit by its last digit.
    const double number =
        quantity.unit == unit
            ? quantity.number
            : std::strtod(fmt::format("{:.12g}", scenario::from_si(*si, unit)).c_str(), nullptr);
    auto fault = devices::misfit(name, *range, number, unit);
    if (!fault) fault = objection_to(scenario_, name, *si);
    if (!fault) return si;
    problem(fault->code, quantity.place, fault->what, fault->remedy);
    return {};
  }

  /// A controller's value is set as its device counts it, whatever scenarios call its unit elsewhere.
  std::string bare_number(const std::string& name) {
    const auto reading = names_.reading(name);
    if (!reading || reading->unit.empty()) return "leave the unit away";
    return fmt::format("write the number of {} without the unit", reading->unit);
  }

  std::optional<Target> target(const scenario::Text& name) {
    auto found = names_.target(name.text);
    if (found && names_.is_driven(name.text)) {
      problem("input.driven-twice"_code, name.place,
              fmt::format("{} is driven by {}: what is set here would not last", name.text,
                          names_.driven_by(name.text)),
              "leave it out here, or what drives it");
      return {};
    }
    if (found) return found;
    const auto fixed = fixed_parameter(scenario_, name.text);
    if (fixed)
      problem(fixed->code, name.place, fixed->what, fixed->remedy);
    else
      problem("timeline.nothing-to-set"_code, name.place,
              fmt::format("nothing called '{}' can be set", name.text), names_.suggest_target(name.text));
    return found;
  }

  std::optional<plants::Fault> fault(const scenario::Stimulus::FaultAction& action) {
    auto found = names_.fault(action.component.text, action.fault.text);
    if (!found) {
      problem("timeline.no-such-fault"_code, action.fault.place,
              fmt::format("{} offers no fault '{}'", action.component.text, action.fault.text),
              names_.suggest_fault(action.component.text));
    }
    return found;
  }

 private:
  Names& names_;
  const scenario::Scenario& scenario_;
  Problems& problems_;
};

}  // namespace

Timeline::Timeline(const scenario::Scenario& scenario, Names& names, devices::Controller* controller,
                   Problems& problems)
    : scenario_(scenario),
      names_(names),
      watch_(names),
      controller_(controller),
      look_every_((millisecond + scenario.scene.step - 1) / scenario.scene.step * scenario.scene.step) {
  auto known = names.reading_names();
  for (const auto& stimulus : scenario.timeline) {
    if (problems.size() > most_suggestions) known.clear();
    take(bind(stimulus, known, problems));
  }
}

void Timeline::take(Entry entry) {
  const auto number = taken_++;
  if (entry.when)
    waiting_.insert(number);
  else
    timed_.emplace(entry.due, number);
  entries_.emplace(number, std::move(entry));
}

bool Timeline::add(const scenario::Stimulus& stimulus, Problems& problems) {
  const auto before = problems.size();
  auto entry = bind(stimulus, {}, problems);
  if (problems.size() > before) return false;
  next_ = std::min(next_, entry.when ? 0 : entry.due);
  added_.push_back(stimulus);
  take(std::move(entry));
  return true;
}

Timeline::Entry Timeline::bind(const scenario::Stimulus& stimulus, const std::vector<std::string>& known,
                               Problems& problems) {
  Binder binder(names_, scenario_, problems);
  const auto slot = [this](const std::string& name) { return watch_.operand(name); };
  Entry entry;
  entry.after = stimulus.after;
  entry.every = stimulus.every;
  entry.over = stimulus.over;
  entry.power = stimulus.power;
  entry.from = stimulus.at.value_or(0);
  entry.line = stimulus.place.line;
  if (stimulus.when) {
    entry.when = scenario::Expression::compile(*stimulus.when, scenario_, slot, known, problems);
  } else {
    entry.due = stimulus.at.value_or(0) + stimulus.after;
  }
  for (const auto& [name, quantity] : stimulus.set) {
    const auto target = binder.target(name);
    if (!target) continue;
    const auto value = binder.value(name.text, target->unit, target->range, quantity);
    if (value) entry.sets.push_back({*target, *value, text_of(name.text, quantity, "=")});
  }
  for (const auto& [name, quantity] : stimulus.ramp) {
    const auto target = binder.target(name);
    if (!target) continue;
    const auto value = binder.value(name.text, target->unit, target->range, quantity);
    if (value) entry.ramps.push_back({*target, *value, text_of(name.text, quantity, "->")});
  }
  for (const auto& action : stimulus.faults) {
    const auto fault = binder.fault(action);
    if (!fault) continue;
    const auto name = action.component.text + "." + action.fault.text;
    const auto value = binder.value(name, fault->unit, range_of(fault->range), action.value);
    if (value) entry.faults.push_back({fault->act, *value, text_of(name, action.value, "=")});
  }
  if (stimulus.power && controller_ == nullptr) {
    binder.problem("scenario.needs-another"_code, stimulus.place, "there is no controller to switch",
                   "add a controller section or leave power away");
  }
  return entry;
}

std::vector<Finding> Timeline::left_undone(Time end) const {
  std::vector<Finding> undone;
  for (const auto& [number, entry] : entries_) {
    if (entry.acted) continue;
    undone.emplace_back(
        "timeline.never-happened"_code,
        entry.when ? fmt::format("the timeline's entry of line {} never happened: its `when` did not "
                                 "come true in {} s",
                                 entry.line, record::seconds_text(end))
                   : fmt::format("the timeline's entry of line {} never happened: it is due at {} s, the "
                                 "run ended at {} s",
                                 entry.line, record::seconds_text(entry.due), record::seconds_text(end)));
  }
  return undone;
}

std::optional<Time> Timeline::due(int line) const {
  for (const auto& [number, entry] : entries_)
    if (entry.line == line && !entry.acted && !entry.when) return entry.due;
  return {};
}

void Timeline::work(Time now, record::Recording& recording) {
  if (now >= next_look_) {
    trigger(now);
    next_look_ = now + look_every_;
  }
  std::vector<std::size_t> due;
  for (; !timed_.empty() && timed_.begin()->first <= now; timed_.erase(timed_.begin()))
    due.push_back(timed_.begin()->second);
  std::sort(due.begin(), due.end());
  for (const auto number : due) {
    auto& entry = entries_.at(number);
    act(entry, now, recording);
    if (!entry.every) {
      entries_.erase(number);
      continue;
    }
    entry.acted = true;
    entry.due += *entry.every;
    timed_.emplace(entry.due, number);
  }
  move_ramps(now);
  next_ = next_after(now);
}

void Timeline::trigger(Time now) {
  if (watch_.empty()) return;
  watch_.update();
  std::erase_if(waiting_, [&](std::size_t number) {
    auto& entry = entries_.at(number);
    if (now < entry.from || !entry.when->evaluate().holds) return false;
    entry.when.reset();
    entry.due = now + entry.after;
    timed_.emplace(entry.due, number);
    return true;
  });
}

void Timeline::act(const Entry& entry, Time now, record::Recording& recording) {
  const auto tell = [&](const char* event, const std::string& text) {
    recording.happened({now, 0, "timeline", event, {}, text, severity_of_every_run(event)});
  };
  for (const auto& set : entry.sets) {
    // A ramp of the same target that is still under way ends here.
    std::erase_if(ramps_, [&](const Ramp& ramp) { return ramp.target.name == set.target.name; });
    set.target.write(set.value);
    tell("set", set.text);
  }
  for (const auto& ramp : entry.ramps) {
    std::erase_if(ramps_, [&](const Ramp& other) { return other.target.name == ramp.target.name; });
    ramps_.push_back({ramp.target, ramp.target.read(), ramp.value, now, entry.over});
    tell("ramp", fmt::format("{} over {} s", ramp.text, record::seconds_text(entry.over)));
  }
  for (const auto& fault : entry.faults) {
    fault.act(fault.value);
    tell("fault", fault.text);
  }
  if (entry.power) {
    controller_->power(*entry.power);
    tell("power", *entry.power ? "on" : "off");
  }
}

void Timeline::move_ramps(Time now) {
  for (const auto& ramp : ramps_) {
    const auto done = std::min(now - ramp.start, ramp.over);
    const double fraction = static_cast<double>(done) / static_cast<double>(ramp.over);
    ramp.target.write(ramp.from + (ramp.to - ramp.from) * fraction);
  }
  std::erase_if(ramps_, [&](const Ramp& ramp) { return now - ramp.start >= ramp.over; });
}

Time Timeline::next_after(Time now) const {
  if (!ramps_.empty()) return now + 1;
  Time next = timed_.empty() ? never : timed_.begin()->first;
  for (const auto number : waiting_) next = std::min(next, std::max(entries_.at(number).from, next_look_));
  return next;
}

void Timeline::visit(StateArchive& archive) {
  // Of a recorded day most entries are as they were read, or gone: only the ends of rows of those are told.
  auto taken = taken_;
  std::vector<std::size_t> gone;
  struct Changed {
    std::size_t number;
    bool triggered;
    bool acted;
    Time due;
  };
  std::vector<Changed> changed;
  if (!archive.restores()) {
    std::size_t expected = 0;
    for (const auto& [number, entry] : entries_) {
      if (number > expected) gone.insert(gone.end(), {expected, number});
      expected = number + 1;
      const bool triggered = !entry.when && stimulus(number).when.has_value();
      if (triggered || entry.acted) changed.push_back({number, triggered, entry.acted, entry.due});
    }
    if (taken_ > expected) gone.insert(gone.end(), {expected, taken_});
  }
  STATE(archive, taken, gone);
  archive.list("changed", changed, [&](Changed& entry) {
    STATE(archive, entry.number, entry.triggered, entry.acted, entry.due);
  });
  if (archive.restores()) {
    take_again(taken, gone);
    for (const auto& [number, triggered, acted, due] : changed) {
      const auto found = entries_.find(number);
      if (found == entries_.end()) throw BadState("an entry of the timeline that there is not");
      auto& entry = found->second;
      if (triggered) entry.when.reset();
      if (waiting_.erase(number) == 0) timed_.erase({entry.due, number});
      entry.acted = acted;
      entry.due = due;
      if (entry.when)
        waiting_.insert(number);
      else
        timed_.emplace(due, number);
    }
  }
  STATE(archive, next_look_, next_, watch_);
  archive.list("ramps_", ramps_, [&](Ramp& ramp) {
    auto name = ramp.target.name;
    STATE(archive, name, ramp.from, ramp.to, ramp.start, ramp.over);
    if (!archive.restores()) return;
    auto target = names_.target(name);
    if (!target) throw BadState("a ramp of what cannot be set");
    ramp.target = std::move(*target);
  });
}

const scenario::Stimulus& Timeline::stimulus(std::size_t number) const {
  const auto own = scenario_.timeline.size();
  return number < own ? scenario_.timeline[number] : added_[number - own];
}

void Timeline::take_again(std::size_t taken, const std::vector<std::size_t>& gone) {
  const auto own = scenario_.timeline.size();
  if (taken < own || taken > own + added_.size()) throw BadState("a timeline with other entries");
  added_.resize(taken - own);
  auto before = std::exchange(entries_, {});
  waiting_.clear();
  timed_.clear();
  Problems none;
  std::size_t row = 0;
  for (taken_ = 0; taken_ < taken;) {
    if (row + 1 < gone.size() && taken_ == gone[row]) {
      if (gone[row + 1] <= taken_) throw BadState("a timeline with other entries");
      taken_ = gone[row + 1];
      row += 2;
      continue;
    }
    const auto& from = stimulus(taken_);
    const auto found = before.find(taken_);
    if (found == before.end() || found->second.when.has_value() != from.when.has_value()) {
      take(bind(from, {}, none));
      continue;
    }
    auto& entry = found->second;
    entry.acted = false;
    if (!entry.when) entry.due = from.at.value_or(0) + from.after;
    take(std::move(entry));
  }
}

}  // namespace drycut::sim::loop
