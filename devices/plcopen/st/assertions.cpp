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

/// What the text calls: AssertTrue, AssertEquals_INT, TEST.
struct AssertionCall {
  using Inputs = std::array<std::string_view, 4>;
  Assertion says = Assertion::equal;
  Inputs inputs = {};          ///< in their order, "" = it has no more
  const Type* type = nullptr;  ///< of AssertEquals_REAL
  bool truth = true;           ///< AssertTrue
};

namespace {

constexpr std::string_view finished_word = "TEST_FINISHED";
constexpr AssertionCall::Inputs of_condition{"Condition", "Message"};
constexpr AssertionCall::Inputs of_two{"Expected", "Actual", "Delta", "Message"};
constexpr AssertionCall::Inputs of_title{"TestName"};

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

bool Expressions::may_assert() const { return unit_ != nullptr && (asserts_ || tests_something(*unit_)); }

bool Expressions::is_assertion(std::string_view name) { return assertion_named(name).has_value(); }

void Expressions::add_assertion_names(std::vector<std::string>& names) {
  for (const auto* name : {"AssertTrue", "AssertFalse", "AssertEquals", "TEST", "TEST_FINISHED"})
    names.emplace_back(name);
  for (const auto& type : elementary_names()) names.push_back("AssertEquals_" + type);
}

std::optional<TypedExpression> Expressions::assertion_call(const StToken& name,
                                                           const std::vector<Argument>& given) {
  const auto call = assertion_named(name.text);
  if (!call || !may_assert()) return std::nullopt;
  const auto values = assertion_inputs(*call, name, given);
  if (!values) return unknown_at(name.place);
  const auto needed = [&](std::size_t input) {
    if (!(*values)[input])
      give_up("st.call"_code, name.place, fmt::format("{} lacks its {}", name.text, call->inputs[input]),
              "give it");
    return *(*values)[input];
  };
  const Type* boolean = type_of(Basic::boolean);
  const TypedExpression none = constant(boolean, 0, name.place);
  Comparison of{none, none, constant(type_of(Basic::lreal), cell_of(0), name.place), boolean};
  std::optional<TypedExpression> message;
  if (call->inputs == of_condition) {
    of.expected = constant(boolean, call->truth ? 1 : 0, name.place);
    of.actual = converted(needed(0), *boolean);
    message = (*values)[1];
  } else if (call->inputs == of_title) {
    message = needed(0);
  } else if (call->inputs == of_two) {
    of.expected = needed(0);
    of.actual = needed(1);
    if (!make_comparable(of, *call, (*values)[2], name)) return unknown_at(name.place);
    message = (*values)[3];
  }
  if (message && message->type->basic != Basic::string)
    return refuse("st.type"_code, message->place,
                  fmt::format("{} takes a text, not {}", name.text, message->type->name), "'what is tested'");
  if (of.expected.unknown() || of.actual.unknown() || of.delta.unknown()) return unknown_at(name.place);
  const int text = message ? message->node : literal_string("", name.place);
  const int list = add_list({value_node(of.expected), value_node(of.actual), value_node(of.delta), text});
  const int node = add_node(StOp::assertion, of.type->basic, name.place, list, -1, -1,
                            static_cast<std::int64_t>(call->says));
  return TypedExpression{boolean, name.place, node, depth_over({of.expected, of.actual, of.delta})};
}

/// What is given to each input, by order or by name; nothing if a value of it is unknown.
std::optional<Expressions::AssertionInputs> Expressions::assertion_inputs(
    const AssertionCall& call, const StToken& name, const std::vector<Argument>& given) {
  AssertionInputs values;
  const auto end = std::find(call.inputs.begin(), call.inputs.end(), "");
  const auto inputs = static_cast<std::size_t>(end - call.inputs.begin());
  std::size_t next = 0;
  for (const Argument& argument : given) {
    TypedExpression value = typed(*argument.tree, call.type);
    if (value.unknown()) return std::nullopt;
    std::size_t input = next++;
    if (argument.name != nullptr)
      input = static_cast<std::size_t>(
          std::find_if(call.inputs.begin(), end,
                       [&](std::string_view known) { return argument.name->word(known); }) -
          call.inputs.begin());
    // AssertEquals(5, count, 'text'): no Delta.
    const bool text = value.type->basic == Basic::string;
    if (argument.name == nullptr && input == 2 && inputs > 2 && text) ++input;
    if (input >= inputs || values[input])
      give_up("st.call"_code, value.place, fmt::format("{} has no such input", name.text),
              inputs == 0 ? "it has none"
                          : fmt::format("{}({})", name.text, fmt::join(call.inputs.begin(), end, ", ")));
    values[input] = std::move(value);
  }
  return values;
}

/// Both values in one type, which a Delta fits; false if they have none.
bool Expressions::make_comparable(Comparison& of, const AssertionCall& call,
                                  const std::optional<TypedExpression>& delta, const StToken& name) {
  take_characters(*this, of.expected, of.actual);
  if (of.expected.unknown() || of.actual.unknown()) return false;
  const bool texts = of.expected.type->basic == Basic::string && of.actual.type->basic == Basic::string;
  of.type = call.type != nullptr ? call.type
            : texts              ? of.actual.type
                                 : common_type(of.expected, of.actual, nullptr);
  if (of.type == nullptr || (of.type->basic != Basic::string && !is_elementary(of.type->basic)) ||
      (of.type->basic == Basic::string && !texts)) {
    complain("st.type"_code, name.place,
             fmt::format("{} does not compare {} with {}", name.text, of.expected.type->name,
                         of.actual.type->name),
             "two values of one elementary type, or two texts");
    return false;
  }
  if (!texts) {
    of.expected = converted(of.expected, *of.type);
    of.actual = converted(of.actual, *of.type);
  }
  if (!delta) return true;
  if (!is_real(of.type->basic)) {
    complain("st.call"_code, delta->place, fmt::format("a Delta of {}", of.type->name),
             "only real numbers may lie apart");
    return false;
  }
  of.delta = cast(*delta, Basic::lreal, delta->place);
  return true;
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

/// What is no test, whatever its name says or it asserts, and what nothing calls: a FUNCTION TEST_..., and a
/// METHOD of a suite.
void Compiler::doubt_tests() {
  const auto asserts = [&](const Unit& unit) {
    return std::any_of(tokens_.begin() + static_cast<std::ptrdiff_t>(unit.first),
                       tokens_.begin() + static_cast<std::ptrdiff_t>(unit.end),
                       [](const StToken& token) { return assertion_named(token.text).has_value(); });
  };
  const auto is_suite = [&](const Unit& block) {
    return is_test(block.name.text) || std::any_of(units_.begin(), units_.end(), [&](const auto& unit) {
             return unit->owner == &block && is_test(unit->name.text);
           });
  };
  for (const auto& unit : units_) {
    const bool named =
        unit->kind == Unit::Kind::function && unit->owner == nullptr && is_test(unit->name.text);
    const bool asserting = unit->owner != nullptr && !is_test(unit->name.text) && unit->pou >= 0 &&
                           is_suite(*unit->owner) && asserts(*unit);
    if (unit->standard || !(named || asserting)) continue;
    const bool called = std::any_of(units_.begin(), units_.end(),
                                    [&](const auto& other) { return other->calls.contains(unit->pou); });
    if (!called)
      code_->doubts.push_back(
          {"program.never-called"_code, unit->name.place.line, unit->name.place.column,
           named ? fmt::format("FUNCTION {} is no test, and nothing calls it: a FUNCTION_BLOCK, a "
                               "PROGRAM or a METHOD of that name is one",
                               unit->name.text)
                 : fmt::format(
                       "METHOD {} asserts, and nothing calls it: one whose name begins with TEST_ is a test",
                       unit->name.text),
           ""});
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
