#include "sim/loop/disturbances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/state_archive.hpp"
#include "sim/loop/live_parameters.hpp"
#include "sim/loop/quantities.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::loop {

namespace {

plants::Random generator(const scenario::Scenario& scenario, std::size_t place) {
  const auto& own = scenario.disturbances[place].seed;
  if (own) return plants::Random(*own, "disturbance");
  return plants::Random(scenario.scene.seed, "disturbance", place + 1);
}

// A single step goes one way.
bool goes_both_ways(const scenario::Disturbance& of) {
  return of.kind != scenario::Disturbance::Kind::step || of.every > 0;
}

}  // namespace

Disturbances::Disturbances(const scenario::Scenario& scenario, Names& names, Problems& problems) {
  const double h = seconds(scenario.scene.step);
  const auto refuse = [&](const scenario::ScenePlace& place, std::string what) {
    problems.push_back(
        scenario::problem_at("scenario.time-grid"_code, scenario, place, std::move(what),
                             fmt::format("less than {:g} Hz, or a shorter scene.step", 0.5 / h)));
  };
  sources_.reserve(scenario.disturbances.size());
  for (std::size_t i = 0; i < scenario.disturbances.size(); ++i) {
    const auto& of = scenario.disturbances[i];
    if (of.at.text.empty()) continue;  // told by the reader
    const auto too_fast = [&](double frequency) { return frequency >= 0.5 / h; };
    if (of.kind == scenario::Disturbance::Kind::sine && too_fast(of.frequency))
      refuse(of.at.place, fmt::format("a sine of {:g} Hz has less than two steps a period", of.frequency));
    if (of.kind == scenario::Disturbance::Kind::noise && too_fast(of.band.high))
      refuse(of.band.place,
             fmt::format("noise up to {:g} Hz has less than two steps a period", of.band.high));
    auto* sum = sum_of(of.at, scenario, names, problems);
    if (sum == nullptr) continue;
    if (sum->is_fault && goes_both_ways(of) && sum->target.read() <= sum->low) {
      problems.push_back(scenario::problem_at(
          "scenario.does-not-go-together"_code, scenario, of.at.place,
          fmt::format("{} cannot be less than it is, and this goes both ways: half of it would be lost",
                      of.at.text),
          "a single step up, {kind: step, amplitude: ...} without every"));
      continue;
    }
    const auto si = [&](const scenario::Quantity& quantity) {
      return in_si(scenario, problems, of.at.text, sum->target.unit, quantity);
    };
    const auto amplitude = si(of.amplitude);
    const auto step = of.kind == scenario::Disturbance::Kind::walk ? si(of.step) : 0;
    if (!amplitude || !step) continue;
    sources_.push_back({&of, sum, *amplitude, *step, generator(scenario, i)});
    auto& source = sources_.back();
    source.next = of.from;
    if (of.kind == scenario::Disturbance::Kind::noise && !too_fast(of.band.high))
      source.noise.emplace(of.band.low, of.band.high, h, source.random);
    next_ = std::min(next_, of.from);
  }
}

Disturbances::Sum* Disturbances::sum_of(const scenario::Text& name, const scenario::Scenario& scenario,
                                        Names& names, Problems& problems) {
  for (auto& sum : sums_)
    if (sum.target.name == name.text) return &sum;
  const auto target = names.disturbed(name.text);
  if (!target) {
    const auto fixed = fixed_parameter(scenario, name.text);
    problems.push_back(scenario::problem_at(
        fixed ? fixed->code : "timeline.nothing-to-set"_code, scenario, name.place,
        fixed ? fixed->what : Prose(fmt::format("nothing called '{}' can be disturbed", name.text)),
        fixed ? fixed->remedy : Prose(names.suggest_disturbed(name.text))));
    return nullptr;
  }
  const auto range = target->range.value_or(devices::ValueRange{});
  if (range.whole) {
    problems.push_back(scenario::problem_at(
        "scenario.not-a-number"_code, scenario, name.place,
        fmt::format("{} takes whole numbers: nothing can be added little by little", name.text),
        "set it in the timeline"));
    return nullptr;
  }
  const auto limit = [&](double number) {
    return target->unit.empty() ? number : scenario::to_si(number, target->unit);
  };
  sums_.push_back({*target, limit(range.low), limit(range.high), target->read(), names.is_fault(name.text)});
  auto& sum = sums_.back();
  names.stand_in(name.text, {[&sum](double base) {
                               sum.base = base;
                               sum.put();
                             },
                             [&sum] { return sum.base; }});
  return &sum;
}

void Disturbances::Sum::put() const { target.write(std::clamp(base + added, low, high)); }

double Disturbances::Source::at(Time now) {
  const double since = seconds(now - of->from);
  const double fade = of->ramp > 0 ? std::min(1.0, since / seconds(of->ramp)) : 1;
  switch (of->kind) {
    case scenario::Disturbance::Kind::sine:
      value = amplitude * std::sin(2 * std::numbers::pi * of->frequency * since);
      break;
    case scenario::Disturbance::Kind::noise:
      value = amplitude * noise->next();
      break;
    case scenario::Disturbance::Kind::step:
      if (of->every == 0) {
        value = amplitude;
      } else if (now >= next) {
        value = amplitude * (2 * random.uniform() - 1);
        next += of->every;
      }
      break;
    case scenario::Disturbance::Kind::walk:
      if (now >= next) {
        value = std::clamp(value + (random.uniform() < 0.5 ? -step : step), -amplitude, amplitude);
        next += of->every;
      }
      break;
  }
  return fade * value;
}

void Disturbances::work(Time now) {
  for (auto& sum : sums_) {
    sum.was_active = std::exchange(sum.active, false);
    sum.added = 0;
  }
  bool any = false;
  Time next = never;
  for (auto& source : sources_) {
    auto& sum = *source.sum;
    if (source.active(now)) {
      sum.added += source.at(now);
      any = sum.active = true;
    } else if (now < source.of->from) {
      next = std::min(next, source.of->from);
    }
  }
  // What has just ended leaves the bare value.
  for (const auto& sum : sums_)
    if (sum.active || sum.was_active) sum.put();
  next_ = any ? now + 1 : next;
}

void Disturbances::visit(StateArchive& archive) {
  STATE(archive, next_);
  archive.each("sums_", sums_,
               [&](Sum& sum) { STATE(archive, sum.base, sum.added, sum.active, sum.was_active); });
  archive.each("sources_", sources_, [&](Source& source) {
    STATE(archive, source.random, source.value, source.next);
    if (source.noise) STATE(archive, *source.noise);
  });
}

}  // namespace drycut::sim::loop
