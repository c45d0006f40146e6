#include <algorithm>
#include <initializer_list>
#include <map>
#include <utility>

#include "devices/plcopen/st/nodes.hpp"

// The instructions of a program, made of its tree. What an operand can name, a variable or a constant, needs
// no instruction of its own; a comparison that decides a condition jumps by itself.
namespace drycut::devices::plcopen::st {
namespace {

bool compares(StOp op) { return op >= StOp::equal && op <= StOp::greater_equal_real; }

class InstructionMaker {
 public:
  InstructionMaker(const Nodes& nodes, Compiled& code) : nodes_(nodes), code_(code) {}

  /// False if they are too many.
  bool make() try {
    for (Pou& pou : code_.pous) pou.body = body(pou.body);
    for (Compiled::Instance& instance : code_.instances) {
      if (instance.before >= 0) instance.before = body(instance.before);
      if (instance.after >= 0) instance.after = body(instance.after);
    }
    return true;
  } catch (const TooMany&) {
    return false;
  }

 private:
  /// Jumps whose end is not known yet.
  using Jumps = std::vector<int>;

  [[nodiscard]] const Node& node(int number) const { return nodes_.node(number); }
  [[nodiscard]] int here() const { return static_cast<int>(code_.code.size()); }
  void lead(const Jumps& jumps, int to) {
    for (const int jump : jumps) code_.code[static_cast<std::size_t>(jump)].d = to;
  }

  struct TooMany {};
  int emit(StOp op, int number, StOperand a = {}, StOperand b = {}, StOperand c = {}, int d = 0) {
    // A node may stand in several places, and those in others.
    if (code_.code.size() >= most_instructions) throw TooMany{};
    const Node& of = node(number);
    const auto standard = [&](int one) { return static_cast<std::size_t>(one) >= nodes_.of_text; };
    Origin origin{number, of.line, of.column};
    origin.standard = standard(number);
    origin.right_side = of.right_side;
    if (statement_ >= 0) {
      const Node& begun = node(statement_);
      origin.statement = standard(statement_) ? 0 : begun.line;
      origin.shown = op != StOp::turn && begun.op != StOp::branch;
    }
    code_.code.push_back({op, of.basic, std::exchange(statement_, -1) >= 0, d, a, b, c});
    code_.origins.push_back(origin);
    return here() - 1;
  }

  static StOperand operand(Base base, std::int64_t cells) {
    return {static_cast<std::uint32_t>(cells), base};
  }
  static StOperand raw(std::int64_t number) { return operand(Base::memory, number); }

  StOperand temporary() {
    code_.temporaries = std::max(code_.temporaries, ++temporaries_);
    return operand(Base::temporary, static_cast<std::int64_t>(temporaries_ - 1));
  }

  StOperand constant(Cell value) {
    const auto [known, fresh] = constants_.emplace(value, static_cast<int>(code_.constants.size()));
    if (fresh) code_.constants.push_back(value);
    return operand(Base::constant, known->second);
  }

  /// Whether computing it may change variables.
  bool acts(int number) {
    signed char& known = acts_[static_cast<std::size_t>(number)];
    if (known < 0) known = computes_by_acts(number) ? 1 : 0;
    return known > 0;
  }
  bool computes_by_acts(int number) {
    const Node& n = node(number);
    const auto any = [&](const std::vector<int>& parts) {
      return std::any_of(parts.begin(), parts.end(), [&](int part) { return part >= 0 && acts(part); });
    };
    switch (n.op) {
      case StOp::call_function:
      case StOp::call_method:
      case StOp::enabled:
      case StOp::assertion:
        return true;
      case StOp::constant:
      case StOp::load:
      case StOp::load_own:
      case StOp::address:
      case StOp::address_own:
      case StOp::time_now:
        return false;
      case StOp::text:
        return any(listed(n.a, n.b));
      case StOp::multiplex:
        return acts(n.a) || any(listed(n.b, n.c));
      case StOp::select:
      case StOp::passes:
      case StOp::index:
        return any({n.a, n.b, n.c});
      default:
        return any({n.a, n.b});
    }
  }
  [[nodiscard]] std::vector<int> listed(int first, int count) const {
    const auto begin = nodes_.lists.begin() + first;
    return {begin, begin + count};
  }

