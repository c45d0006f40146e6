#include "base/json.hpp"

namespace drycut {

// Here alone: each file that reads or writes JSON by itself is a second longer to compile.
Json json_from(std::string_view text) { return Json::parse(text); }

Json json_or_null(std::string_view text) {
  auto json = Json::parse(text, nullptr, false);
  return json.is_discarded() ? Json() : json;
}

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace drycut
