#pragma once
#include <string_view>

#include "devices/plcopen/st/values.hpp"

namespace drycut::devices::plcopen::st {

/// One operator between two values.
struct Operator {
  enum class Kind : std::uint8_t { logic, lazy, comparison, arithmetic, modulo, power };
  std::string_view sign;
  int level = 0;  ///< of precedence, 0 is the weakest
  Kind kind = Kind::logic;
  Op op = Op::nothing;       ///< of whole numbers and BOOL
  Op real_op = Op::nothing;  ///< of real numbers
};
/// Above it stand **, and the signs before a value.
inline constexpr int strongest_level = 6;
/// nullptr if there is none of this sign or word, any case.
const Operator* find_operator(std::string_view sign);
const Operator* find_operator(const Token& token);

/// `a sign b`; problems are told at `told`, the sign or a function's name. `wanted` is the type that the
/// context asks for, or nullptr: it decides only where the parts leave it open, for literals.
Expression binary(Values& values, std::string_view sign, const Token& told, Expression a, Expression b,
                  const Type* wanted);
/// -x, +x and NOT x.
Expression signed_value(Values& values, const Token& sign, Expression operand, const Type* wanted);
Expression complement(Values& values, const Token& sign, Expression operand, const Type* wanted);
/// How wide a literal is decides what NOT and the shifts make of it.
Expression literal_for_bits(Values& values, Expression value, const Type* wanted, const Token& function);

/// The type that both take by themselves; nullptr if there is none.
const Type* common_type(const Expression& a, const Expression& b, const Type* wanted);
/// Of a REAL functions are REAL, of LREAL LREAL; of whole numbers LREAL unless the context wants a REAL.
const Type* real_result(const Expression& value, const Type* wanted);

}  // namespace drycut::devices::plcopen::st
