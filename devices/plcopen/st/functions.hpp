#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "devices/plcopen/st/values.hpp"

// The standard functions of IEC 61131-3, operators as functions among them, and conversions.
namespace drycut::devices::plcopen::st {

/// What an argument means, where the context asks for a type.
using Typed = std::function<Expression(const Tree& argument, const Type* wanted)>;
/// The call of the function `name`; nothing if there is none of this name, any case. Gives up what does not
/// fit its inputs.
std::optional<Expression> standard_call(Values& values, const Token& name, const std::vector<Argument>& given,
                                        const Type* wanted, const Typed& typed);
std::vector<std::string> standard_function_names();

}  // namespace drycut::devices::plcopen::st
