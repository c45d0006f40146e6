#include <algorithm>
#include <array>
#include <cstddef>

#include <fmt/format.h>

#include "devices/qmove/compiler.hpp"

// Blocks of QCL: IF ELSE ENDIF, WHILE ENDWHILE, FOR NEXT, SUB ENDSUB; and where JUMP and CALL lead.
namespace drycut::devices::qmove {

namespace {

struct BlockWords {
  std::string_view opens;
  std::string_view closes;
};
// By the kind of the block; an ELSE goes on with its IF.
constexpr std::array<BlockWords, 5> block_words{
    {{"IF", "ENDIF"}, {"IF", "ENDIF"}, {"WHILE", "ENDWHILE"}, {"FOR", "NEXT"}, {"SUB", "ENDSUB"}}};

template <typename Kind>
constexpr const BlockWords& words_of(Kind kind) {
  return block_words[static_cast<std::size_t>(kind)];
}

}  // namespace

// IF e and WHILE e.
void QclCompiler::open_condition(Block::Kind kind) {
  const Place place = take().place;
  const int begin = here();
  condition();
  insert_barriers(begin);
  blocks_.push_back({kind, place, place, emit(QclOp::jump_if_zero), begin});
}

void QclCompiler::else_block() {
  const Place place = take().place;
  if (!blocks_.empty() && blocks_.back().kind == Block::Kind::else_) {
    complain("qcl.twice"_code, place, "a second ELSE in one IF",
             fmt::format("the IF of line {} has its ELSE in line {}", blocks_.back().place.line,
                         blocks_.back().here.line));
    return;
  }
  const std::optional<Block> block = close("ELSE", Block::Kind::if_, Block::Kind::if_);
  if (!block) return;
  const int exit = emit(QclOp::jump);
  aim(block->exit);
  blocks_.push_back({Block::Kind::else_, block->place, place, exit, 0});
}

// ENDIF, ENDWHILE, NEXT and ENDSUB.
void QclCompiler::close_block(Block::Kind kind) {
  const bool is_if = kind == Block::Kind::if_;
  const std::optional<Block> block = close(words_of(kind).closes, kind, is_if ? Block::Kind::else_ : kind);
  take();
  if (!block) return;
  if (kind == Block::Kind::while_ || kind == Block::Kind::for_) emit(QclOp::jump, block->again);
  if (kind == Block::Kind::sub) emit(QclOp::back);
  aim(block->exit);
}

// FOR (i = first, condition, i = next) or FOR (i = first, condition, step). In the code the step stands
// before the body and is jumped over at the start.
void QclCompiler::for_block() {
  static const std::string form = "write: FOR (i = 1, i LE 10, 1)";
  const Place place = take().place;
  // The block is opened whatever its header is like, so that its NEXT is not a fault too.
  Block block{Block::Kind::for_, place, place, -1, here()};
  const NamedThing* variable = nullptr;
  const auto before = told();
  if (expect("(", form)) {
    if (peek().kind != QclToken::Kind::name)
      syntax_error("qcl.syntax"_code, peek(), "FOR begins with an assignment, found " + found(peek()), form);
    else
      variable = assignment();
  }
  const bool sound = told() == before;
  if (!line_failed_ && expect(",", form)) {
    const int test = here();
    condition();
    insert_barriers(test);
    block.exit = emit(QclOp::jump_if_zero);
    const int body = emit(QclOp::jump);
    block.again = here();
    mark(here());
    if (!line_failed_ && expect(",", form)) for_step(variable, sound, form);
    if (!line_failed_) expect(")", form);
    emit(QclOp::jump, test);
    aim(body);
  }
  blocks_.push_back(block);
}

void QclCompiler::for_step(const NamedThing* variable, bool sound, const std::string& form) {
  stack_ = 0;
  const bool assigns = peek().kind == QclToken::Kind::name &&
                       std::any_of(tokens_.begin() + static_cast<std::ptrdiff_t>(at_), tokens_.end(),
                                   [](const QclToken& token) { return token.is("="); });
  if (assigns) {
    assignment();
    return;
  }
  const bool counts = variable && variable->kind == NamedThing::Kind::scalar;
  if (!counts && !sound) {
    expression();
    return;
  }
  if (!counts)
    return syntax_error("qcl.syntax"_code, peek(),
                        "a step without assignment needs a plain variable to count", form);
  const int begin = here();
  emit(QclOp::load, variable->index);
  const Type type = expression();
  const bool real = variable->size == Size::S || type == Type::real;
  if (real && variable->size != Size::S) emit(QclOp::to_real_below);
  if (real && type != Type::real) emit(QclOp::to_real);
  emit(real ? QclOp::add_real : QclOp::add);
  store(*variable, real ? Type::real : Type::integer);
  insert_barriers(begin);
}

void QclCompiler::sub_block() {
  const Place place = peek().place;
  const QclToken* name = name_operand("SUB <name>");
  const bool nested = std::any_of(blocks_.begin(), blocks_.end(),
                                  [](const Block& block) { return block.kind == Block::Kind::sub; });
  if (nested) complain("qcl.block"_code, place, "SUB inside a SUB", "close the first with ENDSUB");
  // Statements that come to a SUB pass it by; only CALL enters.
  blocks_.push_back({Block::Kind::sub, place, place, emit(QclOp::jump), 0});
  if (!name) return;
  define(subs_, "subroutine", *name);
}

// Takes the innermost open block of one of two kinds off the stack. Blocks inside it that are still open are
// faults of theirs.
std::optional<QclCompiler::Block> QclCompiler::close(std::string_view closing, Block::Kind kind,
                                                     Block::Kind other) {
  const auto found = std::find_if(blocks_.rbegin(), blocks_.rend(), [&](const Block& block) {
    return block.kind == kind || block.kind == other;
  });
  if (found == blocks_.rend()) {
    const std::string_view first = words_of(kind).opens;
    complain("qcl.block"_code, tokens_.front().place, fmt::format("{} without {}", closing, first),
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

void QclCompiler::unclosed(const Block& block) {
  const auto& [opens, closes] = words_of(block.kind);
  complain("qcl.block"_code, block.place, fmt::format("{} without {}", opens, closes),
           fmt::format("write {} at the end of its block", closes));
}

// Lets the jump at `code` lead here.
void QclCompiler::aim(int code) {
  if (code >= 0) program_.code[static_cast<std::size_t>(code)].a = here();
}

// The `what` called `name` stands here.
void QclCompiler::define(Targets& targets, std::string_view what, const QclToken& name) {
  const auto [target, is_new] = targets.places.emplace(lower(name.text), Target{here(), name.place});
  if (is_new)
    targets.names.emplace_back(name.text);
  else
    complain("qcl.twice"_code, name.place, fmt::format("the {} {} stands twice", what, in_quotes(name.text)),
             fmt::format("the first is in line {}; rename one", target->second.place.line));
}

// JUMP and CALL, whose targets may stand below them.
void QclCompiler::refer(Targets& targets, QclOp op, const std::string& form) {
  if (const QclToken* name = name_operand(form))
    targets.uses.push_back({emit(op), std::string(name->text), name->place});
}

// `remedy` has {} where the name stands.
void QclCompiler::resolve(const Targets& targets, std::string_view what, std::string_view remedy) {
  for (const Reference& use : targets.uses) {
    const auto found = targets.places.find(lower(use.name));
    if (found == targets.places.end())
      complain("qcl.unknown-name"_code, use.place, fmt::format("unknown {} {}", what, in_quotes(use.name)),
               suggestion(use.name, targets.names, fmt::format(fmt::runtime(remedy), use.name)));
    else
      program_.code[static_cast<std::size_t>(use.code)].a = found->second.code;
  }
}

}  // namespace drycut::devices::qmove
