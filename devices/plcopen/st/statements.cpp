#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/keywords.hpp"

// Assignments, calls, IF and CASE.
namespace drycut::devices::plcopen::st {

void Compiler::compile_body(Unit& unit) {
  at_ = unit.body;
  stop_ = unit.end;
  unit_ = &unit;
  told_.clear();
  std::vector<int> all;
  while (at_ < stop_) {
    all.push_back(statements({}));
    if (at_ >= stop_) break;
    const Token stray = take();
    if (stray.kind == Token::Kind::bad) continue;
    complain(stray.place, fmt::format("{} closes nothing", quoted(stray.text)),
             "what it belongs to does not stand before it, or has been closed");
    skip_statement();
  }
  const int first = add_list(all);
  code_->pous[static_cast<std::size_t>(unit.pou)].body =
      add_node(Op::sequence, Basic::unknown, unit.name.place, first, static_cast<int>(all.size()));
}

int Compiler::statements(std::initializer_list<std::string_view> closing) {
  return statements_until([&] {
    return std::any_of(closing.begin(), closing.end(),
                       [&](std::string_view word) { return peek().word(word); });
  });
}

int Compiler::statements_until(const std::function<bool()>& closes) {
  std::vector<int> all;
  const Place place = peek().place;
  while (at_ < stop_ && !closes()) {
    if (peek().kind == Token::Kind::name && closes_block(peek().text)) break;
    const std::size_t before = at_;
    try {
      all.push_back(statement());
    } catch (const GiveUp&) {
      skip_statement();
      if (at_ == before) ++at_;
    }
  }
  std::erase(all, -1);
  const int first = add_list(all);
  return add_node(Op::sequence, Basic::unknown, place, first, static_cast<int>(all.size()));
}

int Compiler::statement() {
  constexpr int deepest = 40;
  if (accept(";")) return -1;
  if (nesting_ > deepest) {
    // Told once a POU.
    if (!told_.insert("#nesting").second) throw GiveUp{};
    give_up(peek().place, "statements are nested too deeply", "make a FUNCTION of the inner ones");
  }
  ++nesting_;
  // Also when the statement is given up.
  struct Leave {
    int& count;
    int value;
    ~Leave() { count = value; }
  } const leave{nesting_, nesting_ - 1};
  if (peek().word("IF")) return if_statement();
  if (peek().word("CASE")) return case_statement();
  if (peek().word("FOR")) return for_statement();
  if (peek().word("WHILE")) return while_statement();
  if (peek().word("REPEAT")) return repeat_statement();
  if (peek().word("EXIT")) return jump(Op::leave_loop);
  if (peek().word("CONTINUE")) return jump(Op::next_turn);
  if (peek().word("RETURN")) return jump(Op::leave_pou);
  return assignment_or_call();
}

int Compiler::assignment_or_call() {
  const Token first = peek();
  if (first.kind != Token::Kind::name || is_keyword(first.text)) {
    const bool declares = first.kind == Token::Kind::name && upper(first.text).starts_with("VAR");
    give_up(first.place, fmt::format("{} begins no statement", quoted(first.text)),
            declares ? "variables are declared before the statements"
                     : "a statement is an assignment, a call, IF, CASE, FOR, WHILE or REPEAT");
  }
  Expression target = name_expression();
  target.place = first.place;
  if (peek().is("(") && (target.unknown() || target.address)) {
    if (target.unknown()) {
      arguments();
      expect(";", "ends a call");
      return -1;
    }
    if (target.type->basic != Basic::block)
      give_up(first.place,
              fmt::format("{} is {} and cannot be called", quoted(target.name), target.type->name),
              "a function block is called by its instance");
    const int call = block_call(target);
    expect(";", "ends a call");
    return call;
  }
  if (!peek().is(":=")) {
    // A function that is called for what it does.
    if (!target.address && !target.constant && tokens_[at_ - 1].is(")")) {
      expect(";", "ends a call");
      return target.unknown() ? -1 : add_node(Op::evaluate, Basic::unknown, first.place, value_node(target));
    }
    const bool block = target.type->basic == Basic::block;
    if (block) expect("(", fmt::format("and ')' call it: {}();", target.name));
    expect(":=", "assigns");
  }
  take();
  const Token value_token = peek();
  const Expression value = expression();
  if (target.cam_file && value.string) cam_file(value_token);
  expect(";", "ends a statement");
  return assign(target, value);
}

int Compiler::assign(const Expression& target, const Expression& value) {
  if (target.unknown()) return -1;
  if (!target.locked.empty() || !target.address) {
    complain(target.place,
             target.locked.empty() ? "this is no variable"
                                   : fmt::format("{} {}", quoted(target.name), target.locked),
             target.locked.empty() ? "a variable stands before ':='"
                                   : "only variables and input pins are assigned");
    return -1;
  }
  const Type& type = *target.type;
  if ((type.basic == Basic::axis && target.place.line > 0 &&
       find_member(*globals_, target.name) != nullptr) ||
      type.basic == Basic::block) {
    complain(target.place, fmt::format("{} is {} and is not assigned", quoted(target.name), type.name),
             type.basic == Basic::axis ? "connect it in a call" : "assign its inputs");
    return -1;
  }
  const Expression source = converted(value, type);
  if (source.unknown() || target.node < 0) return -1;
  if (is_elementary(type.basic) || type.basic == Basic::axis) {
    const int node = value_node(source);
    const Node address = code_->nodes[static_cast<std::size_t>(target.node)];
    if (address.op == Op::address)
      return add_node(Op::store, type.basic, target.place, node, -1, -1, address.imm);
    if (address.op == Op::address_own)
      return add_node(Op::store_own, type.basic, target.place, node, -1, -1, address.imm);
    return add_node(Op::store_at, type.basic, target.place, target.node, node);
  }
  if (type.basic == Basic::string)
    return add_node(Op::copy_string, type.basic, target.place, target.node, source.node, -1,
                    static_cast<std::int64_t>(type.length));
  return add_node(Op::copy, type.basic, target.place, target.node, source.node, -1, type.cells);
}

int Compiler::condition(std::string_view closing) {
  const Place place = peek().place;
  int node = -1;
  try {
    const Expression value = expression();
    if (!value.unknown() && value.type->basic != Basic::boolean) {
      const bool assigns = peek().is(":=");
      complain(value.place,
               fmt::format("the condition is {}, not BOOL", value.untyped ? "a number" : value.type->name),
               assigns ? "'=' compares" : "compare it: <> 0");
    } else if (!value.unknown()) {
      node = value_node(value);
    }
    if (peek().is(":=") && (value.unknown() || value.type->basic == Basic::boolean))
      give_up(peek().place, "':=' assigns", "'=' compares");
    expect_word(closing, fmt::format("stands behind the condition of line {}", place.line));
  } catch (const GiveUp&) {
    while (
        at_ < stop_ && !peek().word(closing) && !peek().is(";") &&
        !(peek().kind == Token::Kind::name && (closes_block(peek().text) || peek().place.line != place.line)))
      ++at_;
    accept_word(closing);
  }
  return node;
}

void Compiler::close(const Token& opened, std::string_view closing) {
  if (accept_word(closing)) {
    // Many write END_IF without ';'.
    accept(";");
    return;
  }
  complain(peek().place,
           fmt::format("{} is missing before {}", closing,
                       peek().kind == Token::Kind::end ? "the end of the file" : quoted(peek().text)),
           fmt::format("it closes the {} of line {}", upper(opened.text), opened.place.line));
}

int Compiler::if_statement() {
  const Token opened = take();
  std::vector<int> parts;
  parts.push_back(condition("THEN"));
  parts.push_back(statements({"ELSIF", "ELSE", "END_IF"}));
  while (accept_word("ELSIF")) {
    parts.push_back(condition("THEN"));
    parts.push_back(statements({"ELSIF", "ELSE", "END_IF"}));
  }
  int otherwise = -1;
  if (accept_word("ELSE")) {
    otherwise = statements({"END_IF"});
  }
  close(opened, "END_IF");
  const int first = add_list(parts);
  return add_node(Op::branch, Basic::unknown, opened.place, first, static_cast<int>(parts.size() / 2),
                  otherwise);
}

void Compiler::case_labels(const Type& selector, std::vector<std::pair<Range, Place>>& labels) {
  const auto label = [&]() -> std::int64_t {
    const Place place = peek().place;
    const Expression value = expression();
    if (value.unknown()) throw GiveUp{};
    if (!value.constant || !is_whole(value.type->basic))
      give_up(place, "a label of a CASE that is not constant",
              "whole numbers, constants and values of an enumeration");
    const std::size_t before = problems_.size();
    const Expression same = converted(value, selector);
    if (problems_.size() != before) throw GiveUp{};
    return same.value;
  };
  do {
    const Place place = peek().place;
    Range range;
    range.low = range.high = label();
    if (accept("..")) range.high = label();
    if (range.high < range.low)
      give_up(place, fmt::format("{}..{} is empty", range.low, range.high), "the lower one stands first");
    for (const auto& [other, at] : labels)
      if (range.low <= other.high && other.low <= range.high)
        give_up(place, fmt::format("the label {} is there already", std::max(range.low, other.low)),
                fmt::format("the first one is in line {}", at.line));
    labels.emplace_back(range, place);
  } while (accept(","));
  expect(":", "ends the labels");
}

int Compiler::case_statement() {
  const Token opened = take();
  const Type* type = type_of(Basic::unknown);
  int selector = -1;
  try {
    const Expression value = expression();
    if (!value.unknown() && !is_integer(value.type->basic) && value.type->basic != Basic::enumeration)
      complain(value.place, fmt::format("CASE chooses by {}", value.type->name),
               "by a whole number or an enumeration");
    else if (!value.unknown())
      type = value.untyped ? type_of(Basic::lint) : value.type;
    if (!value.unknown()) selector = value_node(value);
    expect_word("OF", fmt::format("stands behind the selector of the CASE of line {}", opened.place.line));
  } catch (const GiveUp&) {
    while (at_ < stop_ && !peek().word("OF") && !peek().is(";") &&
           !(peek().kind == Token::Kind::name && closes_block(peek().text)))
      ++at_;
    accept_word("OF");
  }
  std::vector<std::pair<Range, Place>> labels;
  std::vector<Choice> choices;
  int otherwise = -1;
  while (at_ < stop_ && !peek().word("END_CASE")) {
    if (accept_word("ELSE")) {
      accept(":");
      otherwise = statements({"END_CASE"});
      break;
    }
    if (peek().kind == Token::Kind::name && closes_block(peek().text)) break;
    const std::size_t before = labels.size();
    try {
      case_labels(*type, labels);
    } catch (const GiveUp&) {
      while (at_ < stop_ && !peek().is(":") && !peek().is(";") &&
             !(peek().kind == Token::Kind::name && closes_block(peek().text)))
        ++at_;
      if (!accept(":")) accept(";");
    }
    const int body = statements_until([&] { return at_label(); });
    for (std::size_t i = before; i < labels.size(); ++i) choices.push_back({labels[i].first, body});
  }
  close(opened, "END_CASE");
  const int first = static_cast<int>(code_->choices.size());
  code_->choices.insert(code_->choices.end(), choices.begin(), choices.end());
  return add_node(Op::choose, Basic::unknown, opened.place, selector, first, static_cast<int>(choices.size()),
                  otherwise);
}

bool Compiler::at_label() const {
  // A label is what has a ':' behind it before anything of a statement.
  for (std::size_t i = 0; at_ + i < stop_; ++i) {
    const Token& token = peek(i);
    if (token.is(":")) return true;
    const bool part = token.kind == Token::Kind::integer || token.is(",") || token.is("..") ||
                      token.is("-") || token.is(".") || token.is("#") ||
                      (token.kind == Token::Kind::name && !is_keyword(token.text));
    if (!part) return false;
  }
  return false;
}

}  // namespace drycut::devices::plcopen::st
