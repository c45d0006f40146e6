#include "devices/qmove/machine.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <type_traits>

#include "base/state_archive.hpp"
#include "devices/coverage.hpp"

namespace drycut::devices::qmove {

namespace {

std::int32_t wrapping(std::int64_t value) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
}
float real(std::int32_t bits) { return std::bit_cast<float>(bits); }
std::int32_t bits(float value) { return std::bit_cast<std::int32_t>(value); }

// Truncates as a long holds it; what no long can hold saturates, not-a-number is 0.
std::int32_t to_long(float value) {
  constexpr float beyond = 2147483648.0F;
  if (std::isnan(value)) return 0;
  if (value >= beyond) return INT32_MAX;
  if (value < -beyond) return INT32_MIN;
  return static_cast<std::int32_t>(value);
}

// Memory holds longs and the bits of singles as they are; flags, bytes and words wrap.
std::int32_t wrapped(std::int32_t size, std::int32_t value) { return wrap(static_cast<Size>(size), value); }

bool within(std::int32_t index, std::int32_t count) { return index >= 1 && index <= count; }

}  // namespace

std::string_view name_of(RunTimeError error) {
  switch (error) {
    case RunTimeError::none:
      return "none";
    case RunTimeError::index_out_of_bound:
      return "index out of bound";
    case RunTimeError::recipe_out_of_range:
      return "datagroup recipe out of range";
    case RunTimeError::step_out_of_range:
      return "datagroup step out of range";
    case RunTimeError::division_by_zero:
      return "division by zero";
    case RunTimeError::watchdog:
      return "watchdog, the task loops without WAIT";
    case RunTimeError::stack:
      return "stack, CALL nested too deep or ENDSUB without CALL";
    case RunTimeError::assertion:
      return "a test has failed";
  }
  return "";
}

