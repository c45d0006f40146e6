#pragma once
#include <string>
#include <string_view>

namespace drycut::renders {

/// `text` with everything escaped that means something in HTML, in text and in quoted attributes; newlines
/// and tabs stay, other control characters and what is no UTF-8 are replaced.
std::string html_text(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace drycut::renders
