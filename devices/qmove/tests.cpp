#include "devices/qmove/tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "devices/qmove/qmove_controller.hpp"

namespace drycut::devices::qmove {

namespace {

std::string_view word_at(std::string_view line, std::size_t number) {
  for (;; --number) {
    line = trimmed(line);
    const auto end = std::find_if_not(line.begin(), line.end(), in_name) - line.begin();
    const auto word = line.substr(0, static_cast<std::size_t>(end));
    if (number == 0 || word.empty()) return word;
    line.remove_prefix(word.size());
  }
}

bool has_tests(const QclProgram& program) {
  return std::any_of(program.subs.begin(), program.subs.end(),
                     [](const QclSub& sub) { return is_test(sub.name); });
}

/// The module as a task that calls a subroutine and ends.
QclProgram calling(QclProgram program, const QclSub& sub) {
  program.start = static_cast<int>(program.code.size());
  for (const Instruction& one : {Instruction{QclOp::call, sub.code, 0}, Instruction{QclOp::end, 0, 0}}) {
    program.code.push_back(one);
    program.lines.push_back(sub.line);
    program.begins.push_back(false);
  }
  return program;
}

/// "glLength = 480, glMax = 500"
std::string values_of(QmoveController& controller, std::size_t task, int line) {
  std::string told;
  const auto texts = controller.programs();
  const auto& named = texts[task].values;
  const auto found = named.find(line);
  if (found == named.end()) return told;
  for (const auto& name : found->second)
    if (const auto value = controller.find(name))
      told += fmt::format("{}{} = {:g}", told.empty() ? "" : ", ", value->name, value->read());
  return told;
}

TestFailure failure_of(QmoveController& controller, const QclProgram& program,
                       const QmoveController::Stop& stop) {
  if (stop.error != RunTimeError::assertion)
    return {program.file, stop.line,
            fmt::format("error {}: {}", static_cast<int>(stop.error), name_of(stop.error)), "", ""};
  const auto line = split_lines(program.text)[static_cast<std::size_t>(stop.line) - 1];
  auto asserted = trimmed(line);
  asserted.remove_prefix(word_at(asserted, 0).size());
  asserted = trimmed(asserted.substr(0, asserted.find(';')));
  return {program.file, stop.line, "", std::string(asserted), values_of(controller, stop.task, stop.line)};
}

TestResult run_test(const Configuration& configuration, std::vector<QclProgram> programs, std::size_t task,
                    const QclSub& sub, std::span<const CatalogueEntry> catalogue, const TestTimes& times,
                    Coverage* coverage) {
  TestResult result{sub.name, programs[task].file, sub.line};
  QmoveController controller(configuration, programs, catalogue, times.cycle_ns);
  controller.count_programs();
  for (;; result.took_ns += times.cycle_ns) {
    controller.run_devices(result.took_ns);
    controller.run_tasks(result.took_ns);
    if (const auto stop = controller.stopped())
      result.log.add(failure_of(controller, programs[stop->task], *stop));
    if (!result.log.failures.empty() || controller.ended(task)) break;
    if (result.took_ns + times.cycle_ns <= times.timeout_ns) continue;
    auto late = not_finished(result, times, "see what it waits for here");
    late.line = controller.positions(result.took_ns).tasks[task].line;
    result.log.add(std::move(late));
    break;
  }
  const auto& code = programs[task].code;
  for (std::size_t i = 0; i < code.size(); ++i)
    if (code[i].op == QclOp::assertion && controller.counts(task).passed[i] > 0) ++result.log.assertions;
  if (coverage != nullptr) controller.add_coverage(*coverage);
  return result;
}

}  // namespace

std::string with_assertions(std::string_view text) {
  std::string all(text);
  bool in_test = false;
  for (const auto line : split_lines(text)) {
    if (same_word(word_at(line, 0), "SUB")) in_test = is_test(word_at(line, 1));
    if (same_word(word_at(line, 0), "ENDSUB")) in_test = false;
    const auto comment = trimmed(line);
    if (in_test && comment.starts_with(';') && same_word(word_at(comment.substr(1), 0), "ASSERT"))
      all[static_cast<std::size_t>(comment.data() - text.data())] = ' ';
  }
  return all;
}

void note_misspelt_assertions(QclProgram& program) {
  bool in_test = false;
  int number = 0;
  for (const auto line : split_lines(program.text)) {
    ++number;
    if (same_word(word_at(line, 0), "SUB")) in_test = is_test(word_at(line, 1));
    if (same_word(word_at(line, 0), "ENDSUB")) in_test = false;
    const auto comment = trimmed(line);
    if (!in_test || !comment.starts_with(';')) continue;
    const auto word = word_at(comment.substr(1), 0);
    // INSERT and its like are words of comments.
    if (word.empty() || lower(word)[0] != 'a' || nearest(std::string(word), {"ASSERT"}).empty()) continue;
    program.notes.emplace_back(
        "qcl.unknown-name"_code,
        fmt::format("{}:{}:{}: {} is a comment and tests nothing; did you mean 'ASSERT'?", program.file,
                    number, word.data() - line.data() + 1, word));
  }
}

std::vector<TestResult> run_tests(const Configuration& configuration, std::span<const QclProgram> modules,
                                  std::span<const CatalogueEntry> catalogue, const TestTimes& times,
                                  Coverage* coverage) {
  std::vector<TestResult> results;
  for (const QclProgram& module : modules)
    for (const QclSub& sub : module.subs) {
      if (!is_test(sub.name)) continue;
      std::vector<QclProgram> programs{calling(module, sub)};
      for (const QclProgram& other : modules)
        if (!has_tests(other)) programs.push_back(other);
      results.push_back(run_test(configuration, std::move(programs), 0, sub, catalogue, times, coverage));
    }
  return results;
}

namespace {

/// The instructions that the task may come to; subroutines, whether something calls them or not.
std::vector<bool> reached(const QclProgram& program) {
  std::vector<bool> seen(program.code.size());
  std::vector<int> open{0, program.start};
  for (const QclSub& sub : program.subs) open.push_back(sub.code);
  while (!open.empty()) {
    const auto at = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (at >= seen.size() || seen[at]) continue;
    seen[at] = true;
    const auto& [op, a, b] = program.code[at];
    if (op == QclOp::jump || op == QclOp::jump_if_zero) open.push_back(a);
    if (op != QclOp::jump && op != QclOp::back && op != QclOp::end) open.push_back(static_cast<int>(at) + 1);
  }
  return seen;
}

/// Whether an operator works on one value, or on one of two.
bool is_of_one(QclOp op) {
  return op == QclOp::negate || (op >= QclOp::negate_real && op <= QclOp::to_flag_real_below) ||
         op == QclOp::logic_not || op == QclOp::bit_not;
}

/// Whether what stands on top of the stack before instruction `at` is made of constants alone.
bool is_constant_before(const QclProgram& program, std::size_t at) {
  for (int wanted = 1; wanted > 0;) {
    if (at == 0) return false;
    const auto op = program.code[--at].op;
    if (op == QclOp::push)
      --wanted;
    else if (op < QclOp::add || op > QclOp::bit_not)
      return false;
    else if (!is_of_one(op))
      ++wanted;
  }
  return true;
}

}  // namespace

Coverage coverage_of(const QclProgram& program, const Counts& counts) {
  constexpr std::array<std::string_view, 6> structure{"ELSE", "ENDIF", "ENDWHILE", "NEXT", "SUB", "ENDSUB"};
  Coverage all;
  auto& file = all.files[program.file];
  const auto lines = split_lines(program.text);
  std::vector<bool> left_out(lines.size() + 1);  // by line
  bool in_test = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (same_word(word_at(lines[i], 0), "SUB")) in_test = is_test(word_at(lines[i], 1));
    left_out[i + 1] = in_test || is_one_of(structure, word_at(lines[i], 0));
    if (same_word(word_at(lines[i], 0), "ENDSUB")) in_test = false;
  }
  const auto may_run = reached(program);
  for (std::size_t i = 0; i < counts.passed.size(); ++i) {
    const int line = program.lines[i];
    const auto op = program.code[i].op;
    // Every module has an END; behind a JUMP it only ends the text.
    if (left_out[static_cast<std::size_t>(line)] || (op == QclOp::end && !may_run[i])) continue;
    const bool decides = op == QclOp::jump_if_zero || op == QclOp::wait_until;
    if (program.begins[i] || decides) file.line(line, counts.passed[i]);
    if (decides && !is_constant_before(program, i))
      file.decisions[line].push_back({counts.passed[i] - counts.refused[i], counts.refused[i]});
  }
  for (const QclSub& sub : program.subs) {
    if (is_test(sub.name)) continue;
    auto& calls = file.functions[{sub.line, sub.name}];
    for (std::size_t i = 0; i < counts.passed.size(); ++i)
      if (program.code[i].op == QclOp::call && program.code[i].a == sub.code) calls += counts.passed[i];
  }
  return all;
}

}  // namespace drycut::devices::qmove
