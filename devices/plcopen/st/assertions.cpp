#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "devices/coverage.hpp"
#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/machine.hpp"
#include "devices/program_test.hpp"

// Tests in the text: which units they are, what they say, and what becomes of that.
namespace drycut::devices::plcopen::st {
namespace {

constexpr std::string_view finished_word = "TEST_FINISHED";

/// The inputs of an assertion in their order, "" = the function has no more.
using InputWords = std::array<std::string_view, 4>;
constexpr InputWords of_condition{"Condition", "Message"};
constexpr InputWords of_two{"Expected", "Actual", "Delta", "Message"};
constexpr InputWords of_title{"TestName"};

/// What the text calls: AssertTrue, AssertEquals_INT, TEST.
struct AssertionCall {
  Assertion says = Assertion::equal;
  InputWords inputs = {};
  const Type* type = nullptr;  ///< of AssertEquals_REAL
  bool truth = true;           ///< AssertTrue
};

std::optional<AssertionCall> assertion_named(std::string_view name) {
  constexpr std::string_view equals = "AssertEquals";
  if (same_word(name, "AssertTrue")) return AssertionCall{Assertion::equal, of_condition};
  if (same_word(name, "AssertFalse")) return AssertionCall{Assertion::equal, of_condition, nullptr, false};
  if (same_word(name, equals)) return AssertionCall{Assertion::equal, of_two};
  if (same_word(name, "TEST")) return AssertionCall{Assertion::title, of_title};
  if (same_word(name, finished_word)) return AssertionCall{Assertion::finished};
  const bool typed = name.size() > equals.size() && same_word(name.substr(0, equals.size()), equals) &&
                     name[equals.size()] == '_';
  const Type* const type = typed ? elementary_type(name.substr(equals.size() + 1)) : nullptr;
  if (type == nullptr || type->basic == Basic::axis) return std::nullopt;
  return AssertionCall{Assertion::equal, of_two, type};
}

bool tests_something(const Unit& unit) {
  return is_test(unit.name.text) || (unit.owner != nullptr && is_test(unit.owner->name.text));
}

}  // namespace

std::string told_name(const Unit& unit) {
  return unit.owner == nullptr ? std::string(unit.name.text)
                               : fmt::format("{}.{}", unit.owner->name.text, unit.name.text);
}

std::optional<TypedExpression> Expressions::assertion_call(const StToken& name,
                                                           const std::vector<Argument>& given) {
  const auto call = assertion_named(name.text);
  if (!call || unit_ == nullptr || (!asserts_ && !tests_something(*unit_))) return std::nullopt;
  std::array<std::optional<TypedExpression>, 4> values;
  const auto inputs = static_cast<std::size_t>(std::find(call->inputs.begin(), call->inputs.end(), "") -
                                               call->inputs.begin());
  std::size_t next = 0;
  for (const Argument& argument : given) {
    TypedExpression value = typed(*argument.tree, call->type);
    if (value.unknown()) return unknown_at(name.place);
    std::size_t input = next++;
    if (argument.name != nullptr)
      input = static_cast<std::size_t>(
          std::find_if(call->inputs.begin(), call->inputs.begin() + static_cast<std::ptrdiff_t>(inputs),
                       [&](std::string_view known) { return argument.name->word(known); }) -
          call->inputs.begin());
    // AssertEquals(5, count, 'text'): no Delta.
    const bool text = value.type->basic == Basic::string;
    if (argument.name == nullptr && input == 2 && inputs > 2 && text) ++input;
    if (input >= inputs || values[input])
      give_up("st.call"_code, value.place, fmt::format("{} has no such input", name.text),
              inputs == 0
                  ? "it has none"
                  : fmt::format("{}({})", name.text,
                                fmt::join(call->inputs.begin(),
                                          call->inputs.begin() + static_cast<std::ptrdiff_t>(inputs), ", ")));
    values[input] = std::move(value);
  }
  const auto needed = [&](std::size_t input) -> TypedExpression& {
    if (!values[input])
      give_up("st.call"_code, name.place, fmt::format("{} lacks its {}", name.text, call->inputs[input]),
              "give it");
    return *values[input];
  };
  const Type* boolean = type_of(Basic::boolean);
  const TypedExpression none = constant(boolean, 0, name.place);
  TypedExpression expected = none;
  TypedExpression actual = none;
  TypedExpression delta = constant(type_of(Basic::lreal), cell_of(0), name.place);
  std::optional<TypedExpression> message;
  const Type* type = boolean;
  if (call->inputs == of_condition) {
    expected = constant(boolean, call->truth ? 1 : 0, name.place);
    actual = converted(needed(0), *boolean);
    message = values[1];
  } else if (call->inputs == of_title) {
    message = needed(0);
  } else if (call->inputs == of_two) {
    expected = needed(0);
    actual = needed(1);
    message = values[3];
    take_characters(*this, expected, actual);
    if (expected.unknown() || actual.unknown()) return unknown_at(name.place);
    const bool texts = expected.type->basic == Basic::string && actual.type->basic == Basic::string;
    type = call->type != nullptr ? call->type : texts ? actual.type : common_type(expected, actual, nullptr);
    if (type == nullptr || (type->basic != Basic::string && !is_elementary(type->basic)) ||
        (type->basic == Basic::string && !texts))
      return refuse(
          "st.type"_code, name.place,
          fmt::format("{} does not compare {} with {}", name.text, expected.type->name, actual.type->name),
          "two values of one elementary type, or two texts");
    if (!texts) {
      expected = converted(expected, *type);
      actual = converted(actual, *type);
    }
    if (values[2]) {
      if (!is_real(type->basic))
        return refuse("st.call"_code, values[2]->place, fmt::format("a Delta of {}", type->name),
                      "only real numbers may lie apart");
      delta = cast(*values[2], Basic::lreal, values[2]->place);
    }
  }
  if (message && message->type->basic != Basic::string)
    return refuse("st.type"_code, message->place,
                  fmt::format("{} takes a text, not {}", name.text, message->type->name), "'what is tested'");
  if (expected.unknown() || actual.unknown() || delta.unknown()) return unknown_at(name.place);
  const int text = message ? message->node : literal_string("", name.place);
  const int list = add_list({value_node(expected), value_node(actual), value_node(delta), text});
  const int node =
      add_node(StOp::assertion, type->basic, name.place, list, -1, -1, static_cast<std::int64_t>(call->says));
  return TypedExpression{boolean, name.place, node, depth_over({expected, actual, delta})};
}

bool Compiler::has_tests() const {
  return std::any_of(units_.begin(), units_.end(), [](const auto& unit) { return is_test(unit->name.text); });
}

/// A FUNCTION_BLOCK or PROGRAM TEST_..., or its METHODs of that name; METHODs TEST_... of any block.
void Compiler::find_tests() {
  const auto finishes = [&](const Unit& unit) {
    return std::any_of(tokens_.begin() + static_cast<std::ptrdiff_t>(unit.first),
                       tokens_.begin() + static_cast<std::ptrdiff_t>(unit.end),
                       [](const StToken& token) { return token.word(finished_word); });
  };
  for (const auto& unit : units_) {
    if (unit->standard || unit->pou < 0 ||
        (unit->kind != Unit::Kind::program && unit->kind != Unit::Kind::function_block))
      continue;
    std::vector<Unit*> methods;
    for (const auto& method : units_)
      if (method->owner == unit.get() && method->pou >= 0 && is_test(method->name.text) &&
          !method->abstract && method->key == lower(method->name.text))
        methods.push_back(method.get());
    if (methods.empty() && !is_test(unit->name.text)) continue;
    const std::size_t instance = code_->instances.size();
    add_instance(unit->name, -1, *unit, 0);
    if (methods.empty())
      code_->tests.push_back({told_name(*unit), unit->name.place.line, instance, -1, finishes(*unit)});
    for (const Unit* method : methods)
      code_->tests.push_back(
          {told_name(*method), method->name.place.line, instance, method->pou, finishes(*method)});
  }
}

void Machine::run(const Compiled::Test& test, std::int64_t time_ns) {
  const Compiled::Instance& instance = code_.instances[test.instance];
  if (test.method < 0) return run(instance, time_ns);
  time_ns_ = time_ns;
  work_ = most_work;
  active_.assign(code_.pous.size(), false);
  const Pou& method = code_.pous[static_cast<std::size_t>(test.method)];
  reset(method, method.frame);
  execute(method.body, instance.cell);
}

Cell Machine::assertion(const StInstruction& of, const Bases& bases) {
  const int* const list = code_.lists.data() + of.d;
  const auto operand = [&](int i) { return at(bases, unpacked(list[i])); };
  const auto message = [&] { return std::string(whole_text(operand(3))); };
  const auto says = static_cast<Assertion>(of.b.cells);
  if (says == Assertion::equal) {
    const Cell expected = operand(0);
    const Cell actual = operand(1);
    const bool texts = of.basic == Basic::string;
    const bool holds = texts ? whole_text(expected) == whole_text(actual)
                       : is_real(of.basic)
                           ? real_of(expected) == real_of(actual) ||
                                 std::abs(real_of(expected) - real_of(actual)) <= real_of(operand(2))
                           : expected == actual;
    if (test_log_ == nullptr) return holds ? 1 : 0;
    ++test_log_->assertions;
    if (holds) return 1;
    const auto told = [&](Cell value) {
      return texts ? fmt::format("'{}'", whole_text(value)) : text_of(of.basic, value);
    };
    const auto line = code_.lines.at(origin(of).line);
    test_log_->add({code_.files[line.file].name, line.line, message(), told(expected), told(actual)});
    return 0;
  }
  if (test_log_ != nullptr && says == Assertion::title) test_log_->title = message();
  if (test_log_ != nullptr && says == Assertion::finished) test_log_->finished = true;
  return 1;
}

}  // namespace drycut::devices::plcopen::st
