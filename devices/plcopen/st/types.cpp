#include "devices/plcopen/st/types.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace drycut::devices::plcopen::st {
namespace {

std::vector<Type> make_elementary() {
  std::vector<Type> types;
  for (const TypeRow& row : type_rows) {
    Type type;
    type.basic = row.basic;
    type.name = row.name;
    if (row.basic == Basic::string) {
      type.length = default_string_length;
      type.cells = string_cells(type.length);
    }
    type.holds_axis = row.basic == Basic::axis;
    const Cell initial = row.basic == Basic::axis ? -1 : is_real(row.basic) ? cell_of(0) : 0;
    type.initial.assign(static_cast<std::size_t>(type.cells), initial);
    types.push_back(std::move(type));
  }
  Type wide = types[static_cast<std::size_t>(Basic::string)];
  wide.name = "WSTRING";
  wide.wide = true;
  wide.cells = string_cells(bytes_of_text(wide));
  wide.initial.assign(static_cast<std::size_t>(wide.cells), 0);
  types.push_back(std::move(wide));
  return types;
}

const std::vector<Type>& elementary() {
  static const std::vector<Type> types = make_elementary();
  return types;
}

}  // namespace

bool is_single(Basic basic) {
  return is_elementary(basic) || basic == Basic::axis || basic == Basic::reference;
}

int bits_of(Basic basic) { return row_of(basic).bits; }

Subrange range_of(Basic basic) {
  const TypeRow& row = row_of(basic);
  if (is_wide(basic)) return {0, std::numeric_limits<std::int64_t>::max()};
  if (row.sign) {
    const std::int64_t high = std::numeric_limits<std::int64_t>::max() >> (64 - row.bits);
    return {-high - 1, high};
  }
  return {0, static_cast<std::int64_t>((std::uint64_t{1} << row.bits) - 1)};
}

Subrange range_of(const Type& type) {
  return type.subrange ? Subrange{type.low, type.high} : range_of(type.basic);
}

int per_second(Basic basic) {
  if (long_clock(basic) == basic) return 1'000'000'000;
  return is_span(basic) || basic == Basic::tod ? 1000 : 1;
}

bool widens(Basic from, Basic to) {
  // Structures, arrays, blocks and enumerations are alike by their names, not by their kinds.
  if (from == to) return is_elementary(from) && from != Basic::enumeration;
  if (from == Basic::enumeration) from = Basic::int_;
  if (from == Basic::real) return to == Basic::lreal;
  if (is_clock(from)) return to == long_clock(from);
  if (!is_integer(from)) return false;
  // A REAL holds whole numbers of 24 bit exactly, an LREAL of 53.
  if (to == Basic::real) return bits_of(from) <= 16;
  if (to == Basic::lreal) return bits_of(from) <= 32;
  if (!is_integer(to)) return false;
  if (is_wide(from)) return is_wide(to);
  return range_of(from).low >= range_of(to).low && range_of(from).high <= range_of(to).high;
}

bool same_type(const Type& a, const Type& b) {
  if (&a == &b) return true;
  if (a.basic != b.basic) return false;
  if (a.basic == Basic::array)
    return a.low == b.low && a.high == b.high && a.open == b.open && same_type(*a.element, *b.element);
  if (a.basic == Basic::reference)
    return a.element != nullptr && b.element != nullptr && same_type(*a.element, *b.element);
  if (a.basic == Basic::string) return a.length == b.length && a.wide == b.wide;
  return a.basic != Basic::enumeration && a.basic != Basic::structure && a.basic != Basic::block;
}

const Type* elementary_type(std::string_view name) {
  for (const auto& [second, first] : {std::pair{"TIME_OF_DAY", "TOD"},
                                      {"DATE_AND_TIME", "DT"},
                                      {"LTIME_OF_DAY", "LTOD"},
                                      {"LDATE_AND_TIME", "LDT"}})
    if (same_word(name, second)) name = first;
  for (const Type& type : elementary())
    if (same_word(type.name, name)) return &type;
  return nullptr;
}

const Type* type_of(Basic basic) { return &elementary().at(static_cast<std::size_t>(basic)); }

const Type* base_of(const Type* type) { return type->subrange ? type_of(type->basic) : type; }

std::size_t bytes_of_text(const Type& type) { return type.wide ? 4 * type.length : type.length; }

int string_cells(std::size_t length) { return static_cast<int>(length / sizeof(Cell)) + 1; }

const std::vector<std::string>& elementary_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const Type& type : elementary())
      if (type.basic != Basic::unknown && type.basic != Basic::signed_time) result.push_back(type.name);
    return result;
  }();
  return names;
}

const Variable* find_member(const Type& type, std::string_view name) {
  const auto found = type.index.find(lower(name));
  return found == type.index.end() ? nullptr : &type.members[found->second];
}

}  // namespace drycut::devices::plcopen::st
