#include "devices/qmove/compiler.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace drycut::devices::qmove {

namespace {

// "folder/task_00.mod" is the task "task_00".
std::string task_name(const std::string& file) {
  const std::size_t slash = file.find_last_of("/\\");
  const std::string name = slash == std::string::npos ? file : file.substr(slash + 1);
  return name.substr(0, name.find_last_of('.'));
}

// How many cells an instruction adds to the stack.
int stack_effect(QclOp op) {
  switch (op) {
    case QclOp::push:
    case QclOp::load:
    case QclOp::load_device:
    case QclOp::load_input:
    case QclOp::load_output:
    case QclOp::load_timer:
      return 1;
    case QclOp::load_at:
    case QclOp::index:
    case QclOp::index_recipe:
    case QclOp::negate:
    case QclOp::negate_real:
    case QclOp::to_real:
    case QclOp::to_real_below:
    case QclOp::to_long:
    case QclOp::to_flag_real:
    case QclOp::to_flag_real_below:
    case QclOp::logic_not:
    case QclOp::bit_not:
    case QclOp::barrier:
    case QclOp::jump:
    case QclOp::command:
    case QclOp::yield:
    case QclOp::call:
    case QclOp::back:
    case QclOp::end:
      return 0;
    case QclOp::store_at:
      return -2;
    default:
      return -1;  // operators of two operands, stores, conditions
  }
}

}  // namespace

QclProgram compile_module(std::string_view text, const std::string& file_name,
                          const Configuration& configuration, std::span<const CatalogueEntry> catalogue,
                          Problems& problems, bool tests) {
  return QclCompiler(file_name, configuration, catalogue, problems).compile(text, tests);
}

QclCompiler::QclCompiler(const std::string& file, const Configuration& configuration,
                         std::span<const CatalogueEntry> catalogue, Problems& problems)
    : TokenReader(file, problems),
      configuration_(configuration),
      catalogue_(catalogue),
      names_(configuration) {}

QclProgram QclCompiler::compile(std::string_view text, bool tests) {
  program_.name = task_name(file_);
  program_.file = file_;
  program_.text = tests ? with_assertions(text) : std::string(text);
  const std::vector<std::string_view> lines = split_lines(program_.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    tokens_ = tokens_of(lines[i], static_cast<int>(i) + 1, file_, problems_);
    if (tokens_.size() == 1) continue;
    at_ = 0;
    stop_ = tokens_.size() - 1;
    line_failed_ = false;
    told_names_.clear();
    last_ = tokens_.back().place;
    const int begin = here();
    const auto at = static_cast<std::size_t>(lines[i].data() - program_.text.data());
    if (lines[i] != text.substr(at, lines[i].size()))
      assertion();
    else
      statement();
    if (here() > begin) mark(begin);
  }
  for (const Block& block : blocks_) unclosed(block);
  if (!ended_)
    complain("qcl.block"_code, last_, "the module has no END", "write END after its last statement");
  emit(QclOp::end);
  resolve(labels_, "label", "write {}: where it leads");
  resolve(subs_, "subroutine", "write SUB {} .. ENDSUB");
  for (const std::string& name : subs_.names) {
    const Target& target = subs_.places.at(lower(name));
    program_.subs.push_back({name, target.place.line, target.code});
  }
  sort();
  if (tests) note_misspelt_assertions(program_);
  program_.begins.assign(program_.code.size(), false);
  for (const int begin : marks_) program_.begins[static_cast<std::size_t>(begin)] = true;
  if (told() > 0) {
    program_.begins.clear();
    program_.code.clear();
    program_.lines.clear();
  }
  return std::move(program_);
}

bool QclCompiler::expect(std::string_view sign, const std::string& remedy) {
  if (accept(sign)) return true;
  syntax_error("qcl.syntax"_code, peek(), fmt::format("expected '{}', found {}", sign, found(peek())),
               remedy);
  return false;
}

void QclCompiler::end_of_statement() {
  if (peek().kind == QclToken::Kind::end) return;
  if (peek().is("="))
    syntax_error("qcl.syntax"_code, peek(), "unexpected '='",
                 "EQ compares; an assignment stands alone on its line");
  else if (const auto remedy = instead_of(peek().text);
           peek().kind == QclToken::Kind::name && !remedy.empty() && !names_.find(peek().text))
    syntax_error("qcl.unknown-name"_code, peek(), fmt::format("QCL has no {}", peek().text),
                 std::string(remedy));
  else
    syntax_error("qcl.syntax"_code, peek(), "unexpected " + found(peek()),
                 "one statement a line, comments after ';'");
}

// The rest of the line is given up: what follows a syntax fault would only be guessed at.
void QclCompiler::syntax_error(Code code, const QclToken& at, std::string what, std::string remedy) {
  if (!line_failed_ && at.kind != QclToken::Kind::bad)
    complain(code, at.place, std::move(what), std::move(remedy));
  line_failed_ = true;
  at_ = stop_;
}

std::string QclCompiler::found(const QclToken& token) {
  return token.kind == QclToken::Kind::end ? "the end of the line" : in_quotes(token.text);
}

int QclCompiler::emit(QclOp op, int a, int b) {
  stack_ += stack_effect(op);
  if (stack_ > max_depth)
    syntax_error("qcl.syntax"_code, peek(), "the expression is nested too deep",
                 "split it into several assignments");
  program_.code.push_back({op, a, b});
  program_.lines.push_back(last_.line);
  return here() - 1;
}

// Puts barriers before the code from `begin` on, for all devices that it reads: a statement waits until
// they have taken what was written to them before, then runs as a whole (spec §2). That code has no jumps
// yet.
void QclCompiler::insert_barriers(int begin) {
  std::vector<Instruction> barriers;
  for (const int device : devices_read_) barriers.push_back({QclOp::barrier, 0, device});
  if (!barriers.empty()) barriers.back().a = 1;
  program_.code.insert(program_.code.begin() + begin, barriers.begin(), barriers.end());
  program_.lines.insert(program_.lines.begin() + begin, barriers.size(), last_.line);
  devices_read_.clear();
}

int QclCompiler::add_symbol(Symbol symbol) {
  const auto same = std::find_if(program_.symbols.begin(), program_.symbols.end(), [&](const Symbol& other) {
    return other.kind == symbol.kind && other.index == symbol.index && other.row == symbol.row;
  });
  if (same != program_.symbols.end()) return static_cast<int>(same - program_.symbols.begin());
  program_.symbols.push_back(symbol);
  return static_cast<int>(program_.symbols.size()) - 1;
}

}  // namespace drycut::devices::qmove
