#include "devices/plcopen/st/code.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>

#include <fmt/format.h>

#include "devices/plcopen/st/lexer.hpp"

namespace drycut::devices::plcopen::st {
namespace {

/// A number of characters, or a place, as one that the text has.
std::size_t within(Cell number, std::size_t most) {
  return static_cast<std::size_t>(std::clamp<Cell>(number, 0, static_cast<Cell>(most)));
}

std::string time_text(Cell ms) {
  std::string text = ms < 0 ? "T#-" : "T#";
  ms = ms < 0 ? -ms : ms;
  for (const TimeUnit& unit : time_units) {
    if (ms >= unit.ms) text += fmt::format("{}{}", ms / unit.ms, unit.name);
    ms %= unit.ms;
  }
  return text.size() > 2 ? text : "T#0ms";
}

std::string long_time_text(Cell ns) {
  if (ns == 0) return "LTIME#0ns";
  std::string text = ns < 0 ? "LTIME#-" : "LTIME#";
  auto rest = ns < 0 ? 0 - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  for (const LongTimeUnit& unit : long_time_units) {
    const auto size = static_cast<std::uint64_t>(unit.ns);
    if (rest >= size) text += fmt::format("{}{}", rest / size, unit.name);
    rest %= size;
  }
  return text;
}

std::string date_text(Cell seconds) {
  // The day of a moment before 1970 has begun before it.
  const std::chrono::sys_days day =
      std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds(std::chrono::seconds(seconds)));
  const std::chrono::year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

std::string clock_text(Cell seconds) {
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600 % 24, seconds / 60 % 60, seconds % 60);
}

/// Of an LTOD or LDT; before 1970 it counts from the midnight before.
std::string long_clock_text(Cell ns) {
  constexpr Cell second = 1'000'000'000;
  constexpr Cell day = 86400 * second;
  const Cell of_day = (ns % day + day) % day;
  return fmt::format("{}.{:09}", clock_text(of_day / second), of_day % second);
}
Cell whole_seconds(Cell ns) {
  constexpr Cell second = 1'000'000'000;
  return ns / second - (ns % second < 0 ? 1 : 0);
}

Cell time_value(Basic basic, std::string_view text) {
  Problems problems;
  const std::vector<StToken> tokens = tokens_of(text, "", problems);
  const Basic written = basic == Basic::signed_time ? Basic::time : basic;
  const Cell value =
      tokens[0].kind == StToken::Kind::number && tokens[0].basic == written ? tokens[0].value : 0;
  return wrapped(basic, value) == value ? value : 0;
}

/// A character's UTF-8.
std::string wide_text(Cell character) {
  const auto code = static_cast<unsigned>(character);
  const auto byte = [](unsigned bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xC0U | code >> 6), byte(0x80U | (code & 0x3FU))};
  return {byte(0xE0U | code >> 12), byte(0x80U | (code >> 6 & 0x3FU)), byte(0x80U | (code & 0x3FU))};
}

/// The first character of a UTF-8 text; what a WCHAR does not hold is U+FFFD.
Cell wide_value(std::string_view text) {
  const auto byte = [&](std::size_t at) {
    return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return static_cast<Cell>(first);
  if (first < 0xE0) return static_cast<Cell>((first & 0x1FU) << 6 | (byte(1) & 0x3FU));
  if (first < 0xF0)
    return static_cast<Cell>((first & 0x0FU) << 12 | (byte(1) & 0x3FU) << 6 | (byte(2) & 0x3FU));
  return 0xFFFD;
}

}  // namespace

std::string edited(TextOp op, std::span<const std::string_view> texts, std::span<const Cell> numbers) {
  const std::string_view text = texts[0];
  const std::size_t size = text.size();
  const std::size_t length = op == TextOp::concat || op == TextOp::insert ? 0 : within(numbers[0], size);
  switch (op) {
    case TextOp::left:
      return std::string(text.substr(0, length));
    case TextOp::right:
      return std::string(text.substr(size - length));
    case TextOp::mid: {
      const std::size_t begin = within(numbers[1] - 1, size);
      return std::string(text.substr(begin, length));
    }
    case TextOp::insert: {
      const std::size_t behind = within(numbers[0], size);
      return std::string(text.substr(0, behind)) + std::string(texts[1]) + std::string(text.substr(behind));
    }
    case TextOp::erase:
    case TextOp::replace: {
      const std::size_t begin = within(numbers[1] - 1, size);
      const std::string_view put = op == TextOp::replace ? texts[1] : std::string_view();
      return std::string(text.substr(0, begin)) + std::string(put) +
             std::string(text.substr(begin + std::min(length, size - begin)));
    }
    default: {
      std::string all;
      for (const std::string_view part : texts) all += part;
      return all;
    }
  }
}

