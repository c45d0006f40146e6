#include "sim/loop/standing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

namespace {

constexpr Time stays = 3 * second;  // what has not changed for so long stands: longer than a piece takes

/// What a working machine may do without: a direction, a limit that is not reached.
bool may_be_off(const std::string& plug) {
  return plug.ends_with(".direction") || plug.ends_with(".backward") ||
         plug.find("limit") != std::string::npos;
}

std::string never_on(const auto& levels) {
  std::vector<std::string> never;
  for (const auto& one : levels)
    if (!one.was_on) never.push_back(fmt::format("{} ({})", one.plug, one.terminal));
  return never.empty() ? "" : fmt::format("never seen on: {}", fmt::join(never, ", "));
}

}  // namespace

Standing::Standing(const scenario::Scenario& scenario, devices::Controller& controller) {
  auto& cards = controller.cards();
  for (const auto& wire : scenario.wiring) {
    const auto found = controller.terminal(wire.terminal.text);
    const auto* address = std::get_if<devices::Address>(&found);
    if (address == nullptr) continue;
    const auto terminal = controller.terminal_name(*address);
    const auto& plug = wire.plug.text;
    const auto follow = [&](std::vector<Level>& levels, const bool& level) {
      levels.push_back({terminal, plug, &level, level, level});
    };
    const bool on_panel = plug.starts_with("panel.");
    if (address->kind == devices::Kind::counter) {
      if (const auto at = cards.counters.find(*address); at != cards.counters.end())
        counts_.push_back({terminal, plug, &at->second, at->second.count});
    } else if (address->kind == devices::Kind::output) {
      const auto at = cards.outputs.find(*address);
      const bool gives_pulses = cards.pulse_outputs.contains(*address);
      if (at != cards.outputs.end() && !may_be_off(plug) && !gives_pulses)
        follow(on_panel ? lamps_ : outputs_, at->second.level);
    } else if (address->kind == devices::Kind::input && !on_panel && !may_be_off(plug)) {
      if (const auto at = cards.inputs.find(*address); at != cards.inputs.end())
        follow(inputs_, at->second.level);
    }
  }
}

void Standing::sample(Time now) {
  for (auto* levels : {&lamps_, &outputs_, &inputs_})
    for (auto& one : *levels) {
      if (*one.level == one.last) continue;
      one.last = *one.level;
      one.was_on = one.was_on || one.last;
      one.changed = now;
    }
}

std::vector<std::string> Standing::texts(Time now) const {
  std::vector<std::string> texts;
  for (const auto& count : counts_)
    if (count.counter->count == count.first)
      texts.push_back(fmt::format("{} ({}) counted nothing", count.terminal, count.plug));
  auto never = never_on(outputs_);
  std::optional<Time> last;
  std::vector<std::string> states;
  for (const auto& output : outputs_) {
    if (output.changed) last = std::max(last.value_or(0), *output.changed);
    states.push_back(fmt::format("{} {}", output.plug, output.last ? "on" : "off"));
  }
  const bool stand = last && now - *last >= stays;
  if (never.empty() && !stand) return texts;  // they work
  for (const auto& lamp : lamps_)
    if (lamp.last && lamp.changed && now - *lamp.changed >= stays)
      texts.push_back(fmt::format("{} is on since {} s", lamp.plug, record::seconds_text(*lamp.changed)));
  if (!never.empty()) {
    texts.push_back(std::move(never));
    return texts;
  }
  // All have worked: where they have stopped, and what they wait for.
  texts.push_back(fmt::format("{} since {} s", fmt::join(states, ", "), record::seconds_text(*last)));
  if (auto waited = never_on(inputs_); !waited.empty()) texts.push_back(std::move(waited));
  return texts;
}

}  // namespace drycut::sim::loop
