#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "devices/qmove/compiler.hpp"

// Expressions of QCL: values, indexes, operators.
namespace drycut::devices::qmove {

namespace {

// What an operator accepts: singles too, longs only, or flags (each side compared with 0).
enum class Operands : std::uint8_t { numbers, longs, flags };

struct QclOperator {
  std::string_view spelling;
  int level;  ///< higher binds tighter
  Operands operands;
  QclOp integer;
  QclOp real;
  bool compares;  ///< the result is 0 or 1
};

// Precedence (spec D8). Unary minus, NOT and NOTB bind tighter than all of these.
constexpr std::array<QclOperator, 17> operators{{
    {"*", 7, Operands::numbers, QclOp::multiply, QclOp::multiply_real, false},
    {"/", 7, Operands::numbers, QclOp::divide, QclOp::divide_real, false},
    {"%", 7, Operands::longs, QclOp::modulo, QclOp::modulo, false},
    {"+", 6, Operands::numbers, QclOp::add, QclOp::add_real, false},
    {"-", 6, Operands::numbers, QclOp::subtract, QclOp::subtract_real, false},
    {"LT", 5, Operands::numbers, QclOp::less, QclOp::less_real, true},
    {"LE", 5, Operands::numbers, QclOp::less_equal, QclOp::less_equal_real, true},
    {"GT", 5, Operands::numbers, QclOp::greater, QclOp::greater_real, true},
    {"GE", 5, Operands::numbers, QclOp::greater_equal, QclOp::greater_equal_real, true},
    {"EQ", 5, Operands::numbers, QclOp::equal, QclOp::equal_real, true},
    {"NEQ", 5, Operands::numbers, QclOp::not_equal, QclOp::not_equal_real, true},
    {"NE", 5, Operands::numbers, QclOp::not_equal, QclOp::not_equal_real, true},
    {"ANDB", 4, Operands::longs, QclOp::bit_and, QclOp::bit_and, false},
    {"XORB", 3, Operands::longs, QclOp::bit_xor, QclOp::bit_xor, false},
    {"ORB", 2, Operands::longs, QclOp::bit_or, QclOp::bit_or, false},
    {"AND", 1, Operands::flags, QclOp::logic_and, QclOp::logic_and, true},
    {"OR", 0, Operands::flags, QclOp::logic_or, QclOp::logic_or, true},
}};

std::optional<std::size_t> operator_row(const QclToken& token) {
  if (token.kind != QclToken::Kind::name && token.kind != QclToken::Kind::sign) return std::nullopt;
  for (std::size_t i = 0; i < operators.size(); ++i)
    if (same_word(operators[i].spelling, token.text)) return i;
  return std::nullopt;
}

/// What an operator of longs gives before it wraps; nothing of a division by 0 and of other instructions.
std::optional<std::int64_t> result_of(QclOp op, std::int64_t left, std::int64_t right) {
  switch (op) {
    case QclOp::add:
      return left + right;
    case QclOp::subtract:
      return left - right;
    case QclOp::multiply:
      return left * right;
    case QclOp::divide:
      return right == 0 ? std::nullopt : std::optional(left / right);
    case QclOp::modulo:
      return right == 0 ? std::nullopt : std::optional(left % right);
    case QclOp::bit_and:
      return left & right;
    case QclOp::bit_or:
      return left | right;
    case QclOp::bit_xor:
      return left ^ right;
    default:
      return std::nullopt;
  }
}

}  // namespace

// Reads operands joined by operators of at least `level`.
QclCompiler::Type QclCompiler::expression(int level) {
  const int left_code = here();
  Type type = unary();
  while (!line_failed_) {
    const std::optional<std::size_t> row = operator_row(peek());
    if (!row || operators[*row].level < level) break;
    const QclToken op = take();
    const int right_code = here();
    const Type right = expression(operators[*row].level + 1);
    binary(*row, type, right, left_code, right_code, op);
    const bool real = type == Type::real || right == Type::real;
    type = real && !operators[*row].compares && operators[*row].operands == Operands::numbers ? Type::real
                                                                                              : Type::integer;
  }
  return type;
}

void QclCompiler::binary(std::size_t row, Type left, Type right, int left_code, int right_code,
                         const QclToken& op) {
  const QclOperator& found = operators[row];
  const bool any_real = left == Type::real || right == Type::real;
  const bool divides = found.integer == QclOp::divide || found.integer == QclOp::modulo;
  if (divides && is_zero(right, right_code))
    complain("qcl.out-of-range"_code, op.place, "a division by 0",
             "it stops all tasks: test the divisor before");
  if (found.operands == Operands::longs && any_real)
    complain("qcl.type"_code, op.place,
             fmt::format("{} works on whole numbers, one side is a single", found.spelling),
             "assign the single to a long first");
  if (found.operands == Operands::numbers && any_real) {
    if (left == Type::integer) emit(QclOp::to_real_below);
    if (right == Type::integer) emit(QclOp::to_real);
    emit(found.real);
    return;
  }
  if (found.operands == Operands::flags && right == Type::real) emit(QclOp::to_flag_real);
  if (found.operands == Operands::flags && left == Type::real) emit(QclOp::to_flag_real_below);
  if (!any_real) note_overflow(found.integer, left_code, right_code, op);
  emit(found.integer);
}

bool QclCompiler::is_zero(Type type, int begin) const {
  if (line_failed_) return false;
  if (type == Type::integer) return constant(begin, here()) == 0;
  const Instruction& last = program_.code.back();
  return here() == begin + 1 && last.op == QclOp::push && std::bit_cast<float>(last.a) == 0.0F;
}

// Numbers are calculated in 32 bits, which wrap.
void QclCompiler::note_overflow(QclOp op, int left_code, int right_code, const QclToken& sign) {
  const auto left = constant(left_code, right_code);
  const auto right = constant(right_code, here());
  if (!left || !right || line_failed_) return;
  const auto result = result_of(op, *left, *right);
  if (!result || *result == static_cast<std::int32_t>(*result)) return;
  program_.notes.emplace_back(
      "qcl.does-not-fit"_code,
      fmt::format("{}:{}:{}: {} {} {} is {}, beyond a long, taken as {}", file_, sign.place.line,
                  sign.place.column, *left, sign.text, *right, *result, static_cast<std::int32_t>(*result)));
}

std::optional<std::int32_t> QclCompiler::constant(int begin, int end) const {
  constexpr int most = 100;  // a longer one is hardly written, and would be looked at again and again
  if (end <= begin || end - begin > most) return std::nullopt;
  std::vector<std::int32_t> stack;
  for (int at = begin; at < end; ++at) {
    const Instruction& step = program_.code[static_cast<std::size_t>(at)];
    if (step.op == QclOp::push) {
      stack.push_back(step.a);
      continue;
    }
    if (stack.empty()) return std::nullopt;
    if (step.op == QclOp::negate || step.op == QclOp::bit_not || step.op == QclOp::logic_not) {
      const auto value = static_cast<std::uint32_t>(stack.back());
      stack.back() = static_cast<std::int32_t>(step.op == QclOp::negate    ? 0U - value
                                               : step.op == QclOp::bit_not ? ~value
                                               : value == 0                ? 1U
                                                                           : 0U);
      continue;
    }
    const std::int32_t right = stack.back();
    stack.pop_back();
    if (stack.empty()) return std::nullopt;
    const auto result = result_of(step.op, stack.back(), right);
    if (!result) return std::nullopt;
    stack.back() = static_cast<std::int32_t>(*result);
  }
  return stack.size() == 1 ? std::optional(stack.front()) : std::nullopt;
}

QclCompiler::Type QclCompiler::unary() {
  if (++nesting_ > max_depth)
    syntax_error("qcl.syntax"_code, peek(), "the expression is nested too deep",
                 "split it into several assignments");
  Type type = Type::integer;
  if (accept("-")) {
    if (peek().kind == QclToken::Kind::number && !peek().is_real) {
      // The most negative long has no positive counterpart that could be negated.
      emit(QclOp::push, static_cast<std::int32_t>(-peek().integer));
      take();
    } else {
      type = unary();
      emit(type == Type::real ? QclOp::negate_real : QclOp::negate);
    }
  } else if (accept_word("NOT")) {
    if (unary() == Type::real) emit(QclOp::to_flag_real);
    emit(QclOp::logic_not);
  } else if (peek().word("NOTB")) {
    const Place place = take().place;
    if (unary() == Type::real)
      complain("qcl.type"_code, place, "NOTB works on whole numbers, not on a single",
               "assign the single to a long first");
    emit(QclOp::bit_not);
  } else {
    type = primary();
  }
  --nesting_;
  return type;
}

QclCompiler::Type QclCompiler::primary() {
  const QclToken& here = peek();
  switch (here.kind) {
    case QclToken::Kind::number:
      if (here.integer > std::numeric_limits<std::int32_t>::max())
        complain("qcl.out-of-range"_code, here.place, in_quotes(here.text) + " is out of range",
                 "a long goes from -2147483648 to 2147483647");
      emit(QclOp::push,
           here.is_real ? std::bit_cast<std::int32_t>(here.real) : static_cast<std::int32_t>(here.integer));
      take();
      return here.is_real ? Type::real : Type::integer;
    case QclToken::Kind::name:
      if (!is_reserved(here.text)) return name_value();
      break;
    case QclToken::Kind::sign:
      if (here.text[0] == '(') return parenthesis();
      break;
    default:
      break;
  }
  const bool at_end = here.kind == QclToken::Kind::end;
  syntax_error("qcl.syntax"_code, here,
               at_end ? "missing operand at the end of the line" : "missing operand before " + found(here),
               "write a number, a name, Device:parameter or an expression in parentheses");
  return Type::integer;
}

QclCompiler::Type QclCompiler::parenthesis() {
  take();
  const Type type = expression();
  expect(")", "close the parenthesis");
  return type;
}

// A name in an expression: something of the configuration, or Device:parameter.
QclCompiler::Type QclCompiler::name_value() {
  const QclToken name = take();
  if (accept(":") || accept(".")) {
    const std::optional<int> device = find_device(name);
    if (peek().kind != QclToken::Kind::name) {
      syntax_error("qcl.syntax"_code, peek(),
                   fmt::format("expected a parameter after {}:, found {}", name.text, found(peek())),
                   "write Device:parameter");
      return Type::integer;
    }
    const QclToken parameter = take();
    const std::optional<Symbol> symbol = device ? find_parameter(*device, parameter) : std::nullopt;
    if (device) devices_read_.insert(*device);
    emit(QclOp::load_device, symbol ? add_symbol(*symbol) : 0, device.value_or(0));
    return Type::integer;
  }
  const NamedThing* thing = find_name(name);
  if (!thing) {
    // Read over the indexes of an unknown array, so that only the name is complained about.
    if (peek().is("[")) indexes({}, name);
    if (peek().is("(")) pass_arguments();
    emit(QclOp::push);
    return Type::integer;
  }
  switch (thing->kind) {
    case NamedThing::Kind::constant:
      emit(QclOp::push, thing->real ? std::bit_cast<std::int32_t>(static_cast<float>(thing->value))
                                    : static_cast<std::int32_t>(thing->value));
      return thing->real ? Type::real : Type::integer;
    case NamedThing::Kind::timer:
      emit(QclOp::load_timer, thing->index);
      return Type::integer;
    case NamedThing::Kind::input:
      emit(QclOp::load_input, thing->index);
      return Type::integer;
    case NamedThing::Kind::output:
      emit(QclOp::load_output, thing->index);
      return Type::integer;
    case NamedThing::Kind::scalar:
      emit(QclOp::load, thing->index);
      break;
    case NamedThing::Kind::array:
    case NamedThing::Kind::group_static:
    case NamedThing::Kind::group_step:
      indexes(*thing, name);
      emit(QclOp::load_at);
      break;
    case NamedThing::Kind::device:
    case NamedThing::Kind::group:
      complain("qcl.type"_code, name.place,
               fmt::format("{} is {}, not a value", in_quotes(name.text), name_of(thing->kind)),
               thing->kind == NamedThing::Kind::device ? fmt::format("write {}:parameter", name.text)
                                                       : "name one of its variables");
      emit(QclOp::push);
      return Type::integer;
  }
  return thing->size == Size::S ? Type::real : Type::integer;
}

// Those of a function that QCL does not have: it is told, and they are not looked at.
void QclCompiler::pass_arguments() {
  do {
    take();
    expression();
  } while (peek().is(",") && !line_failed_);
  expect(")", "close the parenthesis");
}

// Reads [i] or [i, j] and leaves the number of the cell on the stack. A nameless thing takes any count.
void QclCompiler::indexes(const NamedThing& thing, const QclToken& name) {
  const std::size_t wanted = thing.kind == NamedThing::Kind::group_step ? 2 : 1;
  const std::string form = wanted == 2                                    ? "[recipe, step]"
                           : thing.kind == NamedThing::Kind::group_static ? "[recipe]"
                                                                          : "[index]";
  if (!peek().is("[")) {
    syntax_error("qcl.type"_code, name,
                 fmt::format("{} is {} and needs an index", in_quotes(name.text), name_of(thing.kind)),
                 fmt::format("write {}{}", name.text, form));
    return;
  }
  const int stack = stack_;
  const QclToken open = peek();
  std::size_t count = 0;
  do {
    take();
    const Place place = peek().place;
    const int begin = here();
    if (expression() == Type::real) emit(QclOp::to_long);
    check_index(thing, count, begin, place);
    ++count;
  } while (peek().is(",") && !line_failed_);
  expect("]", "close the index");
  if (count != wanted && !thing.name.empty() && !line_failed_)
    complain("qcl.type"_code, open.place,
             fmt::format("{} takes {} index{}, found {}", in_quotes(name.text), wanted,
                         wanted == 1 ? "" : "es", count),
             fmt::format("write {}{}", name.text, form));
  if (thing.kind == NamedThing::Kind::group_step) {
    program_.steps.push_back(thing);
    emit(QclOp::index_step, static_cast<int>(program_.steps.size()) - 1);
  } else {
    emit(thing.kind == NamedThing::Kind::group_static ? QclOp::index_recipe : QclOp::index, thing.index,
         thing.length);
  }
  stack_ = stack + (thing.name.empty() ? 0 : 1);  // as if the count had been right
}

// An index that is a plain number is judged here, as index and index_step would judge it in the run.
void QclCompiler::check_index(const NamedThing& thing, std::size_t number, int begin, Place place) {
  const bool plain = !line_failed_ && here() == begin + 1 && program_.code.back().op == QclOp::push;
  const bool step = thing.kind == NamedThing::Kind::group_step && number == 1;
  if (!plain || thing.name.empty() || (number > 0 && !step)) return;
  const int last = step ? thing.steps : thing.length;
  const std::int32_t index = program_.code.back().a;
  if (index >= 1 && index <= last) return;
  const std::string_view what = step ? "step" : thing.kind == NamedThing::Kind::array ? "index" : "recipe";
  complain("qcl.out-of-range"_code, place,
           fmt::format("{} {} is outside 1..{} of {}", what, index, last, in_quotes(thing.name)),
           fmt::format("take one of 1..{}, or declare more of it in {}", last, configuration_.file));
}

// The value of a condition as 0 or not 0.
void QclCompiler::condition() {
  nesting_ = 0;
  if (expression() == Type::real) emit(QclOp::to_flag_real);
}

const NamedThing* QclCompiler::find_name(const QclToken& name) {
  const NamedThing* thing = names_.find(name.text);
  if (!thing && !told_names_.insert(lower(name.text)).second) return nullptr;
  if (const auto remedy = thing ? "" : instead_of(name.text); !remedy.empty())
    complain("qcl.unknown-name"_code, name.place, fmt::format("QCL has no {}", name.text),
             std::string(remedy));
  else if (!thing)
    complain("qcl.unknown-name"_code, name.place, "unknown name " + in_quotes(name.text),
             suggestion(name.text, names_.names(), "declare it in " + configuration_.file));
  return thing;
}

bool QclCompiler::is_device(std::string_view name) const {
  const NamedThing* thing = names_.find(name);
  return thing && thing->kind == NamedThing::Kind::device;
}

std::optional<int> QclCompiler::find_device(const QclToken& name) {
  const NamedThing* thing = names_.find(name.text);
  if (thing && thing->kind == NamedThing::Kind::device) return thing->index;
  if (!told_names_.insert(lower(name.text)).second) return std::nullopt;
  complain("qcl.unknown-name"_code, name.place,
           thing ? fmt::format("{} is {}, not a device", in_quotes(name.text), name_of(thing->kind))
                 : "unknown device " + in_quotes(name.text),
           suggestion(name.text, device_names(),
                      device_names().empty() ? "declare it under INTDEVICE in " + configuration_.file
                                             : "devices are " + listed(device_names())));
  return std::nullopt;
}

std::optional<Symbol> QclCompiler::find_parameter(int device, const QclToken& name) {
  const DeviceType& type = type_of(device);
  const std::optional<Symbol> symbol = find_symbol(type, name.text);
  if (symbol) return symbol;
  const std::string& device_name = configuration_.devices[static_cast<std::size_t>(device)].name;
  // Print loses underscores: `Axis:st init`.
  const std::string joined = fmt::format("{}_{}", name.text, peek().text);
  if (peek().kind == QclToken::Kind::name && find_symbol(type, joined)) {
    complain("qcl.unknown-name"_code, name.place,
             fmt::format("{} has no parameter or state {}", type.name, in_quotes(name.text)),
             "did you mean " + in_quotes(joined) + "?");
    take();
    return std::nullopt;
  }
  if (const std::optional<int> command = find_command(type, name.text))
    complain("qcl.not-writable"_code, name.place,
             fmt::format("{} is a command of {}, not a parameter", in_quotes(name.text), type.name),
             fmt::format("write {} {}", type.commands[static_cast<std::size_t>(*command)].name, device_name));
  else
    complain("qcl.unknown-name"_code, name.place,
             fmt::format("{} has no parameter or state {}", type.name, in_quotes(name.text)),
             suggestion(name.text, symbol_names(type), fmt::format("see: drycut devices {}", type.name)));
  return std::nullopt;
}

const DeviceType& QclCompiler::type_of(int device) const {
  return *catalogue_[configuration_.devices[static_cast<std::size_t>(device)].type].type;
}

std::vector<std::string> QclCompiler::device_names() const {
  std::vector<std::string> names;
  for (const DeviceRecord& device : configuration_.devices) names.push_back(device.name);
  return names;
}

std::vector<std::string> QclCompiler::all_commands() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < configuration_.devices.size(); ++i)
    for (const DeviceCommand& command : type_of(static_cast<int>(i)).commands)
      names.emplace_back(command.name);
  return names;
}

}  // namespace drycut::devices::qmove
