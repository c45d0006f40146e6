#include "devices/plcopen/st/machine.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/operations.hpp"
#include "devices/text.hpp"

namespace drycut::devices::plcopen::st {

Machine::Machine(const Compiled& code, MotionKernel& kernel) : code_(code), kernel_(kernel) {}

void Machine::start(bool all) {
  std::vector<Cell> fresh = code_.image;
  if (!all && memory_.size() == fresh.size())
    for (const Range& kept : code_.retain)
      std::copy(memory_.begin() + kept.low, memory_.begin() + kept.high + 1, fresh.begin() + kept.low);
  memory_ = std::move(fresh);
  for (std::size_t i = 0; i < code_.external_cells.size(); ++i)
    at(code_.external_cells[i]) = kernel_.find_axis(code_.externals[i].name).number;
  motions_.clear();
  for (const Compiled::Motion& place : code_.motions) {
    Motion motion;
    motion.type = place.type;
    motion.block = place.type->motion->make();
    for (std::size_t pin = 0; pin < place.type->members.size(); ++pin)
      motion.pins.push_back(motion.block->pin(pin));
    at(place.cell) = static_cast<Cell>(motions_.size());
    motions_.push_back(std::move(motion));
  }
}

void Machine::run(std::int64_t time_ms) {
  time_ms_ = wrapped(Basic::time, time_ms);
  statements_ = 0;
  if (code_.program < 0) return;
  const Pou& program = code_.pous[static_cast<std::size_t>(code_.program)];
  reset(program, program.frame);
  execute(program.body);
}

void Machine::reset(const Pou& pou, std::int64_t frame) {
  for (const Range& cells : pou.resets)
    std::copy(pou.type->initial.begin() + cells.low, pou.type->initial.begin() + cells.high + 1,
              memory_.begin() + frame + cells.low);
}

std::string_view Machine::text(std::int64_t place, std::size_t most) const {
  const char* const begin = reinterpret_cast<const char*>(memory_.data() + place);
  most = std::min(most, (memory_.size() - static_cast<std::size_t>(place)) * sizeof(Cell));
  return {begin, strnlen(begin, most)};
}

std::int64_t Machine::element(const Node& n) {
  const Span& span = code_.spans[static_cast<std::size_t>(n.c)];
  const Cell index = value(n.b);
  if (index < span.low || index > span.high)
    throw RuntimeError(n, fmt::format("the index {} is out of bounds; {} to {}", index, span.low, span.high));
  return value(n.a) + (index - span.low) * span.cells + n.imm;
}

Cell Machine::operation(const Node& n) {
  const Cell a = value(n.a);
  const Cell b = n.b >= 0 ? value(n.b) : 0;
  if (const auto none = no_result(n.op, n.basic, a, b))
    throw RuntimeError(n, none->what + "; " + none->remedy);
  return apply(n.op, n.basic, a, b);
}

Cell Machine::multiplex(const Node& n) {
  const Cell which = value(n.a);
  if (which < 0 || which >= n.c)
    throw RuntimeError(n, fmt::format("MUX has no value {}; 0 to {}", which, n.c - 1));
  return value(code_.lists[static_cast<std::size_t>(n.b + which)]);
}

Cell Machine::call_function(const Node& n) {
  struct Input {
    Cell value = 0;
    int place = 0;
    int cells = 0;
  };
  constexpr std::size_t few = 8;
  std::array<Input, few> fewer;
  std::vector<Input> more;
  const int* list = code_.lists.data() + n.a;
  const auto inputs = static_cast<std::size_t>(*list++);
  if (inputs > few) more.resize(inputs);
  Input* const given = inputs > few ? more.data() : fewer.data();
  // An input may call the same function: all are computed before the frame is used.
  for (std::size_t i = 0; i < inputs; ++i, list += 3) given[i] = {value(list[0]), list[1], list[2]};
  const Pou& pou = code_.pous[static_cast<std::size_t>(n.c)];
  reset(pou, pou.frame);
  for (std::size_t i = 0; i < inputs; ++i) {
    if (given[i].cells == 1)
      at(given[i].place) = given[i].value;
    else if (given[i].cells > 1)
      copy_string(given[i].value, given[i].place, static_cast<std::size_t>(given[i].cells) - 2);
    else
      std::copy_n(memory_.begin() + given[i].value, -given[i].cells, memory_.begin() + given[i].place);
  }
  const std::int64_t caller = own_;
  execute(pou.body);
  own_ = caller;
  const Cell result = at(pou.frame + pou.result);
  const int outputs = *list++;
  for (int i = 0; i < outputs; ++i) execute(list[i]);
  return result;
}

Cell Machine::value(int number) {
  const Node& n = node(number);
  switch (n.op) {
    case Op::constant:
      return n.imm;
    case Op::load:
      return at(n.imm);
    case Op::load_own:
      return at(own_ + n.imm);
    case Op::load_at:
      return at(value(n.a));
    case Op::address:
      return n.imm;
    case Op::address_own:
      return own_ + n.imm;
    case Op::follow:
      return at(value(n.a)) + n.imm;
    case Op::element:
      return element(n);
    case Op::call_function:
      return call_function(n);
    case Op::and_then:
      return value(n.a) != 0 ? value(n.b) : 0;
    case Op::or_else:
      return value(n.a) != 0 ? 1 : value(n.b);
    case Op::select: {
      const Cell on = value(n.b);
      const Cell off = value(n.c);
      return value(n.a) != 0 ? on : off;
    }
    case Op::multiplex:
      return multiplex(n);
    case Op::compare_strings: {
      constexpr std::size_t longest = 256;
      const int order = text(value(n.a), longest).compare(text(value(n.b), longest));
      return order < 0 ? -1 : order > 0 ? 1 : 0;
    }
    case Op::time_now:
      return time_ms_;
    case Op::passes: {
      const Cell step = value(n.c);
      return step >= 0 ? value(n.a) <= value(n.b) : value(n.a) >= value(n.b);
    }
    default:
      return operation(n);
  }
}

void Machine::count(const Node& n) {
  if (++statements_ > most_statements)
    throw RuntimeError(
        n, fmt::format("more than {} statements in one scan; a loop does not end", most_statements));
}

Machine::Flow Machine::execute(int number) {
  const Node& n = node(number);
  if (n.op == Op::sequence) return sequence(n);
  count(n);
  switch (n.op) {
    case Op::store:
      at(n.imm) = value(n.a);
      return Flow::next;
    case Op::store_own:
      at(own_ + n.imm) = value(n.a);
      return Flow::next;
    case Op::store_at: {
      const Cell stored = value(n.b);
      at(value(n.a)) = stored;
      return Flow::next;
    }
    case Op::copy: {
      const std::int64_t from = value(n.b);
      std::memmove(&at(value(n.a)), &at(from), static_cast<std::size_t>(n.imm) * sizeof(Cell));
      return Flow::next;
    }
    case Op::copy_string:
      copy_string(value(n.b), value(n.a), static_cast<std::size_t>(n.imm));
      return Flow::next;
    case Op::evaluate:
      value(n.a);
      return Flow::next;
    case Op::call_block:
      call_block(n);
      return Flow::next;
    case Op::branch:
      return branch(n);
    case Op::choose:
      return choose(n);
    case Op::loop:
      return loop(n);
    case Op::repeat:
      return repeat(n);
    case Op::leave_loop:
      return Flow::leave_loop;
    case Op::next_turn:
      return Flow::next_turn;
    case Op::leave_pou:
      return Flow::leave_pou;
    default:
      return Flow::next;
  }
}

Machine::Flow Machine::sequence(const Node& n) {
  for (int i = n.a; i < n.a + n.b; ++i)
    if (const Flow flow = execute(code_.lists[static_cast<std::size_t>(i)]); flow != Flow::next) return flow;
  return Flow::next;
}

Machine::Flow Machine::branch(const Node& n) {
  for (int i = 0; i < n.b; ++i) {
    const auto pair = static_cast<std::size_t>(n.a + 2 * i);
    if (value(code_.lists[pair]) != 0) return execute(code_.lists[pair + 1]);
  }
  return n.c >= 0 ? execute(n.c) : Flow::next;
}

Machine::Flow Machine::choose(const Node& n) {
  const Cell selector = value(n.a);
  for (int i = n.b; i < n.b + n.c; ++i) {
    const Choice& choice = code_.choices[static_cast<std::size_t>(i)];
    if (selector >= choice.range.low && selector <= choice.range.high) return execute(choice.body);
  }
  return n.imm >= 0 ? execute(static_cast<int>(n.imm)) : Flow::next;
}

Machine::Flow Machine::loop(const Node& n) {
  while (value(n.a) != 0) {
    count(n);
    const Flow flow = execute(n.b);
    if (flow == Flow::leave_loop) break;
    if (flow == Flow::leave_pou) return flow;
    if (n.c >= 0) execute(n.c);
  }
  return Flow::next;
}

Machine::Flow Machine::repeat(const Node& n) {
  do {
    count(n);
    const Flow flow = execute(n.a);
    if (flow == Flow::leave_loop) break;
    if (flow == Flow::leave_pou) return flow;
  } while (value(n.b) == 0);
  return Flow::next;
}

void Machine::copy_string(std::int64_t from, std::int64_t to, std::size_t length) {
  if (from == to) return;
  const std::string_view source = text(from, length);
  std::fill_n(memory_.begin() + to, string_cells(length), 0);
  std::memcpy(&at(to), source.data(), source.size());
}

void Machine::call_block(const Node& n) {
  const std::int64_t instance = value(n.a);
  if (n.b < 0) {
    call_motion(instance);
    return;
  }
  const Pou& pou = code_.pous[static_cast<std::size_t>(n.b)];
  reset(pou, instance);
  const std::int64_t caller = own_;
  own_ = instance;
  execute(pou.body);
  own_ = caller;
}

void Machine::call_motion(std::int64_t instance) {
  Motion& motion = motions_[static_cast<std::size_t>(at(instance))];
  for (std::size_t i = 0; i < motion.pins.size(); ++i) {
    const Variable& pin = motion.type->members[i];
    if (pin.section == Section::output) continue;
    const std::int64_t place = instance + pin.offset;
    std::visit(
        [&](auto* target) {
          using T = std::remove_cvref_t<decltype(*target)>;
          if constexpr (std::is_same_v<T, AxisRef>) {
            target->number = static_cast<int>(at(place));
          } else if constexpr (std::is_same_v<T, CamRef>) {
            target->file = text(place, default_string_length);
            target->id = static_cast<std::uint16_t>(at(place + string_cells(default_string_length)));
          } else if constexpr (std::is_same_v<T, double>) {
            *target = real_of(at(place));
          } else {
            *target = static_cast<T>(at(place));
          }
        },
        motion.pins[i]);
  }
  motion.block->call(kernel_);
  for (std::size_t i = 0; i < motion.pins.size(); ++i) {
    const Variable& pin = motion.type->members[i];
    if (pin.section != Section::output) continue;
    Cell& place = at(instance + pin.offset);
    std::visit(
        [&](const auto* source) {
          using T = std::remove_cvref_t<decltype(*source)>;
          if constexpr (std::is_same_v<T, double>)
            place = cell_of(*source);
          else if constexpr (std::is_arithmetic_v<T>)
            place = static_cast<Cell>(*source);
        },
        motion.pins[i]);
  }
}

}  // namespace drycut::devices::plcopen::st