  /// Where the value is, once it is computed; of a variable that is itself.
  StOperand value(int number) {
    const Node& n = node(number);
    if (n.op == StOp::constant || n.op == StOp::address) return constant(n.imm);
    if (n.op == StOp::load) return operand(Base::memory, n.imm);
    if (n.op == StOp::load_own) return operand(Base::own, n.imm);
    const StOperand to = temporary();
    into(number, to);
    return to;
  }

  /// The same, which stays what it is while all of `later` are computed.
  StOperand value(int number, std::initializer_list<int> later) {
    const StOperand of = value(number);
    const bool variable = of.base == Base::memory || of.base == Base::own;
    if (!variable || std::none_of(later.begin(), later.end(), [&](int one) { return acts(one); })) return of;
    const StOperand kept = temporary();
    emit(StOp::move, number, kept, of);
    return kept;
  }

  /// The cell at the address that a node gives.
  StOperand cell_at(int number) {
    const Node& n = node(number);
    if (n.op == StOp::address) return operand(Base::memory, n.imm);
    if (n.op == StOp::address_own) return operand(Base::own, n.imm);
    const StOperand to = temporary();
    fetch(number, number, to);
    return to;
  }

  void fetch(int number, int address, StOperand to) {
    const Node& n = node(address);
    if (n.op == StOp::follow)
      emit(StOp::fetch, number, to, cell_at(n.a), {}, static_cast<int>(n.imm));
    else
      emit(StOp::fetch, number, to, value(address));
  }

  /// Computes the value and puts it there.
  void into(int number, StOperand to) {
    const std::size_t kept = temporaries_;
    const bool parts = puts_in_parts(node(number));
    const StOperand at = parts && to.base != Base::temporary ? temporary() : to;
    compute(number, at);
    if (!(at == to)) emit(StOp::move, number, to, at);
    temporaries_ = kept;
  }
  /// Before all is computed: what is a variable is still needed then, or stored after its outputs.
  static bool puts_in_parts(const Node& n) {
    return n.op == StOp::and_then || n.op == StOp::or_else || n.op == StOp::enabled ||
           n.op == StOp::call_function || n.op == StOp::call_method;
  }

  void compute(int number, StOperand to) {
    const Node& n = node(number);
    switch (n.op) {
      case StOp::constant:
      case StOp::address:
      case StOp::load:
      case StOp::load_own:
        emit(StOp::move, number, to, value(number));
        return;
      case StOp::address_own:
        emit(StOp::place, number, to, operand(Base::own, n.imm));
        return;
      case StOp::load_at:
        return fetch(number, n.a, to);
      case StOp::follow:
        emit(StOp::follow, number, to, cell_at(n.a), {}, static_cast<int>(n.imm));
        return;
      case StOp::element:
        return element(number, to);
      case StOp::dereference:
        emit(n.op, number, to, value(n.a), raw(n.c), static_cast<int>(n.imm));
        return;
      case StOp::make_reference:
        emit(n.op, number, to, value(n.a), {}, n.c);
        return;
      case StOp::in_range:
        emit(n.op, number, to, value(n.a), {}, span(n.c, 0));
        return;
      case StOp::time_now:
        emit(n.op, number, to);
        return;
      case StOp::select: {
        const StOperand on = value(n.b, {n.c, n.a});
        const StOperand off = value(n.c, {n.a});
        emit(n.op, number, to, on, off, packed(value(n.a)));
        return;
      }
      case StOp::index: {
        const StOperand index = value(n.a, {n.b, n.c});
        const StOperand low = value(n.b, {n.c});
        emit(n.op, number, to, index, low, packed(value(n.c)));
        return;
      }
      case StOp::passes: {
        const StOperand step = value(n.c, {n.a, n.b});
        const StOperand now = value(n.a, {n.b});
        emit(n.op, number, to, now, value(n.b), packed(step));
        return;
      }
      case StOp::and_then:
      case StOp::or_else: {
        into(n.a, to);
        const int over = emit(n.op == StOp::and_then ? StOp::jump_unless : StOp::jump_if, number, to);
        into(n.b, to);
        return lead({over}, here());
      }
      case StOp::multiplex:
        return multiplex(number, to);
      case StOp::enabled:
        return enabled(number, to);
      case StOp::text:
        return text(number, to);
      case StOp::assertion:
        return assertion(number, to);
      case StOp::call_function:
      case StOp::call_method:
        return call(number, to);
      default: {
        const bool two = n.b >= 0;
        const StOperand a = two ? value(n.a, {n.b}) : value(n.a);
        emit(n.op, number, to, a, two ? value(n.b) : StOperand{});
      }
    }
  }

