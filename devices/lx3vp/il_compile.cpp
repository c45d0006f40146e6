#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/scanner.hpp"
#include "devices/lx3vp/il_lines.hpp"
#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr std::size_t most_problems = 1000;

bool needs_memory(const Step& step) {
  const Op op = step.op();
  return op == Op::rising || op == Op::falling || op == Op::pls || op == Op::plf || op == Op::out ||
         op == Op::stl || (step.spelling != nullptr && step.spelling->pulse);
}

class IlCompiler : private Complaints {
 public:
  IlCompiler(std::string_view text, const std::string& file, Problems& problems)
      : Complaints(file, problems), text_(text) {
    program_.file = file;
    program_.text = text;
  }

  IlProgram compile() {
    const auto tell = [this](Code code, Place place, std::string what, std::string remedy) {
      problem_at(code, place, std::move(what), std::move(remedy));
      refused_ = true;
    };
    for (const auto& words : statements_of(text_, tell)) {
      if (full_) break;
      line_ = words.front().place.line;
      read_statement(words);
    }
    if (!full_) finish();
    return std::move(program_);
  }

 private:
  void problem(Code code, int column, std::string what, std::string remedy) {
    problem_at(code, {std::max(line_, 1), column}, std::move(what), std::move(remedy));
  }
  void problem_at(Code code, Place place, std::string what, std::string remedy) {
    if (full_) return;
    complain(code, place, std::move(what), std::move(remedy));
    if (told() < most_problems) return;
    full_ = true;
    complain("text.too-many-problems"_code, place, "too many problems: the rest is not told",
             "is this an instruction list?");
  }

  // Statements.

