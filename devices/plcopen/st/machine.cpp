#include "devices/plcopen/st/machine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "base/state_archive.hpp"
#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/code.hpp"
#include "devices/plcopen/st/references.hpp"

namespace drycut::devices::plcopen::st {

Machine::Machine(const Compiled& code, MotionKernel& kernel) : code_(code), kernel_(kernel) {}

void Machine::start(bool all) {
  std::vector<Cell> fresh = code_.image;
  if (!all && memory_.size() == fresh.size())
    for (const Subrange& kept : code_.retain)
      std::copy(memory_.begin() + kept.low, memory_.begin() + kept.high + 1, fresh.begin() + kept.low);
  memory_ = std::move(fresh);
  for (std::size_t i = 0; i < code_.external_cells.size(); ++i)
    at(code_.external_cells[i]) = kernel_.find_axis(code_.externals[i].name).number;
  active_.clear();
  losses_.clear();
  told_.clear();
  motions_.clear();
  for (const Compiled::Motion& place : code_.motions) {
    Motion motion;
    motion.type = place.type;
    motion.block = place.type->motion->make();
    for (std::size_t pin = 0; pin < place.type->members.size(); ++pin)
      motion.pins.push_back(place.type->motion->pin(*motion.block, pin));
    at(place.cell) = static_cast<Cell>(motions_.size());
    motions_.push_back(std::move(motion));
  }
}

void Machine::run(const Compiled::Instance& program, std::int64_t time_ms) {
  time_ms_ = wrapped(Basic::time, time_ms);
  work_ = most_work;
  const Pou& pou = code_.pous[static_cast<std::size_t>(program.pou)];
  reset(pou, program.cell);
  if (program.before >= 0) execute(program.before);
  own_ = program.cell;
  execute(pou.body);
  if (program.after >= 0) execute(program.after);
}

void Machine::exhausted(const Node& n) {
  throw StError(n, fmt::format("more than {} operations in one scan; a loop does not end, or there is more "
                               "to do than a scan can hold",
                               most_work));
}

void Machine::reset(const Pou& pou, std::int64_t frame) {
  for (const Subrange& cells : pou.resets)
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
    throw StError(n, fmt::format("the index {} is out of bounds; {} to {}", index, span.low, span.high));
  return value(n.a) + (index - span.low) * span.cells + n.imm;
}

std::int64_t Machine::dereference(const Node& n) {
  const Reference reference = reference_of(value(n.a));
  if (reference.referent < 0) throw StError(n, "the reference is NULL; test it before: p <> NULL");
  const Referent& wanted = code_.referents[static_cast<std::size_t>(n.c)];
  const bool known = reference.referent < static_cast<std::int64_t>(code_.referents.size());
  if (!known || reference.bytes != 0 ||
      !same_type(*code_.referents[static_cast<std::size_t>(reference.referent)].type, *wanted.type))
    throw StError(n, fmt::format("the reference is of no {}; REF(variable of that type)", wanted.type->name));
  return reference.place + n.imm;
}

std::pair<const Referent*, Cell*> Machine::seen_by(const Node& n, Cell reference, std::int64_t& bytes) {
  const Reference at = reference_of(reference);
  if (at.referent < 0) throw StError(n, "the reference is NULL; test it before: p <> NULL");
  const auto outside = [&] {
    return StError(n, "the reference is outside of what it is of; see how many bytes it was moved by");
  };
  if (at.referent >= static_cast<std::int64_t>(code_.referents.size())) throw outside();
  const Referent& of = code_.referents[static_cast<std::size_t>(at.referent)];
  const int size = bytes_of(of.basic);
  const std::int64_t last = at.bytes + bytes_of(n.basic) - 1;
  const std::int64_t all =
      of.basic == Basic::string ? std::int64_t{of.cells} * 8 - 1 : std::int64_t{of.cells} * size;
  const std::int64_t per_cell = of.basic == Basic::string ? 8 : size;
  if (last >= all) throw outside();
  // Numbers may have been made references: only cells of plain data are touched.
  for (const std::int64_t byte : {at.bytes, last}) {
    const auto cell = static_cast<std::size_t>(at.place + byte / per_cell);
    if (cell >= code_.kinds.size() || code_.kinds[cell] != of.basic) throw outside();
  }
  bytes = at.bytes;
  return {&of, &memory_[static_cast<std::size_t>(at.place)]};
}

Cell Machine::operation(const Node& n) {
  const Cell a = value(n.a);
  const Cell b = n.b >= 0 ? value(n.b) : 0;
  if (const auto none = no_result(n.op, n.basic, a, b)) throw StError(n, none->what + "; " + none->remedy);
  const Cell result = apply(n.op, n.basic, a, b);
  // Real numbers overflow, conversions leave their type; whole numbers wrap.
  if (is_real(n.basic) ? !std::isfinite(real_of(result))
                       : n.op == StOp::to_whole || n.op == StOp::truncate || n.op == StOp::wrap)
    look_at(n, a, result);
  return result;
}

void Machine::look_at(const Node& n, Cell before, Cell result) {
  const std::string& type = type_of(n.basic)->name;
  if (is_real(n.basic)) {
    if (std::isnan(real_of(result)))
      tell_loss(n, "the result is no number; test the values before");
    else
      tell_loss(n, fmt::format("a {} overflows; it goes to {}", type,
                               n.basic == Basic::real ? "3.4e38" : "1.8e308"));
    return;
  }
  // BYTE to LWORD and the parts of numbers take the lower bits by intention.
  const bool number = is_integer(n.basic) && n.basic <= Basic::ulint;
  if (n.op == StOp::wrap) {
    if (number && result != before)
      tell_loss(n, fmt::format("{} does not fit in {}, which makes {} of it", before, type, result));
    return;
  }
  constexpr double two_to_64 = 18446744073709551616.0;
  const double value = n.op == StOp::truncate ? std::trunc(real_of(before)) : std::nearbyint(real_of(before));
  const Subrange range = range_of(n.basic);
  const double high = is_wide(n.basic) ? two_to_64 : static_cast<double>(range.high);
  if (value >= static_cast<double>(range.low) && (is_wide(n.basic) ? value < high : value <= high)) return;
  tell_loss(n, fmt::format("{} does not fit in {}, which makes {} of it", real_of(before), type,
                           is_wide(n.basic) ? fmt::format("{}", static_cast<std::uint64_t>(result))
                                            : fmt::format("{}", result)));
}

void Machine::tell_loss(const Node& n, std::string text) {
  if (told_.insert(static_cast<int>(&n - code_.nodes.data())).second)
    losses_.push_back({n.line, n.column, std::move(text)});
}

Cell Machine::multiplex(const Node& n) {
  const Cell which = value(n.a);
  if (which < 0 || which >= n.c)
    throw StError(n, fmt::format("MUX has no value {}; 0 to {}", which, n.c - 1));
  return value(code_.lists[static_cast<std::size_t>(n.b + which)]);
}

Cell Machine::call_function(const Node& n) { return call_framed(n, code_.lists.data() + n.a, n.c, own_); }

Cell Machine::call_method(const Node& n) {
  const int* const list = code_.lists.data() + n.a;
  const std::int64_t instance = value(list[0]);
  int number = n.c;
  if (list[1] >= 0)
    if (const auto actual = code_.methods.find({at(instance), list[1]}); actual != code_.methods.end())
      number = actual->second;
  active_.resize(code_.pous.size());
  const auto pou = static_cast<std::size_t>(number);
  if (active_[pou]) throw StError(n, fmt::format("{} calls itself; use a loop", code_.pous[pou].type->name));
  active_[pou] = true;
  const Cell result = call_framed(n, list + 2, number, instance);
  active_[pou] = false;
  return result;
}

/// The arguments are for POU n.c. Where another one runs that overrides it, that has the same pins at the
/// same places.
Cell Machine::call_framed(const Node& n, const int* list, int number, std::int64_t own) {
  struct Input {
    Cell value = 0;
    int place = 0;
    int cells = 0;
  };
  constexpr std::size_t few = 8;
  std::array<Input, few> fewer;
  std::vector<Input> more;
  const auto inputs = static_cast<std::size_t>(*list++);
  if (inputs > few) more.resize(inputs);
  Input* const given = inputs > few ? more.data() : fewer.data();
  // An input may call the same function: all are computed before the frame is used.
  for (std::size_t i = 0; i < inputs; ++i, list += 3) given[i] = {value(list[0]), list[1], list[2]};
  const Pou& pou = code_.pous[static_cast<std::size_t>(number)];
  const Pou& named = code_.pous[static_cast<std::size_t>(n.c)];
  const int shift = pou.frame - named.frame;
  spend(n, pou.type->cells / 8);
  reset(pou, pou.frame);
  for (std::size_t i = 0; shift != 0 && i < inputs; ++i) given[i].place += shift;
  for (std::size_t i = 0; i < inputs; ++i) {
    if (given[i].cells == 1)
      at(given[i].place) = given[i].value;
    else if (given[i].cells > 1)
      copy_string(given[i].value, given[i].place, static_cast<std::size_t>(given[i].cells) - 2);
    else
      std::copy_n(memory_.begin() + given[i].value, -given[i].cells, memory_.begin() + given[i].place);
  }
  const std::int64_t caller = own_;
  own_ = own;
  execute(pou.body);
  own_ = caller;
  if (shift != 0)
    std::copy_n(memory_.begin() + pou.frame, std::min(pou.type->cells, named.type->cells),
                memory_.begin() + named.frame);
  const std::int64_t from = pou.frame + pou.result;
  Cell result = at(from);
  if (n.b >= 0) {
    result = value(n.b);
    std::copy_n(memory_.begin() + from, n.imm, memory_.begin() + result);
  }
  const int outputs = *list++;
  for (int i = 0; i < outputs; ++i) execute(list[i]);
  return result;
}

Cell Machine::enabled(const Node& n) {
  const int* const list = code_.lists.data() + n.a;
  const bool on = value(list[0]) != 0;
  const Cell result = value(list[on ? 1 : 2]);
  const int store = list[on ? 3 : 4];
  if (store >= 0) execute(store);
  return result;
}

Cell Machine::in_range(const Node& n) {
  const Span& span = code_.spans[static_cast<std::size_t>(n.c)];
  const Cell a = value(n.a);
  if (a >= span.low && a <= span.high) return a;
  throw StError(n, fmt::format("{} is out of the range; {} to {}", a, span.low, span.high));
}

Cell Machine::passes(const Node& n) {
  const Cell step = value(n.c);
  const Cell a = value(n.a);
  const Cell b = value(n.b);
  if (is_wide(n.basic)) return static_cast<std::uint64_t>(a) <= static_cast<std::uint64_t>(b) ? 1 : 0;
  return (step >= 0 ? a <= b : a >= b) ? 1 : 0;
}

Cell Machine::compare(const Node& n) {
  const std::string_view a = text(value(n.a), longest_bytes());
  const std::string_view b = text(value(n.b), longest_bytes());
  charge(static_cast<std::int64_t>(std::min(a.size(), b.size()) / 8));
  const int order = a.compare(b);
  return order < 0 ? -1 : order > 0 ? 1 : 0;
}

Cell Machine::text_value(const Node& n) {
  const auto op = static_cast<TextOp>(n.imm);
  const int* list = code_.lists.data() + n.a;
  const int* const end = list + n.b;
  const Cell target = op < TextOp::length ? value(*list++) : 0;
  if (op == TextOp::from_value) {
    put_string(text_of(n.basic, value(*list)), target, longest_bytes());
    return target;
  }
  const std::size_t texts = texts_of(op, static_cast<std::size_t>(end - list));
  // A part may be computed where another one has been: each has a place of its own.
  std::vector<std::string_view> parts;
  std::vector<Cell> numbers;
  std::size_t size = 0;
  for (std::size_t i = 0; list != end; ++i, ++list) {
    const Cell given = value(*list);
    if (i >= texts) {
      numbers.push_back(given);
    } else {
      parts.push_back(text(given, longest_bytes()));
      size += parts.back().size();
    }
  }
  // FIND looks at each place.
  charge(static_cast<std::int64_t>(op == TextOp::find ? 8 + size : 8 + size / 8));
  const bool wide = n.c > 0;
  if (op == TextOp::length) return static_cast<Cell>(characters(parts[0], wide));
  if (op == TextOp::find) {
    const Cell at = found(parts[0], parts[1]);
    return at == 0 || !wide
               ? at
               : static_cast<Cell>(characters(parts[0].substr(0, static_cast<std::size_t>(at)), true));
  }
  if (wide) numbers = in_bytes(op, parts[0], numbers);
  if (op == TextOp::to_value) return value_of(n.basic, parts[0]);
  put_string(edited(op, parts, numbers), target, longest_bytes());
  return target;
}

Cell Machine::value(int number) {
  const Node& n = node(number);
  charge(1);
  switch (n.op) {
    case StOp::constant:
      return n.imm;
    case StOp::load:
      return at(n.imm);
    case StOp::load_own:
      return at(own_ + n.imm);
    case StOp::load_at:
      return at(value(n.a));
    case StOp::address:
      return n.imm;
    case StOp::address_own:
      return own_ + n.imm;
    case StOp::follow:
      return at(value(n.a)) + n.imm;
    case StOp::element:
      return element(n);
    case StOp::call_method:
      return call_method(n);
    case StOp::instance: {
      const Cell place = value(n.a);
      if (place == 0) throw StError(n, "the interface stands for nothing; assign an instance to it before");
      return place - 1;
    }
    case StOp::dereference:
      return dereference(n);
    case StOp::make_reference:
      return cell_of_reference(n.c, value(n.a));
    case StOp::load_by: {
      std::int64_t bytes = 0;
      const auto [of, cells] = seen_by(n, value(n.a), bytes);
      return seen_as(n.basic, bytes, of->basic, cells);
    }
    case StOp::call_function:
      return call_function(n);
    case StOp::and_then:
      return value(n.a) != 0 ? value(n.b) : 0;
    case StOp::or_else:
      return value(n.a) != 0 ? 1 : value(n.b);
    case StOp::select: {
      const Cell on = value(n.b);
      const Cell off = value(n.c);
      return value(n.a) != 0 ? on : off;
    }
    case StOp::multiplex:
      return multiplex(n);
    case StOp::compare_strings:
      return compare(n);
    case StOp::text:
      return text_value(n);
    case StOp::enabled:
      return enabled(n);
    case StOp::in_range:
      return in_range(n);
    case StOp::time_now:
      return time_ms_;
    case StOp::passes:
      return passes(n);
    default:
      return operation(n);
  }
}

/// A line keeps the best that came of it in a scan.
void Machine::note(int number, char mark) {
  if (static_cast<std::size_t>(number) >= code_.user_nodes) return;
  const auto line = static_cast<std::size_t>(node(number).line) - 1;
  if (line < trace_->lines.size() && trace_->lines[line] != '+') trace_->lines[line] = mark;
}

/// One statement more; what a standard block does counts as its call.
void Machine::note_turn(int number) {
  constexpr std::size_t most_kept = 100'000;
  auto* const order = trace_->order;
  if (order == nullptr || order->size() >= most_kept) return;
  const bool of_text = static_cast<std::size_t>(number) < code_.user_nodes;
  order->push_back(of_text ? node(number).line : order->empty() ? 0 : order->back());
}

Machine::Flow Machine::execute(int number) {
  const Node& n = node(number);
  if (n.op == StOp::sequence) return sequence(n);
  spend(n, 1);
  ++statements_;
  if (trace_ != nullptr) {
    if (n.op != StOp::branch) note(number, '+');
    note_turn(number);
  }
  switch (n.op) {
    case StOp::store:
      at(n.imm) = value(n.a);
      return Flow::next;
    case StOp::store_own:
      at(own_ + n.imm) = value(n.a);
      return Flow::next;
    case StOp::store_at: {
      const Cell stored = value(n.b);
      at(value(n.a)) = stored;
      return Flow::next;
    }
    case StOp::store_by: {
      const Cell stored = value(n.b);
      std::int64_t bytes = 0;
      const auto [of, cells] = seen_by(n, value(n.a), bytes);
      put_as(n.basic, stored, bytes, of->basic, cells);
      return Flow::next;
    }
    case StOp::store_bits:
      store_bits(n);
      return Flow::next;
    case StOp::copy: {
      const std::int64_t from = value(n.b);
      spend(n, n.imm / 8);
      std::memmove(&at(value(n.a)), &at(from), static_cast<std::size_t>(n.imm) * sizeof(Cell));
      return Flow::next;
    }
    case StOp::copy_string:
      if (const std::string_view whole = whole_text(value(n.b));
          n.c < 0 ? whole.size() > static_cast<std::size_t>(n.imm)
                  : characters(whole, true) > static_cast<std::size_t>(n.c))
        tell_loss(n, fmt::format("a text of {} characters is cut off at {}", characters(whole, n.c >= 0),
                                 n.c < 0 ? n.imm : n.c));
      if (n.c >= 0)
        put_string(first_characters(text(value(n.b), static_cast<std::size_t>(n.imm)),
                                    static_cast<std::size_t>(n.c)),
                   value(n.a), static_cast<std::size_t>(n.imm));
      else
        copy_string(value(n.b), value(n.a), static_cast<std::size_t>(n.imm));
      return Flow::next;
    case StOp::evaluate:
      value(n.a);
      return Flow::next;
    case StOp::call_block:
      call_block(n);
      return Flow::next;
    case StOp::branch:
      return branch(n);
    case StOp::choose:
      return choose(n);
    case StOp::loop:
      return loop(n, number);
    case StOp::repeat:
      return repeat(n, number);
    case StOp::leave_loop:
      return Flow::leave_loop;
    case StOp::next_turn:
      return Flow::next_turn;
    case StOp::leave_pou:
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
    const bool holds = value(code_.lists[pair]) != 0;
    if (trace_ != nullptr) note(code_.lists[pair], holds ? '+' : '-');
    if (holds) return execute(code_.lists[pair + 1]);
  }
  return n.c >= 0 ? execute(n.c) : Flow::next;
}

Machine::Flow Machine::choose(const Node& n) {
  const Cell selector = value(n.a);
  spend(n, n.c / 8);
  for (int i = n.b; i < n.b + n.c; ++i) {
    const Choice& choice = code_.choices[static_cast<std::size_t>(i)];
    if (selector >= choice.range.low && selector <= choice.range.high) return execute(choice.body);
  }
  return n.imm >= 0 ? execute(static_cast<int>(n.imm)) : Flow::next;
}

Machine::Flow Machine::loop(const Node& n, int number) {
  while (value(n.a) != 0) {
    spend(n, 1);
    ++statements_;
    if (trace_ != nullptr) note_turn(number);
    const Flow flow = execute(n.b);
    if (flow == Flow::leave_loop) break;
    if (flow == Flow::leave_pou) return flow;
    if (n.c >= 0) execute(n.c);
  }
  return Flow::next;
}

Machine::Flow Machine::repeat(const Node& n, int number) {
  do {
    spend(n, 1);
    ++statements_;
    if (trace_ != nullptr) note_turn(number);
    const Flow flow = execute(n.a);
    if (flow == Flow::leave_loop) break;
    if (flow == Flow::leave_pou) return flow;
  } while (value(n.b) == 0);
  return Flow::next;
}

void Machine::store_bits(const Node& n) {
  const auto part = static_cast<std::uint64_t>(value(n.b));
  Cell& whole = at(value(n.a));
  const std::uint64_t mask = ((std::uint64_t{1} << n.c) - 1) << n.imm;
  const std::uint64_t rest = static_cast<std::uint64_t>(whole) & ~mask;
  whole = wrapped(n.basic, static_cast<Cell>(rest | ((part << n.imm) & mask)));
}

void Machine::copy_string(std::int64_t from, std::int64_t to, std::size_t length) {
  if (from != to) put_string(text(from, length), to, length);
}

/// As much of the text as fits; it may stand where it goes to.
void Machine::put_string(std::string_view text, std::int64_t to, std::size_t length) {
  const std::size_t size = std::min(text.size(), length);
  char* const begin = reinterpret_cast<char*>(&at(to));
  std::memmove(begin, text.data(), size);
  std::memset(begin + size, 0, static_cast<std::size_t>(string_cells(length)) * sizeof(Cell) - size);
}

void Machine::call_block(const Node& n) {
  const std::int64_t instance = value(n.a);
  if (n.b < 0) {
    constexpr std::int64_t work_of_a_motion_block = 50;
    spend(n, work_of_a_motion_block);
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

const FunctionBlock* Machine::motion_at(int place) const {
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const Compiled::Motion& motion = code_.motions[i];
    if (place >= motion.cell && place < motion.cell + motion.type->cells) return motions_[i].block.get();
  }
  return nullptr;
}

void Machine::call_motion(std::int64_t instance) {
  Motion& motion = motions_[static_cast<std::size_t>(at(instance))];
  for (std::size_t i = 0; i < motion.pins.size(); ++i) {
    const Variable& pin = motion.type->members[i];
    if (pin.section == VarClass::output) continue;
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
    if (pin.section != VarClass::output) continue;
    if (const auto cell = cell_of_pin(motion.pins[i])) at(instance + pin.offset) = *cell;
  }
}

void Machine::Motion::visit(StateArchive& archive) {
  // Inputs are given before each call, and no output is a CamRef.
  for (std::size_t i = 0; i < pins.size(); ++i)
    if (const Variable& pin = type->members[i]; pin.section == VarClass::output)
      std::visit(
          [&](auto* value) {
            if constexpr (!std::is_same_v<decltype(value), CamRef*>) archive.named(pin.name, *value);
          },
          pins[i]);
  block->visit(archive);
}

void Machine::visit(StateArchive& archive) {
  std::vector<int> told(told_.begin(), told_.end());
  archive("memory, told", memory_, told);
  told_ = {told.begin(), told.end()};
  if (memory_.size() != code_.image.size()) throw BadState("the memory of another program");
  for (std::size_t i = 0; i < motions_.size(); ++i)
    archive.named(fmt::format("{}_{}", motions_[i].type->name, i), motions_[i]);
}

}  // namespace drycut::devices::plcopen::st
