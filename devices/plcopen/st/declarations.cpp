#include "devices/plcopen/st/compiler.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "devices/plcopen/st/lexer.hpp"

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
  // F_TRIG of IEC 61131-3: before its first scan CLK was TRUE.
  if (unit.standard && dialect_ == StDialect::iec && type.name == "F_TRIG")
    type.initial[static_cast<std::size_t>(find_member(type, "last")->offset)] = 1;
  Pou& own = pou(unit);
  own.type = &type;
  if (const Variable* unfit = unit.standard && unit.framed() ? find_member(type, "UNFIT") : nullptr)
    own.unfit = unfit->offset;
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
      refuse_open(*result.type, place);
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
  refers_to_.reset();
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
  const auto refers_to = std::exchange(refers_to_, std::nullopt);
  if (refers_to && section.section == VarClass::temp)
    give_up("st.initial-value"_code, value.place, "a VAR_TEMP begins with NULL",
            "assign it by a statement: p := REF(x);");
  expect(";", "ends a declaration");
  if ((place.terminal || place.memory) && names.size() > 1) {
    complain("st.declared-twice"_code, names[1].place, "two variables at one place",
             "declare each with its own AT");
    place = {};
  }
  for (const StToken& name : names) {
    const std::size_t members = owner.members.size();
    add_variable(unit, owner, section, name, type, place, initial);
    if (owner.members.size() > members) owner.members[members].refers_to = refers_to;
  }
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
  const bool rises = word.word("R_EDGE");
  if (!rises) is_iec(DialectDifference::first_falling_edge, word.place);
  return rises;
}

void Declarations::add_edge(Unit& unit, Type& owner, const StToken& name, bool rising) {
  const Type* boolean = type_of(Basic::boolean);
  for (const std::string_view what : {edge_mark, last_mark})
    append(owner, {.name = fmt::format("{}{}", name.text, what), .type = boolean, .place = name.place},
           boolean->initial);
  if (!rising && dialect_ == StDialect::iec) owner.initial.back() = 1;
  unit.edges.push_back({name, rising});
}

bool Declarations::check_section(const Unit& unit, const VarSection& section, const StToken& name,
                                 const Type& type, const Location& located) {
  const auto refuse = [&](Code code, std::string what, std::string remedy) {
    complain(code, name.place, std::move(what), std::move(remedy));
    return false;
  };
  const std::string_view in = section.global ? "VAR_GLOBAL" : name_of(section.section);
  const bool takes_open =
      section.section == VarClass::in_out || (section.section == VarClass::input && unit.framed());
  if (type.open > 0 && (!takes_open || unit.kind == Unit::Kind::program))
    return refuse("st.declaration"_code,
                  fmt::format("the {} {} in {} has no length", type.name, in_quotes(name.text), in),
                  "it stands in VAR_IN_OUT, and in VAR_INPUT of a FUNCTION or METHOD: the caller's array");
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
  return (!located.terminal && !located.memory) || check_location(unit, section, name, type, located);
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
  if (type->basic != Basic::unknown) {
    variable.reads_terminal = located.terminal && located.terminal->kind == devices::Kind::input;
    keep_at_place(owner, name, *type, located, pou);
  }
  const std::vector<Cell> pointer(1, 0);
  append(owner, std::move(variable),
         section.section == VarClass::in_out ? std::span<const Cell>(pointer) : initial);
  // Until a call gives it an array it has no element.
  for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(type->open); ++i)
    append(owner, {.name = bound_name(name.text, i), .type = type_of(Basic::lint), .place = name.place},
           std::vector<Cell>(1, i % 2 == 0 ? 0 : -1));
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

}  // namespace drycut::devices::plcopen::st
