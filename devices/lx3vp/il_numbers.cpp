// What the operands of an instruction must be that fit each alone: their numbers, what goes together, and
// what the PLC lets a program write.
#include <fmt/format.h>

#include <limits>
#include <utility>

#include "devices/lx3vp/il_operands.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

/// The number of an operand that is one, and not changed by an index register.
std::optional<std::int32_t> constant_of(const Step& step, std::size_t i) {
  const Operand& operand = step.operands[i];
  if (operand.kind != OperandType::constant || operand.index != Operand::no_index) return {};
  return operand.value;
}

bool names_a_bit(const Operand& operand) {
  return std::string_view("XYMS").find(letter_of(operand.kind)) != std::string_view::npos;
}

std::size_t operand_at(char digit) { return static_cast<std::size_t>(digit - '0'); }

std::int32_t most_of(const NumberRange& range, const Step& step) {
  constexpr int exponent_of_a_word = 4;  // 2^4 bits
  if (range.powers && !names_a_bit(step.operands[operand_at(range.counts.front())]))
    return exponent_of_a_word;
  return step.wide() && range.wide_most > 0 ? range.wide_most : range.most;
}

/// How many values an operand stands for, as the constant says that counts them; nullopt if none does.
std::optional<int> counted(const Step& step, std::size_t i) {
  for (const NumberRange& range : step.spelling->mnemonic->ranges) {
    const bool counts = range.counts.find(static_cast<char>('0' + i)) != std::string_view::npos;
    const auto number = counts ? constant_of(step, range.operand) : std::nullopt;
    if (!number) continue;
    if (!range.powers) return *number;
    return names_a_bit(step.operands[i]) ? 1 << *number : 1;
  }
  return {};
}

Misfit misfit_at(std::size_t operand, std::string what, std::string remedy) {
  return {operand, {"il.operand"_code, std::move(what), std::move(remedy)}};
}

std::optional<Misfit> misfit_of_numbers(const Step& step) {
  for (const NumberRange& range : step.spelling->mnemonic->ranges) {
    const auto number = constant_of(step, range.operand);
    if (number && !is_in(range, step, *number))
      return misfit_at(range.operand, fmt::format("{}: {} is {}", step.spelling->text, range.name, *number),
                       remedy_of(range, step));
  }
  return {};
}

std::optional<Misfit> misfit_of_counts(const Step& step) {
  for (std::size_t i = 0; i < step.operands.size(); ++i) {
    const Operand& first = step.operands[i];
    const auto count = counted(step, i);
    if (!count || first.index != Operand::no_index || has_values(first, *count, step.wide())) continue;
    const bool narrow_counter = first.kind == OperandType::C && first.number < first_wide_counter;
    return Misfit{
        i,
        {"il.out-of-range"_code,
         fmt::format("{} takes {} values from {} on", step.spelling->text, *count, to_string(first)),
         narrow_counter ? "the 16-bit counters end at C199" : devices_text(first)}};
  }
  return {};
}

/// One constant must not be above another.
struct NotAbove {
  std::string_view name;
  std::size_t low;
  std::size_t high;
  std::string_view text;  ///< with both numbers
};
constexpr NotAbove orders[] = {
    {"PWM", 0, 1, "S1 is {}, more than the period S2 of {}"},
    {"SMOV", 2, 1, "{} digits from place {} down"},
    {"SMOV", 2, 4, "{} digits to place {} and down"},
    {"SFTL", 3, 2, "{1} bits are shifted by {0}"},
    {"SFTR", 3, 2, "{1} bits are shifted by {0}"},
    {"WSFL", 3, 2, "{1} words are shifted by {0}"},
    {"WSFR", 3, 2, "{1} words are shifted by {0}"},
    {"ZCP", 0, 1, "the zone is from {} to {}"},
    {"HSZ", 0, 1, "the zone is from {} to {}"},
};

std::optional<Misfit> misfit_of_order(const Step& step) {
  for (const NotAbove& order : orders) {
    if (order.name != step.spelling->mnemonic->name) continue;
    const auto low = constant_of(step, order.low);
    const auto high = constant_of(step, order.high);
    if (!low || !high || *low <= *high) continue;
    return misfit_at(
        order.low,
        fmt::format("{}: {}", step.spelling->text, fmt::format(fmt::runtime(order.text), *low, *high)),
        fmt::format("write {} or less", *high));
  }
  return {};
}

bool is_zero(const Operand& operand) {
  if (operand.index != Operand::no_index) return false;
  return operand.kind == OperandType::real ? operand.real == 0
                                           : operand.kind == OperandType::constant && operand.value == 0;
}

std::optional<Misfit> misfit_of_division(const Step& step) {
  const auto name = step.spelling->mnemonic->name;
  if ((name != "DIV" && name != "EDIV") || !is_zero(step.operands[1])) return {};
  return misfit_at(1, fmt::format("{}: division by 0", step.spelling->text), "divide by another number");
}

