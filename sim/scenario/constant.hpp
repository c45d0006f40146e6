#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/expression.hpp"

namespace drycut::sim::scenario {

/// What a text is, seen as arithmetic over quantities: "800 mm / 2 + 3 mm".
struct Constant {
  enum class Kind {
    value,      ///< arithmetic alone; `faults` says where units do not fit
    condition,  ///< the same with a comparison
    formula,    ///< an expression with names in it
    text        ///< none
  };
  Kind kind = Kind::text;
  std::string value = {};  ///< "403 mm"; a number without unit is a pure number
  std::vector<ExpressionFault> faults = {};
};
Constant read_constant(std::string_view text);

}  // namespace drycut::sim::scenario
