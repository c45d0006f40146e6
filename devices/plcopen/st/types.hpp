#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/text.hpp"

namespace drycut::devices::plcopen {
struct BlockType;
}

namespace drycut::devices::plcopen::st {

/// One place of the memory. BOOL, integers, times, dates and enumerations are numbers (ULINT and LWORD the
/// bits of an unsigned one), REAL and LREAL the bits of a double, AXIS_REF the axis' number; a STRING takes
/// eight characters a cell.
using Cell = std::int64_t;
inline double real_of(Cell cell) { return std::bit_cast<double>(cell); }
inline Cell cell_of(double value) { return std::bit_cast<Cell>(value); }

enum class Basic : std::uint8_t {
  unknown,  ///< of something that has been complained of
  boolean,
  sint,
  int_,
  dint,
  lint,
  usint,
  uint,
  udint,
  ulint,
  byte,
  word,
  dword,
  lword,
  real,
  lreal,
  time,            ///< whole ms in 32 bit, wraps after 49 days, as on CODESYS and TwinCAT
  signed_time,     ///< the same with a sign: TIME of StDialect::iec
  ltime,           ///< ns in 64 bit with a sign, as of the other long ones
  tod,             ///< ms since midnight
  ltod,            ///< ns since midnight
  date,            ///< s since 1970-01-01 in 32 bit, whole days
  ldate,           ///< ns since 1970-01-01, whole days
  dt,              ///< s since 1970-01-01 in 32 bit
  ldt,             ///< ns since 1970-01-01
  character,       ///< CHAR: a byte of a STRING
  wide_character,  ///< WCHAR: a character of a WSTRING, to U+FFFF
  string,
  axis,
  enumeration,
  structure,
  array,
  block,
  reference,  ///< REF_TO: see references.cpp; without an element it is NULL
};

/// An elementary type.
struct TypeRow {
  Basic basic;
  std::string_view name;
  int bits;
  bool sign;
};
/// In the order of Basic.
inline constexpr std::array<TypeRow, 29> type_rows{{
    {Basic::unknown, "?", 64, true},
    {Basic::boolean, "BOOL", 1, false},
    {Basic::sint, "SINT", 8, true},
    {Basic::int_, "INT", 16, true},
    {Basic::dint, "DINT", 32, true},
    {Basic::lint, "LINT", 64, true},
    {Basic::usint, "USINT", 8, false},
    {Basic::uint, "UINT", 16, false},
    {Basic::udint, "UDINT", 32, false},
    {Basic::ulint, "ULINT", 64, false},
    {Basic::byte, "BYTE", 8, false},
    {Basic::word, "WORD", 16, false},
    {Basic::dword, "DWORD", 32, false},
    {Basic::lword, "LWORD", 64, false},
    {Basic::real, "REAL", 32, true},
    {Basic::lreal, "LREAL", 64, true},
    {Basic::time, "TIME", 32, false},
    {Basic::signed_time, "TIME", 32, true},
    {Basic::ltime, "LTIME", 64, true},
    {Basic::tod, "TOD", 32, false},
    {Basic::ltod, "LTOD", 64, true},
    {Basic::date, "DATE", 32, false},
    {Basic::ldate, "LDATE", 64, true},
    {Basic::dt, "DT", 32, false},
    {Basic::ldt, "LDT", 64, true},
    {Basic::character, "CHAR", 8, false},
    {Basic::wide_character, "WCHAR", 16, false},
    {Basic::string, "STRING", 0, false},
    {Basic::axis, "AXIS_REF", 32, true},
}};

/// An enumeration is kept as an INT.
constexpr const TypeRow& row_of(Basic basic) {
  return type_rows.at(static_cast<std::size_t>(basic == Basic::enumeration ? Basic::int_ : basic));
}

/// Smallest and largest value of a type of whole numbers, BOOL and times included; of ULINT and LWORD what is
/// a LINT too.
struct Subrange {
  std::int64_t low = 0;
  std::int64_t high = 0;
};

struct Type;

/// Where a variable is declared: it decides who may write it.
enum class VarClass : std::uint8_t { local, input, output, in_out, temp };

/// A variable of a POU, or a member of a structure.
struct Variable {
  std::string name;
  const Type* type = nullptr;
  VarClass section = VarClass::local;
  int offset = 0;  ///< in cells from the beginning of its owner
  bool constant = false;
  bool retain = false;
  bool reads_terminal = false;     ///< AT %IX
  std::optional<Cell> value = {};  ///< of an elementary constant
  /// A reference that begins with another variable of its owner.
  struct RefersTo {
    int referent = 0;
    int offset = 0;  ///< in cells from the beginning of the owner
  };
  std::optional<RefersTo> refers_to = {};
  Place place = {};
};

struct EnumValue {
  std::string name;
  std::int64_t value = 0;
};

struct Type {
  Basic basic = Basic::unknown;
  std::string name;
  int cells = 1;
  std::vector<Cell> initial;  ///< `cells` of them

