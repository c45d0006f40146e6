#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/plcopen/st/values.hpp"

namespace drycut::devices::plcopen::st {

/// Inputs by their names, second names of CODESYS behind '|'; more of them are IN`more`, IN`more + 1` ...
struct InputNames {
  std::array<std::string_view, 4> fixed{};
  int more = -1;
};

struct StandardCall;
struct StandardFunction {
  std::string_view name;
  TypedExpression (StandardCall::*meaning)() = nullptr;
  std::size_t least = 1;  ///< number of inputs
  std::size_t most = 1;
  InputNames inputs{{"IN"}};
  std::string_view sign{};  ///< of an operator
  StOp op = StOp::nothing;
  Basic to = Basic::unknown;
  TextOp text = TextOp::left;
};

/// A call of a standard function: its inputs in their order, none of them unknown.
struct StandardCall {
  Values& values;
  const StandardFunction& function;
  const StToken& name;
  std::vector<TypedExpression> inputs;
  const Type* wanted;

  [[nodiscard]] Place place() const { return name.place; }
  [[nodiscard]] Basic basic(std::size_t input) const { return inputs[input].type->basic; }

  /// Tells that the function does not take the value.
  TypedExpression refused(const TypedExpression& value, std::string takes);

  /// The sign between the inputs, from the left.
  TypedExpression chain();

  /// The sign holds between each input and the next.
  TypedExpression ordered();

  /// MOVE.
  TypedExpression same();

  TypedExpression complemented() { return complement(values, name, inputs[0], wanted); }

  /// Bits of the first moved by the second.
  TypedExpression shift();

  [[nodiscard]] const TypedExpression* no_number() const;

  /// What they refuse as bits, if anything is.
  [[nodiscard]] const TypedExpression* bits_of_iec() const;

  TypedExpression absolute();

  /// Of one or two real numbers.
  TypedExpression real();

  using Inputs = std::vector<TypedExpression>;

  /// As values of one type; nothing, and told, if there is none.
  std::optional<Inputs> to_common(const Inputs& given);

  /// Likewise of what a program chooses among: texts too.
  std::optional<Inputs> to_chosen(const Inputs& given);

  TypedExpression extreme(const Inputs& given, StOp whole, StOp real);
  TypedExpression smallest_of(const Inputs& given);
  TypedExpression largest_of(const Inputs& given);
  TypedExpression smallest() { return smallest_of(inputs); }
  TypedExpression largest() { return largest_of(inputs); }

  TypedExpression limit();

  /// The type of values of one type; of texts, which are of different lengths, the longest.
  [[nodiscard]] const Type* chosen_type(const Inputs& given) const;

  TypedExpression select();

  TypedExpression multiplex();

  std::vector<int> nodes_of(const Inputs& given);

  /// Texts, and numbers behind them.
  TypedExpression text();

  TypedExpression text_value(TextOp op, const Type* number, bool wide_result = false);

  /// CONCAT_DATE_TOD, and of long ones.
  TypedExpression moment();

  /// TRUNC, FLOOR and CEIL give what the context wants.
  TypedExpression truncated();

  /// TIME(), LTIME().
  TypedExpression clock();

  /// IS_VALID, IS_VALID_BCD.
  TypedExpression valid();

  /// TO_BIG_ENDIAN and the like: a number here has its lowest byte first.
  TypedExpression in_byte_order();

  /// X_TO_Y.
  TypedExpression converted(const Type& target);
};

}  // namespace drycut::devices::plcopen::st