  int span(int number, std::int64_t behind) {
    Span of = nodes_.spans[static_cast<std::size_t>(number)];
    of.behind = behind;
    code_.spans.push_back(of);
    return static_cast<int>(code_.spans.size()) - 1;
  }

  /// The index is looked at before the array, which may be an element itself.
  void element(int number, StOperand to) {
    const Node& n = node(number);
    const StOperand index = value(n.b, {n.a});
    const Node& array = node(n.a);
    if (array.op == StOp::address) {
      emit(n.op, number, to, constant(0), index, span(n.c, array.imm + n.imm));
      return;
    }
    const StOperand behind = temporary();
    emit(n.op, number, behind, constant(0), index, span(n.c, n.imm));
    emit(StOp::add, number, to, value(n.a), behind);
    code_.code.back().basic = Basic::lint;
  }

  void multiplex(int number, StOperand to) {
    const Node& n = node(number);
    const StOperand which = value(n.a);
    const auto list = code_.lists.size();
    code_.lists.resize(list + static_cast<std::size_t>(n.c));
    emit(n.op, number, which, {}, raw(n.c), static_cast<int>(list));
    Jumps over;
    for (int i = 0; i < n.c; ++i) {
      code_.lists[list + static_cast<std::size_t>(i)] = here();
      into(nodes_.lists[static_cast<std::size_t>(n.b + i)], to);
      if (i + 1 < n.c) over.push_back(emit(StOp::jump, number));
    }
    lead(over, here());
  }

  void enabled(int number, StOperand to) {
    const std::vector<int> list = listed(node(number).a, 5);
    if (list[1] == list[2]) {  // only ENO is asked for
      into(list[1], to);
      if (list[3] >= 0) statement(list[3]);
      return;
    }
    const int off = emit(StOp::jump_unless, number, value(list[0]));
    into(list[1], to);
    if (list[3] >= 0) statement(list[3]);
    const int over = emit(StOp::jump, number);
    lead({off}, here());
    into(list[2], to);
    if (list[4] >= 0) statement(list[4]);
    lead({over}, here());
  }

  void text(int number, StOperand to) {
    const Node& n = node(number);
    std::vector<int> list{n.b, n.c > 0 ? 1 : 0};
    const std::vector<int> parts = listed(n.a, n.b);
    for (std::size_t i = 0; i < parts.size(); ++i)
      list.push_back(packed(kept_for(parts[i], parts, i + 1, 1)));
    emit(n.op, number, to, raw(n.imm), {}, put_list(list));
  }

  void assertion(int number, StOperand to) {
    const Node& n = node(number);
    const std::vector<int> parts = listed(n.a, 4);
    std::vector<int> list;
    for (std::size_t i = 0; i < parts.size(); ++i)
      list.push_back(packed(kept_for(parts[i], parts, i + 1, 1)));
    emit(n.op, number, to, raw(n.imm), {}, put_list(list));
  }

  /// A value that stays while each `step`th of `parts` from `next` on is computed.
  StOperand kept_for(int number, const std::vector<int>& parts, std::size_t next, std::size_t step) {
    for (; next < parts.size(); next += step)
      if (acts(parts[next])) return value(number, {parts[next]});
    return value(number);
  }

  int put_list(const std::vector<int>& list) {
    code_.lists.insert(code_.lists.end(), list.begin(), list.end());
    return static_cast<int>(code_.lists.size() - list.size());
  }

  void call(int number, StOperand to) {
    const Node& n = node(number);
    std::vector<int> list;
    auto from = static_cast<std::size_t>(n.a);
    const bool method = n.op == StOp::call_method;
    const std::size_t first = from + (method ? 2 : 0);
    const auto inputs = static_cast<std::size_t>(nodes_.lists[first]);
    const std::vector<int> triples = listed(static_cast<int>(first) + 1, static_cast<int>(3 * inputs));
    if (method) {
      list.push_back(packed(kept_for(nodes_.lists[from], triples, 0, 3)));
      list.push_back(nodes_.lists[from + 1]);
    }
    list.push_back(n.c);
    list.push_back(static_cast<int>(inputs));
    for (std::size_t i = 0; i < triples.size(); i += 3) {
      list.push_back(packed(kept_for(triples[i], triples, i + 3, 3)));
      list.insert(list.end(), {triples[i + 1], triples[i + 2]});
    }
    const StOperand whole = n.b >= 0 ? value(n.b) : StOperand{};
    emit(n.op, number, to, whole, raw(n.b >= 0 ? n.imm : 0), put_list(list));
    const std::size_t outputs = first + 1 + triples.size();
    for (const int output : listed(static_cast<int>(outputs) + 1, nodes_.lists[outputs])) statement(output);
  }