std::size_t characters(std::string_view text, bool wide) {
  if (!wide) return text.size();
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string_view first_characters(std::string_view text, std::size_t count) {
  std::size_t at = 0;
  for (; at < text.size(); ++at)
    if ((static_cast<unsigned char>(text[at]) & 0xC0U) != 0x80U && count-- == 0) break;
  return text.substr(0, at);
}

std::vector<Cell> in_bytes(TextOp op, std::string_view text, std::span<const Cell> numbers) {
  const std::size_t all = characters(text, true);
  const auto bytes = [&](Cell count) {
    return static_cast<Cell>(first_characters(text, within(count, all)).size());
  };
  if (numbers.empty()) return {};
  const Cell count = numbers[0];
  if (op == TextOp::left || op == TextOp::insert) return {bytes(count)};
  if (op == TextOp::right)
    return {static_cast<Cell>(text.size()) - bytes(static_cast<Cell>(all - within(count, all)))};
  const Cell begin = static_cast<Cell>(within(numbers[1] - 1, all));
  return {bytes(begin + static_cast<Cell>(within(count, all))) - bytes(begin), bytes(begin) + 1};
}

Cell found(std::string_view text, std::string_view wanted) {
  const std::size_t at = wanted.empty() ? std::string_view::npos : text.find(wanted);
  return at == std::string_view::npos ? 0 : static_cast<Cell>(at) + 1;
}

std::string text_of(Basic basic, Cell value) {
  switch (basic) {
    case Basic::boolean:
      return value != 0 ? "TRUE" : "FALSE";
    case Basic::real:
      return fmt::format("{}", static_cast<float>(real_of(value)));
    case Basic::lreal:
      return fmt::format("{}", real_of(value));
    case Basic::ulint:
    case Basic::lword:
      return fmt::format("{}", static_cast<std::uint64_t>(value));
    case Basic::time:
    case Basic::signed_time:
      return time_text(value);
    case Basic::ltime:
      return long_time_text(value);
    case Basic::ltod:
      return "LTOD#" + long_clock_text(value);
    case Basic::ldate:
      return "LDATE#" + date_text(whole_seconds(value));
    case Basic::ldt:
      return fmt::format("LDT#{}-{}", date_text(whole_seconds(value)), long_clock_text(value));
    case Basic::character:
      return value == 0 ? "" : std::string(1, static_cast<char>(value));
    case Basic::wide_character:
      return value == 0 ? "" : wide_text(value);
    case Basic::tod:
      return fmt::format("TOD#{}.{:03}", clock_text(value / 1000), value % 1000);
    case Basic::date:
      return "D#" + date_text(value);
    case Basic::dt:
      return fmt::format("DT#{}-{}", date_text(value), clock_text(value));
    default:
      return fmt::format("{}", value);
  }
}

Cell value_of(Basic basic, std::string_view text) {
  if (is_clock(basic)) return time_value(basic, text);
  if (basic == Basic::character) return text.empty() ? 0 : static_cast<unsigned char>(text.front());
  if (basic == Basic::wide_character) return wide_value(text);
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  if (text.starts_with('+')) text.remove_prefix(1);
  if (basic == Basic::boolean) return same_word(text, "TRUE") || text == "1" ? 1 : 0;
  // What is no number, or out of range, stays 0.
  const auto number = [&](auto value) {
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
  };
  if (is_real(basic)) return cell_of(rounded(basic, number(0.0)));
  if (is_wide(basic)) return static_cast<Cell>(number(std::uint64_t{0}));
  return wrapped(basic, number(std::int64_t{0}));
}

}  // namespace drycut::devices::plcopen::st
