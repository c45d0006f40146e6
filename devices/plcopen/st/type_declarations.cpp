#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/pins.hpp"
#include "devices/plcopen/st/compiler.hpp"

// TYPE sections, and what may stand behind a ':'.
namespace drycut::devices::plcopen::st {
namespace {

const Type* type_of_pin(const Pin& pin, const PinValue& value, const Type* cam_ref) {
  if (std::holds_alternative<CamRef*>(value)) return cam_ref;
  if (std::holds_alternative<AxisRef*>(value)) return type_of(Basic::axis);
  if (const Type* type = elementary_type(pin.type)) return type;
  constexpr std::array basics{Basic::boolean, Basic::int_,  Basic::uint,
                              Basic::dint,    Basic::udint, Basic::lreal};
  return type_of(basics.at(value.index()));
}

/// What a pin holds, if it is of one cell and no AXIS_REF.
std::optional<Cell> cell_of_pin(const PinValue& pin) {
  const auto cell = [](const auto* held) -> std::optional<Cell> {
    using T = std::remove_cvref_t<decltype(*held)>;
    if constexpr (std::is_same_v<T, double>) return cell_of(*held);
    if constexpr (std::is_integral_v<T>) return static_cast<Cell>(*held);
    return std::nullopt;
  };
  return std::visit(cell, pin);
}

}  // namespace

void append(Type& owner, Variable variable, std::span<const Cell> initial) {
  variable.offset = owner.cells;
  owner.cells += static_cast<int>(initial.size());
  owner.initial.insert(owner.initial.end(), initial.begin(), initial.end());
  owner.depth = std::max(owner.depth, variable.type->depth + 1);
  if (owner.basic == Basic::structure) {
    owner.holds_block = owner.holds_block || variable.type->holds_block;
    owner.holds_axis = owner.holds_axis || variable.type->holds_axis;
  }
  owner.index.emplace(lower(variable.name), owner.members.size());
  owner.members.push_back(std::move(variable));
}

void fill_empty(Type& type) {
  if (type.cells > 0) return;
  type.cells = 1;
  type.initial.assign(1, 0);
}

Type& Declarations::new_type(Basic basic, std::string name, bool composed) {
  code_->types.push_back(std::make_unique<Type>());
  Type& type = *code_->types.back();
  type.basic = basic;
  type.name = std::move(name);
  type.cells = composed ? 0 : 1;
  type.initial.assign(static_cast<std::size_t>(type.cells), 0);
  type.holds_block = basic == Basic::block;
  return type;
}

void Declarations::check_size(Place place, int cells, int depth) {
  // 128 MB of initial values, and no more recursion over a type than this.
  constexpr std::int64_t most_in_all = 16'000'000;
  constexpr int deepest = 60;
  type_cells_ += cells;
  if (type_cells_ > most_in_all)
    give_up("st.too-large"_code, place, "the types and variables take too much memory",
            "128 MB at most, all types together");
  if (depth > deepest)
    give_up("st.too-large"_code, place, "the types are nested too deeply",
            fmt::format("{} within each other at most", deepest));
}

void Declarations::declare_type(Unit& unit) {
  try {
    if (accept_word("STRUCT")) {
      Type& type = new_type(Basic::structure, std::string(unit.name.text), true);
      unit.type = &type;
      declare_structure(type);
      initial_of(type);
    } else if (peek().is("(") || at_based_enumeration()) {
      Type& type = new_type(Basic::enumeration, std::string(unit.name.text));
      unit.type = &type;
      declare_enumeration(type);
      initial_of(type);
    } else {
      unit.type = parse_type();
      if (peek().is(":=")) {
        code_->types.push_back(std::make_unique<Type>(*unit.type));
        initial_of(*code_->types.back());
        unit.type = code_->types.back().get();
      }
    }
    if (at_ < stop_)
      give_up("st.syntax"_code, peek().place, in_quotes(peek().text) + " is not expected behind a type",
              "a type ends with ';'");
  } catch (const GiveUp&) {
    if (unit.type == nullptr) unit.type = type_of(Basic::unknown);
  }
}

/// What variables of the type begin with.
void Declarations::initial_of(Type& type) {
  if (accept(":=")) type.initial = initial_value(type);
}

/// INT (a := 0, b): not a range, INT (0..9), nor a length, STRING(cLong). Of REAL it is refused.
bool Declarations::at_based_enumeration() const {
  const Type* base = elementary_type(peek().text);
  const StToken& behind = peek(3);
  return base != nullptr && base->basic != Basic::string && peek(1).is("(") &&
         peek(2).kind == StToken::Kind::name && (behind.is(",") || behind.is(":=") || behind.is(")"));
}

void Declarations::declare_structure(Type& type) {
  Unit* const unit = unit_;
  while (at_ < stop_ && !peek().word("END_STRUCT")) {
    try {
      declare_variables(*unit, type, {});
    } catch (const GiveUp&) {
      skip_past("END_STRUCT");
    }
  }
  expect_word("END_STRUCT", "a STRUCT ends with END_STRUCT");
  fill_empty(type);
}

/// INT (a, b) or (a, b) INT; without a type it is INT.
void Declarations::declare_enumeration(Type& type) {
  const StToken before = peek();
  const Type* base = at_based_enumeration() ? elementary_type(take().text) : nullptr;
  const auto take_whole = [&](const StToken& of) {
    if (is_integer(base->basic)) return;
    complain("st.type"_code, of.place, fmt::format("an enumeration of {}", base->name),
             "its values are whole numbers: (a, b) or INT (a, b)");
    base = nullptr;
  };
  if (base != nullptr) take_whole(before);
  expect("(", "begins an enumeration");
  std::int64_t next = 0;
  std::set<std::string> names;
  std::vector<Place> places;
  do {
    const StToken name = expect_name("the name of a value");
    if (!names.insert(lower(name.text)).second)
      complain("st.declared-twice"_code, name.place, in_quotes(name.text) + " is in the enumeration twice",
               "name each value once");
    if (accept(":=")) next = constant_value(*type_of(Basic::lint));
    places.push_back(name.place);
    enum_values_.emplace(lower(name.text), std::pair{&type, next});
    type.values.push_back({std::string(name.text), next});
    if (next < range_of(Basic::lint).high) ++next;
  } while (accept(","));
  expect(")", "ends an enumeration");
  if (base == nullptr && peek().kind == StToken::Kind::name && elementary_type(peek().text) != nullptr) {
    const StToken behind = take();
    base = elementary_type(behind.text);
    take_whole(behind);
  }
  const Subrange kept = range_of(Basic::int_);
  const Subrange own = base == nullptr ? kept : range_of(*base);
  for (std::size_t i = 0; i < type.values.size(); ++i) {
    const auto& [name, value] = type.values[i];
    if (value < own.low || value > own.high)
      complain("st.out-of-range"_code, places[i],
               fmt::format("{} is {}, which is no {}", in_quotes(name), value,
                           base == nullptr ? "INT" : base->name),
               fmt::format("{} to {}", own.low, own.high));
    else if (value < kept.low || value > kept.high)
      complain("st.out-of-range"_code, places[i],
               fmt::format("{} is {}; an enumeration is kept as an INT here, of {} too", in_quotes(name),
                           value, base->name),
               fmt::format("{} to {}", kept.low, kept.high));
    else
      continue;
    break;  // those behind it count on
  }
  type.initial.assign(1, type.values.front().value);
  enumerations_.emplace(lower(type.name), &type);
}

const Type* Declarations::parse_type() {
  if (peek().word("ARRAY")) {
    constexpr int deepest = 40;
    if (nesting_ > deepest)
      give_up("st.too-large"_code, peek().place, "the type is nested too deeply",
              "give its inner types names");
    take();
    const Nested nested(nesting_);
    return array_type();
  }
  if (peek().word("STRING") || peek().word("WSTRING")) return string_type();
  if (peek().word("REF_TO") || (peek().word("POINTER") && peek(1).word("TO"))) return reference_type();
  if (peek().is("(") || at_based_enumeration()) {
    Type& type = new_type(Basic::enumeration, "enumeration");
    declare_enumeration(type);
    return &type;
  }
  return named_type();
}

/// ARRAY [*, *] OF T: the caller says how long each dimension is.
const Type* Declarations::open_array_type() {
  const Place place = peek().place;
  int dimensions = 0;
  std::string stars;
  do {
    expect("*", "stands for each of the bounds: ARRAY [*, *] OF INT");
    stars += dimensions++ == 0 ? "*" : ", *";
  } while (accept(","));
  expect("]", "closes the bounds");
  expect_word("OF", "ARRAY [*] OF LREAL");
  const Type* element = parse_type();
  if (element->basic == Basic::array || element->basic == Basic::axis)
    give_up("st.declaration"_code, place, fmt::format("an ARRAY [*] of {}", element->name),
            "of numbers, texts or structures: ARRAY [*, *] OF INT");
  Type& type = new_type(Basic::array, fmt::format("ARRAY [{}] OF {}", stars, element->name));
  type.element = element;
  type.open = dimensions;
  type.depth = element->depth + 1;
  type.holds_block = element->holds_block;
  return &type;
}

void Declarations::refuse_open(const Type& type, Place place) {
  if (type.open > 0)
    give_up("st.declaration"_code, place, fmt::format("{} has no length here", type.name),
            "it stands in VAR_IN_OUT, and in VAR_INPUT of a FUNCTION or METHOD: the caller's array");
}

const Type* Declarations::array_type() {
  expect("[", "opens the bounds: ARRAY [0..7] OF LREAL");
  if (peek().is("*")) return open_array_type();
  struct Bounds {
    std::int64_t low = 0;
    std::int64_t high = 0;
    Place place;
  };
  std::vector<Bounds> dimensions;
  do {
    Bounds bounds;
    bounds.place = peek().place;
    bounds.low = constant_integer("a bound");
    expect("..", "stands between the bounds: ARRAY [0..7] OF LREAL");
    bounds.high = constant_integer("a bound");
    if (bounds.high < bounds.low)
      give_up("st.out-of-range"_code, bounds.place,
              fmt::format("an array from {} to {} is empty", bounds.low, bounds.high),
              "the lower bound stands first");
    dimensions.push_back(bounds);
  } while (accept(","));
  expect("]", "closes the bounds");
  expect_word("OF", "ARRAY [0..7] OF LREAL");
  const Place place = peek().place;
  const Type* element = parse_type();
  if (element->basic == Basic::axis)
    give_up("st.declaration"_code, place, "an array of AXIS_REF", "name each axis in VAR_EXTERNAL");
  refuse_open(*element, place);
  for (auto bounds = dimensions.rbegin(); bounds != dimensions.rend(); ++bounds) {
    const std::int64_t most = most_cells / std::max(element->cells, 1);
    if (bounds->high - bounds->low < 0 || bounds->high - bounds->low >= most)
      give_up("st.too-large"_code, bounds->place, "the array is too large",
              fmt::format("{} elements of this type at most", most));
    const std::int64_t count = bounds->high - bounds->low + 1;
    Type& type =
        new_type(Basic::array, fmt::format("ARRAY [{}..{}] OF {}", bounds->low, bounds->high, element->name));
    type.element = element;
    type.low = bounds->low;
    type.high = bounds->high;
    type.cells = static_cast<int>(count) * element->cells;
    type.depth = element->depth + 1;
    type.holds_block = element->holds_block;
    check_size(bounds->place, type.cells, type.depth);
    type.initial.clear();
    for (std::int64_t i = 0; i < count; ++i)
      type.initial.insert(type.initial.end(), element->initial.begin(), element->initial.end());
    element = &type;
  }
  return element;
}

const Type* Declarations::string_type() {
  const bool wide = take().word("WSTRING");
  const std::string name = wide ? "WSTRING" : "STRING";
  const bool round = peek().is("(");
  if (!round && !peek().is("[")) return elementary_type(name);
  take();
  const Place place = peek().place;
  const std::int64_t length = constant_integer("the length");
  expect(round ? ")" : "]", "closes the length");
  if (length < 1 || length > static_cast<std::int64_t>(most_string_length))
    give_up("st.out-of-range"_code, place, fmt::format("a {} of {} characters", name, length),
            fmt::format("1 to {}", most_string_length));
  code_->longest_text = std::max(code_->longest_text, static_cast<std::size_t>(length));
  Type& type = new_type(Basic::string, fmt::format("{}[{}]", name, length));
  type.wide = wide;
  type.length = static_cast<std::size_t>(length);
  type.cells = string_cells(bytes_of_text(type));
  type.initial.assign(static_cast<std::size_t>(type.cells), 0);
  return &type;
}

const Type* Declarations::named_type() {
  const StToken name = expect_name("a type");
  Unit* const unit = find_unit(name.text);
  if (const Type* type = type_named(name.text); type != nullptr && unit == nullptr)
    return peek().is("(") ? subrange(*type) : type;
  if (unit != nullptr) {
    const bool type = unit->kind == Unit::Kind::type || unit->kind == Unit::Kind::function_block ||
                      unit->kind == Unit::Kind::interface;
    if (!type)
      give_up("st.use"_code, name.place, in_quotes(name.text) + " is no type",
              "a PROGRAM or FUNCTION has no variables of its kind");
    if (unit->state == Unit::State::open)
      give_up("st.recursion"_code, name.place, in_quotes(name.text) + " contains itself",
              "a type is made of types that do not need it");
    constexpr int deepest = 100;
    if (open_units_ > deepest)
      give_up("st.too-large"_code, name.place, "the types are nested too deeply",
              fmt::format("declare {} before what is made of it", in_quotes(name.text)));
    if (unit->standard && same_word(name.text, "F_TRIG"))
      is_iec(DialectDifference::first_falling_edge, name.place);
    declare(*unit);
    return unit->type;
  }
  if (same_word(name.text, "MC_CAM_REF")) return cam_ref();
  for (const NamedType& named : named_types)
    if (same_word(name.text, named.name)) return elementary_type(named.type);
  if (const BlockType* block = find_block_type(name.text)) return motion_type(*block);
  const auto known = [&] {
    std::vector<std::string> names = elementary_names();
    for (const BlockType& block : block_types()) names.emplace_back(block.name);
    for (const auto& unit : units_)
      if (unit->kind == Unit::Kind::type || unit->kind == Unit::Kind::function_block)
        names.emplace_back(unit->name.text);
    names.emplace_back("MC_CAM_REF");
    return names;
  };
  give_up("st.unknown-name"_code, name.place, fmt::format("there is no type {}", in_quotes(name.text)),
          suggested(name.text, known, "BOOL, INT, LREAL, TIME, MC_CamIn, TON ..."));
}

/// INT (0..9): the values between, which begin at the lower one.
const Type* Declarations::subrange(const Type& base) {
  const Place place = peek().place;
  if (!is_integer(base.basic))
    give_up("st.type"_code, place, fmt::format("a range of {}", base.name),
            "whole numbers have ranges: INT (0..9)");
  take();
  const std::int64_t low = constant_integer("a bound", &base);
  expect("..", "stands between the bounds: INT (0..9)");
  const std::int64_t high = constant_integer("a bound", &base);
  expect(")", "closes the bounds");
  if (high < low)
    give_up("st.out-of-range"_code, place, fmt::format("a range from {} to {} is empty", low, high),
            "the lower bound stands first");
  Type& type = new_type(base.basic, fmt::format("{} ({}..{})", base.name, low, high));
  type.subrange = true;
  type.low = low;
  type.high = high;
  type.initial.assign(1, low);
  return &type;
}

const Type* Declarations::cam_ref() {
  if (cam_ref_ != nullptr) return cam_ref_;
  Type& type = new_type(Basic::structure, "MC_CAM_REF", true);
  for (const auto& [name, basic] : {std::pair{"File", Basic::string}, std::pair{"ID", Basic::uint}})
    append(type, {.name = name, .type = type_of(basic)}, type_of(basic)->initial);
  return cam_ref_ = &type;
}

const Type* Declarations::motion_type(const BlockType& block) {
  if (const auto known = motions_.find(&block); known != motions_.end()) return known->second;
  Type& type = new_type(Basic::block, std::string(block.name));
  // The first cell is the number of the block at run time.
  type.motion = &block;
  const auto instance = block.make();
  for (std::size_t i = 0; i < block.pins.size(); ++i) {
    const Pin& pin = block.pins[i];
    const PinValue value = block.pin(*instance, i);
    Variable member{.name = std::string(pin.name), .type = type_of_pin(pin, value, cam_ref())};
    member.section = pin.direction == PinDirection::input    ? VarClass::input
                     : pin.direction == PinDirection::output ? VarClass::output
                                                             : VarClass::in_out;
    std::vector<Cell> initial = member.type->initial;
    if (const auto cell = cell_of_pin(value)) initial[0] = *cell;
    append(type, std::move(member), initial);
  }
  motions_.emplace(&block, &type);
  return &type;
}

}  // namespace drycut::devices::plcopen::st
