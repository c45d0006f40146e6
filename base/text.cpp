#include "base/text.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include <fmt/format.h>

namespace drycut {

namespace {

// The C library's versions depend on the locale and are undefined for bytes above 127.
char lower_char(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
char upper_char(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

std::string question(const std::string& name) { return "did you mean " + name + "?"; }

/// The first candidate of which `word` is the end: knife.length for length.
std::string longer(std::string_view word, const std::vector<std::string>& candidates) {
  const auto dotted = "." + std::string(word);
  for (const auto& candidate : candidates)
    if (!word.empty() && candidate.ends_with(dotted)) return candidate;
  return {};
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), lower_char);
  return result;
}

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), upper_char);
  return result;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower_char(x) == lower_char(y); });
}

bool is_letter(char c) { return (lower_char(c) >= 'a' && lower_char(c) <= 'z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool in_name(char c) { return is_letter(c) || is_digit(c); }

bool is_identifier(std::string_view text) {
  return !text.empty() && is_letter(text.front()) && std::all_of(text.begin(), text.end(), in_name);
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

Words split_words(std::string_view line, Place begin, std::string_view gaps) {
  Words words;
  for (std::size_t at = line.find_first_not_of(gaps); at < line.size();) {
    const std::size_t end = std::min(line.find_first_of(gaps, at), line.size());
    words.push_back(
        {std::string(line.substr(at, end - at)), {begin.line, begin.column + static_cast<int>(at)}});
    at = line.find_first_not_of(gaps, end);
  }
  return words;
}

std::string counted(std::int64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result = "'";
  for (const char c : text.substr(0, longest)) {
    if (c >= ' ' && c <= '~')
      result += c;
    else
      result += fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
  }
  return result + (text.size() > longest ? "...'" : "'");
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         const std::string& otherwise) {
  std::string near = nearest(std::string(word), candidates);
  if (near.empty()) near = longer(word, candidates);
  return near.empty() ? otherwise : question(near);
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  return did_you_mean(word, candidates,
                      candidates.empty() ? "nothing can stand here" : "known: " + listed(candidates));
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates,
                       const std::string& otherwise) {
  constexpr std::size_t longest_name = 64;
  const std::string near = word.size() > longest_name ? "" : nearest(std::string(word), candidates);
  return near.empty() ? otherwise : question(in_quotes(near));
}

std::string listed(const std::vector<std::string>& items) {
  return fmt::format("{}", fmt::join(items, ", "));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return text.substr(0, 0);
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view without_byte_order_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

std::string xml_text(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size() + text.size() / 16);
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

void sort_from(Problems& problems, std::size_t first) {
  std::stable_sort(problems.begin() + static_cast<std::ptrdiff_t>(first), problems.end(),
                   [](const Problem& a, const Problem& b) {
                     return std::tie(a.line, a.column) < std::tie(b.line, b.column);
                   });
}

SourceLines::SourceLines(std::span<const SourceFile> files) {
  for (const auto& [name, text] : files) {
    begins_.push_back(end_);
    names_.push_back(name);
    end_ += static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
  }
}

SourceLines::At SourceLines::at(int line) const {
  const auto next = std::upper_bound(begins_.begin(), begins_.end(), line);
  if (next == begins_.begin()) return {0, line};
  return {static_cast<std::size_t>(next - begins_.begin()) - 1, line - *std::prev(next) + 1};
}

std::string SourceLines::told(int line, int seen_from) const {
  const auto [file, own] = at(line);
  if (names_.empty() || file == at(seen_from).file) return fmt::format("line {}", own);
  return fmt::format("line {} of {}", own, names_[file]);
}

}  // namespace drycut
