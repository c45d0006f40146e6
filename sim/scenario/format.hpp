#pragma once
#include <string>
#include <string_view>

#include "sim/time.hpp"

namespace drycut::sim {

/// A duration as a scenario writes it, exactly, in the unit that needs fewest digits: "2 ms", "1.5 s".
std::string format_time(Time time);
/// A text as a YAML value: plain where it reads back as itself, else in quotes.
std::string yaml_text(std::string_view text);
/// Always in quotes, for expressions.
std::string yaml_quoted(std::string_view text);

}  // namespace drycut::sim
