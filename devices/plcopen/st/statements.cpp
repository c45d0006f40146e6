#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/lexer.hpp"

// Assignments, calls, IF and CASE.
namespace drycut::devices::plcopen::st {

void Statements::compile_body(Unit& unit) {
  at_ = unit.body;
  stop_ = unit.end;
  unit_ = &unit;
  told_.clear();
  std::vector<int> all;
  find_edges(unit, all);
  while (at_ < stop_) {
    all.push_back(statements({}));
    if (at_ >= stop_) break;
    const StToken stray = take();
    if (stray.kind == StToken::Kind::bad) continue;
    complain("st.syntax"_code, stray.place, fmt::format("{} closes nothing", in_quotes(stray.text)),
             "what it belongs to does not stand before it, or has been closed");
    skip_statement();
  }
  pou(unit).body = sequence_node(std::move(all), unit.name.place);
  pou(unit).name = told_name(unit);
  pou(unit).line = unit.standard ? 0 : unit.name.place.line;
}

/// What the body sees of its inputs with R_EDGE and F_EDGE.
void Statements::find_edges(const Unit& unit, std::vector<int>& all) {
  const Type* boolean = type_of(Basic::boolean);
  for (const auto& [name, rising] : unit.edges) {
    const auto& input = name;  // clang 14 has no structured bindings in lambdas
    const Place place = input.place;
    const auto cell = [&](std::string_view mark) {
      const Variable* member = find_member(*unit.type, fmt::format("{}{}", input.text, mark));
      return variable_at(boolean, leaf_node(StOp::address_own, Basic::boolean, place, member->offset),
                         std::string(input.text), place);
    };
    const auto inverted = [&](const TypedExpression& value) {
      return apply_op(StOp::bit_not, boolean, place, value);
    };
    const TypedExpression now = cell("");
    const TypedExpression last = cell(last_mark);
    const TypedExpression edge =
        apply_op(StOp::bit_and, boolean, place, rising ? now : inverted(now), rising ? inverted(last) : last);
    all.push_back(assign(cell(edge_mark), edge));
    all.push_back(assign(last, now));
  }
}

int Statements::statements(std::initializer_list<std::string_view> closing) {
  return statements_until(
      [&] { return peek().kind == StToken::Kind::name && is_one_of(closing, peek().text); });
}

int Statements::statements_until(const std::function<bool()>& closes) {
  std::vector<int> all;
  const Place place = peek().place;
  while (at_ < stop_ && !closes()) {
    if (at_word(closes_block)) break;
    if (read_as_closer()) continue;
    const std::size_t before = at_;
    try {
      all.push_back(statement());
    } catch (const GiveUp&) {
      skip_statement();
      if (at_ == before) ++at_;
    }
  }
  return sequence_node(std::move(all), place);
}

/// ENDIF where END_IF is meant: told once, and read as that, so that nothing follows from it.
bool Statements::read_as_closer() {
  StToken& word = tokens_[at_];
  if (word.kind != StToken::Kind::name || is_keyword(word.text)) return false;
  if (word.word("END") && at_ + 1 < stop_ && is_keyword(peek(1).text)) {
    const auto closer = meant_closer(fmt::format("END{}", peek(1).text));
    if (closer.empty()) return false;
    complain("st.unknown-name"_code, word.place, fmt::format("there is no word 'END {}'", peek(1).text),
             fmt::format("did you mean {}?", in_quotes(closer)));
    tokens_[++at_].text = closer;
    return true;
  }
  const auto& next = peek(1);
  const bool used = next.is(":=") || next.is(".") || next.is("[");
  const auto meant = used ? std::string_view() : meant_closer(word.text);
  // ELSEIF (a > b) THEN; a call ends with ')'.
  if (meant.empty() || (next.is("(") && meant != "ELSIF")) return false;
  complain("st.unknown-name"_code, word.place, fmt::format("there is no word {}", in_quotes(word.text)),
           fmt::format("did you mean {}?", in_quotes(meant)));
  word.text = meant;
  return true;
}

int Statements::statement() {
  constexpr int deepest = 40;
  if (accept(";")) return -1;
  if (nesting_ > deepest) {
    // Told once a POU.
    if (!told_.insert("#nesting").second) throw GiveUp{};
    give_up("st.too-large"_code, peek().place, "statements are nested too deeply",
            "make a FUNCTION of the inner ones");
  }
  const Nested nested(nesting_);
  if (peek().word("IF")) return if_statement();
  if (peek().word("CASE")) return case_statement();
  if (peek().word("FOR")) return for_statement();
  if (peek().word("WHILE")) return while_statement();
  if (peek().word("REPEAT")) return repeat_statement();
  if (peek().word("EXIT")) return jump(StOp::leave_loop);
  if (peek().word("CONTINUE")) return jump(StOp::next_turn);
  if (peek().word("RETURN")) return jump(StOp::leave_pou);
  return assignment_or_call();
}

int Statements::assignment_or_call() {
  const StToken first = peek();
  if (first.is("("))
    give_up("st.syntax"_code, first.place, "no dialect assigns several variables at once",
            "give a function's outputs in its call: a := f(In := x, Out => b);");
  const bool address = first.kind == StToken::Kind::address;
  if (!address && (first.kind != StToken::Kind::name || is_keyword(first.text))) {
    const bool declares = first.kind == StToken::Kind::name && upper(first.text).starts_with("VAR");
    give_up("st.syntax"_code, first.place, fmt::format("{} begins no statement", in_quotes(first.text)),
            declares ? "variables are declared before the statements"
                     : "a statement is an assignment, a call, IF, CASE, FOR, WHILE or REPEAT");
  }
  const Tree left = name_tree();
  if (peek().is(":="))
    if (const auto setting = set_property(left)) return *setting;
  if (!peek().is(":=")) {
    if (left.kind == Tree::Kind::call) return call_statement(left);
    const TypedExpression target = typed(left);
    if (target.unknown()) throw GiveUp{};
    const bool block = target.type->basic == Basic::block;
    if (block) expect("(", fmt::format("and ')' call it: {}();", target.name));
    expect(":=", "assigns");
  }
  TypedExpression target = typed(left);
  target.place = first.place;
  take();
  const StToken value_token = peek();
  const TypedExpression value = expression(target.type);
  if (peek().kind == StToken::Kind::bad) throw GiveUp{};
  if (target.cam_file && value.string) cam_file(value_token);
  const int assignment = assign(target, value);
  expect(";", "ends a statement");
  return assignment;
}

int Statements::call_statement(const Tree& call) {
  const Tree& callee = call.parts[0];
  const StToken& name = *callee.token;
  if (const auto body = super_call(callee)) {
    expect(";", "ends a call");
    return *body;
  }
  if (names_function(callee) || method_of(callee, "").unit != nullptr) {
    statement_ = true;
    const TypedExpression value = typed(call);
    expect(";", "ends a call");
    // For what it does: what it gives, nobody wants.
    if (value.unknown() || value.constant) return -1;
    return add_node(StOp::evaluate, Basic::unknown, name.place, value_node(value));
  }
  TypedExpression instance = typed(callee);
  instance.place = name.place;
  if (instance.unknown()) {
    for (const Argument& argument : arguments(call)) typed(*argument.tree);
    expect(";", "ends a call");
    return -1;
  }
  if (instance.type->basic != Basic::block)
    give_up("st.use"_code, name.place,
            fmt::format("{} is {} and cannot be called", in_quotes(instance.name), instance.type->name),
            "a function block is called by its instance");
  const int node = block_call(instance, call);
  expect(";", "ends a call");
  return node;
}

int Statements::condition(std::string_view closing) {
  const Place place = peek().place;
  int node = -1;
  try {
    const TypedExpression value = expression();
    if (peek().is(":=")) give_up("st.syntax"_code, peek().place, "':=' assigns", "'=' compares");
    if (peek().kind == StToken::Kind::bad) throw GiveUp{};
    if (!value.unknown() && value.type->basic != Basic::boolean)
      complain("st.type"_code, value.place,
               fmt::format("the condition is {}, not BOOL", value.untyped ? "a number" : value.type->name),
               "compare it: <> 0");
    else if (!value.unknown())
      node = value_node(value);
    expect_word(closing, "stands behind the condition of " + line_of(place));
  } catch (const GiveUp&) {
    skip_to([&] {
      const bool next_line = peek().kind == StToken::Kind::name && peek().place.line != place.line;
      return peek().word(closing) || peek().is(";") || at_word(closes_block) || next_line;
    });
    accept_word(closing);
  }
  return node;
}

void Statements::close(const StToken& opened, std::string_view closing) {
  if (!peek().word(closing)) read_as_closer();
  if (accept_word(closing)) {
    // Many write END_IF without ';'.
    accept(";");
    return;
  }
  complain("st.syntax"_code, peek().place,
           fmt::format("{} is missing before {}", closing,
                       peek().kind == StToken::Kind::end ? "the end of the file" : in_quotes(peek().text)),
           fmt::format("it closes the {} of {}", upper(opened.text), line_of(opened.place)));
  // Something too much stands before it.
  std::size_t ahead = 0;
  while (at_ + ahead < stop_ && peek(ahead).place.line == peek().place.line && !peek(ahead).is(";")) {
    if (peek(ahead++).word(closing)) {
      at_ += ahead;
      accept(";");
      return;
    }
  }
}

int Statements::if_statement() {
  const StToken opened = take();
  std::vector<int> parts;
  do {
    parts.push_back(condition("THEN"));
    parts.push_back(statements({"ELSIF", "ELSE", "END_IF"}));
  } while (accept_word("ELSIF"));
  const int otherwise = accept_word("ELSE") ? statements({"END_IF"}) : -1;
  close(opened, "END_IF");
  const int first = add_list(parts);
  return add_node(StOp::branch, Basic::unknown, opened.place, first, static_cast<int>(parts.size() / 2),
                  otherwise);
}

std::int64_t Statements::case_label(const Type& selector) {
  return constant_value(selector, "a label of a CASE that is not constant",
                        "whole numbers, constants and values of an enumeration", is_whole);
}

std::vector<Subrange> Statements::case_labels(const Type& selector, Labels& labels) {
  std::vector<Subrange> ranges;
  do {
    const Place place = peek().place;
    Subrange range;
    range.low = range.high = case_label(selector);
    if (accept("..")) range.high = case_label(selector);
    if (range.high < range.low)
      give_up("st.out-of-range"_code, place, fmt::format("{}..{} is empty", range.low, range.high),
              "the lower one stands first");
    // Those before do not overlap: only the last that begins below its end can.
    const auto next = labels.upper_bound(range.high);
    if (next != labels.begin()) {
      const auto& [low, other] = *std::prev(next);
      if (other.first >= range.low)
        give_up("st.declared-twice"_code, place,
                fmt::format("the label {} is there already", std::max(range.low, low)),
                "the first one is in " + line_of(other.second));
    }
    labels.emplace(range.low, std::pair{range.high, place});
    ranges.push_back(range);
  } while (accept(","));
  expect(":", "ends the labels");
  return ranges;
}

int Statements::case_statement() {
  const StToken opened = take();
  const Type* type = type_of(Basic::unknown);
  int selector = -1;
  try {
    const TypedExpression value = expression();
    if (!value.unknown() && !is_integer(value.type->basic) && !is_character(value.type->basic) &&
        value.type->basic != Basic::enumeration)
      complain("st.type"_code, value.place, fmt::format("CASE chooses by {}", value.type->name),
               "by a whole number, a CHAR or an enumeration");
    else if (!value.unknown())
      type = value.untyped ? type_of(Basic::lint) : base_of(value.type);
    if (!value.unknown()) selector = value_node(value);
    expect_word("OF", "stands behind the selector of the CASE of " + line_of(opened.place));
  } catch (const GiveUp&) {
    skip_to([&] { return peek().word("OF") || peek().is(";") || at_word(closes_block); });
    accept_word("OF");
  }
  Labels labels;
  std::vector<Choice> choices;
  int otherwise = -1;
  while (at_ < stop_ && !peek().word("END_CASE")) {
    if (accept_word("ELSE")) {
      accept(":");
      otherwise = statements({"END_CASE"});
      break;
    }
    if (at_word(closes_block)) break;
    std::vector<Subrange> ranges;
    try {
      ranges = case_labels(*type, labels);
    } catch (const GiveUp&) {
      skip_to([&] { return peek().is(":") || peek().is(";") || at_word(closes_block); });
      if (!accept(":")) accept(";");
    }
    const int body = statements_until([&] { return at_label(); });
    for (const Subrange& range : ranges) choices.push_back({range, body});
  }
  close(opened, "END_CASE");
  const int first = static_cast<int>(nodes_.choices.size());
  nodes_.choices.insert(nodes_.choices.end(), choices.begin(), choices.end());
  return add_node(StOp::choose, Basic::unknown, opened.place, selector, first,
                  static_cast<int>(choices.size()), otherwise);
}

bool Statements::at_label() const {
  // A label is what has a ':' behind it before anything of a statement.
  for (std::size_t i = 0; at_ + i < stop_; ++i) {
    const StToken& token = peek(i);
    if (token.is(":")) return true;
    const bool part = token.whole() || token.is(",") || token.is("..") || token.is("-") || token.is(".") ||
                      token.is("#") || token.kind == StToken::Kind::string ||
                      (token.kind == StToken::Kind::name && !is_keyword(token.text));
    if (!part) return false;
  }
  return false;
}

}  // namespace drycut::devices::plcopen::st
