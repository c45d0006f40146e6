#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/references.hpp"

// What stands behind := in a declaration.
namespace drycut::devices::plcopen::st {

std::vector<Cell> Declarations::initial_value(const Type& type) {
  std::vector<Cell> cells = type.initial;
  initial_into(type, cells);
  return cells;
}

void Declarations::initial_into(const Type& type, std::span<Cell> cells) {
  switch (type.basic) {
    case Basic::array:
      refuse_open(type, peek().place);
      initial_array(type, cells);
      return;
    case Basic::structure:
    case Basic::block:
      initial_members(type, cells);
      return;
    case Basic::axis:
      give_up("st.initial-value"_code, peek().place, "an AXIS_REF has no initial value",
              "its axis comes from the configuration");
    case Basic::unknown:
      throw GiveUp{};
    case Basic::reference:
      cells[0] = initial_reference(type);
      return;
    case Basic::string:
      break;
    default:
      cells[0] = constant_value(type);
      return;
  }
  const StToken text = take();
  if (text.kind != StToken::Kind::string)
    give_up("st.initial-value"_code, text.place, "a STRING begins with a text, not " + in_quotes(text.text),
            "'text'");
  if (text.wide != type.wide)
    give_up("st.initial-value"_code, text.place, fmt::format("{} is no {}", in_quotes(text.text), type.name),
            type.wide ? "a WSTRING is written \"text\"" : "a STRING is written 'text'");
  if (const auto size = characters(text.string, type.wide); size > type.length)
    give_up("st.out-of-range"_code, text.place,
            fmt::format("{} characters do not fit in {}", size, type.name),
            fmt::format("{} at most", type.length));
  std::fill(cells.begin(), cells.end(), 0);
  std::memcpy(cells.data(), text.string.data(), text.string.size());
}

/// NULL, or REF(x) of what has its place: of a global variable, and of one of the same PROGRAM or block.
Cell Declarations::initial_reference(const Type& type) {
  const TypedExpression value = converted(expression(&type), type);
  if (value.unknown()) throw GiveUp{};
  if (value.constant && value.value == 0) return 0;
  const bool keeps = unit_->kind == Unit::Kind::program || unit_->kind == Unit::Kind::function_block;
  if (value.node >= 0 && node(value.node).op == StOp::make_reference && node(value.node).a >= 0) {
    const Node& reference = node(value.node);
    const Node& address = node(reference.a);
    const bool global = address.op == StOp::address && !unit_->framed();
    if (global) return cell_of_reference(reference.c, address.imm);
    if (address.op == StOp::address_own && keeps && in_members_ == 0) {
      refers_to_ = Variable::RefersTo{reference.c, static_cast<int>(address.imm)};
      return 0;
    }
  }
  give_up("st.initial-value"_code, value.place,
          "a reference begins with NULL, or with a variable of its own unit that is declared before it",
          "assign it by a statement: p := REF(x);");
}

void Declarations::initial_array(const Type& type, std::span<Cell> cells) {
  const Place opening = peek().place;
  // Values without brackets are as older programs have them; a member's would run into the next member.
  const bool bare = !peek().is("[") && in_members_ == 0;
  if (!bare) expect("[", fmt::format("opens the values of an {}", type.name));
  const Nested inner(in_members_);
  // A flat list has the values of all dimensions, the last one the fastest.
  const bool nested = peek().is("[") || (peek().whole() && peek(1).is("(") && peek(2).is("["));
  const Type* element = type.element;
  while (!nested && element->basic == Basic::array) element = element->element;
  const auto size = static_cast<std::size_t>(element->cells);
  const std::size_t count = cells.size() / size;
  std::size_t given = 0;
  const auto too_many = [&](Place place) {
    give_up("st.out-of-range"_code, place,
            fmt::format("more values than the {} elements of the {}", count, type.name),
            "leave the rest out");
  };
  do {
    const Place place = peek().place;
    // 4(0.5) is four times 0.5.
    if (peek().whole() && peek(1).is("(")) {
      const std::int64_t times = take().value;
      take();
      const std::size_t first = given;
      if (times < 1 || static_cast<std::uint64_t>(times) > count - given) too_many(place);
      initial_into(*element, cells.subspan(first * size, size));
      expect(")", "ends a repeated value");
      for (given = first + 1; given < first + static_cast<std::size_t>(times); ++given)
        std::copy_n(cells.begin() + static_cast<std::ptrdiff_t>(first * size), size,
                    cells.begin() + static_cast<std::ptrdiff_t>(given * size));
      continue;
    }
    if (given == count) too_many(place);
    initial_into(*element, cells.subspan(given++ * size, size));
  } while (accept(","));
  // One value alone is hardly meant for the first element.
  if (bare && given == 1 && count > 1)
    give_up("st.syntax"_code, opening, fmt::format("one value for an {}", type.name),
            fmt::format("[{}(value)] gives it to all elements", count));
  if (!bare) expect("]", "closes the values opened in " + line_of(opening));
}

void Declarations::initial_members(const Type& type, std::span<Cell> cells) {
  const Nested members(in_members_);
  expect("(", fmt::format("opens the values of a {}", type.name));
  do {
    const StToken name = expect_name("the name of a member");
    const Variable* member =
        type.basic == Basic::block ? pin_of(type, name, false) : find_member(type, name.text);
    if (member == nullptr && type.basic == Basic::block) throw GiveUp{};
    if (member == nullptr) {
      const std::vector<std::string> names = names_of(type.members);
      give_up("st.unknown-name"_code, name.place,
              fmt::format("{} has no member {}", type.name, in_quotes(name.text)),
              suggestion(name.text, names, "it has " + listed(names)));
    }
    if (member->section == VarClass::in_out)
      give_up("st.initial-value"_code, name.place, in_quotes(name.text) + " has no initial value",
              "it is connected in a call");
    expect(":=", "stands between a member and its value");
    if (&type == cam_ref_ && member == type.members.data()) cam_file(peek());
    initial_into(*member->type, cells.subspan(static_cast<std::size_t>(member->offset),
                                              static_cast<std::size_t>(member->type->cells)));
  } while (accept(","));
  expect(")", "ends the values");
}

Cell Declarations::constant_value(const Type& wanted, const char* what, const char* remedy,
                                  bool (*takes)(Basic)) {
  const Place place = peek().place;
  TypedExpression value = expression(&wanted);
  if (value.unknown()) throw GiveUp{};
  if (is_character(wanted.basic) && value.string) value = converted(std::move(value), wanted);
  if (value.unknown()) throw GiveUp{};
  if (!value.constant || !takes(value.type->basic)) give_up("st.initial-value"_code, place, what, remedy);
  const std::size_t before = told();
  value = converted(value, wanted);
  if (told() != before) throw GiveUp{};
  return value.on_the_way ? taken_as(value, value.type->basic).value : value.value;
}

Declarations::LaterConstants Declarations::constants_of(const Unit& unit) const {
  LaterConstants constants;
  for (std::size_t i = unit.first; i < unit.end; ++i) {
    if (tokens_[i].word("METHOD") || tokens_[i].word("PROPERTY") || tokens_[i].word("ACTION")) break;
    if (!tokens_[i].word("CONSTANT")) continue;
    // a, b : INT := 3; VAR_EXTERNAL has no value.
    std::vector<std::string> names;
    std::size_t colon = 0;
    for (++i; i < unit.end && !tokens_[i].word("END_VAR"); ++i) {
      const StToken& token = tokens_[i];
      if (token.is(";")) {
        names.clear();
        colon = 0;
      } else if (token.is(":=") && colon > 0) {
        for (const std::string& name : names) constants.emplace(name, LaterConstant{colon, false, {}});
        names.clear();
      } else if (token.is(":") && colon == 0) {
        colon = i;
      } else if (token.kind == StToken::Kind::name && colon == 0) {
        names.push_back(lower(token.text));
      }
    }
  }
  return constants;
}

std::optional<TypedExpression> Declarations::later_constant(const StToken& name) {
  constexpr int deepest = 40;
  if (unit_->state != Unit::State::open || unit_->type == nullptr || unit_->type == globals_)
    return std::nullopt;
  auto known = later_constants_.find(unit_);
  if (known == later_constants_.end()) known = later_constants_.emplace(unit_, constants_of(*unit_)).first;
  const auto found = known->second.find(lower(name.text));
  if (found == known->second.end() || found->second.open || later_ >= deepest) return std::nullopt;
  LaterConstant& constant = found->second;
  if (!constant.value) {
    const Nested inner(later_);
    const std::size_t before = at_;
    constant.open = true;
    at_ = constant.at + 1;
    constant.value = unknown_at(name.place);
    try {
      const Type* type = parse_type();
      if (accept(":=") && is_elementary(type->basic))
        constant.value = st::constant(type, constant_value(*type), name.place);
    } catch (const GiveUp&) {  // told, and told of the name once more where it is declared
    }
    constant.open = false;
    at_ = before;
  }
  TypedExpression value = *constant.value;
  value.place = name.place;
  value.locked = "is a constant";
  value.name = name.text;
  return value;
}

std::int64_t Declarations::constant_integer(std::string_view what, const Type* wanted) {
  const Place place = peek().place;
  const TypedExpression value = expression(wanted);
  if (value.unknown()) throw GiveUp{};
  if (!value.constant || !is_integer(value.type->basic))
    give_up("st.type"_code, place, fmt::format("{} is not a constant whole number", what),
            "give a literal or a VAR CONSTANT of integers");
  if (wanted != nullptr) return literal_as(value, *wanted).value;
  if (value.value < 0 && is_wide(value.type->basic))
    give_up("st.out-of-range"_code, place, fmt::format("{} {} is too large", what, whole_text(value)),
            "it goes to 9223372036854775807");
  return value.value;
}

}  // namespace drycut::devices::plcopen::st