  /// Whether it is the same, but for time, if it is not computed at all.
  [[nodiscard]] bool may_be_left_out(int number) const {
    const Node& n = node(number);
    if (n.op == StOp::constant || n.op == StOp::load || n.op == StOp::load_own) return true;
    const bool bits = n.op >= StOp::bit_and && n.op <= StOp::bit_not;
    return (bits || compares(n.op)) && may_be_left_out(n.a) && (n.b < 0 || may_be_left_out(n.b));
  }

  /// Goes on where the condition holds; from the jumps where it does not. `shown`: whoever watches sees it.
  Jumps condition(int number, bool shown) {
    const std::size_t kept = temporaries_;
    Jumps jumps;
    part_of_condition(number, jumps);
    temporaries_ = kept;
    const bool of_text = static_cast<std::size_t>(number) < nodes_.of_text;
    if (of_text) ++decisions_;
    for (const int jump : jumps) {
      Origin& origin = code_.origins[static_cast<std::size_t>(jump)];
      origin.line = node(number).line;
      if (of_text) origin.decision = decisions_;
      if (shown && of_text)
        origin.condition = jump == jumps.back() ? Origin::Condition::last : Origin::Condition::part;
    }
    return jumps;
  }

  void part_of_condition(int number, Jumps& jumps) {
    const Node& n = node(number);
    const bool bits = n.basic == Basic::boolean;
    if (n.op == StOp::and_then || (n.op == StOp::bit_and && bits && may_be_left_out(n.b))) {
      part_of_condition(n.a, jumps);
      part_of_condition(n.b, jumps);
    } else if (compares(n.op)) {
      const auto jump = static_cast<StOp>(static_cast<int>(n.op) - static_cast<int>(StOp::equal) +
                                          static_cast<int>(StOp::unless_equal));
      const StOperand a = value(n.a, {n.b});
      jumps.push_back(emit(jump, number, {}, a, value(n.b)));
    } else if (n.op == StOp::passes && node(n.c).op == StOp::constant && !is_wide(n.basic)) {
      const bool up = node(n.c).imm >= 0;
      const StOperand a = value(n.a, {n.b});
      jumps.push_back(
          emit(up ? StOp::unless_less_equal : StOp::unless_greater_equal, number, {}, a, value(n.b)));
    } else if (n.op == StOp::bit_not && bits) {
      jumps.push_back(emit(StOp::jump_if, number, value(n.a)));
    } else {
      jumps.push_back(emit(StOp::jump_unless, number, value(number)));
    }
  }

  void statement(int number) {
    const Node& n = node(number);
    if (n.op == StOp::sequence) {
      for (const int one : listed(n.a, n.b)) statement(one);
      return;
    }
    const std::size_t kept = temporaries_;
    statement_ = number;
    execute(number);
    // What does nothing is a statement too.
    if (statement_ >= 0) emit(StOp::nothing, number);
    temporaries_ = kept;
  }

  void execute(int number) {
    const Node& n = node(number);
    switch (n.op) {
      case StOp::store:
        return into(n.a, operand(Base::memory, n.imm));
      case StOp::store_own:
        return into(n.a, operand(Base::own, n.imm));
      case StOp::store_at:
        return store_at(number);
      case StOp::store_by:
      case StOp::store_bits:
      case StOp::copy:
      case StOp::copy_string: {
        const StOperand stored = value(n.b, {n.a});
        const StOperand to = value(n.a);
        const int c = n.op == StOp::copy_string ? n.c + 1 : n.c;
        emit(n.op, number, to, stored, raw(c), static_cast<int>(n.imm));
        return;
      }
      case StOp::evaluate:
        return into(n.a, temporary());
      case StOp::call_block:
        return call_block(number);
      case StOp::branch:
        return branch(number);
      case StOp::choose:
        return choose(number);
      case StOp::loop:
      case StOp::repeat:
        return loop(number);
      case StOp::leave_loop:
        leaves_->push_back(emit(StOp::jump, number));
        return;
      case StOp::next_turn:
        turns_->push_back(emit(StOp::jump, number));
        return;
      case StOp::leave_pou:
        emit(n.op, number);
        return;
      default:
        return;
    }
  }

