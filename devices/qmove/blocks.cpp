#include <algorithm>
#include <cstddef>
#include <initializer_list>

#include <fmt/format.h>

#include "devices/qmove/compiler.hpp"

// Blocks of QCL: IF ELSE ENDIF, WHILE ENDWHILE, FOR NEXT, SUB ENDSUB; and where JUMP and CALL lead.
namespace drycut::devices::qmove {

std::string_view Compiler::opener(Block::Kind kind) {
  switch (kind) {
    case Block::Kind::if_:
      return "IF";
    case Block::Kind::else_:
      return "ELSE";
    case Block::Kind::while_:
      return "WHILE";
    case Block::Kind::for_:
      return "FOR";
    case Block::Kind::sub:
      return "SUB";
  }
  return "";
}

std::string_view Compiler::closer(Block::Kind kind) {
  switch (kind) {
    case Block::Kind::if_:
    case Block::Kind::else_:
      return "ENDIF";
    case Block::Kind::while_:
      return "ENDWHILE";
    case Block::Kind::for_:
      return "NEXT";
    case Block::Kind::sub:
      return "ENDSUB";
  }
  return "";
}

// IF e and WHILE e.
void Compiler::open_condition(Block::Kind kind) {
  const Place place = token().place;
  advance();
  const int begin = here();
  condition();
  insert_barriers(begin);
  blocks_.push_back({kind, place, place, emit(Op::jump_if_zero), begin});
}

void Compiler::else_block() {
  const Place place = token().place;
  advance();
  if (!blocks_.empty() && blocks_.back().kind == Block::Kind::else_) {
    complain(place, "a second ELSE in one IF",
             fmt::format("the IF of line {} has its ELSE in line {}", blocks_.back().place.line,
                         blocks_.back().here.line));
    return;
  }
  const std::optional<Block> block = close("ELSE", {Block::Kind::if_});
  if (!block) return;
  const int exit = emit(Op::jump);
  aim(block->exit);
  blocks_.push_back({Block::Kind::else_, block->place, place, exit, 0});
}

void Compiler::endif_block() {
  const std::optional<Block> block = close("ENDIF", {Block::Kind::if_, Block::Kind::else_});
  advance();
  if (block) aim(block->exit);
}

void Compiler::endwhile_block() {
  const std::optional<Block> block = close("ENDWHILE", {Block::Kind::while_});
  advance();
  if (!block) return;
  emit(Op::jump, block->again);
  aim(block->exit);
}

// FOR (i = first, condition, i = next) or FOR (i = first, condition, step). In the code the step stands
// before the body and is jumped over at the start.
void Compiler::for_block() {
  static const std::string form = "write: FOR (i = 1, i LE 10, 1)";
  const Place place = token().place;
  advance();
  // The block is opened whatever its header is like, so that its NEXT is not a fault too.
  Block block{Block::Kind::for_, place, place, -1, here()};
  const NamedThing* variable = nullptr;
  if (expect('(', form)) {
    if (token().kind != Token::Kind::word)
      syntax_error(token(), "FOR begins with an assignment, found " + found(token()), form);
    else
      variable = assignment();
  }
  if (!line_failed_ && expect(',', form)) {
    const int test = here();
    condition();
    insert_barriers(test);
    block.exit = emit(Op::jump_if_zero);
    const int body = emit(Op::jump);
    block.again = here();
    if (!line_failed_ && expect(',', form)) for_step(variable, form);
    if (!line_failed_) expect(')', form);
    emit(Op::jump, test);
    aim(body);
  }
  blocks_.push_back(block);
}

void Compiler::for_step(const NamedThing* variable, const std::string& form) {
  stack_ = 0;
  const bool assigns = token().kind == Token::Kind::word &&
                       std::any_of(line_.begin() + static_cast<std::ptrdiff_t>(at_), line_.end(),
                                   [](const Token& token) { return is_sign(token, '='); });
  if (assigns) {
    assignment();
    return;
  }
  const bool counts = variable && variable->kind == NamedThing::Kind::scalar;
  if (!counts)
    return syntax_error(token(), "a step without assignment needs a plain variable to count", form);
  const int begin = here();
  emit(Op::load, variable->index);
  const Type type = expression();
  const bool real = variable->size == Size::S || type == Type::real;
  if (real && variable->size != Size::S) emit(Op::to_real_below);
  if (real && type != Type::real) emit(Op::to_real);
  emit(real ? Op::add_real : Op::add);
  store(*variable, real ? Type::real : Type::integer);
  insert_barriers(begin);
}

void Compiler::next_block() {
  const std::optional<Block> block = close("NEXT", {Block::Kind::for_});
  advance();
  if (!block) return;
  emit(Op::jump, block->again);
  aim(block->exit);
}

void Compiler::sub_block() {
  const Place place = token().place;
  const Token* name = name_operand("SUB <name>");
  const bool nested = std::any_of(blocks_.begin(), blocks_.end(),
                                  [](const Block& block) { return block.kind == Block::Kind::sub; });
  if (nested) complain(place, "SUB inside a SUB", "close the first with ENDSUB");
  // Statements that come to a SUB pass it by; only CALL enters.
  blocks_.push_back({Block::Kind::sub, place, place, emit(Op::jump), 0});
  if (!name) return;
  const auto [target, is_new] = subs_.emplace(lower(name->text), Target{here(), name->place});
  if (is_new)
    sub_names_.emplace_back(name->text);
  else
    complain(name->place, fmt::format("the subroutine {} stands twice", in_quotes(name->text)),
             fmt::format("the first is in line {}; rename one", target->second.place.line));
}

void Compiler::endsub_block() {
  const std::optional<Block> block = close("ENDSUB", {Block::Kind::sub});
  advance();
  if (!block) return;
  emit(Op::back);
  aim(block->exit);
}

// Takes the innermost open block of one of `kinds` off the stack. Blocks inside it that are still open are
// faults of theirs.
std::optional<Compiler::Block> Compiler::close(std::string_view closing,
                                               std::initializer_list<Block::Kind> kinds) {
  const auto found = std::find_if(blocks_.rbegin(), blocks_.rend(), [&](const Block& block) {
    return std::find(kinds.begin(), kinds.end(), block.kind) != kinds.end();
  });
  if (found == blocks_.rend()) {
    const std::string_view first = opener(*kinds.begin());
    complain(line_.front().place, fmt::format("{} without {}", closing, first),
             fmt::format("no {} is open here; remove it or write the missing {}", first, first));
    return std::nullopt;
  }
  while (&blocks_.back() != &*found) {
    unclosed(blocks_.back());
    blocks_.pop_back();
  }
  const Block block = blocks_.back();
  blocks_.pop_back();
  return block;
}

void Compiler::unclosed(const Block& block) {
  const std::string_view name = opener(block.kind == Block::Kind::else_ ? Block::Kind::if_ : block.kind);
  complain(block.place, fmt::format("{} without {}", name, closer(block.kind)),
           fmt::format("write {} at the end of its block", closer(block.kind)));
}

// Lets the jump at `code` lead here.
void Compiler::aim(int code) {
  if (code >= 0) program_.code[static_cast<std::size_t>(code)].a = here();
}

// JUMP and CALL, whose targets may stand below them.
void Compiler::resolve() {
  for (const Reference& reference : jumps_) {
    const auto found = labels_.find(lower(reference.name));
    if (found == labels_.end())
      complain(
          reference.place, "unknown label " + in_quotes(reference.name),
          suggestion(reference.name, label_names_, fmt::format("write {}: where it leads", reference.name)));
    else
      program_.code[static_cast<std::size_t>(reference.code)].a = found->second.code;
  }
  for (const Reference& reference : calls_) {
    const auto found = subs_.find(lower(reference.name));
    if (found == subs_.end())
      complain(reference.place, "unknown subroutine " + in_quotes(reference.name),
               suggestion(reference.name, sub_names_, fmt::format("write SUB {} .. ENDSUB", reference.name)));
    else
      program_.code[static_cast<std::size_t>(reference.code)].a = found->second.code;
  }
}

}  // namespace drycut::devices::qmove
