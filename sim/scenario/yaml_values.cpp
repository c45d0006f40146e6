// The readers of single values: quantities, durations, numbers, words, expressions.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/expression.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

const std::vector<std::string> common_units = {
    "mm",    "um",    "cm",      "m",         "s",      "ms",     "us",     "min",   "m/min", "mm/min",
    "m/s",   "mm/s",  "m/s^2",   "rpm",       "rad/s",  "deg/s",  "deg",    "rad",   "turn",  "rev",
    "N",     "kN",    "N m",     "kg",        "g",      "kg m^2", "kg/m^3", "N/m",   "N/mm",  "N m/rad",
    "N s/m", "V",     "mV",      "V/s",       "A",      "bar",    "Hz",     "1/min", "%",     "W",
    "kW",    "count", "count/s", "N m s/rad", "kg/m^2", "rad/s^2"};

// What stands behind a number and is no unit. "0,4 mm" is how many write it.
std::string unit_remedy(const std::string& unit) {
  return did_you_mean(unit, common_units, "units are written like mm, m/min, N m, kg m^2, rpm, deg, %");
}

std::string example(std::string_view unit) { return fmt::format("for example 1 {}", unit); }

// Whatever its names mean: they are looked up later.
std::optional<Expression> compile_anything(const Text& text, std::vector<ExpressionFault>& faults) {
  static constexpr double any = 1;
  const auto resolve = [](const std::string&) { return Expression::Operand(&any); };
  return Expression::compile(text.text, resolve, {}, faults, Expression::Kind::condition, resolve);
}

}  // namespace

std::string with_decimal_point(std::string_view text) {
  const auto comma = text.find(',');
  const auto is_digit_at = [&](std::size_t at) { return at < text.size() && is_digit(text[at]); };
  if (comma == std::string_view::npos || comma == 0 || !is_digit_at(comma - 1) || !is_digit_at(comma + 1))
    return "";
  auto pointed = std::string(text);
  pointed[comma] = '.';
  const auto quantity = parse_quantity(pointed);
  return quantity && is_unit(quantity->unit) ? pointed : "";
}

void refuse_unit(const Text& text, const std::string& name, Findings& findings) {
  const auto quantity = parse_quantity(text.text);
  const auto pointed = with_decimal_point(text.text);
  const bool is_ratio = quantity->unit.starts_with(":");
  if (is_ratio && parsed<double>(std::string_view(quantity->unit).substr(1)))
    findings.add("scenario.not-a-number"_code, text.place,
                 fmt::format("{}: '{}' is a ratio of two numbers, and one is wanted", name, text.text),
                 fmt::format("write {:.6g}",
                             quantity->number / *parsed<double>(std::string_view(quantity->unit).substr(1))));
  else if (!pointed.empty())
    findings.add("scenario.not-a-number"_code, text.place,
                 fmt::format("{}: '{}' has a decimal comma", name, text.text),
                 fmt::format("write {}", pointed));
  else
    findings.add("scenario.unknown-unit"_code, text.at(quantity->unit_offset),
                 fmt::format("{}: unknown unit '{}'", name, quantity->unit), unit_remedy(quantity->unit));
}

bool needs_unit(std::string_view unit) {
  return !unit.empty() && (!same_dimension(unit, "") || to_si(1, unit) != 1);
}

std::optional<Quantity> read_quantity(const Text& text, const std::string& name, Findings& findings) {
  const auto parsed = parse_quantity(text.text);
  if (!parsed) {
    findings.add("scenario.not-a-number"_code, text.place,
                 fmt::format("{}: '{}' is not a number", name, text.text),
                 "write a number, with its unit if it has one: 0.5, 60 m/min");
    return {};
  }
  if (!is_unit(parsed->unit)) {
    refuse_unit(text, name, findings);
    return {};
  }
  return Quantity{parsed->number, parsed->unit, text.place};
}

