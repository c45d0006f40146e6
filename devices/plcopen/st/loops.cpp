#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// FOR, WHILE, REPEAT, EXIT, CONTINUE, RETURN.
namespace drycut::devices::plcopen::st {

int Statements::for_statement() {
  const StToken opened = take();
  const Place place = opened.place;
  int start = -1;
  int test = -1;
  int step_on = -1;
  std::vector<int> all;
  try {
    const StToken name = peek();
    if (name.kind != StToken::Kind::name)
      give_up("st.loop"_code, name.place, "FOR counts no variable", "FOR i := 0 TO 9 DO");
    TypedExpression counter = typed(name_tree());
    counter.place = name.place;
    if (!counter.unknown() && !is_integer(counter.type->basic)) {
      complain("st.type"_code, name.place,
               fmt::format("FOR counts {}, which is {}", in_quotes(counter.name), counter.type->name),
               "a variable of whole numbers");
      counter = unknown_at(name.place);
    }
    expect(":=", "stands behind the variable of a FOR");
    const TypedExpression from = expression(counter.type);
    start = assign(counter, from);
    // Behind its last turn the counter of a subrange is out of it.
    counter.type = base_of(counter.type);
    expect_word("TO", fmt::format("FOR {} := 0 TO 9 DO", name.text));
    TypedExpression to = converted(expression(counter.type), *counter.type);
    TypedExpression step = constant(counter.type, 1, place);
    if (accept_word("BY")) step = converted(expression(counter.type), *counter.type);
    if (step.constant && step.value == 0)
      complain("st.loop"_code, step.place, "FOR with a step of 0 never ends", "BY 1 or BY -1");
    expect_word("DO", fmt::format("FOR {} := 0 TO 9 DO", name.text));
    if (!counter.unknown() && !to.unknown() && !step.unknown() && counter.address) {
      note_endless(counter, from, to, step);
      // The end and the step are computed once.
      const auto kept = [&](const TypedExpression& value) {
        if (value.constant) return value;
        const TypedExpression cell =
            variable_at(counter.type, scratch(*counter.type, value.place), "", value.place);
        all.push_back(
            add_node(StOp::store_at, counter.type->basic, value.place, cell.node, value_node(value)));
        return cell;
      };
      to = kept(to);
      step = kept(step);
      const int current = value_node(counter);
      const int end = value_node(to);
      test = add_node(StOp::passes, counter.type->basic, place, current, end, value_node(step));
      step_on = assign(counter, apply_op(StOp::add, counter.type, place, counter, step));
    }
  } catch (const GiveUp&) {
    skip_to([&] { return peek().word("DO") || peek().is(";"); });
    accept_word("DO");
  }
  const int body = loop_body({"END_FOR"});
  close(opened, "END_FOR");
  all.insert(all.begin(), start);
  all.push_back(add_node(StOp::loop, Basic::unknown, place, test, body, step_on));
  return sequence_node(std::move(all), place);
}

/// FOR i := 0 TO 127 of a SINT: behind 127 comes -128.
void Statements::note_endless(const TypedExpression& counter, const TypedExpression& from,
                              const TypedExpression& to, const TypedExpression& step) {
  const Basic basic = counter.type->basic;
  if (!to.constant || !step.constant || step.value == 0 || is_wide(basic)) return;
  const bool up = step.value > 0;
  const Subrange range = range_of(basic);
  std::int64_t last = to.value;
  if (from.constant && (up ? from.value <= to.value : from.value >= to.value))
    last = to.value - (to.value - from.value) % step.value;
  else if (step.value != 1 && step.value != -1)
    return;
  if (up ? last <= range.high - step.value : last >= range.low - step.value) return;
  code_->doubts.push_back(
      {"st.loop"_code, counter.place.line, counter.place.column,
       fmt::format("FOR counts {}, which is {}, to {}: behind it comes {}, and only EXIT ends the loop; "
                   "count with a wider type",
                   counter.name, type_of(basic)->name, last,
                   wrapped(basic, static_cast<Cell>(static_cast<std::uint64_t>(last) +
                                                    static_cast<std::uint64_t>(step.value)))),
       ""});
}

int Statements::loop_body(std::initializer_list<std::string_view> closing) {
  const Nested nested(loops_);
  return statements(closing);
}

int Statements::while_statement() {
  const StToken opened = take();
  const int test = condition("DO");
  const int body = loop_body({"END_WHILE"});
  close(opened, "END_WHILE");
  return add_node(StOp::loop, Basic::unknown, opened.place, test, body);
}

int Statements::repeat_statement() {
  const StToken opened = take();
  const int body = loop_body({"UNTIL", "END_REPEAT"});
  int test = -1;
  if (accept_word("UNTIL")) {
    const Place place = peek().place;
    const TypedExpression value = expression();
    accept(";");
    if (!value.unknown() && value.type->basic != Basic::boolean)
      complain("st.type"_code, place, fmt::format("the condition is {}, not BOOL", value.type->name),
               "compare it: <> 0");
    else if (!value.unknown())
      test = value_node(value);
  } else if (peek().word("END_REPEAT")) {
    complain("st.syntax"_code, peek().place, "UNTIL is missing before 'END_REPEAT'",
             fmt::format("REPEAT of {} ends with UNTIL condition END_REPEAT", line_of(opened.place)));
  }
  close(opened, "END_REPEAT");
  return add_node(StOp::repeat, Basic::unknown, opened.place, body, test);
}

int Statements::jump(StOp op) {
  const StToken word = take();
  if (op != StOp::leave_pou && loops_ == 0)
    complain("st.loop"_code, word.place, fmt::format("{} stands in no loop", upper(word.text)),
             "it leaves or goes on with a FOR, WHILE or REPEAT");
  expect(";", "ends a statement");
  return add_node(op, Basic::unknown, word.place);
}

}  // namespace drycut::devices::plcopen::st
