#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/json.hpp"

namespace drycut::renders {

/// `text` with everything escaped that means something in HTML, in text and in quoted attributes; newlines
/// and tabs stay, other control characters and what is no UTF-8 are replaced.
std::string html_text(std::string_view text);

/// `json` for a script element, which nothing in it can end; what is no UTF-8 is replaced.
std::string safe_in_script(const Json& json);

/// A path as the address of a link: what is no letter, digit or one of -._~/ is percent-encoded (RFC 3986).
std::string link_address(std::string_view path);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace drycut::renders
