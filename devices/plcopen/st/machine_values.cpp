#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "devices/plcopen/st/machine.hpp"
#include "devices/plcopen/st/references.hpp"

// What takes more than a step's few operations: values that may be lost or refused, references, texts.
namespace drycut::devices::plcopen::st {

Cell Machine::operation(const StInstruction& of, Cell a, Cell b) {
  if (const auto none = no_result(of.op, of.basic, a, b)) fail_value(of, none->what + "; " + none->remedy);
  const Cell result = apply(of.op, of.basic, a, b);
  // Real numbers overflow, conversions leave their type; whole numbers wrap.
  if (is_real(of.basic) ? !std::isfinite(real_of(result))
                        : of.op == StOp::to_whole || of.op == StOp::truncate || of.op == StOp::wrap)
    look_at(of, a, result);
  return result;
}

std::optional<std::string> loss_of(StOp op, Basic basic, Cell before, Cell result) {
  const auto type = [&] { return type_of(basic)->name; };
  if (is_real(basic)) {
    if (std::isfinite(real_of(result))) return std::nullopt;
    if (std::isnan(real_of(result))) return "the result is no number; test the values before";
    return fmt::format("a {} overflows; it goes to {}", type(), basic == Basic::real ? "3.4e38" : "1.8e308");
  }
  const bool number = (is_integer(basic) && basic <= Basic::ulint) || is_span(basic);
  if (op == StOp::wrap)
    return number && result != before
               ? std::optional(
                     fmt::format("{} does not fit in {}, which makes {} of it", before, type(), result))
               : std::nullopt;
  if (op != StOp::to_whole && op != StOp::truncate) return std::nullopt;
  constexpr double two_to_64 = 18446744073709551616.0;
  const double value = op == StOp::truncate ? std::trunc(real_of(before)) : std::nearbyint(real_of(before));
  const Subrange range = range_of(basic);
  const double high = is_wide(basic) ? two_to_64 : static_cast<double>(range.high);
  if (value >= static_cast<double>(range.low) && (is_wide(basic) ? value < high : value <= high))
    return std::nullopt;
  return fmt::format(
      "{} does not fit in {}, which makes {} of it", real_of(before), type(),
      is_wide(basic) ? fmt::format("{}", static_cast<std::uint64_t>(result)) : fmt::format("{}", result));
}

void Machine::look_at(const StInstruction& of, Cell before, Cell result) {
  if (auto loss = loss_of(of.op, of.basic, before, result)) tell_loss(of, std::move(*loss));
}

void Machine::tell_loss(const StInstruction& of, std::string text) {
  const Origin& at = origin(of);
  if (at.standard) return;  // its caller tells what did not fit
  if (told_.insert(at.node).second) losses_.push_back({at.line, at.column, std::move(text)});
}

Cell Machine::element(const StInstruction& of, Cell array, Cell index) const {
  const Span& span = code_.spans[static_cast<std::size_t>(of.d)];
  if (index < span.low || index > span.high)
    fail_value(of, fmt::format("the index {} is out of bounds; {} to {}", index, span.low, span.high));
  return array + (index - span.low) * span.cells + span.behind;
}

Cell Machine::index(const StInstruction& of, Cell value, Cell low, Cell high) const {
  if (value < low || value > high)
    fail_value(of, fmt::format("the index {} is out of bounds; {} to {}", value, low, high));
  return value - low;
}

Cell Machine::in_range(const StInstruction& of, Cell value) const {
  const Span& span = code_.spans[static_cast<std::size_t>(of.d)];
  if (value < span.low || value > span.high)
    fail(of, fmt::format("{} is out of the range; {} to {}", value, span.low, span.high));
  return value;
}

Cell Machine::dereference(const StInstruction& of, Cell value) const {
  const Reference reference = reference_of(value);
  if (reference.referent < 0) fail_value(of, "the reference is NULL; test it before: p <> NULL");
  const Referent& wanted = code_.referents[of.c.cells];
  const bool known = reference.referent < static_cast<std::int64_t>(code_.referents.size());
  if (!known || reference.bytes != 0 ||
      !same_type(*code_.referents[static_cast<std::size_t>(reference.referent)].type, *wanted.type))
    fail(of, fmt::format("the reference is of no {}; REF(variable of that type)", wanted.type->name));
  return reference.place + of.d;
}

std::pair<const Referent*, Cell*> Machine::seen_by(const StInstruction& by, Cell reference,
                                                   std::int64_t& bytes) {
  const Reference at = reference_of(reference);
  if (at.referent < 0) fail_value(by, "the reference is NULL; test it before: p <> NULL");
  const auto outside = [&] {
    fail(by, "the reference is outside of what it is of; see how many bytes it was moved by");
  };
  if (at.referent >= static_cast<std::int64_t>(code_.referents.size())) outside();
  const Referent& of = code_.referents[static_cast<std::size_t>(at.referent)];
  const int size = bytes_of(of.basic);
  const std::int64_t last = at.bytes + bytes_of(by.basic) - 1;
  const std::int64_t all =
      of.basic == Basic::string ? std::int64_t{of.cells} * 8 - 1 : std::int64_t{of.cells} * size;
  const std::int64_t per_cell = of.basic == Basic::string ? 8 : size;
  if (last >= all) outside();
  // Numbers may have been made references: only cells of plain data are touched.
  for (const std::int64_t byte : {at.bytes, last}) {
    const auto cell = static_cast<std::size_t>(at.place + byte / per_cell);
    if (cell >= code_.kinds.size() || code_.kinds[cell] != of.basic) outside();
  }
  bytes = at.bytes;
  return {&of, &memory_[static_cast<std::size_t>(at.place)]};
}

std::string_view Machine::text(std::int64_t place, std::size_t most) const {
  const char* const begin = reinterpret_cast<const char*>(memory_.data() + place);
  most = std::min(most, (memory_.size() - static_cast<std::size_t>(place)) * sizeof(Cell));
  return {begin, strnlen(begin, most)};
}

Cell Machine::compare(std::int64_t a, std::int64_t b) {
  const std::string_view first = whole_text(a);
  const std::string_view second = whole_text(b);
  charge(static_cast<std::int64_t>(std::min(first.size(), second.size()) / 8));
  const int order = first.compare(second);
  return order < 0 ? -1 : order > 0 ? 1 : 0;
}

Cell Machine::text_value(const StInstruction& of, const Bases& bases) {
  const auto op = static_cast<TextOp>(of.b.cells);
  const int* list = code_.lists.data() + of.d;
  const int* const end = list + 2 + list[0];
  const bool wide = list[1] != 0;
  list += 2;
  const auto value = [&](int operand) { return at(bases, unpacked(operand)); };
  // Of the place that the result has.
  const std::size_t room = wide ? longest_bytes() : code_.longest_text;
  const Cell target = op < TextOp::length ? value(*list++) : 0;
  if (op == TextOp::from_value) {
    put_string(text_of(of.basic, value(*list)), target, room);
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
  if (op == TextOp::length) return static_cast<Cell>(characters(parts[0], wide));
  if (op == TextOp::find) {
    const Cell first = found(parts[0], parts[1]);
    return first == 0 || !wide
               ? first
               : static_cast<Cell>(characters(parts[0].substr(0, static_cast<std::size_t>(first)), true));
  }
  if (wide) numbers = in_bytes(op, parts[0], numbers);
  if (op == TextOp::to_value) return value_of(of.basic, parts[0]);
  put_string(edited(op, parts, numbers), target, room);
  return target;
}

void Machine::store_bits(const StInstruction& of, Cell& whole, Cell part) const {
  const std::uint64_t mask = ((std::uint64_t{1} << of.c.cells) - 1) << of.d;
  const std::uint64_t rest = static_cast<std::uint64_t>(whole) & ~mask;
  whole = wrapped(of.basic, static_cast<Cell>(rest | ((static_cast<std::uint64_t>(part) << of.d) & mask)));
}

void Machine::store_text(const StInstruction& of, std::int64_t to, std::int64_t from) {
  const bool wide = of.c.cells > 0;
  const auto most = static_cast<std::size_t>(of.d);
  const std::size_t most_characters = wide ? of.c.cells - 1 : most;
  const std::string_view whole = whole_text(from);
  const std::size_t size = characters(whole, wide);
  if (size > most_characters)
    tell_loss(of, fmt::format("a text of {} characters is cut off at {}", size, most_characters));
  if (wide)
    put_string(first_characters(text(from, most), most_characters), to, most);
  else
    copy_string(from, to, most);
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

}  // namespace drycut::devices::plcopen::st
