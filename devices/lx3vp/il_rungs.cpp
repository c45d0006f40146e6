#include "devices/lx3vp/il_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace drycut::devices::lx3vp::il {

namespace {

constexpr int most_blocks = 8;     // FX: LD without ANB or ORB
constexpr int most_branches = 11;  // FX: MPS without MPP

/// Where an instruction may stand in a rung.
enum class RungPlace { opens, contact, joins, branch, output, state, free };

RungPlace place_of(const Step& step) {
  const Op op = step.op();
  if (is_contact(op))
    return step.spelling->mnemonic->join() == Join::begins ? RungPlace::opens : RungPlace::contact;
  switch (op) {
    case Op::inv:
      return RungPlace::contact;
    case Op::anb:
    case Op::orb:
      return RungPlace::joins;
    case Op::mps:
    case Op::mrd:
    case Op::mpp:
      return RungPlace::branch;
    case Op::stl:
      return RungPlace::state;
    case Op::mcr:
    case Op::ret:
    case Op::for_:
    case Op::next:
    case Op::sret:
    case Op::iret:
    case Op::ei:
    case Op::di:
    case Op::label:
    case Op::nop:
    case Op::fend:
    case Op::end:
      return RungPlace::free;
    default:
      return RungPlace::output;
  }
}

}  // namespace

void Rungs::add(Step& step) {
  switch (place_of(step)) {
    case RungPlace::opens:
      open(step);
      break;
    case RungPlace::contact:
      need_contact(step);
      after_output_ = false;
      break;
    case RungPlace::joins:
      if (blocks_ < 2)
        tell("il.rung"_code, step, fmt::format("{} has no two blocks to join", step.spelling->text),
             "begin each block with LD");
      else
        --blocks_;
      after_output_ = false;
      break;
    case RungPlace::branch:
      branch(step);
      break;
    case RungPlace::output:
      need_contact(step);
      need_one_block(step);
      after_output_ = true;
      break;
    case RungPlace::state:
      end_rung(step);
      // A contact that coils and new rungs may follow.
      blocks_ = 1;
      after_output_ = true;
      break;
    case RungPlace::free:
      if (step.op() != Op::nop) end_rung(step);
      break;
  }
}

void Rungs::lose() {
  lost_ = true;
  blocks_ = std::max(blocks_, 1);
}

void Rungs::tell(Code code, const Step& step, std::string what, std::string remedy) {
  if (!lost_) tell_(code, {step.line, step.column}, std::move(what), std::move(remedy));
}

void Rungs::open(Step& step) {
  const bool new_rung = blocks_ == 0 || (after_output_ && branches_ == 0);
  if (new_rung) {
    lost_ = false;
    blocks_ = 1;
  } else {
    step.opens_block = true;
    if (++blocks_ > most_blocks)
      tell("il.rung"_code, step, fmt::format("more than {} blocks wait for ANB or ORB", most_blocks),
           "join blocks as you go");
    if (after_output_)
      tell("il.rung"_code, step, "a branch goes on behind a coil with LD",
           "take it up with MRD or MPP before");
  }
  after_output_ = false;
}

void Rungs::branch(const Step& step) {
  need_contact(step);
  need_one_block(step);
  if (step.op() == Op::mps) {
    if (++branches_ > most_branches)
      tell("il.rung"_code, step, fmt::format("more than {} branches wait for MPP", most_branches),
           "end branches with MPP");
  } else if (branches_ == 0) {
    tell("il.rung"_code, step, fmt::format("{} has no branch to take up", step.spelling->text),
         "keep the result with MPS before");
  } else if (step.op() == Op::mpp) {
    --branches_;
  }
  after_output_ = false;
}

void Rungs::need_contact(const Step& step) {
  if (blocks_ > 0) return;
  tell("il.rung"_code, step, fmt::format("{} has no contact before it", step.spelling->text),
       "begin with LD; LD M8000 is always ON");
  blocks_ = 1;
}

void Rungs::need_one_block(const Step& step) {
  if (blocks_ <= 1) return;
  tell("il.rung"_code, step, fmt::format("{} blocks are not joined at {}", blocks_, step.spelling->text),
       "join them with ANB or ORB");
  blocks_ = 1;
}

void Rungs::end_rung(const Step& step) {
  if (blocks_ > 0 && !after_output_)
    tell("il.rung"_code, step, "the contacts before it lead to no coil",
         "end them with OUT or another instruction");
  if (branches_ > 0)
    tell("il.rung"_code, step, "a branch is not ended", "take it up for the last time with MPP");
  lost_ = false;
  blocks_ = branches_ = 0;
  after_output_ = false;
}

}  // namespace drycut::devices::lx3vp::il
