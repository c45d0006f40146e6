#include "devices/plcopen/st/compiler.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "base/text.hpp"
#include "devices/plcopen/st/lexer.hpp"
#include "devices/plcopen/terminals.hpp"

// The VAR sections of POUs and VAR_GLOBAL.
namespace drycut::devices::plcopen::st {
namespace {

struct SectionName {
  std::string_view name;
  VarClass section;
};
constexpr std::array section_names{
    SectionName{"VAR", VarClass::local},         SectionName{"VAR_INPUT", VarClass::input},
    SectionName{"VAR_OUTPUT", VarClass::output}, SectionName{"VAR_IN_OUT", VarClass::in_out},
    SectionName{"VAR_TEMP", VarClass::temp},     SectionName{"VAR_EXTERNAL", VarClass::local},
    SectionName{"VAR_GLOBAL", VarClass::local}};

/// Of those with this section the first: VAR.
std::string_view name_of(VarClass section) {
  return std::find_if(section_names.begin(), section_names.end(),
                      [&](const SectionName& known) { return known.section == section; })
      ->name;
}

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

/// The pins of standard blocks have the names of CODESYS, and those of IEC 61131-3 as well.
void name_standard_pins(Type& type) {
  struct Pin {
    std::string_view block;
    std::string_view name;
    std::string_view standard;
  };
  constexpr std::array<Pin, 8> pins{{{"SR", "set1", "s1"},
                                     {"SR", "reset", "r"},
                                     {"RS", "set", "s"},
                                     {"RS", "reset1", "r1"},
                                     {"CTU", "reset", "r"},
                                     {"CTD", "load", "ld"},
                                     {"CTUD", "reset", "r"},
                                     {"CTUD", "load", "ld"}}};
  for (const Pin& pin : pins)
    if (type.standard && (type.name == pin.block || type.name.starts_with(std::string(pin.block) + "_")))
      type.index.emplace(pin.standard, type.index.at(std::string(pin.name)));
}

}  // namespace

void Declarations::declare(Unit& unit) {
  if (unit.state != Unit::State::untouched) return;
  const auto saved = std::tuple(at_, stop_, unit_);
  ++open_units_;
  unit.state = Unit::State::open;
  at_ = unit.first;
  stop_ = unit.end;
  unit_ = &unit;
  if (unit.kind == Unit::Kind::type)
    declare_type(unit);
  else
    declare_pou(unit);
  unit.state = Unit::State::done;
  --open_units_;
  std::tie(at_, stop_, unit_) = saved;
}

void Declarations::declare_pou(Unit& unit) {
  if (unit.kind == Unit::Kind::globals) {
    unit.type = globals_;
    while (variable_section(unit, *globals_)) {
    }
    return;
  }
  if (unit.kind == Unit::Kind::interface) return declare_interface(unit);
  Type& type = new_type(Basic::block, std::string(unit.name.text), true);
  type.standard = unit.standard;
  unit.type = &type;
  unit.pou = static_cast<int>(code_->pous.size());
  type.pou = unit.pou;
  code_->pous.emplace_back();
  if (unit.framed())
    declare_function_result(unit, type);
  else
    declare_base(unit, type);
  while (variable_section(unit, type)) {
  }
  fill_empty(type);
  name_standard_pins(type);
  Pou& own = pou(unit);
  own.type = &type;
  if (unit.framed()) own.resets.push_back({0, type.cells - 1});
  for (const Variable& member : type.members)
    if (!unit.framed() && member.section == VarClass::temp)
      own.resets.push_back({member.offset, member.offset + member.type->cells - 1});
  unit.body = at_;
  if (!unit.framed() || memory_ == 0) return;
  own.frame = memory_;
  memory_ += type.cells;
}

void Declarations::declare_function_result(Unit& unit, Type& type) {
  Variable result{
      .name = std::string(unit.name.text), .type = type_of(Basic::unknown), .place = unit.name.place};
  if (unit.property_type > 0) return declare_property(unit, type);
  unit.procedure = !peek().is(":") && elementary_type(peek().text) == nullptr;
  if (unit.procedure) {
    // A cell that no name of the text means.
    accept(";");
    result.name = "'result";
    result.type = type_of(Basic::boolean);
  }
  if (!unit.procedure) try {
      expect(":", fmt::format("and a type are the result: FUNCTION {} : LREAL", unit.name.text));
      const Place place = peek().place;
      result.type = parse_type();
      accept(";");
      if (result.type->holds_block || result.type->holds_axis) {
        complain("st.declaration"_code, place,
                 fmt::format("a FUNCTION does not return {}", result.type->name),
                 "it keeps its state: connect it as VAR_IN_OUT");
        result.type = type_of(Basic::unknown);
      }
    } catch (const GiveUp&) {
      while (at_ < stop_ && !upper(peek().text).starts_with("VAR") && !take().is(";")) {
      }
    }
  unit.result = base_of(result.type);
  append(type, std::move(result), unit.result->initial);
}

std::optional<Declarations::VarSection> Declarations::section_header() {
  const auto* const found = std::find_if(section_names.begin(), section_names.end(),
                                         [&](const SectionName& known) { return peek().word(known.name); });
  if (found == section_names.end()) return std::nullopt;
  VarSection section;
  section.section = found->section;
  section.external = found->name == "VAR_EXTERNAL";
  section.global = found->name == "VAR_GLOBAL";
  take();
  while (true) {
    if (accept_word("CONSTANT"))
      section.constant = true;
    else if (accept_word("RETAIN") || accept_word("PERSISTENT"))
      section.retain = true;
    else
      return section;
  }
}

bool Declarations::variable_section(Unit& unit, Type& owner) {
  if (at_ >= stop_) return false;
  const StToken opening = peek();
  const std::optional<VarSection> section = section_header();
  if (!section) return false;
  while (at_ < stop_ && !peek().word("END_VAR")) {
    // VAR without END_VAR runs into the next section or the statements.
    if (at_word(is_keyword) && upper(peek().text).starts_with("VAR")) break;
    try {
      declare_variables(unit, owner, *section);
    } catch (const GiveUp&) {
      owner.broken = true;
      skip_past("END_VAR");
    }
  }
  if (!accept_word("END_VAR") && unit.kind != Unit::Kind::globals)
    complain("st.syntax"_code, opening.place, fmt::format("{} has no END_VAR", upper(opening.text)),
             "write END_VAR behind its last variable");
  return true;
}

void Declarations::declare_variables(Unit& unit, Type& owner, const VarSection& section) {
  std::vector<StToken> names{expect_name("the name of a variable")};
  while (accept(",")) names.push_back(expect_name("the name of a variable"));
  try {
    declare_named(unit, owner, section, names);
  } catch (const GiveUp&) {
    // Known, so that their uses are not told again.
    const Type* unknown = type_of(Basic::unknown);
    for (const StToken& name : names)
      if (find_member(owner, name.text) == nullptr)
        add_variable(unit, owner, {}, name, unknown, {}, unknown->initial);
    throw;
  }
}

void Declarations::declare_named(Unit& unit, Type& owner, const VarSection& section,
                                 const std::vector<StToken>& names) {
  Location place;
  if (accept_word("AT")) place = location();
  expect(":", "stands between a variable's name and its type");
  const Type* type = parse_type();
  const std::optional<bool> rising = edge(unit, section, *type);
  if (section.external) {
    expect(";", "ends a declaration");
    for (const StToken& name : names) external(name, type);
    return;
  }
  const StToken value = peek(peek().is(":=") ? 1 : 0);
  std::vector<Cell> initial = type->initial;
  if (accept(":=")) {
    if (section.section == VarClass::in_out)
      give_up("st.initial-value"_code, value.place, "a VAR_IN_OUT has no initial value",
              "it is the caller's variable");
    initial = initial_value(*type);
  } else if (section.constant) {
    complain("st.initial-value"_code, names.front().place,
             in_quotes(names.front().text) + " is a constant without a value", ":= value behind its type");
  }
  expect(";", "ends a declaration");
  if ((place.terminal || place.memory) && names.size() > 1) {
    complain("st.declared-twice"_code, names[1].place, "two variables at one place",
             "declare each with its own AT");
    place = {};
  }
  for (const StToken& name : names) add_variable(unit, owner, section, name, type, place, initial);
  if (rising)
    for (const StToken& name : names) add_edge(unit, owner, name, *rising);
}

/// BOOL R_EDGE, true, or F_EDGE, false: the body sees the edge of the input.
std::optional<bool> Declarations::edge(const Unit& unit, const VarSection& section, const Type& type) {
  const StToken word = peek();
  if (!word.word("R_EDGE") && !word.word("F_EDGE")) return std::nullopt;
  take();
  const bool keeps = unit.kind == Unit::Kind::program || unit.kind == Unit::Kind::function_block;
  if (section.section != VarClass::input || !keeps || type.basic != Basic::boolean)
    give_up("st.declaration"_code, word.place, fmt::format("{} stands behind no input", upper(word.text)),
            "it follows a BOOL in VAR_INPUT of a FUNCTION_BLOCK or PROGRAM");
  return word.word("R_EDGE");
}

void Declarations::add_edge(Unit& unit, Type& owner, const StToken& name, bool rising) {
  const Type* boolean = type_of(Basic::boolean);
  for (const std::string_view what : {edge_mark, last_mark})
    append(owner, {.name = fmt::format("{}{}", name.text, what), .type = boolean, .place = name.place},
           boolean->initial);
  unit.edges.push_back({name, rising});
}

bool Declarations::check_section(const Unit& unit, const VarSection& section, const StToken& name,
                                 const Type& type, const Location& located) {
  const auto refuse = [&](Code code, std::string what, std::string remedy) {
    complain(code, name.place, std::move(what), std::move(remedy));
    return false;
  };
  const std::string_view in = section.global ? "VAR_GLOBAL" : name_of(section.section);
  if (type.holds_axis && (section.section != VarClass::in_out || type.basic != Basic::axis))
    return refuse("st.declaration"_code,
                  fmt::format("the AXIS_REF {} in {} has no axis", in_quotes(name.text), in),
                  "an axis of the configuration is named in VAR_EXTERNAL, a caller's in VAR_IN_OUT");
  const bool own = section.section == VarClass::local || section.section == VarClass::output;
  const bool keeps = section.section == VarClass::in_out || (own && !unit.framed());
  if (type.holds_block && (!keeps || section.constant))
    return refuse("st.declaration"_code,
                  fmt::format("the function block {} cannot be in {} here", in_quotes(name.text), in),
                  "it keeps its state: declare it in VAR of a PROGRAM or FUNCTION_BLOCK, or in VAR_GLOBAL");
  if (const Unit* block = type.basic == Basic::block ? find_unit(type.name) : nullptr;
      block != nullptr && block->abstract && section.section != VarClass::in_out)
    return refuse("st.declaration"_code, fmt::format("{} is ABSTRACT and has no instances", type.name),
                  "declare one of a block that EXTENDS it");
  if (!located.terminal && !located.memory) return true;
  if (located.terminal && type.basic != Basic::boolean)
    return refuse("st.place"_code,
                  fmt::format("{} at a terminal is a BOOL, not {}", in_quotes(name.text), type.name),
                  "start AT %IX0.0 : BOOL;");
  if ((unit.kind != Unit::Kind::program && unit.kind != Unit::Kind::globals) ||
      section.section != VarClass::local)
    return refuse("st.place"_code,
                  fmt::format("{} cannot have {} here", in_quotes(name.text),
                              located.terminal ? "a terminal" : "a place in memory"),
                  "AT stands in VAR of a PROGRAM or in VAR_GLOBAL");
  if (located.memory) return check_memory(name, type, *located.memory);
  const auto [other, fresh] = terminals_.emplace(*located.terminal, name.text);
  if (!fresh)
    return refuse(
        "st.declared-twice"_code,
        fmt::format("{} and {} are at one terminal", in_quotes(name.text), in_quotes(other->second)),
        "each terminal has one variable");
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
  for (const auto& [other_first, other_end, other_bits, other] : occupied_) {
    if (other_bits != bits || first >= other_end || end <= other_first) continue;
    complain("st.declared-twice"_code, name.place,
             fmt::format("{} and {} share memory", in_quotes(name.text), in_quotes(other)),
             "each place has one variable");
    return false;
  }
  occupied_.push_back({first, end, bits, std::string(name.text)});
  return true;
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

void Declarations::add_variable(Unit& unit, Type& owner, const VarSection& section, const StToken& name,
                                const Type* type, const Location& located, std::span<const Cell> initial) {
  if (!name_is_free(unit, owner, name) || !check_section(unit, section, name, *type, located)) {
    // Known, so that its uses are not told again.
    if (find_member(owner, name.text) == nullptr)
      type = type_of(Basic::unknown);
    else
      return;
    initial = type->initial;
  }
  Variable variable{.name = std::string(name.text),
                    .type = type,
                    .section = section.section,
                    .constant = section.constant,
                    .retain = section.retain,
                    .place = name.place};
  if (section.constant && (is_elementary(type->basic))) variable.value = initial.front();
  check_size(name.place, type->cells, type->depth);
  if (owner.cells + type->cells > most_cells)
    give_up("st.too-large"_code, name.place, "the variables take too much memory", "8 MB at most");
  const int pou = &owner == globals_ ? -1 : unit.pou;
  if (located.terminal && type->basic == Basic::boolean) {
    variable.reads_terminal = located.terminal->kind == Kind::input;
    code_->located.push_back({std::string(name.text), *located.terminal, name.place.line, name.place.column});
    code_->located_cells.push_back(owner.cells);
    located_in_.push_back(pou);
  }
  if (located.memory && type->basic != Basic::unknown) keep_in_memory(name, *type, *located.memory, pou);
  const std::vector<Cell> pointer(1, 0);
  append(owner, std::move(variable),
         section.section == VarClass::in_out ? std::span<const Cell>(pointer) : initial);
}

bool Declarations::name_is_free(const Unit& unit, const Type& owner, const StToken& name) {
  const Variable* other = find_member(owner, name.text);
  if (other == nullptr) return true;
  if (unit.framed() && same_word(unit.name.text, name.text))
    complain("st.declared-twice"_code, name.place, in_quotes(name.text) + " is the function's result",
             "choose another name");
  else
    tell_twice(name, other->name, other->place);
  return false;
}

void Declarations::external(const StToken& name, const Type* type) {
  const Variable* global = find_member(*globals_, name.text);
  if (type->basic == Basic::axis) {
    if (global != nullptr && global->type->basic == Basic::axis) return;
    if (global != nullptr) {
      complain("st.declaration"_code, name.place,
               fmt::format("{} is a {} in VAR_GLOBAL", in_quotes(name.text), global->type->name),
               "choose another name");
      return;
    }
    code_->externals.push_back({std::string(name.text), name.place.line, name.place.column});
    code_->external_cells.push_back(globals_->cells);
    append(*globals_, {.name = std::string(name.text), .type = type, .place = name.place}, type->initial);
    return;
  }
  if (type->basic == Basic::unknown || (global != nullptr && same_type(*global->type, *type))) return;
  if (global != nullptr) {
    complain("st.type"_code, name.place,
             fmt::format("{} is {} here and {} in VAR_GLOBAL", in_quotes(name.text), type->name,
                         global->type->name),
             "declare both alike");
    return;
  }
  complain("st.unknown-name"_code, name.place, fmt::format("there is no VAR_GLOBAL {}", in_quotes(name.text)),
           "VAR_EXTERNAL names what VAR_GLOBAL declares, or an AXIS_REF of the configuration");
}

Declarations::Location Declarations::location() {
  const StToken token = take();
  if (token.kind == StToken::Kind::address) {
    if (const auto address = located_address(token.text)) return {*address, {}};
    if (const auto place = parse_memory_place(token.text)) return {{}, *place};
  }
  if (upper(token.text).starts_with("%M"))
    give_up("st.place"_code, token.place, in_quotes(token.text) + " is no memory that is known",
            "%MX0.0 is a BOOL, %MW0 a word, %MD0 two, %ML0 four: bits and words 0 to 65535");
  give_up("st.place"_code, token.place, in_quotes(token.text) + " is no terminal that is known",
          "%IX0.0 is an input, %QX0.0 an output: byte 0 to 65535 and bit 0 to 7");
}

}  // namespace drycut::devices::plcopen::st