std::optional<Misfit> misfit_of_digits(const Step& step) {
  const auto number = step.spelling->mnemonic->name == "BIN" ? constant_of(step, 0) : std::nullopt;
  for (auto rest = static_cast<std::uint32_t>(number.value_or(0)); rest > 0; rest >>= 4)
    if ((rest & 0xF) > 9)
      return misfit_at(0, fmt::format("{}: {} is no BCD", step.spelling->text, to_string(step.operands[0])),
                       "write decimal digits: H1984");
  return {};
}

std::optional<Misfit> misfit_of_writing(const Step& step) {
  if (step.op() == Op::zrst) {
    if (step.indexed) return {};
    const int count = step.operands[1].number - step.operands[0].number + 1;
    if (auto fault = read_only(step.operands[0], count, *step.spelling)) return Misfit{0, std::move(*fault)};
    return {};
  }
  for (std::size_t i = 0; i < step.operands.size(); ++i) {
    const Operand& operand = step.operands[i];
    if (!is_written(step.kind(i)) || operand.index != Operand::no_index) continue;
    const auto values = counted(step, i);
    const int count =
        values ? *values * stride_of(operand, step.wide()) : extent_of(operand, step.kind(i), step.wide());
    if (auto fault = read_only(operand, count, *step.spelling)) return Misfit{i, std::move(*fault)};
  }
  return {};
}

std::optional<Misfit> misfit_of_refresh(const Step& step) {
  const auto& first = step.operands[0];
  if (first.number % 8 != 0)
    return misfit_at(0, fmt::format("REF begins at {}", to_string(first)),
                     "begin where a row of eight does: X0, X10, X20");
  const auto count = constant_of(step, 1);
  if (!count || (*count >= 8 && *count % 8 == 0 && first.number + *count <= terminals)) return {};
  return misfit_at(1, fmt::format("REF refreshes {} of {}", *count, to_string(first)),
                   "write K8, K16 and on, as many as there are");
}

/// Devices that are not of one kind, or not of one size.
std::optional<Misfit> misfit_of_devices(const Step& step) {
  const Op op = step.op();
  const auto& operands = step.operands;
  const auto& name = step.spelling->text;
  if (op == Op::zrst) {
    const auto pair = fmt::format("ZRST from {} to {}", to_string(operands[0]), to_string(operands[1]));
    if (operands[0].kind != operands[1].kind)
      return misfit_at(1, pair, "name two devices of the same letter");
    if (!step.indexed && operands[0].number > operands[1].number)
      return misfit_at(1, pair, "name the lower one first");
  }
  if (op == Op::block && operands[0].kind == OperandType::bits && operands[1].kind == OperandType::bits &&
      operands[0].count != operands[1].count)
    return misfit_at(1, fmt::format("{} from {} to {}", name, to_string(operands[0]), to_string(operands[1])),
                     "group as many bits in both");
  if (op == Op::hscr && operands[2].kind == OperandType::C && operands[2].number != operands[1].number)
    return misfit_at(
        2, fmt::format("{} compares {} and resets {}", name, to_string(operands[1]), to_string(operands[2])),
        "a counter resets itself, or Y, M or S");
  if (op == Op::rotate && operands[0].kind == OperandType::bits) {
    const int width = step.wide() ? 32 : 16;
    if (4 * operands[0].count != width)
      return misfit_at(0,
                       fmt::format("{} turns {} bits, not those of {}", name, width, to_string(operands[0])),
                       fmt::format("group K{}", width / 4));
  }
  // Pulses, and behind them their direction.
  if (!step.spelling->mnemonic->operands.ends_with("py")) return {};
  const auto& direction = operands.back();
  const auto& output = operands[operands.size() - 2];
  if (output.kind == direction.kind && output.number == direction.number)
    return misfit_at(operands.size() - 1, fmt::format("{} is the pulse output itself", to_string(direction)),
                     "name another Y for the direction");
  return {};
}

}  // namespace

bool is_in(const NumberRange& range, const Step& step, std::int64_t number) {
  return number >= range.least && number <= most_of(range, step);
}

std::string remedy_of(const NumberRange& range, const Step& step) {
  const auto most = most_of(range, step);
  return most == std::numeric_limits<std::int32_t>::max() ? fmt::format("write {} or more", range.least)
                                                          : fmt::format("write {} to {}", range.least, most);
}

std::optional<Misfit> misfit_together(const Step& step) {
  if (auto misfit = misfit_of_devices(step)) return misfit;
  if (step.op() == Op::ref) return misfit_of_refresh(step);
  for (const auto check : {misfit_of_numbers, misfit_of_order, misfit_of_counts, misfit_of_division,
                           misfit_of_digits, misfit_of_writing})
    if (auto misfit = check(step)) return misfit;
  return {};
}

}  // namespace drycut::devices::lx3vp::il
