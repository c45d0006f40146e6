// What one sees of the programs while they run: their texts, the values that each line names, where the tasks
// stand.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "devices/qmove/lexer.hpp"
#include "devices/qmove/qmove_controller.hpp"
#include "devices/qmove/tests.hpp"

namespace drycut::devices::qmove {

namespace {

/// `[3]`, `[2, cLast]`: an index of numbers and constants that begins at token `at`, as find() takes it; ""
/// if it is none, or depends on a variable.
std::string fixed_index(const std::vector<QclToken>& tokens, std::size_t at, const SymbolTable& names) {
  std::string index;
  for (; at < tokens.size(); ++at) {
    const QclToken& token = tokens[at];
    if (token.kind == QclToken::Kind::sign && (token.is("[") || token.is(",") || token.is("]"))) {
      index += token.text;
      if (token.is("]")) return index;
    } else if (token.kind == QclToken::Kind::number && !token.is_real) {
      index += std::to_string(token.integer);
    } else if (const auto* thing = token.kind == QclToken::Kind::name ? names.find(token.text) : nullptr;
               thing != nullptr && thing->kind == NamedThing::Kind::constant && !thing->real) {
      index += fmt::format("{:.0f}", thing->value);
    } else {
      return "";
    }
  }
  return "";
}

}  // namespace

ProgramText QmoveController::module_text(const QclProgram& program) const {
  ProgramText told(program.file, "qcl", program.text);
  const auto lines = split_lines(told.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int line = static_cast<int>(i) + 1;
    Problems none;  // it has been compiled
    const auto tokens = tokens_of(lines[i], line, program.file, none);
    for (std::size_t t = 0; t + 1 < tokens.size(); ++t) {
      if (tokens[t].kind != QclToken::Kind::name) continue;
      const std::string name(tokens[t].text);
      if (tokens[t + 1].is(":") && tokens[t + 2].kind == QclToken::Kind::name) {
        if (const auto found = locate(fmt::format("{}.{}", name, tokens[t + 2].text))) {
          told.add_value(line, found->name);
          t += 2;
          continue;
        }
      }
      const auto index = tokens[t + 1].is("[") ? fixed_index(tokens, t + 1, names_) : std::string();
      if (const auto found = locate(name + index)) told.add_value(line, found->name);
    }
  }
  return told;
}

std::vector<ProgramText> QmoveController::programs() {
  if (!texts_.empty()) return texts_;
  texts_.reserve(programs_.size() + 1);
  for (const QclProgram& program : programs_) texts_.push_back(module_text(program));
  ProgramText& set_up = texts_.emplace_back(configuration_.file, "cnf", configuration_.text);
  const auto add = [&](const auto& things) {
    for (const auto& thing : things) set_up.add_value(thing.place.line, thing.name);
  };
  add(configuration_.scalars);
  add(configuration_.timers);
  add(configuration_.inputs);
  add(configuration_.outputs);
  return texts_;
}

ProgramPositions QmoveController::positions(std::int64_t) const {
  ProgramPositions told;
  told.tasks.reserve(programs_.size());
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    const QclProgram& program = programs_[i];
    const auto line = [&](int at) { return program.lines[static_cast<std::size_t>(at)]; };
    ProgramPositions::Task task{program.name, i, 0, doing(i), {}};
    if (powered_ && !program.code.empty()) {
      task.line = line(tasks_[i].at);
      task.calls.reserve(tasks_[i].calls.size());
      for (const int call : tasks_[i].calls) task.calls.push_back(line(call));
    }
    told.tasks.push_back(std::move(task));
  }
  told.scanned.resize(programs_.size() + 1);
  return told;
}

void QmoveController::count_programs() {
  counts_.clear();
  for (const QclProgram& program : programs_) counts_.emplace_back(program.code.size());
}

void QmoveController::add_coverage(Coverage& to) const {
  for (std::size_t i = 0; i < counts_.size(); ++i) to.add(coverage_of(programs_[i], counts_[i]));
}

std::optional<QmoveController::Stop> QmoveController::stopped() const {
  if (mode_ != OsMode::error) return std::nullopt;
  return Stop{failed_, programs_[failed_].lines[static_cast<std::size_t>(tasks_[failed_].at)], error_};
}

std::vector<ProgramWait> QmoveController::waits() {
  std::vector<ProgramWait> waits;
  if (!powered_ || mode_ != OsMode::run) return waits;
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    const int at = tasks_[i].waits_at;
    if (at < 0) continue;
    const ProgramText named(programs_[i].file, "qcl", "");
    const auto first = static_cast<std::size_t>(at);
    ProgramWait wait{named.name, programs_[i].lines[first], tasks_[i].waits_since, tasks_[i].ended};
    const auto& code = programs_[i].code;
    for (auto asked = first; asked < code.size() && code[asked].op != QclOp::wait_until; ++asked) {
      const bool is_timer = !wait.ended && code[asked].op == QclOp::load_timer;
      const auto elapses = is_timer ? machine_.timers[static_cast<std::size_t>(code[asked].a)] : 0;
      if (elapses > machine_.now) wait.until_ns = std::max(wait.until_ns, elapses);
    }
    waits.push_back(std::move(wait));
  }
  return waits;
}

std::string QmoveController::doing(std::size_t number) const {
  const Task& task = tasks_[number];
  const QclProgram& program = programs_[number];
  if (!powered_) return "no power";
  if (mode_ == OsMode::error)
    return number == failed_ ? fmt::format("error {}: {}", static_cast<int>(error_), name_of(error_))
                             : "stopped";
  if (task.ended) return "ended";
  if (task.in_turn) return "runs";
  if (task.wait == Task::Wait::none) return task.at == 0 ? "begins" : "waits";
  const auto device = static_cast<std::size_t>(program.code[static_cast<std::size_t>(task.at)].b);
  return fmt::format("waits for {}", configuration_.devices[device].name);
}

}  // namespace drycut::devices::qmove
