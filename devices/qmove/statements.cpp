#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "devices/qmove/compiler.hpp"

// Statements of QCL, but for blocks. One a line.
namespace drycut::devices::qmove {

void QclCompiler::statement() {
  nesting_ = 0;
  stack_ = 0;
  devices_read_.clear();
  if (peek().kind != QclToken::Kind::name)
    syntax_error("qcl.syntax"_code, peek(), found(peek()) + " does not begin a statement",
                 "write a statement, or ';' before a comment");
  else if (peek(1).is(":") && peek(2).kind == QclToken::Kind::end)
    label();
  else
    word_statement();
  if (!line_failed_) end_of_statement();
}

// ; ASSERT e
void QclCompiler::assertion() {
  nesting_ = 0;
  stack_ = 0;
  devices_read_.clear();
  take();
  const int begin = here();
  condition();
  insert_barriers(begin);
  emit(QclOp::assertion);
  if (!line_failed_) end_of_statement();
}

void QclCompiler::word_statement() {
  struct Row {
    std::string_view word;
    void (*run)(QclCompiler&);
  };
  static constexpr std::array<Row, 15> table{{
      {"IF", [](QclCompiler& c) { c.open_condition(Block::Kind::if_); }},
      {"ELSE", [](QclCompiler& c) { c.else_block(); }},
      {"ENDIF", [](QclCompiler& c) { c.close_block(Block::Kind::if_); }},
      {"WHILE", [](QclCompiler& c) { c.open_condition(Block::Kind::while_); }},
      {"ENDWHILE", [](QclCompiler& c) { c.close_block(Block::Kind::while_); }},
      {"FOR", [](QclCompiler& c) { c.for_block(); }},
      {"NEXT", [](QclCompiler& c) { c.close_block(Block::Kind::for_); }},
      {"WAIT", [](QclCompiler& c) { c.wait(); }},
      {"JUMP", [](QclCompiler& c) { c.refer(c.labels_, QclOp::jump, "JUMP <label>"); }},
      {"SUB", [](QclCompiler& c) { c.sub_block(); }},
      {"ENDSUB", [](QclCompiler& c) { c.close_block(Block::Kind::sub); }},
      {"CALL", [](QclCompiler& c) { c.refer(c.subs_, QclOp::call, "CALL <subroutine>"); }},
      {"END", [](QclCompiler& c) { c.end(); }},
      {"SETOUT", [](QclCompiler& c) { c.set_output(true); }},
      {"RESOUT", [](QclCompiler& c) { c.set_output(false); }},
  }};
  for (const Row& row : table)
    if (peek().word(row.word)) return row.run(*this);
  if (other_closer()) return;
  const QclToken& next = peek(1);
  if (next.kind == QclToken::Kind::name) return device_command();
  const bool assigns = next.kind == QclToken::Kind::sign && std::string_view("=[:.").find(next.text[0]) < 4;
  if (assigns && !is_reserved(peek().text))
    assignment();
  else
    unknown_statement();
}

// END_IF of Structured Text: told once, and read as what it means, so that nothing follows from it.
bool QclCompiler::other_closer() {
  struct Closer {
    std::string_view word;
    std::string_view meant;
    Block::Kind closes;
  };
  static constexpr std::array<Closer, 4> closers{{{"END_IF", "ENDIF", Block::Kind::if_},
                                                  {"END_WHILE", "ENDWHILE", Block::Kind::while_},
                                                  {"END_FOR", "NEXT", Block::Kind::for_},
                                                  {"END_SUB", "ENDSUB", Block::Kind::sub}}};
  for (const auto& [word, meant, closes] : closers) {
    if (!peek().word(word)) continue;
    complain("qcl.unknown-name"_code, peek().place, "unknown statement " + in_quotes(peek().text),
             fmt::format("did you mean {}?", in_quotes(meant)));
    close_block(closes);
    return true;
  }
  return false;
}

// name = e, name[i] = e, name[i, j] = e, Device:parameter = e. Returns the name assigned to, if it is one.
const NamedThing* QclCompiler::assignment() {
  const int begin = here();
  const QclToken name = take();
  const std::string remedy = "write: name = value";
  if (accept(":") || accept(".")) {
    const std::optional<int> device = find_device(name);
    const QclToken parameter = peek();
    if (parameter.kind != QclToken::Kind::name) {
      syntax_error("qcl.syntax"_code, parameter,
                   fmt::format("expected a parameter after {}:, found {}", name.text, found(parameter)),
                   "write Device:parameter = value");
      return nullptr;
    }
    take();
    const std::optional<Symbol> symbol = device ? find_parameter(*device, parameter) : std::nullopt;
    if (symbol) check_writable(*device, *symbol, parameter);
    if (!expect("=", "write: Device:parameter = value")) return nullptr;
    const int value = here();
    const Type type = expression();
    note_fraction(type, value, parameter);
    if (symbol) note_range(type_of(*device), *symbol, type, value, parameter);
    if (type == Type::real) emit(QclOp::to_long);
    emit(QclOp::store_device, symbol ? add_symbol(*symbol) : 0, device.value_or(0));
    insert_barriers(begin);
    return nullptr;
  }
  const NamedThing* thing = find_name(name);
  const bool indexed =
      thing && (thing->kind == NamedThing::Kind::array || thing->kind == NamedThing::Kind::group_static ||
                thing->kind == NamedThing::Kind::group_step);
  if (thing) check_assignable(*thing, name);
  if (indexed || (peek().is("[") && !thing)) indexes(indexed ? *thing : NamedThing{}, name);
  if (thing && !indexed && peek().is("["))
    syntax_error("qcl.type"_code, peek(),
                 fmt::format("{} is {} and takes no index", in_quotes(name.text), name_of(thing->kind)),
                 remedy);
  if (line_failed_ || !expect("=", remedy)) return thing;
  const int value = here();
  const Type type = expression();
  if (thing) note_wrapping(*thing, type, value, name);
  if (thing && thing->size != Size::S) note_fraction(type, value, name);
  store(thing ? *thing : NamedThing{}, type);
  insert_barriers(begin);
  return thing;
}

// A number beyond the size of its variable wraps in the run: said here, as a device says it of a parameter.
void QclCompiler::note_wrapping(const NamedThing& thing, Type type, int begin, const QclToken& name) {
  if (line_failed_ || type == Type::real || thing.size == Size::S) return;
  const auto known = constant(begin, here());
  if (!known) return;
  const std::int32_t value = *known;
  const std::int32_t stored = wrap(thing.size, value);
  if (stored == value) return;
  program_.notes.emplace_back(
      "qcl.does-not-fit"_code,
      fmt::format("{}:{}:{}: {}: {} does not fit size {}, taken as {}", file_, name.place.line,
                  name.place.column, name.text, value, static_cast<char>(thing.size), stored));
}

// What takes whole numbers cuts a single's fraction off: toll = 0.03 is 0.
void QclCompiler::note_fraction(Type type, int begin, const QclToken& name) {
  const bool plain = !line_failed_ && here() == begin + 1 && program_.code.back().op == QclOp::push;
  if (!plain || type != Type::real) return;
  const auto value = std::bit_cast<float>(program_.code.back().a);
  if (value == std::trunc(value)) return;
  program_.notes.emplace_back(
      "qcl.rounded"_code,
      fmt::format("{}:{}:{}: {} takes whole numbers: {} is taken as {}", file_, name.place.line,
                  name.place.column, name.text, value, std::trunc(value)));
}

// A device takes what lies outside of a parameter's range, and the run tells it: said here already.
void QclCompiler::note_range(const DeviceType& type, Symbol symbol, Type of_value, int begin,
                             const QclToken& name) {
  if (line_failed_ || of_value == Type::real || symbol.kind != Symbol::Kind::variable) return;
  const auto known = constant(begin, here());
  if (!known) return;
  const DeviceVariable& variable = type.variables[static_cast<std::size_t>(symbol.index)];
  const std::int32_t value = *known;
  if (value >= variable.min && value <= variable.max) return;
  program_.notes.emplace_back(
      "qcl.outside-range"_code,
      fmt::format("{}:{}:{}: {} goes from {} to {}, and {} is outside", file_, name.place.line,
                  name.place.column, name.text, variable.min, variable.max, value));
}

// Converts the value on the stack to what `thing` holds and stores it there.
void QclCompiler::store(const NamedThing& thing, Type type) {
  if (thing.size == Size::S && type == Type::integer) emit(QclOp::to_real);
  if (thing.size != Size::S && type == Type::real)
    emit(thing.size == Size::F ? QclOp::to_flag_real : QclOp::to_long);
  const int size = static_cast<int>(thing.size);
  switch (thing.kind) {
    case NamedThing::Kind::array:
    case NamedThing::Kind::group_static:
    case NamedThing::Kind::group_step:
      emit(QclOp::store_at, 0, size);
      break;
    case NamedThing::Kind::timer:
      emit(QclOp::store_timer, thing.index);
      break;
    case NamedThing::Kind::output:
      emit(QclOp::store_output, thing.index);
      break;
    default:
      emit(QclOp::store, thing.index, size);
      break;
  }
}

void QclCompiler::check_assignable(const NamedThing& thing, const QclToken& name) {
  using Kind = NamedThing::Kind;
  if (thing.kind == Kind::constant || thing.kind == Kind::input || thing.kind == Kind::group ||
      thing.kind == Kind::device)
    complain("qcl.not-writable"_code, name.place,
             fmt::format("{} is {} and cannot be assigned", in_quotes(name.text), name_of(thing.kind)),
             thing.kind == Kind::device  ? fmt::format("write {}:parameter = value", name.text)
             : thing.kind == Kind::group ? "assign one of its variables"
                                         : "assign a variable, a timer, an output or Device:parameter");
}

void QclCompiler::check_writable(int device, Symbol symbol, const QclToken& parameter) {
  const DeviceType& type = type_of(device);
  if (symbol.kind == Symbol::Kind::state)
    complain(
        "qcl.not-writable"_code, parameter.place,
        fmt::format("{} is a state of {}, only the device changes it", in_quotes(parameter.text), type.name),
        "give the command that changes it");
  else if (type.variables[static_cast<std::size_t>(symbol.index)].access == Access::read)
    complain("qcl.not-writable"_code, parameter.place,
             fmt::format("{} of {} is read-only", in_quotes(parameter.text), type.name),
             "assign a parameter that programs may write");
}

void QclCompiler::label() {
  const QclToken name = take();
  take();
  if (is_reserved(name.text) || is_device(name.text)) {
    complain("qcl.not-writable"_code, name.place, fmt::format("{} cannot be a label", in_quotes(name.text)),
             is_reserved(name.text) ? "it is a word of the language"
                                    : fmt::format("it is a device; write {}:parameter = value", name.text));
    return;
  }
  define(labels_, "label", name);
}

void QclCompiler::wait() {
  take();
  static constexpr std::array<std::string_view, 3> times = {"ms", "s", "min"};
  if (peek().kind == QclToken::Kind::number && is_one_of(times, peek(1).text))
    return syntax_error("qcl.type"_code, peek(1), "WAIT takes a condition, not a time",
                        "start a TIMER and wait for it: tmPause = 100, then WAIT tmPause");
  emit(QclOp::yield);
  const int begin = here();
  mark(begin);
  condition();
  insert_barriers(begin);
  emit(QclOp::wait_until, begin);
}

// The name after JUMP, CALL or SUB.
const QclToken* QclCompiler::name_operand(const std::string& form) {
  take();
  if (peek().kind != QclToken::Kind::name || is_reserved(peek().text)) {
    syntax_error("qcl.syntax"_code, peek(), "expected a name, found " + found(peek()), "write: " + form);
    return nullptr;
  }
  return &take();
}

void QclCompiler::end() {
  take();
  ended_ = true;
  emit(QclOp::end);
}

void QclCompiler::set_output(bool on) {
  const QclToken* name = name_operand(on ? "SETOUT <output>" : "RESOUT <output>");
  if (!name) return;
  const NamedThing* thing = find_name(*name);
  if (!thing) return;
  if (thing->kind != NamedThing::Kind::output) {
    complain("qcl.type"_code, name->place,
             fmt::format("{} is {}, not an output", in_quotes(name->text), name_of(thing->kind)),
             "name an output that is declared under OUTPUT");
    return;
  }
  emit(QclOp::push, on ? 1 : 0);
  emit(QclOp::store_output, thing->index);
}

// COMMAND Device: two words and nothing else.
void QclCompiler::device_command() {
  const QclToken word = peek();
  const QclToken name = peek(1);
  const std::vector<std::string> commands = all_commands();
  if (!is_device(name.text) && !is_one_of(commands, word.text)) return unknown_statement();
  take();
  take();
  const std::optional<int> device = find_device(name);
  if (!device) return;
  const DeviceType& type = type_of(*device);
  const std::optional<int> command = find_command(type, word.text);
  if (command) {
    emit(QclOp::command, *command, *device);
    return;
  }
  std::vector<std::string> own;
  for (const DeviceCommand& candidate : type.commands) own.emplace_back(candidate.name);
  complain("qcl.unknown-name"_code, word.place,
           fmt::format("{} has no command {}", type.name, in_quotes(word.text)),
           suggestion(word.text, own, fmt::format("see: drycut devices {}", type.name)));
}

std::string_view QclCompiler::instead_of(std::string_view word) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 29> rows{{
      {"INC", "write name = name + 1"},
      {"DEC", "write name = name - 1"},
      {"MOD", "write a % b"},
      {"REM", "write a % b; a comment begins with ';'"},
      {"DIV", "write a / b, which cuts off between longs"},
      {"ABS", "write IF a LT 0, a = -a and ENDIF, a line each"},
      {"SGN", "write IF a LT 0 and ELSE"},
      {"MIN", "write IF a LT b and ELSE"},
      {"MAX", "write IF a GT b and ELSE"},
      {"INT", "assign the single to a long, which cuts its fraction off"},
      {"SQRT", "it has + - * / and % only"},
      {"SQR", "it has + - * / and % only"},
      {"XOR", "write XORB for bits, NEQ for flags"},
      {"SHL", "write a * 2 for each place"},
      {"SHR", "write a / 2 for each place"},
      {"TRUE", "write 1"},
      {"FALSE", "write 0"},
      {"THEN", "an IF ends with its line; write what follows below it"},
      {"ELSEIF", "write ELSE, and an IF with an ENDIF of its own in it"},
      {"ELSIF", "write ELSE, and an IF with an ENDIF of its own in it"},
      {"ELIF", "write ELSE, and an IF with an ENDIF of its own in it"},
      {"LET", "write name = value"},
      {"GOTO", "write JUMP label"},
      {"GOSUB", "write CALL subroutine"},
      {"RETURN", "a subroutine ends at its ENDSUB; JUMP to a label before it"},
      {"WEND", "write ENDWHILE"},
      {"EXIT", "JUMP to a label behind the block"},
      {"DIM", "declare it in the .cnf, under GLOBAL or ARRGBL"},
      {"DELAY", "start a TIMER and wait for it: tmPause = 100, then WAIT tmPause"},
  }};
  for (const auto& [foreign, remedy] : rows)
    if (same_word(foreign, word)) return remedy;
  return "";
}

