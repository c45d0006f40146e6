#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

struct RegisterValue {
  RegisterName name;
  double value = 0;
  int line = 0;  ///< of the file
};

/// What is wrong with giving `value` to the register, nullopt if it takes it as it is.
std::optional<ValueFault> misfit(const RegisterName& name, double value);

/// Reads lines of name, `separator` and value: `D10,5`, `D20:L,100000`, `D30:F,1.5`, `M0,1`, `D40,H1F`.
/// Comments begin with ; or, at the beginning of a line or after a blank, #. A first line `address,value` is
/// a heading. Every fault becomes a problem, and so does a register that is given twice.
std::vector<RegisterValue> read_register_values(std::string_view text, const std::string& file,
                                                char separator, Problems& problems);

/// True if a line of the text gives a register, or is the heading `address`: it is meant for
/// read_register_values, whatever is wrong with the other lines.
bool is_register_file(std::string_view text, char separator);

}  // namespace drycut::devices::lx3vp