std::optional<double> read_si(const Text& text, const std::string& name, std::string_view unit,
                              Findings& findings) {
  const auto quantity = read_quantity(text, name, findings);
  if (!quantity) return {};
  if (quantity->unit.empty()) {
    if (!needs_unit(unit)) return quantity->number;
    findings.add("scenario.wrong-unit"_code, text.place,
                 fmt::format("{}: '{}' has no unit, but this is {}", name, text.text, dimension_name(unit)),
                 fmt::format("write {} {} if that is meant", text.text, unit));
    return {};
  }
  if (!same_dimension(quantity->unit, unit)) {
    findings.add("scenario.wrong-unit"_code, text.at(parse_quantity(text.text)->unit_offset),
                 fmt::format("{} is {}, not {} ({})", name, dimension_name(unit),
                             dimension_name(quantity->unit), quantity->unit),
                 unit.empty() ? "write a number without unit" : example(unit));
    return {};
  }
  return to_si(quantity->number, quantity->unit);
}

std::optional<Time> read_time(const Text& text, const std::string& name, Sign sign, Findings& findings) {
  const auto value = read_si(text, name, "s", findings);
  if (!value) return {};
  const double exact = *value * 1e9;
  const double whole = std::round(exact);
  if (sign == Sign::positive && *value <= 0) {
    findings.add("scenario.out-of-range"_code, text.place,
                 fmt::format("{} is {}; it must be longer than 0", name, text.text), "for example 2 ms");
    return {};
  }
  if (*value < 0) {
    findings.add("scenario.out-of-range"_code, text.place,
                 fmt::format("{} is {}; it must not be negative", name, text.text), "for example 0 s");
    return {};
  }
  if (*value > 1e9) {
    findings.add("scenario.out-of-range"_code, text.place,
                 fmt::format("{} is {}; the clock ends at 1e9 s", name, text.text), "give a shorter time");
    return {};
  }
  const bool none = *value > 0 && whole == 0;
  if (none || std::abs(exact - whole) > 1e-6 + 1e-15 * exact) {
    const auto next = static_cast<Time>(std::max(1.0, whole));
    findings.add("scenario.not-a-number"_code, text.place,
                 fmt::format("{}: {} is no whole number of nanoseconds", name, text.text),
                 fmt::format("the nearest is {}", format_time(next)));
    return {};
  }
  return static_cast<Time>(whole);
}

std::optional<long long> read_integer(const Text& text, const std::string& name, long long min, long long max,
                                      Findings& findings) {
  long long number = 0;
  const char* const end = text.text.data() + text.text.size();
  const auto read = std::from_chars(text.text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end) {
    findings.add("scenario.not-a-number"_code, text.place,
                 fmt::format("{}: '{}' is not a whole number", name, text.text),
                 fmt::format("{} to {}", min, max));
    return {};
  }
  if (number < min || number > max) {
    findings.add("scenario.out-of-range"_code, text.place,
                 fmt::format("{} is {}, out of range", name, number), fmt::format("{} to {}", min, max));
    return {};
  }
  return number;
}

std::optional<bool> read_switch(const Text& text, const std::string& name, Findings& findings) {
  if (text.text == "on" || text.text == "true") return true;
  if (text.text == "off" || text.text == "false") return false;
  findings.add("scenario.unknown-choice"_code, text.place,
               fmt::format("{}: '{}' is not a switch position", name, text.text),
               "write on or off (or true, false)");
  return {};
}

bool read_choice(const Text& text, const std::string& name, const std::vector<std::string>& choices,
                 Findings& findings) {
  if (std::find(choices.begin(), choices.end(), text.text) != choices.end()) return true;
  findings.add("scenario.unknown-choice"_code, text.place,
               fmt::format("{}: unknown choice '{}'", name, text.text), did_you_mean(text.text, choices));
  return false;
}

void check_expression(const Text& text, Findings& findings) {
  std::vector<ExpressionFault> faults;
  compile_anything(text, faults);
  for (const auto& fault : faults) findings.add(fault.code, text.at(fault.offset), fault.what, fault.remedy);
}

bool has_statistics(const Text& text) {
  std::vector<ExpressionFault> ignored;
  const auto expression = compile_anything(text, ignored);
  return expression && !expression->statistics().empty();
}

}  // namespace drycut::sim::scenario
