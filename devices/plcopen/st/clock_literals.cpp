#include "devices/plcopen/st/clock_literals.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "devices/plcopen/st/lexer.hpp"

namespace drycut::devices::plcopen::st {
namespace {

/// The number at the beginning of `text`, up to `until`, which goes too ('\0': the end).
std::optional<std::int64_t> leading(std::string_view& text, char until) {
  const std::size_t size = until == '\0' ? text.size() : text.find(until);
  constexpr std::size_t longest = 5;
  if (size > longest) return std::nullopt;
  const auto number = parsed<std::uint32_t>(text.substr(0, size));
  text.remove_prefix(std::min(size + 1, text.size()));
  return number;
}

/// Of a TOD ms, of DATE and DT s since 1970.
std::optional<std::int64_t> day_seconds(Basic basic, std::string_view text) {
  constexpr std::int64_t day = 86400;
  std::int64_t seconds = 0;
  if (basic != Basic::tod) {
    const auto year = leading(text, '-');
    const auto month = leading(text, '-');
    const auto days = leading(text, basic == Basic::dt ? '-' : '\0');
    if (!year || !month || !days) return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year{static_cast<int>(*year)},
                                           std::chrono::month{static_cast<unsigned>(*month)},
                                           std::chrono::day{static_cast<unsigned>(*days)}};
    if (!date.ok()) return std::nullopt;
    seconds = std::chrono::sys_days(date).time_since_epoch().count() * day;
  }
  double clock = 0;
  if (basic != Basic::date) {
    const auto hours = leading(text, ':');
    const auto minutes = leading(text, text.find(':') == std::string_view::npos ? '\0' : ':');
    if (!hours || !minutes || *hours > 23 || *minutes > 59) return std::nullopt;
    const auto rest = text.empty() ? std::optional(0.0) : parsed<double>(text, std::chars_format::fixed);
    if (!rest || *rest < 0 || *rest >= 60) return std::nullopt;
    clock = static_cast<double>(*hours * 3600 + *minutes * 60) + *rest;
  }
  if (basic == Basic::tod) return std::llround(clock * 1000) % (day * 1000);
  return seconds + static_cast<std::int64_t>(clock);
}

}  // namespace

std::optional<std::int64_t> clock_number(Basic basic, std::string_view text) {
  const auto number = day_seconds(basic, text);
  const bool kept = number && *number >= 0 && *number <= std::numeric_limits<std::uint32_t>::max();
  return kept ? number : std::nullopt;
}

std::optional<std::int64_t> long_clock_number(Basic basic, std::string_view text) {
  constexpr std::int64_t second = 1'000'000'000;
  std::int64_t ns = 0;
  const std::size_t point = basic == Basic::ldate ? std::string_view::npos : text.find('.');
  if (point != std::string_view::npos) {
    const auto decimals = text.substr(point + 1);
    constexpr std::size_t most = 9;
    const auto number = parsed<std::uint32_t>(decimals);
    if (!number || decimals.size() > most) return std::nullopt;
    ns = *number;
    for (std::size_t i = decimals.size(); i < most; ++i) ns *= 10;
    text = text.substr(0, point);
  }
  const bool clock = basic == Basic::ltod;
  const auto whole = clock ? clock_number(Basic::tod, text)
                           : day_seconds(basic == Basic::ldate ? Basic::date : Basic::dt, text);
  if (!whole) return std::nullopt;
  const std::int64_t seconds = clock ? *whole / 1000 : *whole;
  constexpr std::int64_t last = std::numeric_limits<std::int64_t>::max() / second;
  if (seconds < 0 || seconds > last ||
      (seconds == last && ns > std::numeric_limits<std::int64_t>::max() % second))
    return std::nullopt;
  return seconds * second + ns;
}

std::optional<std::int64_t> nanoseconds(std::string_view text, bool& fits) {
  if (text.empty()) return std::nullopt;
  std::int64_t sum = 0;
  std::size_t largest = 0;
  while (!text.empty()) {
    const auto digits = [&text] {
      std::size_t count = 0;
      while (count < text.size() && is_digit(text[count])) ++count;
      const auto taken = text.substr(0, count);
      text.remove_prefix(count);
      return taken;
    };
    const std::string_view whole = digits();
    std::string_view decimals;
    if (text.starts_with('.')) {
      text.remove_prefix(1);
      decimals = digits();
      if (decimals.empty()) return std::nullopt;
    }
    std::size_t letters = 0;
    while (letters < text.size() && is_letter(text[letters])) ++letters;
    std::size_t unit = largest;
    while (unit < long_time_units.size() && !same_word(long_time_units[unit].name, text.substr(0, letters)))
      ++unit;
    if (whole.empty() || unit == long_time_units.size()) return std::nullopt;
    text.remove_prefix(letters);
    largest = unit + 1;
    std::int64_t ns = long_time_units[unit].ns;
    std::int64_t part = 0;
    const auto count = parsed<std::int64_t>(whole);
    fits = fits && count && !__builtin_mul_overflow(*count, ns, &part) &&
           !__builtin_add_overflow(sum, part, &sum);
    for (const char digit : decimals) {
      fits = fits && (digit == '0' || (ns > 0 && ns % 10 == 0));
      ns /= 10;
      fits = fits && !__builtin_add_overflow(sum, (digit - '0') * ns, &sum);
    }
  }
  return sum;
}

std::optional<double> milliseconds(std::string_view text) {
  if (text.empty()) return std::nullopt;
  double sum = 0;
  std::size_t largest = 0;
  while (!text.empty()) {
    double value = 0;
    if (!is_digit(text.front())) return std::nullopt;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    std::size_t letters = 0;
    while (letters < text.size() && is_letter(text[letters])) ++letters;
    std::size_t unit = largest;
    while (unit < time_units.size() && !same_word(time_units[unit].name, text.substr(0, letters))) ++unit;
    if (unit == time_units.size()) return std::nullopt;
    sum += value * static_cast<double>(time_units[unit].ms);
    largest = unit + 1;
    text.remove_prefix(letters);
  }
  return sum;
}

}  // namespace drycut::devices::plcopen::st