void QclCompiler::unknown_statement() {
  std::vector<std::string> words = reserved_words();
  const std::vector<std::string> commands = all_commands();
  words.insert(words.end(), commands.begin(), commands.end());
  for (const NamedThing& thing : names_.things()) words.push_back(thing.name);
  const std::string usual = "write an assignment, a command such as INIT Device, or IF, WAIT, JUMP, ...";
  const NamedThing* thing = names_.find(peek().text);
  if (is_reserved(peek().text))
    syntax_error("qcl.syntax"_code, peek(), in_quotes(peek().text) + " does not begin a statement", usual);
  else if (thing)
    syntax_error("qcl.syntax"_code, peek(1),
                 fmt::format("expected '=' after {}, found {}", in_quotes(peek().text), found(peek(1))),
                 thing->kind == NamedThing::Kind::device
                     ? fmt::format("write {}:parameter = value", peek().text)
                     : "write: name = value");
  else if (is_one_of(commands, peek().text))
    syntax_error("qcl.syntax"_code, peek(), fmt::format("{} needs a device", in_quotes(peek().text)),
                 fmt::format("write {} Device", peek().text));
  else if (const auto remedy = instead_of(peek().text); !remedy.empty())
    syntax_error("qcl.unknown-name"_code, peek(), "QCL has no " + std::string(peek().text),
                 std::string(remedy));
  else
    syntax_error("qcl.unknown-name"_code, peek(), "unknown statement " + in_quotes(peek().text),
                 suggestion(peek().text, words, usual));
}

}  // namespace drycut::devices::qmove
