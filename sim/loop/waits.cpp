#include "sim/loop/waits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.hpp"
#include "sim/loop/program_words.hpp"

namespace drycut::sim::loop {

namespace {

constexpr Time told_wait = second / 2;  // a wait that is told ...
constexpr Time share_of_run =
    20;  // ... in a run of at most so many of them: a long run's end finds it at work

constexpr Time long_timer = 4;  // a timer of a quarter of the run and more is one

std::string values_of(const devices::ProgramText& program, int line, devices::Controller& controller) {
  const auto named = program.values.find(line);
  if (named == program.values.end()) return "";
  std::vector<std::string> values;
  for (const auto& name : named->second)
    if (const auto value = controller.find(name))
      values.push_back(fmt::format("{}={:.6g}{}{}", value->name, value->read(),
                                   value->unit.empty() ? "" : " ", value->unit));
  return values.empty() ? "" : fmt::format(" ({})", fmt::join(values, "; "));
}

/// A terminal that the program of that name works or reads by a name of the configuration: "2.OUT04
/// (panel.alarm)"; "" = none.
std::string wire_that_it_names(const scenario::Scenario& scenario, devices::Controller& controller,
                               const std::string& program) {
  const auto programs = controller.programs();
  const auto own =
      std::find_if(programs.begin(), programs.end(), [&](const auto& one) { return one.name == program; });
  const auto setup =
      std::find_if(programs.begin(), programs.end(), [](const auto& one) { return one.language == "cnf"; });
  if (own == programs.end() || setup == programs.end()) return "";
  const auto lines = split_lines(setup->text);
  for (const auto& [number, names] : setup->values) {
    const auto& line = lines[static_cast<std::size_t>(number) - 1];
    for (const auto& wire : scenario.wiring) {
      if (line.find(wire.terminal.text) == std::string_view::npos) continue;
      for (const auto& [at, named] : own->values)
        if (std::find(named.begin(), named.end(), names.front()) != named.end())
          return fmt::format("{} ({})", wire.terminal.text, wire.plug.text);
    }
  }
  return "";
}

}  // namespace

Waits waits_of(devices::Controller& controller, Time now) {
  Waits found;
  const auto waits = controller.waits();
  const auto programs = controller.programs();
  for (const auto& wait : waits) {
    const Time waited = now - wait.since_ns;
    if (waited < std::min(told_wait, now / 2) || (!wait.ended && waited < now / share_of_run)) continue;
    // A timer that soon elapses is no standstill.
    if (wait.until_ns > 0 && wait.until_ns - wait.since_ns < now / long_timer) continue;
    const auto program = std::find_if(programs.begin(), programs.end(),
                                      [&](const auto& one) { return one.name == wait.program; });
    if (program == programs.end()) continue;
    if (wait.ended && wait.since_ns > now / 2) continue;  // it may well be done
    found.since = std::max(found.since, seconds(wait.since_ns));
    if (wait.ended) {
      found.texts.emplace_back("loop.program-ended"_code,
                               fmt::format("{} came to its end, line {}, at {} s", wait.program, wait.line,
                                           seconds_text(wait.since_ns)));
      continue;
    }
    if (!wait.lacks.empty()) {
      found.texts.emplace_back("loop.program-waits"_code,
                               fmt::format("{} stands at line {}, {}: {}", wait.program, wait.line,
                                           code_of(*program, wait.line), wait.lacks));
      continue;
    }
    found.texts.emplace_back(
        "loop.program-waits"_code,
        fmt::format(
            "{} stands at line {}, {}{}, since {} s{}", wait.program, wait.line, code_of(*program, wait.line),
            values_of(*program, wait.line, controller), seconds_text(wait.since_ns),
            wait.until_ns > 0 ? fmt::format(", until its timer elapses at {} s", seconds_text(wait.until_ns))
                              : ""));
    if (program->language == "st") break;  // what comes behind has to wait for it
  }
  const auto running = std::count_if(programs.begin(), programs.end(),
                                     [](const auto& program) { return program.language == "qcl"; });
  found.all = running > 0 && static_cast<std::size_t>(running) == found.texts.size();
  return found;
}

std::vector<Finding> ended_at_once(const scenario::Scenario& scenario, devices::Controller& controller,
                                   Time now) {
  constexpr Time at_once = 1 * second;
  constexpr Time long_run = 2 * at_once;
  std::vector<Finding> found;
  // Of QCL alone: what is scanned never ends.
  if (now < long_run || scenario.controller->kind() != "qmove") return found;
  for (const auto& wait : controller.waits()) {
    if (!wait.ended || wait.since_ns > at_once) continue;
    const auto wire = wire_that_it_names(scenario, controller, wait.program);
    if (!wire.empty())
      found.emplace_back("loop.program-ended-early"_code,
                         fmt::format("{} came to its end at {} s, line {}, and looks after {} no more",
                                     wait.program, seconds_text(wait.since_ns), wait.line, wire));
  }
  return found;
}

std::optional<OpenLoop> without_loop(devices::Controller& controller) {
  std::string code;
  for (const auto& program : controller.programs())
    if (program.language == "qcl") code += program_words(program);
  for (const auto& name : controller.names()) {
    constexpr std::string_view state = ".st_loopon";
    if (!name.ends_with(state)) continue;
    const auto axis = name.substr(0, name.size() - state.size());
    const auto value = controller.find(name);
    if (!value || value->read() != 0 || code.find("loopon " + lower(axis)) != std::string::npos) continue;
    return OpenLoop{axis,
                    {"loop.axis-open"_code,
                     fmt::format("{} is without LOOPON: no program closes its position loop", axis)}};
  }
  return {};
}

}  // namespace drycut::sim::loop
