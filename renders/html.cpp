#include "renders/html.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "base/json.hpp"
#include "base/text.hpp"
#include "renders/text.hpp"

namespace drycut::renders {

std::string html_text(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size() + text.size() / 16);
  const auto append = [&](std::string_view piece) { escaped += xml_text(one_line(piece)); };
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\n' && text[i] != '\t') continue;
    append(text.substr(begin, i - begin));
    escaped += text[i];
    begin = i + 1;
  }
  append(text.substr(begin));
  return escaped;
}

std::string safe_in_script(const Json& json) {
  // Signs that could end the script element stand in strings only, and are escaped there.
  std::string text;
  for (const char c : json_text(json)) {
    if (c == '<' || c == '>' || c == '&')
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      text += c;
  }
  return text;
}

std::string link_address(std::string_view path) {
  std::string text;
  for (const char c : path) {
    const bool keeps =
        is_letter(c) || is_digit(c) || std::string_view("-._~/").find(c) != std::string_view::npos;
    text += keeps ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U;
    };
    const std::uint32_t three = byte(0) << 16U | byte(1) << 8U | byte(2);
    text += kDigits[three >> 18U & 63U];
    text += kDigits[three >> 12U & 63U];
    text += i + 1 < bytes.size() ? kDigits[three >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? kDigits[three & 63U] : '=';
  }
  return text;
}

}  // namespace drycut::renders
