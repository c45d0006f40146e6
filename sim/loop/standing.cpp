#include "sim/loop/standing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/state_archive.hpp"
#include "sim/loop/program_words.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

namespace {

constexpr Time stays = 3 * second;  // what has not changed for so long stands ...
constexpr double at_work = 1.5;     // ... and for longer than so many pieces have taken

/// What a working machine may do without: a direction, a limit that is not reached.
bool may_be_off(const std::string& plug) {
  return plug.ends_with(".direction") || plug.ends_with(".backward") ||
         plug.find("limit") != std::string::npos;
}

/// A QMOVE device reads its home switch only in a PRESET.
bool seeks_home(devices::Controller& controller) {
  const auto programs = controller.programs();
  return presets(controller, "") ||
         std::any_of(programs.begin(), programs.end(), [](const devices::ProgramText& program) {
           return program.language == "il" || program.language == "st";
         });
}

std::optional<Finding> those_never_on(const auto&... levels) {
  std::vector<std::string> never;
  const auto look = [&](const auto& list) {
    for (const auto& one : list)
      if (!one.was_on) never.push_back(fmt::format("{} ({})", one.plug, one.terminal));
  };
  (look(levels), ...);
  if (never.empty()) return {};
  return Finding{"loop.never-on"_code, fmt::format("never seen on: {}", fmt::join(never, ", "))};
}

}  // namespace

Standing::Standing(const scenario::Scenario& scenario, devices::Controller& controller)
    : controller_(controller) {
  auto& cards = controller.cards();
  const bool homes = seeks_home(controller);
  const auto programs = read_programs(controller);
  const bool has_devices = std::any_of(programs.begin(), programs.end(), [](const ReadProgram& read) {
    return read.program.language == "cnf";
  });
  for (const auto& wire : scenario.wiring) {
    const auto found = controller.terminal(wire.terminal.text);
    const auto* address = std::get_if<devices::Address>(&found);
    if (address == nullptr) continue;
    const auto terminal = controller.terminal_name(*address);
    const auto& plug = wire.plug.text;
    const auto follow = [&](std::vector<Level>& levels, const bool& level) {
      // A lamp that a device works, and no program, is on where all is well.
      const bool wanted =
          &levels == &inputs_
              ? (homes || !plug.ends_with(".home")) && is_named(terminal, programs, Named::surely)
              : &levels == &lamps_ && has_devices && name_in_program(terminal, programs).empty();
      levels.push_back({terminal, plug, &level, level, level, wanted});
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
      if (levels != &outputs_) continue;
      if (worked_ > 0) longest_ = std::max(longest_, now - worked_);
      worked_ = now;
    }
}

std::vector<Finding> Standing::texts(Time now, double until) const {
  std::vector<Finding> texts;
  for (const auto& count : counts_)
    if (count.counter->count == count.first)
      texts.emplace_back("loop.counted-nothing"_code,
                         fmt::format("{} ({}) counted nothing", count.terminal, count.plug));
  const auto never = those_never_on(outputs_) ? those_never_on(outputs_, inputs_) : std::nullopt;
  std::vector<std::string> states;
  for (const auto& output : outputs_)
    states.push_back(fmt::format("{} {}", output.plug, output.last ? "on" : "off"));
  const auto long_enough = std::max(stays, static_cast<Time>(at_work * static_cast<double>(longest_)));
  const bool stand = worked_ > 0 && seconds(worked_) <= until && now - worked_ >= long_enough;
  if (!never && !stand) return texts;  // they work
  if (never) texts.push_back(*never);
  for (const auto& lamp : lamps_)
    if (lamp.last && lamp.changed && now - *lamp.changed >= stays)
      texts.emplace_back("loop.lamp-stays-on"_code,
                         fmt::format("{} is on since {} s{}", lamp.plug, record::seconds_text(*lamp.changed),
                                     switched_on_by(controller_, lamp.terminal)));
  if (never) return texts;
  // All have worked: where they have stopped, and what they wait for.
  texts.emplace_back("loop.machine-stands"_code,
                     fmt::format("{} since {} s", fmt::join(states, ", "), record::seconds_text(worked_)));
  if (auto waited = never_on()) texts.push_back(std::move(*waited));
  return texts;
}

std::string Standing::never_on(const std::string& plug) const {
  for (const auto& input : inputs_)
    if (input.plug == plug && input.is_wanted && !input.was_on)
      return fmt::format("{} ({})", input.plug, input.terminal);
  return "";
}

std::optional<Finding> Standing::never_on() const {
  auto wanted = inputs_;
  wanted.insert(wanted.end(), lamps_.begin(), lamps_.end());
  std::erase_if(wanted, [](const Level& level) { return !level.is_wanted; });
  return those_never_on(wanted);
}

void Standing::visit(StateArchive& archive) {
  for (auto* levels : {&lamps_, &outputs_, &inputs_})
    archive.each("levels", *levels,
                 [&](Level& level) { STATE(archive, level.last, level.was_on, level.changed); });
  STATE(archive, worked_, longest_);
  archive.each("counts_", counts_, [&](Count& count) { STATE(archive, count.first); });
}

}  // namespace drycut::sim::loop
