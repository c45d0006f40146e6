#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/time.hpp"

namespace drycut::sim::scenario {

class Archive;

/// What `visit` shows, as YAML: maps and lists in lines of their own, unless the section says otherwise.
std::string yaml_of(const std::function<void(Archive&)>& visit);

/// A duration as a scenario writes it, exactly, in the unit that needs fewest digits: "2 ms", "1.5 s".
std::string format_time(Time time);
/// A text as a YAML value: plain where it reads back as itself, else in quotes.
std::string yaml_text(std::string_view text);
/// Always in quotes, for expressions.
std::string yaml_quoted(std::string_view text);
/// "{a: 1, b: 2}" of its entries.
std::string yaml_map(const std::vector<std::string>& entries);
/// "[a, b]"
std::string yaml_list(const std::vector<std::string>& items);

}  // namespace drycut::sim::scenario
