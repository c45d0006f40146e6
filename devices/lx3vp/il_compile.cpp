#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/il_rungs.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr std::size_t most_problems = 1000;

struct Word {
  std::string_view text;
  int column = 1;
};

/// The words of a line, without its comment.
std::vector<Word> words_of(std::string_view line) {
  line = line.substr(0, std::min({line.find(';'), line.find("//"), line.size()}));
  const auto is_gap = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == ','; };
  std::vector<Word> words;
  for (std::size_t i = 0; i < line.size();) {
    if (is_gap(line[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < line.size() && !is_gap(line[end])) ++end;
    words.push_back({line.substr(i, end - i), static_cast<int>(i) + 1});
    i = end;
  }
  return words;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t most = 24;
  std::string shown = "'";
  for (const char c : text.substr(0, most)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > most ? "...'" : "'");
}

bool needs_memory(const Step& step) {
  const Op op = step.op();
  return (op >= Op::ldp && op <= Op::orf) || op == Op::pls || op == Op::plf || op == Op::out ||
         (step.spelling != nullptr && step.spelling->pulse);
}

class Compiler {
 public:
  Compiler(std::string_view text, const std::string& file, Problems& problems)
      : text_(text), problems_(problems), before_(problems.size()) {
    program_.file = file;
  }

  Program compile() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    while (!text_.empty() && !full_) {
      const auto end = std::min(text_.find('\n'), text_.size());
      ++line_;
      const auto words = words_of(text_.substr(0, end));
      if (!words.empty()) read_line(words);
      text_.remove_prefix(std::min(end + 1, text_.size()));
    }
    if (!full_) finish();
    return std::move(program_);
  }

 private:
  void problem(int column, std::string what, std::string remedy) {
    problem_at(std::max(line_, 1), column, std::move(what), std::move(remedy));
  }
  void problem_at(int line, int column, std::string what, std::string remedy) {
    if (full_) return;
    problems_.push_back({program_.file, line, column, std::move(what), std::move(remedy)});
    if (problems_.size() - before_ < most_problems) return;
    full_ = true;
    problems_.push_back({program_.file, line, column, "too many problems: the rest is not told",
                         "is this an instruction list?"});
  }

  // Lines.

  void read_line(const std::vector<Word>& words) {
    if (ended_) {
      problem(words.front().column, "stands behind END", "END is the last instruction");
      full_ = true;
      return;
    }
    if (is_label(words.front().text)) {
      read_label(words);
      return;
    }
    const auto* spelling = find_spelling(words.front().text);
    if (spelling == nullptr) {
      refuse_mnemonic(words.front());
      return;
    }
    Step step;
    step.spelling = spelling;
    step.line = line_;
    step.column = words.front().column;
    read_operands(step, words);
    add(std::move(step));
  }

  static bool is_label(std::string_view word) {
    return word.size() > 1 && (word.front() == 'P' || word.front() == 'p') && word[1] >= '0' &&
           word[1] <= '9';
  }

  void read_label(const std::vector<Word>& words) {
    auto text = words.front().text;
    if (text.ends_with(':')) text.remove_suffix(1);
    OperandFault fault;
    auto operand = read_operand(text, fault);
    if (!operand) {
      problem(words.front().column, std::move(fault.what), std::move(fault.remedy));
      return;
    }
    if (words.size() > 1)
      problem(words[1].column, fmt::format("{} stands behind a label", quoted(words[1].text)),
              "give a label a line of its own");
    const auto [first, fresh] = labels_.emplace(operand->number, Label{line_, program_.steps.size()});
    if (!fresh) {
      problem(words.front().column, fmt::format("label {} is there twice", to_string(*operand)),
              fmt::format("it was first given in line {}", first->second.line));
      return;
    }
    Step step;
    step.line = line_;
    step.column = words.front().column;
    step.operands.push_back(*operand);
    add(std::move(step));
  }

  void refuse_mnemonic(const Word& word) {
    if (is_not_simulated(word.text)) {
      problem(word.column, fmt::format("{} is not simulated", word.text),
              "`drycut devices LX3VP` lists what is");
      return;
    }
    std::vector<std::string> names;
    for (const auto& spelling : spellings()) names.push_back(spelling.text);
    const auto near = nearest(std::string(word.text.substr(0, 24)), names);
    problem(word.column, fmt::format("there is no instruction {}", quoted(word.text)),
            near.empty() ? "one instruction a line: LD X0" : fmt::format("did you mean {}?", near));
  }

  // Operands.

  void read_operands(Step& step, const std::vector<Word>& words) {
    std::string kinds(step.spelling->mnemonic->operands);
    for (std::size_t i = 1; i < words.size(); ++i) {
      OperandFault fault;
      auto operand = read_operand(words[i].text, fault);
      if (!operand) {
        problem(words[i].column, std::move(fault.what), std::move(fault.remedy));
        continue;
      }
      operand->column = words[i].column;
      step.operands.push_back(*operand);
      const auto place = i - 1;
      // The set value of a timer or a counter.
      if (place == 0 && step.op() == Op::out && (operand->kind == Kind::T || operand->kind == Kind::C))
        kinds += 'v';
      if (place < kinds.size()) check_operand(step, *operand, kinds[place]);
    }
    if (words.size() - 1 != kinds.size()) {
      const auto at = words.size() - 1 > kinds.size() ? words[kinds.size() + 1] : words.back();
      problem(at.column,
              fmt::format("{} has {} operand{}, not {}", step.spelling->text, kinds.size(),
                          kinds.size() == 1 ? "" : "s", words.size() - 1),
              operands_text(step, kinds));
      return;
    }
    check_together(step);
  }

  static std::string operands_text(const Step& step, const std::string& kinds) {
    if (kinds.empty()) return "write it alone";
    std::string text = "give ";
    for (std::size_t i = 0; i < kinds.size(); ++i)
      text += fmt::format("{}{}",
                          i == 0                  ? ""
                          : i + 1 == kinds.size() ? " and then "
                                                  : ", then ",
                          operand_text(kinds[i]));
    (void)step;
    return text;
  }

  void check_operand(const Step& step, const Operand& operand, char kind) {
    if (kind == 'v') {
      check_set_value(step, operand);
      return;
    }
    if (auto fault = misfit(operand, kind, *step.spelling))
      problem(operand.column, std::move(fault->what), std::move(fault->remedy));
  }

  void check_set_value(const Step& step, const Operand& operand) {
    constexpr int most = 32767;
    const auto& coil = step.operands.front();
    const bool wide = coil.kind == Kind::C && coil.number >= 200;
    const auto remedy =
        wide ? "give a set value K or the first D of a pair" : "give a set value K1 to K32767 or a D";
    const bool is_number = operand.kind == Kind::constant;
    if (!is_number && operand.kind != Kind::D)
      problem(operand.column, fmt::format("{} is no set value", to_string(operand)), remedy);
    else if (is_number && !wide && (operand.value < 1 || operand.value > most))
      problem(operand.column, fmt::format("set value {} is out of range", to_string(operand)), remedy);
    else if (!is_number && wide && operand.number == 8255)
      problem(operand.column, fmt::format("{} is no pair of words", to_string(operand)), remedy);
  }

  /// Operands that must go together.
  void check_together(const Step& step) {
    if (step.op() == Op::zrst && step.operands.size() == 2) {
      const auto& first = step.operands[0];
      const auto& last = step.operands[1];
      if (first.kind != last.kind)
        problem(last.column, fmt::format("ZRST from {} to {}", to_string(first), to_string(last)),
                "name two devices of the same letter");
      else if (first.number > last.number)
        problem(last.column, fmt::format("ZRST from {} to {}", to_string(first), to_string(last)),
                "name the lower one first");
    }
    const Op op = step.op();
    const bool pulses = op == Op::plsv || op == Op::drvi || op == Op::drva || op == Op::decam;
    if (!pulses || step.operands.size() < 3) return;
    const auto& direction = step.operands.back();
    const auto& output = step.operands[step.operands.size() - 2];
    if (output.kind == direction.kind && output.number == direction.number)
      problem(direction.column, fmt::format("{} is the pulse output itself", to_string(direction)),
              "name another Y for the direction");
  }

  // Structure.

  void add(Step step) {
    rungs_.add(step);
    if (needs_memory(step)) step.memory = program_.memories++;
    step.number = program_.size;
    program_.size += steps_of(step);
    ended_ = step.op() == Op::end;
    program_.steps.push_back(std::move(step));
  }

  static int steps_of(const Step& step) {
    if (step.spelling == nullptr) return 1;
    const auto& mnemonic = *step.spelling->mnemonic;
    if (step.op() == Op::out && step.operands.size() == 2)
      return step.operands[0].kind == Kind::C && step.operands[0].number >= 200 ? 5 : 3;
    return step.wide() && mnemonic.wide_steps > 0 ? mnemonic.wide_steps : mnemonic.steps;
  }

  void finish() {
    if (!ended_) {
      problem(1, program_.steps.empty() ? "there is no program" : "END is missing",
              "end the program with END");
    }
    for (auto& step : program_.steps) {
      if (step.op() != Op::cj || step.operands.empty()) continue;
      const auto found = labels_.find(step.operands[0].number);
      if (found != labels_.end())
        step.target = static_cast<int>(found->second.place);
      else
        problem_at(step.line, step.operands[0].column,
                   fmt::format("there is no label {}", to_string(step.operands[0])),
                   "give it a line of its own");
    }
  }

  struct Label {
    int line = 0;
    std::size_t place = 0;
  };
  std::string_view text_;
  Problems& problems_;
  std::size_t before_;
  bool full_ = false;
  Program program_;
  int line_ = 0;
  bool ended_ = false;
  Rungs rungs_{[this](int column, std::string what, std::string remedy) {
    problem(column, std::move(what), std::move(remedy));
  }};
  std::map<int, Label> labels_;
};

}  // namespace

Program compile(std::string_view text, const std::string& file, Problems& problems) {
  return Compiler(text, file, problems).compile();
}

}  // namespace drycut::devices::lx3vp::il
