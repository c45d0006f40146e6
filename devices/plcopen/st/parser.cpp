#include "devices/plcopen/st/parser.hpp"

#include <fmt/format.h>

#include "devices/plcopen/st/lexer.hpp"
#include "devices/plcopen/st/values.hpp"

namespace drycut::devices::plcopen::st {
namespace {

constexpr int deepest_tree = 60;

bool belongs(const StToken& token, int level) {
  const Operator* sign = find_operator(token);
  return sign != nullptr && sign->level == level;
}

Tree leaf(Tree::Kind kind, const StToken& token) {
  Tree tree;
  tree.kind = kind;
  tree.token = &token;
  return tree;
}

Tree over(Tree::Kind kind, const StToken& token, Tree part) {
  Tree tree = leaf(kind, token);
  tree.parts.push_back(std::move(part));
  return tree;
}

/// AND(a, b): an operator as a function.
bool is_operator_function(const StToken& token) {
  return token.word("AND") || token.word("OR") || token.word("XOR") || token.word("MOD");
}

}  // namespace

std::vector<Argument> arguments(const Tree& call) {
  std::vector<Argument> result;
  for (std::size_t i = 1; i < call.parts.size(); ++i)
    result.push_back(
        {call.names[i - 1].token, call.names[i - 1].output, call.names[i - 1].negated, &call.parts[i]});
  return result;
}

Tree Parser::tree() {
  const Nested nested(nesting_);
  if (nesting_ > deepest_tree)
    give_up("st.too-large"_code, peek().place, "the expression is nested too deeply",
            "split it up by a variable");
  return tree(0);
}

Tree Parser::tree(int level) {
  if (level > strongest_level) return unary_tree();
  Tree first = tree(level + 1);
  if (at_ >= stop_ || !belongs(peek(), level)) return first;
  Tree chain = over(Tree::Kind::chain, *first.token, std::move(first));
  while (at_ < stop_ && belongs(peek(), level)) {
    chain.tokens.push_back(&take());
    chain.parts.push_back(tree(level + 1));
  }
  return chain;
}

Tree Parser::unary_tree() {
  const StToken& sign = peek();
  // NOT(IN := a) is a call.
  const bool call = sign.word("NOT") && peek(1).is("(") && peek(3).is(":=");
  if (call || (!sign.is("-") && !sign.is("+") && !sign.word("NOT"))) return power_tree();
  const Nested nested(nesting_);
  if (nesting_ > deepest_tree)
    give_up("st.too-large"_code, sign.place, "the expression is nested too deeply",
            "split it up by a variable");
  take();
  return over(Tree::Kind::sign, sign, unary_tree());
}

Tree Parser::power_tree() {
  Tree base = primary_tree();
  if (at_ >= stop_ || !peek().is("**")) return base;
  Tree chain = over(Tree::Kind::chain, *base.token, std::move(base));
  while (at_ < stop_ && peek().is("**")) {
    chain.tokens.push_back(&take());
    chain.parts.push_back(peek().is("-") ? unary_tree() : primary_tree());
  }
  return chain;
}

Tree Parser::primary_tree() {
  if (at_ >= stop_)
    give_up("st.syntax"_code, behind(), "an expression is missing at the end", "a value stands here");
  const StToken& token = peek();
  switch (token.kind) {
    case StToken::Kind::number:
    case StToken::Kind::string:
      take();
      return leaf(Tree::Kind::literal, token);
    case StToken::Kind::name:
      return name_tree();
    case StToken::Kind::address:
      return name_tree();
    default:
      break;
  }
  if (token.is(".") && peek(1).kind == StToken::Kind::number)
    give_up("st.syntax"_code, token.place, "a number begins with a digit",
            fmt::format("write 0.{}", peek(1).text));
  if (!accept("("))
    give_up("st.syntax"_code, token.place,
            fmt::format("an expression is missing before {}", in_quotes(token.text)), "a value stands here");
  Tree inner = over(Tree::Kind::parenthesised, token, tree());
  expect(")", "closes the parenthesis of " + line_of(token.place));
  return inner;
}

Tree Parser::name_tree() {
  const StToken& name = peek();
  if (name.kind == StToken::Kind::address) return leaf(Tree::Kind::address, take());
  const bool value = name.word("TRUE") || name.word("FALSE");
  const bool function =
      peek(1).is("(") && (is_operator_function(name) || (name.word("NOT") && peek(3).is(":=")));
  if (is_keyword(name.text) && !value && !function)
    give_up("st.syntax"_code, name.place,
            fmt::format("an expression is missing before {}", in_quotes(name.text)), "a value stands here");
  take();
  if (accept("#")) {
    Tree typed = leaf(Tree::Kind::typed, name);
    typed.negative = accept("-");
    typed.tokens.push_back(&take());
    return typed;
  }
  Tree result = leaf(Tree::Kind::name, name);
  constexpr int longest = 50;
  for (int parts = 0; at_ < stop_; ++parts) {
    if (parts > longest) give_up("st.too-large"_code, peek().place, "the name is too long", "split it up");
    if (accept("."))
      result = member_tree(std::move(result));
    else if (accept("["))
      result = element_tree(std::move(result));
    else if (peek().is("("))
      result = call_tree(std::move(result));
    else if (peek().is("^"))
      result = over(Tree::Kind::dereference, take(), std::move(result));
    else
      break;
  }
  return result;
}

Tree Parser::member_tree(Tree owner) {
  const bool bits = peek().whole() || peek().kind == StToken::Kind::address;
  if (!bits) expect_name("the name of a member");
  const StToken& name = bits ? take() : tokens_[at_ - 1];
  return over(Tree::Kind::member, name, std::move(owner));
}

Tree Parser::element_tree(Tree owner) {
  const StToken& name = *owner.token;
  Tree element = over(Tree::Kind::element, name, std::move(owner));
  do {
    element.parts.push_back(tree());
  } while (accept(","));
  expect("]", "closes the index");
  return element;
}

Tree Parser::call_tree(Tree callee) {
  const StToken& name = *callee.token;
  Tree call = over(Tree::Kind::call, name, std::move(callee));
  const StToken& opening = peek();
  call.tokens.push_back(&opening);
  expect("(", "opens the arguments");
  if (accept(")")) return call;
  do {
    Tree::ArgumentName argument;
    if (peek().word("NOT") && peek(1).kind == StToken::Kind::name && peek(2).is("=>"))
      argument.negated = &take();
    if (peek().kind == StToken::Kind::name && (peek(1).is(":=") || peek(1).is("=>"))) {
      argument.token = &take();
      argument.output = take().is("=>");
    }
    // q => ; connects nothing.
    if (argument.output && (peek().is(",") || peek().is(")"))) continue;
    call.parts.push_back(tree());
    call.names.push_back(argument);
  } while (accept(","));
  expect(")", "closes the arguments opened in " + line_of(opening.place));
  return call;
}

}  // namespace drycut::devices::plcopen::st
