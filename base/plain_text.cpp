#include "base/plain_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drycut {

namespace {

unsigned byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
}

bool is_control(std::string_view text, std::size_t at) {
  const auto byte = byte_at(text, at);
  return byte < 0x20 || byte == 0x7F || (byte == 0xC2 && byte_at(text, at + 1) < 0xA0);
}

}  // namespace

std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto first = byte_at(text, at);
  if (first < 0x80) return at < text.size() ? 1 : 0;
  const std::size_t length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte_at(text, at + i) & 0xC0) != 0x80) return 0;
  const auto second = byte_at(text, at + 1);
  const bool longer_than_needed = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool surrogate = first == 0xED && second >= 0xA0;
  const bool beyond = first == 0xF4 && second >= 0x90;
  return longer_than_needed || surrogate || beyond ? 0 : length;
}

std::optional<TextFault> text_fault(std::string_view text) {
  constexpr std::string_view harmless = "\t\n\r";
  TextFault fault;
  for (std::size_t at = 0; at < text.size();) {
    const auto length = utf8_length(text, at);
    const bool harms = is_control(text, at) && harmless.find(text[at]) == std::string_view::npos;
    if (length == 0 || harms) {
      fault.what = length < 2 ? fmt::format("byte 0x{:02x} is no text", byte_at(text, at))
                              : fmt::format("U+{:04X} is no text", byte_at(text, at + 1));
      return fault;
    }
    ++fault.column;
    if (text[at] == '\n') fault = {fault.line + 1, 1, ""};
    at += length;
  }
  return {};
}

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const auto length = utf8_length(text, at);
    if (length == 0 || is_control(text, at)) {
      for (std::size_t i = 0; i < std::max<std::size_t>(length, 1); ++i)
        shown += fmt::format("\\x{:02X}", byte_at(text, at + i));
    } else {
      shown += text.substr(at, length);
    }
    at += std::max<std::size_t>(length, 1);
  }
  return shown;
}

std::string shell_word(std::string_view text) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./,:=@%+").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return std::string(text);
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

}  // namespace drycut
