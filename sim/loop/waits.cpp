#include "sim/loop/waits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.hpp"
#include "sim/loop/consistency.hpp"
#include "sim/loop/recorder.hpp"

namespace drycut::sim::loop {

namespace {

constexpr Time told_wait = second / 2;  // a wait that is told

/// The line without its comment.
std::string code_of(const devices::ProgramText& program, int number) {
  const auto lines = split_lines(program.text);
  if (number < 1 || static_cast<std::size_t>(number) > lines.size()) return "";
  const auto line = lines[static_cast<std::size_t>(number) - 1];
  return std::string(trimmed(line.substr(0, line.find(program.language == "st" ? "//" : ";"))));
}

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

}  // namespace

Waits waits_of(devices::Controller& controller, Time now) {
  Waits found;
  const auto waits = controller.waits();
  const auto programs = controller.programs();
  for (const auto& wait : waits) {
    if (now - wait.since_ns < std::min(told_wait, now / 2)) continue;
    const auto program = std::find_if(programs.begin(), programs.end(),
                                      [&](const auto& one) { return one.name == wait.program; });
    if (program == programs.end()) continue;
    found.since = std::max(found.since, seconds(wait.since_ns));
    found.texts.push_back(fmt::format(
        "{} stands at line {}, {}{}, since {} s", wait.program, wait.line, code_of(*program, wait.line),
        values_of(*program, wait.line, controller), seconds_text(wait.since_ns)));
    if (program->language == "st") break;  // what comes behind has to wait for it
  }
  const auto running = std::count_if(programs.begin(), programs.end(),
                                     [](const auto& program) { return program.language == "qcl"; });
  found.all = running > 0 && static_cast<std::size_t>(running) == found.texts.size();
  return found;
}

std::string without_loop(devices::Controller& controller) {
  std::string code;
  for (const auto& program : controller.programs())
    if (program.language == "qcl") code += program_words(program);
  for (const auto& name : controller.names()) {
    constexpr std::string_view state = ".st_loopon";
    if (!name.ends_with(state)) continue;
    const auto axis = name.substr(0, name.size() - state.size());
    const auto value = controller.find(name);
    if (!value || value->read() != 0 || code.find("loopon " + lower(axis)) != std::string::npos) continue;
    return fmt::format("{} is without LOOPON: no program closes its position loop", axis);
  }
  return "";
}

}  // namespace drycut::sim::loop