  void store_at(int number) {
    const Node& n = node(number);
    const Node& address = node(n.a);
    if (address.op == StOp::address || address.op == StOp::address_own) return into(n.b, cell_at(n.a));
    const StOperand stored = value(n.b, {n.a});
    if (address.op == StOp::follow)
      emit(StOp::put, number, cell_at(address.a), stored, {}, static_cast<int>(address.imm));
    else
      emit(StOp::put, number, value(n.a), stored);
  }

  void call_block(int number) {
    const Node& n = node(number);
    const StOp address = node(n.a).op;
    if (n.b >= 0)
      emit(n.op, number, value(n.a), {}, {}, n.b);
    else if (address == StOp::address || address == StOp::address_own)
      emit(StOp::call_motion, number, cell_at(n.a));
    else
      emit(StOp::call_motion, number, value(n.a), {}, raw(1));
  }

  void branch(int number) {
    const Node& n = node(number);
    const std::vector<int> pairs = listed(n.a, 2 * n.b);
    Jumps over;
    for (std::size_t i = 0; i < pairs.size(); i += 2) {
      const Jumps jumps = condition(pairs[i], true);
      statement(pairs[i + 1]);
      if (i + 2 < pairs.size() || n.c >= 0) over.push_back(emit(StOp::jump, number));
      lead(jumps, here());
    }
    if (n.c >= 0) statement(n.c);
    lead(over, here());
  }

  void choose(int number) {
    const Node& n = node(number);
    const StOperand selector = value(n.a);
    const auto first = nodes_.choices.begin() + n.b;
    const std::size_t begin = code_.choices.size();
    code_.choices.insert(code_.choices.end(), first, first + n.c);
    const int choosing = emit(n.op, number, selector, raw(static_cast<std::int64_t>(begin)), raw(n.c));
    Jumps over;
    // Labels with a body in common stand behind each other.
    int body = -1;
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(n.c); ++i) {
      const bool fresh = std::exchange(body, code_.choices[i].body) != code_.choices[i].body;
      code_.choices[i].body = fresh ? here() : code_.choices[i - 1].body;
      if (!fresh) continue;
      statement(body);
      over.push_back(emit(StOp::jump, number));
    }
    lead({choosing}, here());
    if (n.imm >= 0) statement(static_cast<int>(n.imm));
    lead(over, here());
  }

  void loop(int number) {
    const Node& n = node(number);
    const bool repeats = n.op == StOp::repeat;
    emit(StOp::nothing, number);
    const int begin = here();
    Jumps leaves;
    Jumps turns;
    if (!repeats) leaves = condition(n.a, false);
    statement_ = number;
    emit(StOp::turn, number);
    Jumps* const leaves_outside = std::exchange(leaves_, &leaves);
    Jumps* const turns_outside = std::exchange(turns_, &turns);
    statement(repeats ? n.a : n.b);
    leaves_ = leaves_outside;
    turns_ = turns_outside;
    lead(turns, here());
    if (repeats) {
      lead(condition(n.b, false), begin);
    } else {
      if (n.c >= 0) statement(n.c);
      lead({emit(StOp::jump, number)}, begin);
    }
    lead(leaves, here());
  }

  int body(int number) {
    if (number < 0) return -1;
    const int begin = here();
    statement(number);
    emit(StOp::leave_pou, number);
    return begin;
  }

  const Nodes& nodes_;
  Compiled& code_;
  std::map<Cell, int> constants_;
  std::vector<signed char> acts_ = std::vector<signed char>(nodes_.nodes.size(), -1);  ///< -1: not known yet
  std::size_t temporaries_ = 0;
  int statement_ = -1;       ///< whose first instruction comes next
  int decisions_ = -1;       ///< the last one
  Jumps* leaves_ = nullptr;  ///< EXIT of the loop
  Jumps* turns_ = nullptr;   ///< CONTINUE
};

}  // namespace

bool make_instructions(const Nodes& nodes, Compiled& code) { return InstructionMaker(nodes, code).make(); }

}  // namespace drycut::devices::plcopen::st
