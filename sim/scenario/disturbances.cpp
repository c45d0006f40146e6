// disturbances: what is added to settings, live parameters and faults of plants.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/scenario/archive.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

const std::vector<std::string> disturbance_words = {"sine", "noise", "step", "walk"};

std::string band_text(const Disturbance::Band& band) {
  return fmt::format("{}..{}", from_si(band.low, "Hz"), format_quantity(band.high, "Hz"));
}

// "5..20 Hz"
Form band_form(Disturbance::Band& band) {
  const auto read = [&band](const Text& text, const std::string& name, Findings& findings) {
    constexpr auto* remedy = "write a band as 5..20 Hz, or from 0: 0..20 Hz";
    const auto dots = text.text.find("..");
    const auto low = parse_quantity(text.text.substr(0, dots));
    if (dots == std::string::npos || !low) {
      findings.add("scenario.not-a-number"_code, text.place,
                   fmt::format("{}: '{}' is no band", name, text.text), remedy);
      return;
    }
    const auto high = read_si({text.text.substr(dots + 2), text.at(dots + 2)}, name, "Hz", findings);
    if (!high) return;
    // The lower end has the unit of the upper one unless it has one of its own.
    const auto unit = parse_quantity(text.text.substr(dots + 2))->unit;
    const auto first = fmt::format("{} {}", low->number, low->unit.empty() ? unit : low->unit);
    const auto from = read_si({first, text.place}, name, "Hz", findings);
    if (!from) return;
    if (*from < 0 || *from >= *high)
      findings.add("scenario.order"_code, text.place,
                   fmt::format("{}: {} is not a lower and a higher frequency", name, text.text), remedy);
    band = {*from, *high, text.place};
  };
  return single(
      read, [&band] { return band_text(band); },
      R"({"type": "string", "pattern": "^[+]?[0-9.]+.*[.][.].+[A-Za-z]"})");
}

struct KeyRule {
  std::string_view key;
  std::vector<Disturbance::Kind> takes;
  std::vector<Disturbance::Kind> needs;
  std::string_view example;
};

std::string_view word_of(Disturbance::Kind kind) { return disturbance_words[static_cast<std::size_t>(kind)]; }

void judge_disturbance(MapReader& reader, const Disturbance& disturbance) {
  static const std::vector<KeyRule> rules = {
      {"frequency", {Disturbance::Kind::sine}, {Disturbance::Kind::sine}, "2 Hz"},
      {"band", {Disturbance::Kind::noise}, {Disturbance::Kind::noise}, "0..20 Hz"},
      {"step", {Disturbance::Kind::walk}, {Disturbance::Kind::walk}, "0.1 m/min"},
      {"every", {Disturbance::Kind::step, Disturbance::Kind::walk}, {Disturbance::Kind::walk}, "100 ms"},
  };
  if (!reader.is_sound()) return;
  const auto has = [&](const std::vector<Disturbance::Kind>& kinds) {
    return std::find(kinds.begin(), kinds.end(), disturbance.kind) != kinds.end();
  };
  for (const auto& rule : rules) {
    if (has(rule.needs) && !reader.has(rule.key))
      reader.missing(rule.key, fmt::format("add {}: {}", rule.key, rule.example));
    if (has(rule.takes) || !reader.has(rule.key)) continue;
    std::vector<std::string_view> owners;
    for (const auto kind : rule.takes) owners.push_back(word_of(kind));
    reader.refuse("scenario.needs-another"_code, rule.key,
                  fmt::format("{} does not go with a {}", reader.full(rule.key), word_of(disturbance.kind)),
                  fmt::format("{} belongs to {}", rule.key, fmt::join(owners, " and ")));
  }
  const bool single_step = disturbance.kind == Disturbance::Kind::step && disturbance.every == 0;
  if (disturbance.amplitude.number < 0 && !single_step)
    reader.findings().add("scenario.out-of-range"_code, disturbance.amplitude.place,
                          fmt::format("{} is negative", reader.full("amplitude")),
                          "a size is 0 or more; only a single step goes down");
  if (disturbance.step.number < 0)
    reader.findings().add("scenario.out-of-range"_code, disturbance.step.place,
                          fmt::format("{} is negative", reader.full("step")),
                          "a walk goes up and down by the same step");
  if (disturbance.to && *disturbance.to <= disturbance.from)
    reader.refuse("scenario.order"_code, "to", fmt::format("{} is not after from", reader.full("to")),
                  "let to be later than from");
}

}  // namespace

void visit(Archive& archive, Disturbance& disturbance) {
  const auto kind = disturbance.kind;
  archive.in_line();
  archive.value({"at", "a setting, live parameter or fault of a plant: web.speed, web.wheel.slip"},
                form(disturbance.at));
  archive.require("at", "name what it is added to: at: web.speed");
  archive.value({"kind", "sine, noise of a band, a step or random steps, a random walk"},
                choice_form(disturbance_words, disturbance.kind));
  archive.require("kind", "one of sine, noise, step, walk");
  archive.value({"amplitude", "sine: peak; noise: rms; step: height; walk: how far it goes at most"},
                form(disturbance.amplitude));
  archive.require("amplitude", "say how large it is");
  archive.value({"frequency", "of a sine", kind == Disturbance::Kind::sine},
                form(disturbance.frequency, "Hz", 1e-6, 1e6, "1e-6 Hz to 1e6 Hz"));
  archive.value({"band", "of noise: 5..20 Hz", kind == Disturbance::Kind::noise},
                band_form(disturbance.band));
  archive.value({"step", "of a walk: up or down by this each time", kind == Disturbance::Kind::walk},
                form(disturbance.step));
  archive.value({"every", "walk: its steps; step: a new height by chance each time", disturbance.every > 0},
                form(disturbance.every, Sign::positive));
  archive.value({"ramp", "it fades in over this time", disturbance.ramp > 0},
                form(disturbance.ramp, Sign::not_negative));
  archive.value({"seed", "of its own; else from the scene's seed and its place in the list"},
                form(disturbance.seed));
  archive.value({"from", "it begins then"}, form(disturbance.from, Sign::not_negative));
  archive.value({"to", "it ends then"}, form(disturbance.to, Sign::positive));
  archive.judge([&disturbance](MapReader& reader) {
    judge_disturbance(reader, disturbance);
    // What is wrong has been told: nothing is looked up for it.
    if (!reader.is_sound()) disturbance.at.text.clear();
  });
}

}  // namespace drycut::sim::scenario