  std::size_t length = 0;         ///< of a STRING: bytes, of a WSTRING: characters
  bool wide = false;              ///< WSTRING: Basic::string in UTF-8, counted by its characters
  const Type* element = nullptr;  ///< of an array; what a reference is of
  std::int64_t low = 0;           ///< bounds of an array, or of a subrange INT (0..9)
  std::int64_t high = 0;
  int open = 0;  ///< of ARRAY [*, *] OF element: how many dimensions the caller gives; it is where that is
  bool subrange = false;
  int depth = 1;             ///< of arrays and structures within each other
  bool holds_block = false;  ///< it is a function block, or an array or structure with one in it
  bool holds_axis = false;
  std::vector<EnumValue> values;
  std::vector<Variable> members;  ///< of a structure or function block
  /// Of the members by their names in lower case, and by the second names of standard blocks' pins.
  std::unordered_map<std::string, std::size_t> index;
  const BlockType* motion = nullptr;
  int pou = -1;           ///< number of a user's function block
  bool standard = false;  ///< TON and its like
  bool broken = false;    ///< a declaration was given up: what is missing has been told

  /// LTIME, LTOD, LDATE, LDT
  [[nodiscard]] bool is_long() const;
};

/// SINT..ULINT, BYTE..LWORD
constexpr bool is_integer(Basic basic) { return basic >= Basic::sint && basic <= Basic::lword; }
/// ULINT, LWORD
constexpr bool is_wide(Basic basic) { return basic == Basic::ulint || basic == Basic::lword; }
constexpr bool is_real(Basic basic) { return basic == Basic::real || basic == Basic::lreal; }
constexpr bool is_number(Basic basic) { return is_integer(basic) || is_real(basic); }
/// BYTE, WORD, DWORD, LWORD
constexpr bool is_bits(Basic basic) { return basic >= Basic::byte && basic <= Basic::lword; }
/// TIME, TOD, DATE, DT, and the long ones
constexpr bool is_clock(Basic basic) { return basic >= Basic::time && basic <= Basic::ldt; }
/// TIME, LTIME
constexpr bool is_span(Basic basic) { return basic >= Basic::time && basic <= Basic::ltime; }
/// The long one of a kind: LTOD of TOD and LTOD.
constexpr Basic long_clock(Basic basic) {
  if (is_span(basic)) return Basic::ltime;
  if (basic == Basic::tod) return Basic::ltod;
  if (basic == Basic::date) return Basic::ldate;
  return basic == Basic::dt ? Basic::ldt : basic;
}
inline bool Type::is_long() const { return is_clock(basic) && long_clock(basic) == basic; }
constexpr bool is_character(Basic basic) {
  return basic == Basic::character || basic == Basic::wide_character;
}
/// What is kept as a whole number: integers, BOOL, times, dates, characters, enumerations.
constexpr bool is_whole(Basic basic) {
  return is_integer(basic) || basic == Basic::boolean || is_clock(basic) || is_character(basic) ||
         basic == Basic::enumeration;
}
constexpr bool is_elementary(Basic basic) { return is_whole(basic) || is_real(basic); }
bool is_single(Basic basic);  ///< of one cell, which is its value
/// Of a type that is_whole.
Subrange range_of(Basic basic);
Subrange range_of(const Type& type);
/// Units of a type that is_clock in one second.
int per_second(Basic basic);
int bits_of(Basic basic);
/// `value` in the width of the type, as a machine drops the bits above.
constexpr std::int64_t wrapped(Basic basic, std::int64_t value) {
  if (!is_whole(basic)) return value;
  const TypeRow& row = row_of(basic);
  const auto above = static_cast<unsigned>(64 - row.bits);
  const std::uint64_t shifted = static_cast<std::uint64_t>(value) << above;
  return row.sign ? static_cast<std::int64_t>(shifted) >> above : static_cast<std::int64_t>(shifted >> above);
}
/// `value` as a REAL or LREAL keeps it.
constexpr double rounded(Basic basic, double value) {
  return basic == Basic::real ? static_cast<double>(static_cast<float>(value)) : value;
}
/// Whether every value of `from` is one of `to`: the conversions that IEC 61131-3 makes by itself.
bool widens(Basic from, Basic to);
bool same_type(const Type& a, const Type& b);

/// BOOL..STRING and AXIS_REF by name, any case; nullptr if there is none.
const Type* elementary_type(std::string_view name);
const Type* type_of(Basic basic);
/// What values of the type are computed in: INT of INT (0..9).
const Type* base_of(const Type* type);
/// Most bytes of a text of the type.
std::size_t bytes_of_text(const Type& type);
/// Of a STRING of so many characters.
int string_cells(std::size_t length);
inline constexpr std::size_t default_string_length = 80;
inline constexpr std::size_t most_string_length = 32767;
const std::vector<std::string>& elementary_names();
/// The member called `name`, any case; nullptr if there is none.
const Variable* find_member(const Type& type, std::string_view name);

}  // namespace drycut::devices::plcopen::st