namespace {

// One switch over all instructions: the room's hottest loop, kept in one piece for speed. `timed`: statements
// are counted down. `counting`: what runs is counted.
template <bool timed, bool counting>
RunTimeError run(const QclProgram& program, Task& task, QclMachine& machine, std::int64_t& statements,
                 Counts* counts) {
  std::array<std::int32_t, max_depth + 2> stack{};  // the compiler has checked that no expression needs more
  std::int32_t* top = stack.data();                 // the value on top
  const Instruction* const code = program.code.data();
  int at = task.at;
  int left = timed && task.in_turn ? task.left : max_work;
  task.in_turn = false;
  const auto fail = [&](RunTimeError error) {
    task.at = at;
    return error;
  };
  const auto suspend = [&](int where) {
    task.at = where;
    task.turned = machine.now;
    return RunTimeError::none;
  };
  const auto post = [&](int device) {
    machine.post(static_cast<std::size_t>(device));
    task.last_post[static_cast<std::size_t>(device)] = machine.posts;
  };
  // Operators of two operands. In 64 bits the quotient of the most negative long by -1 fits too.
  const auto integers = [&](auto compute) {
    --top;
    *top = wrapping(compute(std::int64_t{*top}, std::int64_t{top[1]}));
  };
  const auto reals = [&](auto compute) {
    --top;
    const auto result = compute(real(*top), real(top[1]));
    if constexpr (std::is_same_v<decltype(result), const bool>)
      *top = result;
    else
      *top = bits(result);
  };
  const auto keep = [&](std::int32_t size, std::int32_t value) {
    const auto kept = wrapped(size, value);
    if (kept != value && static_cast<Size>(size) != Size::F) [[unlikely]]
      machine.cut = {at, value, kept};
    return kept;
  };
  for (;; ++at) {
    if constexpr (timed) {
      if (program.begins[static_cast<std::size_t>(at)]) {
        if (statements == 0) {
          task.at = at;
          task.left = left;
          task.in_turn = true;
          return RunTimeError::none;
        }
        --statements;
      }
    }
    if (--left < 0) return fail(RunTimeError::watchdog);
    if constexpr (counting) ++counts->passed[static_cast<std::size_t>(at)];
    const Instruction& now = code[at];
    switch (now.op) {
      case QclOp::push:
        *++top = now.a;
        break;
      case QclOp::load:
        *++top = machine.cells[now.a];
        break;
      case QclOp::load_at:
        *top = machine.cells[*top];
        break;
      case QclOp::index:
      case QclOp::index_recipe:
        if (!within(*top, now.b))
          return fail(now.op == QclOp::index ? RunTimeError::index_out_of_bound
                                             : RunTimeError::recipe_out_of_range);
        *top += now.a - 1;
        break;
      case QclOp::index_step: {
        const NamedThing& variable = program.steps[now.a];
        const std::int32_t step = *top--;
        if (!within(*top, variable.length)) return fail(RunTimeError::recipe_out_of_range);
        if (!within(step, variable.steps)) return fail(RunTimeError::step_out_of_range);
        *top = variable.index + (*top - 1) * variable.steps + step - 1;
        break;
      }
      case QclOp::load_device:
        *++top = machine.devices[now.b]->read(program.symbols[now.a]);
        break;
      case QclOp::load_input:
        *++top = machine.inputs[now.a]->level ? 1 : 0;
        break;
      case QclOp::load_output:
        *++top = machine.outputs[now.a]->level ? 1 : 0;
        break;
      case QclOp::load_timer:
        *++top = machine.now >= machine.timers[now.a] ? 1 : 0;
        break;

      case QclOp::store:
        machine.cells[now.a] = keep(now.b, *top--);
        break;
      case QclOp::store_at:
        machine.cells[top[-1]] = keep(now.b, *top);
        top -= 2;
        break;
      case QclOp::store_device:
        if ((left -= device_work) < 0) return fail(RunTimeError::watchdog);
        post(now.b);
        machine.devices[now.b]->write(program.symbols[now.a], *top--);
        break;
      case QclOp::store_output:
        machine.outputs[now.a]->level = *top-- != 0;
        break;
      case QclOp::store_timer: {
        constexpr std::int64_t ns_per_ms = 1'000'000;
        machine.timers[now.a] = machine.now + std::max(*top--, 0) * ns_per_ms;
        break;
      }

      case QclOp::add:
        integers(std::plus{});
        break;
      case QclOp::subtract:
        integers(std::minus{});
        break;
      case QclOp::multiply:
        integers(std::multiplies{});
        break;
      case QclOp::divide:
        if (*top == 0) return fail(RunTimeError::division_by_zero);
        integers(std::divides{});
        break;
      case QclOp::modulo:
        if (*top == 0) return fail(RunTimeError::division_by_zero);
        integers(std::modulus{});
        break;
      case QclOp::negate:
        *top = wrapping(-std::int64_t{*top});
        break;
      case QclOp::add_real:
        reals(std::plus{});
        break;
      case QclOp::subtract_real:
        reals(std::minus{});
        break;
      case QclOp::multiply_real:
        reals(std::multiplies{});
        break;
      case QclOp::divide_real:
        if (real(*top) == 0.0F) return fail(RunTimeError::division_by_zero);
        reals(std::divides{});
        break;
      case QclOp::negate_real:
        *top = bits(-real(*top));
        break;
      case QclOp::to_real:
        *top = bits(static_cast<float>(*top));
        break;
      case QclOp::to_real_below:
        top[-1] = bits(static_cast<float>(top[-1]));
        break;
      case QclOp::to_long:
        *top = to_long(real(*top));
        break;
      case QclOp::to_flag_real:
        *top = real(*top) != 0.0F ? 1 : 0;
        break;
      case QclOp::to_flag_real_below:
        top[-1] = real(top[-1]) != 0.0F ? 1 : 0;
        break;

      case QclOp::equal:
        integers(std::equal_to{});
        break;
      case QclOp::not_equal:
        integers(std::not_equal_to{});
        break;
      case QclOp::less:
        integers(std::less{});
        break;
      case QclOp::less_equal:
        integers(std::less_equal{});
        break;
      case QclOp::greater:
        integers(std::greater{});
        break;
      case QclOp::greater_equal:
        integers(std::greater_equal{});
        break;
      case QclOp::equal_real:
        reals(std::equal_to{});
        break;
      case QclOp::not_equal_real:
        reals(std::not_equal_to{});
        break;
      case QclOp::less_real:
        reals(std::less{});
        break;
      case QclOp::less_equal_real:
        reals(std::less_equal{});
        break;
      case QclOp::greater_real:
        reals(std::greater{});
        break;
      case QclOp::greater_equal_real:
        reals(std::greater_equal{});
        break;

      case QclOp::logic_and:
        integers(std::logical_and{});
        break;
      case QclOp::logic_or:
        integers(std::logical_or{});
        break;
      case QclOp::logic_not:
        *top = *top == 0 ? 1 : 0;
        break;
      case QclOp::bit_and:
        integers(std::bit_and{});
        break;
      case QclOp::bit_or:
        integers(std::bit_or{});
        break;
      case QclOp::bit_xor:
        integers(std::bit_xor{});
        break;
      case QclOp::bit_not:
        *top = ~*top;
        break;

      case QclOp::barrier: {
        if (task.wait == Task::Wait::none) task.reached = machine.posts;
        const std::uint64_t oldest = machine.oldest_post[now.b];
        if (!machine.devices[now.b]->settled() && oldest <= task.reached) {
          if (task.wait != Task::Wait::own)
            task.wait = task.last_post[now.b] >= oldest ? Task::Wait::own : Task::Wait::others;
          if constexpr (counting) --counts->passed[static_cast<std::size_t>(at)];  // it comes here again
          task.at = at;
          return RunTimeError::none;
        }
        if (now.a != 0) task.wait = Task::Wait::none;
        break;
      }
      case QclOp::jump:
        at = now.a - 1;
        break;
      case QclOp::jump_if_zero:
        if (*top-- == 0) {
          if constexpr (counting) ++counts->refused[static_cast<std::size_t>(at)];
          at = now.a - 1;
        }
        break;
      case QclOp::command:
        if ((left -= device_work) < 0) return fail(RunTimeError::watchdog);
        post(now.b);
        machine.devices[now.b]->command(now.a, program.name);
        break;
      case QclOp::yield:
        return suspend(at + 1);
      case QclOp::wait_until:
        if (*top-- == 0) {
          if constexpr (counting) ++counts->refused[static_cast<std::size_t>(at)];
          if (task.waits_at != now.a) task.waits_since = machine.now;
          task.waits_at = now.a;
          return suspend(now.a);
        }
        task.waits_at = -1;
        break;
      case QclOp::call:
        if (task.calls.size() >= max_calls) return fail(RunTimeError::stack);
        task.calls.push_back(at);
        at = now.a - 1;
        break;
      case QclOp::back:
        if (task.calls.empty()) return fail(RunTimeError::stack);
        at = task.calls.back();
        task.calls.pop_back();
        break;
      case QclOp::end:
        task.ended = true;
        task.waits_at = at;
        task.waits_since = machine.now;
        return suspend(at);
      case QclOp::assertion:
        if (*top-- == 0) return fail(RunTimeError::assertion);
        break;
    }
  }
}

}  // namespace

RunTimeError run_turn(const QclProgram& program, Task& task, QclMachine& machine, Counts* counts) {
  std::int64_t uncounted = 0;
  return counts == nullptr ? run<false, false>(program, task, machine, uncounted, nullptr)
                           : run<false, true>(program, task, machine, uncounted, counts);
}

RunTimeError run_statements(const QclProgram& program, Task& task, QclMachine& machine,
                            std::int64_t& statements, Counts* counts) {
  return counts == nullptr ? run<true, false>(program, task, machine, statements, nullptr)
                           : run<true, true>(program, task, machine, statements, counts);
}

void Task::visit(StateArchive& archive) {
  std::vector<int> told_cuts(cuts.begin(), cuts.end());
  STATE(archive, at, ended, calls, wait, reached, last_post, turned, told_cuts, told, in_turn, left, waits_at,
        waits_since);
  if (archive.restores()) cuts = {told_cuts.begin(), told_cuts.end()};
}

}  // namespace drycut::devices::qmove