  void read_statement(const Statement& words) {
    if (ended_) {
      problem("il.syntax"_code, words.front().place.column, "stands behind END",
              "END is the last instruction");
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
    step.spell(*spelling);
    step.line = line_;
    step.column = words.front().place.column;
    read_operands(step, words);
    add(std::move(step));
  }

  static bool is_label(std::string_view word) {
    return word.size() > 1 && std::string_view("PpIi").find(word.front()) != std::string_view::npos &&
           is_digit(word[1]);
  }

  void read_label(const Statement& words) {
    auto text = words.front().text;
    if (text.ends_with(':')) text.pop_back();
    ValueFault fault;
    auto operand = read_operand(text, fault);
    if (!operand) {
      problem(fault.code, words.front().place.column, std::move(fault.what), std::move(fault.remedy));
      refused_ = true;
      return;
    }
    if (words.size() > 1)
      problem("il.jump"_code, words[1].place.column,
              fmt::format("{} stands behind a label", in_quotes(words[1].text)),
              "give a label a line of its own");
    const bool interrupts = operand->kind == OperandType::interrupt;
    if (interrupts && !is_interrupt_label(text, operand->number)) {
      problem("il.jump"_code, words.front().place.column,
              fmt::format("there is no interrupt {}", in_quotes(text)),
              "X0 to X5 have I000 and I001 to I500 and I501, DHSCS I010 to I060, times of 10 to 99 ms I610, "
              "I710 and I810 and up");
      return;
    }
    if (interrupts)
      for (const auto& other : program_.interrupts)
        if (refuse_second_edge(*operand, other, words.front().place.column)) return;
    auto& labels = interrupts ? interrupts_ : labels_;
    const auto [first, fresh] = labels.emplace(operand->number, Label{line_, program_.steps.size()});
    if (!fresh) {
      problem("il.jump"_code, words.front().place.column,
              fmt::format("label {} is there twice", to_string(*operand)),
              fmt::format("it was first given in line {}", first->second.line));
      return;
    }
    if (interrupts) program_.interrupts.push_back({operand->number, program_.steps.size()});
    Step step;
    step.line = line_;
    step.column = words.front().place.column;
    step.operands.push_back(*operand);
    add(std::move(step));
  }

  /// Three digits, as the family writes it.
  static bool is_interrupt_label(std::string_view text, int number) {
    constexpr std::size_t length = 4;
    return text.size() == length && is_interrupt(number);
  }

  /// An input, and a timer, has one interrupt: I000 or I001, one of I610 to I699.
  bool refuse_second_edge(const Operand& operand, const InterruptRoutine& other, int column) {
    const auto source = [](int number) { return is_counter_interrupt(number) ? number : number / 100 * 100; };
    const bool counters = is_counter_interrupt(operand.number) || is_counter_interrupt(other.number);
    if (counters || operand.number == other.number || source(operand.number) != source(other.number))
      return false;
    problem("il.jump"_code, column,
            fmt::format("I{:03} and I{:03} are of the same {}", operand.number, other.number,
                        operand.number < 600 ? "input" : "timer"),
            "it has one interrupt: keep one of them");
    return true;
  }

  void refuse_mnemonic(const Word& word) {
    refused_ = true;
    rungs_.lose();
    if (is_not_simulated(word.text)) {
      problem("il.not-simulated"_code, word.place.column, fmt::format("{} is not simulated", word.text),
              "`drycut devices LX3VP` lists what is");
      return;
    }
    std::vector<std::string> names;
    for (const auto& spelling : spellings()) names.push_back(spelling.text);
    const auto near = nearest(word.text.substr(0, 24), names);
    problem("il.unknown-instruction"_code, word.place.column,
            fmt::format("there is no instruction {}", in_quotes(word.text)),
            near.empty() ? "one instruction a line: LD X0" : fmt::format("did you mean {}?", near));
  }

  // Operands.

  /// One problem an instruction: the others may only follow from it.
  void read_operands(Step& step, const Statement& words) {
    std::string kinds(step.spelling->mnemonic->operands);
    std::optional<ValueFault> fault;
    const Word* at = &words.front();
    const auto refuse = [&](const Word& word, ValueFault what) {
      if (!fault) at = &word;
      if (!fault) fault = std::move(what);
    };
    for (std::size_t i = 1; i < words.size(); ++i) {
      ValueFault unread;
      auto operand = read_operand(words[i].text, unread);
      if (!operand) {
        if (const auto number = decimal_comma(words, i); !number.empty())
          unread = {"il.operand"_code,
                    fmt::format("{},{} has a decimal comma", words[i - 1].text, words[i].text),
                    fmt::format("write {}", number)};
        refuse(words[i], std::move(unread));
        continue;
      }
      operand->line = words[i].place.line;
      operand->column = words[i].place.column;
      step.indexed = step.indexed || operand->index != Operand::no_index;
      step.operands.push_back(*operand);
      const auto place = i - 1;
      // The set value of a timer or a counter.
      if (place == 0 && step.op() == Op::out &&
          (operand->kind == OperandType::T || operand->kind == OperandType::C))
        kinds += 'v';
      if (place >= kinds.size()) continue;
      if (auto wrong = kinds[place] == 'v' ? misfit_of_set_value(step, *operand)
                                           : misfit(*operand, kinds[place], *step.spelling))
        refuse(words[i], std::move(*wrong));
      else if (auto unknown = unserved(*operand))
        refuse(words[i], std::move(*unknown));
    }
    if (words.size() - 1 != kinds.size())
      refuse(words.size() - 1 > kinds.size() ? words[kinds.size() + 1] : words.back(),
             {"il.syntax"_code,
              fmt::format("{} has {} operand{}, not {}", step.spelling->text, kinds.size(),
                          kinds.size() == 1 ? "" : "s", words.size() - 1),
              operands_text(kinds)});
    if (!fault) {
      if (auto misfit = misfit_together(step)) {
        at = &words[misfit->operand + 1];
        fault = std::move(misfit->fault);
      }
    }
    if (!fault) return;
    const auto& last = step.operands.empty() || at != &words.front() ? *at : words.back();
    problem_at(fault->code, last.place, std::move(fault->what), std::move(fault->remedy));
  }

  /// "E1.5" of the words that E1,5 falls apart into, the second at `i`; "" of others.
  static std::string decimal_comma(const Statement& words, std::size_t i) {
    const auto& before = words[i - 1];
    const auto& after = words[i];
    const bool together =
        before.place.column + static_cast<int>(before.text.size()) + 1 == after.place.column;
    const bool real = before.text.front() == 'E' || before.text.front() == 'e';
    const bool digits = std::all_of(after.text.begin(), after.text.end(), is_digit);
    return together && real && digits && before.text.find('.') == std::string::npos
               ? fmt::format("{}.{}", before.text, after.text)
               : "";
  }

  static std::string operands_text(const std::string& kinds) {
    if (kinds.empty()) return "write it alone";
    std::string text = "give ";
    for (std::size_t i = 0; i < kinds.size(); ++i)
      text += fmt::format("{}{}",
                          i == 0                  ? ""
                          : i + 1 == kinds.size() ? " and then "
                                                  : ", then ",
                          operand_text(kinds[i]));
    return text;
  }

  static std::optional<ValueFault> misfit_of_set_value(const Step& step, const Operand& operand) {
    constexpr int most = 32767;
    const auto& coil = step.operands.front();
    const bool wide = coil.kind == OperandType::C && coil.number >= first_wide_counter;
    const auto remedy =
        wide ? "give a set value K or the first D of a pair" : "give a set value K1 to K32767 or a D";
    const bool is_number = operand.kind == OperandType::constant;
    if (coil.index != Operand::no_index || operand.index != Operand::no_index)
      return ValueFault{"il.index-register"_code,
                        fmt::format("OUT {} {} has an index register", to_string(coil), to_string(operand)),
                        "timers, counters and their set values take none"};
    if (!is_number && operand.kind != OperandType::D)
      return ValueFault{"il.operand"_code, fmt::format("{} is no set value", to_string(operand)), remedy};
    if (is_number && !wide && (operand.value < 1 || operand.value > most))
      return ValueFault{"il.operand"_code, fmt::format("set value {} is out of range", to_string(operand)),
                        remedy};
    if (!is_number && wide && operand.number + 1 >= data_words)
      return ValueFault{"il.operand"_code, fmt::format("{} is no pair of words", to_string(operand)), remedy};
    return {};
  }

  // Structure.

  void add(Step step) {
    rungs_.add(step);
    if (needs_memory(step)) step.memory = program_.memories++;
    step.route = route_of(step);
    if (step.route == Route::bit) {
      step.letter = letter_of(step.operands[0].kind);
      step.bit = step.operands[0].number;
    }
    step.number = program_.size;
    program_.size += steps_of(step);
    ended_ = step.op() == Op::end;
    program_.steps.push_back(std::move(step));
  }

  static Route route_of(const Step& step) {
    const Op op = step.op();
    const bool plain = !step.indexed && (step.spelling == nullptr || !step.spelling->pulse);
    if (is_contact(op)) {
      const bool level = (op == Op::on || op == Op::off) && plain && !step.operands.empty();
      return level && step.operands[0].kind != OperandType::word_bit ? Route::bit : Route::contact;
    }
    if (op <= Op::inv) return Route::join;
    if (op == Op::set || op == Op::rst) return plain ? Route::action : Route::coil;
    if (op <= Op::plf) return Route::coil;
    if (op >= Op::mc) return Route::flow;
    const bool drives = op >= Op::plsv && op <= Op::decam;
    return plain && !drives ? Route::action : Route::call;
  }

  static int steps_of(const Step& step) {
    if (step.spelling == nullptr) return 1;
    const auto& mnemonic = *step.spelling->mnemonic;
    if (step.op() == Op::out && step.operands.size() == 2)
      return step.operands[0].kind == OperandType::C && step.operands[0].number >= first_wide_counter ? 5 : 3;
    return step.wide() && mnemonic.wide_steps > 0 ? mnemonic.wide_steps : mnemonic.steps;
  }

  void finish() {
    if (!ended_ && !refused_)
      problem("il.syntax"_code, 1, program_.steps.empty() ? "there is no program" : "END is missing",
              "end the program with END");
    // What an instruction that was refused would have begun or ended is not known.
    if (refused_)
      find_labels(program_, labels_, tell_);
    else
      join_structure(program_, labels_, tell_);
    int next = static_cast<int>(program_.steps.size());
    for (auto step = program_.steps.rbegin(); step != program_.steps.rend(); ++step) {
      step->skip = next;
      if (step->route != Route::action) next = static_cast<int>(program_.steps.rend() - step) - 1;
    }
    std::ranges::sort(program_.interrupts, {}, &InterruptRoutine::number);
  }

  std::string_view text_;
  bool full_ = false;
  bool refused_ = false;  ///< an instruction could not be read
  IlProgram program_;
  int line_ = 0;
  bool ended_ = false;
  const TellLine tell_ = [this](Code code, Place place, std::string what, std::string remedy) {
    problem_at(code, place, std::move(what), std::move(remedy));
  };
  Rungs rungs_{tell_};
  Labels labels_;
  Labels interrupts_;
};

}  // namespace

IlProgram compile(std::string_view text, const std::string& file, Problems& problems) {
  return IlCompiler(text, file, problems).compile();
}

}  // namespace drycut::devices::lx3vp::il
