#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// Where variables are outside of the program: AT %IX0.0 and %QW2 at terminals, AT %MW3 in memory; and the
// places that a text names by their addresses only.
namespace drycut::devices::plcopen::st {
namespace {

/// How a value of the type lies in memory of that size; nullopt if it does not fit.
std::optional<ModbusFormat> memory_format(char size, Basic basic) {
  switch (basic) {
    case Basic::boolean:
      return size == 'X' ? std::optional(ModbusFormat::bit) : std::nullopt;
    case Basic::int_:
      return size == 'W' ? std::optional(ModbusFormat::int16) : std::nullopt;
    case Basic::uint:
    case Basic::word:
      return size == 'W' ? std::optional(ModbusFormat::uint16) : std::nullopt;
    case Basic::dint:
      return size == 'D' ? std::optional(ModbusFormat::int32) : std::nullopt;
    case Basic::udint:
    case Basic::dword:
      return size == 'D' ? std::optional(ModbusFormat::uint32) : std::nullopt;
    case Basic::real:
      return size == 'D' ? std::optional(ModbusFormat::real32) : std::nullopt;
    case Basic::lreal:
      return size == 'L' ? std::optional(ModbusFormat::real64) : std::nullopt;
    default:
      return std::nullopt;
  }
}
std::string_view memory_types(char size) {
  switch (size) {
    case 'X':
      return "a BOOL";
    case 'W':
      return "an INT, UINT or WORD";
    case 'D':
      return "a DINT, UDINT, DWORD or REAL";
    default:
      return "an LREAL";
  }
}

/// What a place of so many bits holds if nobody says more.
const Type* type_of_width(int bits) {
  switch (bits) {
    case 1:
      return type_of(Basic::boolean);
    case 8:
      return type_of(Basic::byte);
    case 16:
      return type_of(Basic::word);
    case 32:
      return type_of(Basic::dword);
    default:
      return type_of(Basic::lword);
  }
}

int width_of(char size) { return size == 'X' ? 1 : size == 'W' ? 16 : size == 'D' ? 32 : 64; }

}  // namespace

/// Puts a variable at its place, if it may be there.
bool Declarations::check_location(const Unit& unit, const VarSection& section, const StToken& name,
                                  const Type& type, const Location& located) {
  const auto refuse = [&](Code code, std::string what, std::string remedy) {
    complain(code, name.place, std::move(what), std::move(remedy));
    return false;
  };
  const bool one_bit = located.width == 1;
  const bool fits = one_bit
                        ? type.basic == Basic::boolean
                        : is_integer(type.basic) && bits_of(type.basic) == located.width && !type.subrange;
  if (located.terminal && !fits)
    return refuse("st.place"_code,
                  fmt::format("{} at {} is {}, not {}", in_quotes(name.text),
                              one_bit ? "a terminal" : fmt::format("{} terminals", located.width),
                              one_bit ? "a BOOL" : "a whole number of that width", type.name),
                  one_bit ? "start AT %IX0.0 : BOOL;" : "%IB0 has 8 bits, %IW0 16, %ID0 32, %IL0 64");
  if ((unit.kind != Unit::Kind::program && unit.kind != Unit::Kind::globals) ||
      section.section != VarClass::local)
    return refuse("st.place"_code,
                  fmt::format("{} cannot have {} here", in_quotes(name.text),
                              located.terminal ? "a terminal" : "a place in memory"),
                  "AT stands in VAR of a PROGRAM or in VAR_GLOBAL");
  if (located.memory) return check_memory(name, type, *located.memory);
  for (int bit = 0; bit < located.width; ++bit) {
    Address address = *located.terminal;
    address.number += bit;
    const auto [other, fresh] = terminals_.emplace(address, name.text);
    if (!fresh)
      return refuse(
          "st.declared-twice"_code,
          fmt::format("{} and {} are at one terminal", in_quotes(name.text), in_quotes(other->second)),
          "each terminal has one variable");
  }
  return true;
}

bool Declarations::check_memory(const StToken& name, const Type& type, const MemoryPlace& place) {
  const bool array = type.basic == Basic::array;
  const Basic basic = array ? type.element->basic : type.basic;
  if (!memory_format(place.size, basic)) {
    complain("st.place"_code, name.place,
             fmt::format("{} at {} is {}, or an array of them, not {}", in_quotes(name.text),
                         to_string(place), memory_types(place.size), type.name),
             "%MX0.0 has a bit, %MW0 a word, %MD0 two words, %ML0 four");
    return false;
  }
  const std::int64_t count = array ? type.high - type.low + 1 : 1;
  constexpr std::int64_t addresses = 65536;
  const bool bits = place.size == 'X';
  const std::int64_t first = static_cast<std::int64_t>(place.number) * addresses_of(place);
  const std::int64_t end = first + count * addresses_of(place);
  if (end > addresses) {
    complain("st.place"_code, name.place,
             fmt::format("{} does not end within the memory", in_quotes(name.text)),
             fmt::format("it has {} {}", addresses, bits ? "bits" : "words"));
    return false;
  }
  for (const Occupied& other : occupied_) {
    if (other.bits != bits || first >= other.end || end <= other.first) continue;
    complain("st.declared-twice"_code, name.place,
             fmt::format("{} and {} share memory", in_quotes(name.text), in_quotes(other.name)),
             "each place has one variable");
    return false;
  }
  occupied_.push_back({first, end, bits, std::string(name.text)});
  return true;
}

/// Notes where the variable is that `owner` gets next.
void Declarations::keep_at_place(const Type& owner, const StToken& name, const Type& type,
                                 const Location& located, int pou) {
  if (located.terminal) {
    for (int bit = 0; bit < located.width; ++bit) {
      Address address = *located.terminal;
      address.number += bit;
      code_->located.push_back({std::string(name.text), address, name.place.line, name.place.column,
                                located.width == 1 ? -1 : bit});
      code_->located_cells.push_back({owner.cells, type.basic});
      located_in_.push_back(pou);
    }
    seats_[place_name(*located.terminal, located.width)] = {&owner, &type, std::string(name.text),
                                                            owner.cells};
  }
  if (!located.memory) return;
  keep_in_memory(name, type, *located.memory, pou);
  const bool array = type.basic == Basic::array;
  for (std::int64_t i = 0; i < (array ? type.high - type.low + 1 : 1); ++i) {
    MemoryPlace place = *located.memory;
    place.number += static_cast<int>(i);
    seats_[to_string(place)] = {&owner, array ? type.element : &type, std::string(name.text),
                                owner.cells + static_cast<int>(i)};
  }
}

void Declarations::keep_in_memory(const StToken& name, const Type& type, const MemoryPlace& place, int pou) {
  Program::InMemory kept{std::string(name.text), place, {}, {}, 1, name.place.line, name.place.column};
  const bool array = type.basic == Basic::array;
  kept.format = *memory_format(place.size, array ? type.element->basic : type.basic);
  if (array) {
    kept.low = type.low;
    kept.count = static_cast<int>(type.high - type.low + 1);
  }
  code_->in_memory.push_back(std::move(kept));
  memory_in_.push_back(pou);
}

Declarations::Location Declarations::location() {
  const StToken token = take();
  if (token.kind == StToken::Kind::address) {
    if (const auto bits = located_bits(token.text)) return {bits->first, bits->count, {}};
    if (const auto place = parse_memory_place(token.text)) return {{}, 1, *place};
  }
  if (peek().is("*"))
    give_up("st.place"_code, token.place, fmt::format("'{}*' says no place", token.text),
            "VAR_CONFIG is not taken: write it here, %IX0.0, %QX0.0 or %MW0");
  if (upper(token.text).starts_with("%M"))
    give_up("st.place"_code, token.place, in_quotes(token.text) + " is no memory that is known",
            "%MX0.0 is a BOOL, %MW0 a word, %MD0 two, %ML0 four: bits and words 0 to 65535");
  give_up("st.place"_code, token.place, in_quotes(token.text) + " is no terminal that is known",
          "%IX0.0 is an input, %QX0.0 an output: byte 0 to 65535 and bit 0 to 7; %IW0 has 16 of them");
}

/// %QW2 in the statements, where no variable is declared AT it, is a variable of all units.
void Declarations::declare_addresses(std::size_t first) {
  addresses_declared_ = true;
  std::set<std::string> told;
  for (std::size_t i = first; i < tokens_.size(); ++i) {
    if (tokens_[i].kind != StToken::Kind::address || tokens_[i - 1].is(".") || tokens_[i - 1].word("AT"))
      continue;
    const StToken& token = tokens_[i];
    if (!told.insert(upper(token.text)).second) continue;
    at_ = i;
    stop_ = i + 1;
    try {
      const Location place = location();
      const std::string name =
          place.terminal ? place_name(*place.terminal, place.width) : to_string(*place.memory);
      if (seats_.contains(name)) continue;
      declare_address(token, name, place);
    } catch (const GiveUp&) {
    }
  }
}

void Declarations::declare_address(const StToken& token, const std::string& name, const Location& place) {
  const int width = place.terminal ? place.width : width_of(place.memory->size);
  if (place.memory && width == width_of('L'))
    give_up("st.place"_code, token.place, fmt::format("{} stands without a variable", name),
            fmt::format("declare one: x AT {} : LREAL;", name));
  StToken named = token;
  const auto known = std::find_if(address_names_.begin(), address_names_.end(),
                                  [&](const auto& one) { return *one == name; });
  named.text = known != address_names_.end()
                   ? **known
                   : *address_names_.emplace_back(std::make_unique<std::string>(name));
  const Type* type = type_of_width(width);
  Unit globals;
  globals.kind = Unit::Kind::globals;
  // An input may be read as a bit and in a word.
  const bool input = place.terminal && place.terminal->kind == devices::Kind::input;
  if (!input && !check_location(globals, {}, named, *type, place)) return;
  Variable variable{.name = name, .type = type, .reads_terminal = input, .place = token.place};
  keep_at_place(*globals_, named, *type, place, -1);
  append(*globals_, std::move(variable), type->initial);
}

TypedExpression Expressions::direct_place(const StToken& token) {
  if (!addresses_declared_)
    give_up("st.initial-value"_code, token.place, fmt::format("{} is not constant", in_quotes(token.text)),
            "an address stands in statements");
  const auto bits = located_bits(token.text);
  const auto memory = bits ? std::nullopt : parse_memory_place(token.text);
  const auto found = bits     ? seats_.find(place_name(bits->first, bits->count))
                     : memory ? seats_.find(to_string(*memory))
                              : seats_.end();
  if (found == seats_.end()) return unknown_at(token.place);  // it has been told
  const auto& [owner, type, name, cell] = found->second;
  const bool global = owner == globals_;
  const bool own = unit_->type == owner || (unit_->owner != nullptr && unit_->owner->type == owner);
  if (!global && !own)
    return refuse("st.place"_code, token.place,
                  fmt::format("{} is {} of another PROGRAM", in_quotes(token.text), in_quotes(name)),
                  "declare that in VAR_GLOBAL");
  TypedExpression result =
      variable_at(type, leaf_node(global ? StOp::address : StOp::address_own, type->basic, token.place, cell),
                  std::string(token.text), token.place);
  result.direct = is_integer(type->basic) && !type->subrange;
  if (bits && bits->first.kind == devices::Kind::input) result.locked = "is an input terminal";
  return result;
}

}  // namespace drycut::devices::plcopen::st
