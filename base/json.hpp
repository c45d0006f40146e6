#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace drycut {

/// Keys stay in the order in which they were put in.
using Json = nlohmann::ordered_json;

/// What a text says. Throws Json::parse_error where it is no JSON.
Json json_from(std::string_view text);
/// The same, or null where it is no JSON.
Json json_or_null(std::string_view text);
/// `indent`: of a level, or -1 for all in one line. What is no UTF-8 in a text is replaced.
std::string json_text(const Json& json, int indent = -1);

}  // namespace drycut
