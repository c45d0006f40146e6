#include "devices/plcopen/st/machine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "base/state_archive.hpp"
#include "devices/coverage.hpp"
#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/code.hpp"
#include "devices/plcopen/st/references.hpp"

// The memory and the steps.
namespace drycut::devices::plcopen::st {

Machine::Machine(const Compiled& code, MotionKernel& kernel)
    : code_(code), kernel_(kernel), constants_(code.constants) {}

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

void Machine::run(const Compiled::Instance& program, std::int64_t time_ns) {
  time_ns_ = time_ns;
  work_ = most_work;
  const Pou& pou = code_.pous[static_cast<std::size_t>(program.pou)];
  reset(pou, program.cell);
  if (program.before >= 0) execute(program.before, program.cell);
  execute(pou.body, program.cell);
  if (program.after >= 0) execute(program.after, program.cell);
}

void Machine::fail(const StInstruction& at, const std::string& text) const {
  throw StError(origin(at).line, origin(at).column, text);
}

void Machine::fail_value(const StInstruction& at, const std::string& text) const {
  fail(at,
       origin(at).right_side
           ? text + " (AND and OR take both sides; AND_THEN and OR_ELSE the right one only where it counts)"
           : text);
}

void Machine::exhausted(const StInstruction& at) const {
  fail(at, fmt::format("more than {} operations in one scan; a loop does not end, or there is more "
                       "to do than a scan can hold",
                       most_work));
}

void Machine::reset(const Pou& pou, std::int64_t frame) {
  for (const Subrange& cells : pou.resets)
    std::copy(pou.type->initial.begin() + cells.low, pou.type->initial.begin() + cells.high + 1,
              memory_.begin() + frame + cells.low);
}

/// A line keeps the best that came of it in a scan.
void Machine::note(int line, char mark) {
  const auto number = static_cast<std::size_t>(line) - 1;
  if (number < trace_->lines.size() && trace_->lines[number] != '+') trace_->lines[number] = mark;
}

/// One statement more; what a standard block does counts as its call.
void Machine::note_statement(const Origin& origin) {
  constexpr std::size_t most_kept = 100'000;
  if (origin.shown && origin.statement > 0) note(origin.statement, '+');
  auto* const order = trace_->order;
  if (order == nullptr || order->size() >= most_kept) return;
  order->push_back(origin.statement > 0 ? origin.statement : order->empty() ? 0 : order->back());
}

void Machine::execute(int first, std::int64_t own) {
  if (trace_ == nullptr)
    steps<false>(first, own);
  else
    steps<true>(first, own);
}

template <bool watched>
void Machine::steps(int first, std::int64_t own) {
  constexpr std::size_t few = 32;
  std::array<Cell, few> fewer;  // each is computed before it is read
  std::vector<Cell> more;
  if (code_.temporaries > few) more.resize(code_.temporaries);
  const Bases bases{memory_.data(), memory_.data() + own, more.empty() ? fewer.data() : more.data(),
                    constants_.data()};
  const auto cell = [&](const StOperand& of) -> Cell& { return at(bases, of); };
  const auto real = [&](const StOperand& of) { return real_of(at(bases, of)); };
  const StInstruction* const begin = code_.code.data();
  const StInstruction* next = begin + first;
  while (true) {
    const StInstruction& i = *next++;
    --work_;
    statements_ += static_cast<std::int64_t>(i.statement);
    if constexpr (watched) {
      if (i.statement) note_statement(origin(i));
      if (trace_->counts != nullptr) ++trace_->counts->passed[static_cast<std::size_t>(&i - begin)];
    }
    const auto whole = [&](std::uint64_t result) { cell(i.a) = wrapped(i.basic, static_cast<Cell>(result)); };
    const auto bits = [&](const StOperand& of) { return static_cast<std::uint64_t>(cell(of)); };
    const auto truth = [&](bool holds) { cell(i.a) = holds ? 1 : 0; };
    const auto number = [&](double result) {
      const Cell kept = cell_of(rounded(i.basic, result));
      cell(i.a) = kept;
      if (!std::isfinite(real_of(kept))) look_at(i, 0, kept);
    };
    /// Jumps where a condition does not hold.
    const auto unless = [&](bool holds) {
      if constexpr (watched) {
        const Origin& of = origin(i);
        if (of.condition == Origin::Condition::last || (of.condition == Origin::Condition::part && !holds))
          note(of.line, holds ? '+' : '-');
        if (!holds && trace_->counts != nullptr)
          ++trace_->counts->refused[static_cast<std::size_t>(&i - begin)];
      }
      if (!holds) next = begin + i.d;
    };
    if (i.op > last_op) __builtin_unreachable();  // so that the switch need not ask
    switch (i.op) {
      case StOp::move:
        cell(i.a) = cell(i.b);
        break;
      case StOp::place:
        cell(i.a) = place_of(cell(i.b));
        break;
      case StOp::fetch:
        cell(i.a) = at(cell(i.b) + i.d);
        break;
      case StOp::put:
        at(cell(i.a) + i.d) = cell(i.b);
        break;
      case StOp::follow:
        cell(i.a) = cell(i.b) + i.d;
        break;
      case StOp::element:
        cell(i.a) = element(i, cell(i.b), cell(i.c));
        break;
      case StOp::dereference:
        cell(i.a) = dereference(i, cell(i.b));
        break;
      case StOp::make_reference:
        cell(i.a) = cell_of_reference(i.d, cell(i.b));
        break;
      case StOp::load_by: {
        std::int64_t bytes = 0;
        const auto [of, cells] = seen_by(i, cell(i.b), bytes);
        cell(i.a) = seen_as(i.basic, bytes, of->basic, cells);
        break;
      }
      case StOp::store_by: {
        std::int64_t bytes = 0;
        const auto [of, cells] = seen_by(i, cell(i.a), bytes);
        put_as(i.basic, cell(i.b), bytes, of->basic, cells);
        break;
      }
      case StOp::instance:
        if (cell(i.b) == 0) fail(i, "the interface stands for nothing; assign an instance to it before");
        cell(i.a) = cell(i.b) - 1;
        break;

      case StOp::add:
        whole(bits(i.b) + bits(i.c));
        break;
      case StOp::subtract:
        whole(bits(i.b) - bits(i.c));
        break;
      case StOp::multiply:
        whole(bits(i.b) * bits(i.c));
        break;
      case StOp::add_real:
        number(real(i.b) + real(i.c));
        break;
      case StOp::subtract_real:
        number(real(i.b) - real(i.c));
        break;
      case StOp::multiply_real:
        number(real(i.b) * real(i.c));
        break;
      case StOp::divide_real:
        if (real(i.c) == 0) operation(i, cell(i.b), cell(i.c));  // refuses it
        number(real(i.b) / real(i.c));
        break;
      case StOp::negate_real:
        number(-real(i.b));
        break;
      case StOp::absolute_real:
        number(std::abs(real(i.b)));
        break;
      case StOp::to_real:
        number(static_cast<double>(cell(i.b)));
        break;
      case StOp::bit_and:
        cell(i.a) = cell(i.b) & cell(i.c);
        break;
      case StOp::bit_or:
        cell(i.a) = cell(i.b) | cell(i.c);
        break;
      case StOp::bit_not:
        whole(~bits(i.b));
        break;
      case StOp::equal:
        truth(cell(i.b) == cell(i.c));
        break;
      case StOp::not_equal:
        truth(cell(i.b) != cell(i.c));
        break;
      case StOp::less:
        truth(cell(i.b) < cell(i.c));
        break;
      case StOp::less_equal:
        truth(cell(i.b) <= cell(i.c));
        break;
      case StOp::greater:
        truth(cell(i.b) > cell(i.c));
        break;
      case StOp::greater_equal:
        truth(cell(i.b) >= cell(i.c));
        break;
      case StOp::less_real:
        truth(real(i.b) < real(i.c));
        break;
      case StOp::less_equal_real:
        truth(real(i.b) <= real(i.c));
        break;
      case StOp::greater_real:
        truth(real(i.b) > real(i.c));
        break;
      case StOp::greater_equal_real:
        truth(real(i.b) >= real(i.c));
        break;

      case StOp::select:
        cell(i.a) = cell(cell(unpacked(i.d)) != 0 ? i.b : i.c);
        break;
      case StOp::passes: {
        const Cell a = cell(i.b);
        const Cell b = cell(i.c);
        if (is_wide(i.basic))
          truth(static_cast<std::uint64_t>(a) <= static_cast<std::uint64_t>(b));
        else
          truth(cell(unpacked(i.d)) >= 0 ? a <= b : a >= b);
        break;
      }
      case StOp::index:
        cell(i.a) = index(i, cell(i.b), cell(i.c), cell(unpacked(i.d)));
        break;
      case StOp::in_range:
        cell(i.a) = in_range(i, cell(i.b));
        break;
      case StOp::time_now:
        cell(i.a) = i.basic == Basic::ltime ? time_ns_ : wrapped(i.basic, time_ns_ / 1'000'000);
        break;
      case StOp::compare_strings:
        cell(i.a) = compare(cell(i.b), cell(i.c));
        break;
      case StOp::text:
        cell(i.a) = text_value(i, bases);
        break;
      case StOp::assertion:
        cell(i.a) = assertion(i, bases);
        break;

      case StOp::store_bits:
        store_bits(i, at(cell(i.a)), cell(i.b));
        break;
      case StOp::copy:
        spend(i, i.d / 8);
        std::memmove(&at(cell(i.a)), &at(cell(i.b)), static_cast<std::size_t>(i.d) * sizeof(Cell));
        break;
      case StOp::copy_string:
        store_text(i, cell(i.a), cell(i.b));
        break;

      case StOp::call_function:
        cell(i.a) = call_function(i, bases);
        break;
      case StOp::call_method:
        cell(i.a) = call_method(i, bases);
        break;
      case StOp::call_block:
        call_block(i, cell(i.a));
        break;
      case StOp::call_motion:
        call_motion(i, i.c.cells != 0 ? &at(cell(i.a)) : &cell(i.a));
        break;

      case StOp::turn:
        spend(i, 0);
        break;
      case StOp::jump:
        next = begin + i.d;
        break;
      case StOp::jump_if:
        unless(cell(i.a) == 0);
        break;
      case StOp::jump_unless:
        unless(cell(i.a) != 0);
        break;
      case StOp::unless_equal:
        unless(cell(i.b) == cell(i.c));
        break;
      case StOp::unless_not_equal:
        unless(cell(i.b) != cell(i.c));
        break;
      case StOp::unless_less:
        unless(cell(i.b) < cell(i.c));
        break;
      case StOp::unless_less_equal:
        unless(cell(i.b) <= cell(i.c));
        break;
      case StOp::unless_greater:
        unless(cell(i.b) > cell(i.c));
        break;
      case StOp::unless_greater_equal:
        unless(cell(i.b) >= cell(i.c));
        break;
      case StOp::unless_equal_real:
        unless(real(i.b) == real(i.c));
        break;
      case StOp::unless_not_equal_real:
        unless(real(i.b) != real(i.c));
        break;
      case StOp::unless_less_real:
        unless(real(i.b) < real(i.c));
        break;
      case StOp::unless_less_equal_real:
        unless(real(i.b) <= real(i.c));
        break;
      case StOp::unless_greater_real:
        unless(real(i.b) > real(i.c));
        break;
      case StOp::unless_greater_equal_real:
        unless(real(i.b) >= real(i.c));
        break;
      case StOp::choose: {
        charge(i.c.cells / 8);
        const Cell selector = cell(i.a);
        const Choice* const first_choice = code_.choices.data() + i.b.cells;
        const Choice* const end = first_choice + i.c.cells;
        const Choice* const chosen = std::find_if(first_choice, end, [&](const Choice& choice) {
          return selector >= choice.range.low && selector <= choice.range.high;
        });
        next = begin + (chosen == end ? i.d : chosen->body);
        break;
      }
      case StOp::multiplex: {
        const Cell which = cell(i.a);
        if (which < 0 || which >= static_cast<Cell>(i.c.cells))
          fail(i, fmt::format("MUX has no value {}; 0 to {}", which, i.c.cells - 1));
        next = begin + code_.lists[static_cast<std::size_t>(i.d + which)];
        break;
      }
      case StOp::leave_pou:
        return;
      case StOp::nothing:
        break;
      default:
        cell(i.a) = operation(i, cell(i.b), cell(i.c));
    }
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
