#include "sim/scenario/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <memory>
#include <mutex>

#include "sim/scenario/everyday_units.hpp"
#include "sim/scenario/unit_table.hpp"

namespace drycut::sim::scenario {

namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

// UDUNITS reads numbers, offsets and logarithms anywhere in a unit ("5 10 mm" would be 50 mm). Here a number
// is an exponent, or the 1 of "1/min".
bool well_formed(std::string_view text) {
  if (text.starts_with("1/")) text.remove_prefix(1);
  char before = ' ';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const auto byte = static_cast<unsigned char>(c);
    if (std::isdigit(byte) != 0) {
      const bool exponent = std::isalpha(static_cast<unsigned char>(before)) != 0 || before == '^' ||
                            (before == '-' && i > 1 && text[i - 2] != ' ') ||
                            std::isdigit(static_cast<unsigned char>(before)) != 0;
      if (!exponent) return false;
    } else if (std::isalpha(byte) == 0 && byte < 0x80 &&
               std::string_view(" /*.^-()%").find(c) == std::string_view::npos) {
      return false;
    }
    before = c;
  }
  for (const std::string_view word : {" since ", " after ", " from ", " ref ", "lg(", "ln(", "lb("}) {
    if (text.find(word) != std::string_view::npos) return false;
  }
  return text.empty() || (text.front() != ' ' && text.back() != ' ' && text.front() != '-');
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// "lb in" and "oz-in s2" with the forces that they mean: "lbf in", "ozf-in s2". A length squared ("lb in2")
// leaves the mass, and so does a time below the line, where "lb ft/s2" is a force already.
std::string with_forces(std::string_view text) {
  const auto line = text.find('/');
  const auto above = text.substr(0, line);
  const auto is_letter = [&](std::size_t i) {
    return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0;
  };
  std::size_t pound = text.size();
  std::size_t pound_end = 0;
  bool beside_length = false;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (is_letter(end)) ++end;
    const auto word = text.substr(i, end - i);
    const bool powered =
        end < text.size() && (text[end] == '^' || std::isdigit(static_cast<unsigned char>(text[end])) != 0);
    if (i >= above.size()) {
      if (is_one_of(word, {"s", "sec", "second", "min", "minute"})) return std::string(text);
    } else if (!powered &&
               is_one_of(word, {"lb", "lbs", "pound", "pounds", "oz", "ozs", "ounce", "ounces"})) {
      pound = i;
      pound_end = end;
    } else if (!powered && is_one_of(word, {"in", "inch", "inches", "ft", "foot", "feet"})) {
      beside_length = true;
    }
    i = std::max(end, i + 1);
  }
  if (pound == text.size() || !beside_length) return std::string(text);
  return fmt::format("{}{}{}", text.substr(0, pound), text[pound] == 'o' ? "ozf" : "lbf",
                     text.substr(pound_end));
}

std::string& carried_units() {
  static std::string file;
  return file;
}

// Libraries of FMUs that lie in several folders have a table of their own each and share the one UDUNITS that
// is loaded, whose reader of XML keeps its state in statics: a lock that all of them have, the C library's of
// stderr.
class UnitsOfProcess {
 public:
  UnitsOfProcess() { flockfile(stderr); }
  ~UnitsOfProcess() { funlockfile(stderr); }
  UnitsOfProcess(const UnitsOfProcess&) = delete;
  UnitsOfProcess& operator=(const UnitsOfProcess&) = delete;
};

// The table of UDUNITS, loaded once (5 ms). UDUNITS is not safe for several threads, hence one lock over all.
class UnitTable {
 public:
  UnitTable() {
    const UnitsOfProcess alone;
    ut_set_error_message_handler(ut_ignore);
    system_ = ut_read_xml(carried_units().empty() ? nullptr : carried_units().c_str());
    if (system_ == nullptr) return;
    add("deg", "degree");
    add("rev", "revolution");
    add("revs", "revolution");
    add("turns", "turn");
    add("Nm", "N m");
    add("kNm", "kN m");
    add("mNm", "mN m");
    add("Ncm", "N cm");
    // In UDUNITS alone an oz is a volume, and ozf, slug and hp have six digits.
    add("oz", "lb/16");
    add("ozs", "lb/16");
    add("ounce", "lb/16");
    add("ounces", "lb/16");
    add("lbs", "lb");
    add("ozf", "lbf/16");
    add("lbsf", "lbf");
    for (const char* power : {"hp", "HP", "Hp"}) add(power, "550 foot lbf/second");
    add("slug", "lbf second2/foot");
    add("ips", "inch/second");
    add("fpm", "foot/minute");
    for (const char* counted : {"line", "lines", "piece", "pieces", "cut", "cuts", "pulse", "pulses", "blade",
                                "blades", "bit", "bits"}) {
      add(counted, "1");
    }
  }
  UnitTable(const UnitTable&) = delete;
  UnitTable& operator=(const UnitTable&) = delete;
  ~UnitTable() {
    const UnitsOfProcess alone;
    ut_free_system(system_);
  }

  std::optional<Conversion> find(std::string_view unit) {
    const std::scoped_lock lock(mutex_);
    if (const auto known = known_.find(unit); known != known_.end()) return known->second;
    const UnitsOfProcess alone;
    auto conversion = convert(unit);
    if (conversion) known_.emplace(unit, *conversion);
    return conversion;
  }

 private:
  void add(const char* name, const char* meaning) {
    const Unit unit(ut_parse(system_, meaning, UT_UTF8));
    ut_map_name_to_unit(name, UT_ASCII, unit.get());
  }

  std::optional<Conversion> convert(std::string_view text) const {
    if (system_ == nullptr || text.size() > 60 || !well_formed(text)) return {};
    const Unit unit(ut_parse(system_, with_forces(text).c_str(), UT_UTF8));
    if (!unit) return {};
    std::array<char, 256> definition{};
    const int length =
        ut_format(unit.get(), definition.data(), definition.size() - 1, UT_ASCII | UT_DEFINITION);
    if (length < 0 || length >= static_cast<int>(definition.size()) - 1) return {};
    Conversion result;
    result.dimension = dimension_of(std::string(definition.data()));
    const Unit base(ut_parse(system_, result.dimension.empty() ? "1" : result.dimension.c_str(), UT_UTF8));
    if (!base || ut_are_convertible(unit.get(), base.get()) == 0) return {};
    const std::unique_ptr<cv_converter, void (*)(cv_converter*)> converter(
        ut_get_converter(unit.get(), base.get()), cv_free);
    if (!converter) return {};
    result.offset = cv_convert_double(converter.get(), 0);
    result.factor = cv_convert_double(converter.get(), 1) - result.offset;
    if (!std::isfinite(result.factor) || result.factor == 0 || !std::isfinite(result.offset)) return {};
    const double inverse = std::round(1 / result.factor);
    if (result.factor < 1 && std::abs(inverse * result.factor - 1) < 1e-12) {
      result.factor = 1;
      result.divisor = inverse;
    }
    return result;
  }

  // "0.0166667 m.s-1" -> "m.s-1", "K @ 273.15" -> "K", "0.01 1" and "1" -> "".
  static std::string dimension_of(std::string definition) {
    if (const auto offset = definition.find(" @"); offset != std::string::npos) definition.resize(offset);
    if (const auto factor = definition.find(' '); factor != std::string::npos) {
      definition.erase(0, factor + 1);
    }
    return definition == "1" ? "" : definition;
  }

  std::mutex mutex_;
  ut_system* system_ = nullptr;
  std::map<std::string, Conversion, std::less<>> known_;
};

std::optional<Conversion> find(std::string_view unit) {
  const auto everyday = std::ranges::lower_bound(everyday_units, unit, {}, &EverydayUnit::unit);
  if (everyday != everyday_units.end() && everyday->unit == unit)
    return Conversion{everyday->factor, everyday->divisor, everyday->offset,
                      std::string(everyday->dimension)};
  return udunits_conversion(unit);
}

struct NamedUnit {
  std::string_view unit;
  std::string_view name;
};
constexpr std::array<NamedUnit, 27> dimension_names = {{
    {"", "a pure number"},
    {"m", "a length"},
    {"m^2", "an area"},
    {"m^3", "a volume"},
    {"s", "a time"},
    {"1/s", "a frequency"},
    {"m/s", "a speed"},
    {"m/s^2", "an acceleration"},
    {"m/s^3", "a jerk"},
    {"rad", "an angle"},
    {"rad/s", "a rotational speed"},
    {"rad/s^2", "an angular acceleration"},
    {"kg", "a mass"},
    {"kg/m^3", "a density"},
    {"kg/m^2", "a mass per area"},
    {"kg m^2", "an inertia"},
    {"N", "a force"},
    {"N m", "a torque"},
    {"N/m", "a stiffness"},
    {"N s/m", "a damping"},
    {"N m/rad", "a torsional stiffness"},
    {"N m s/rad", "a torsional damping"},
    {"Pa", "a pressure"},
    {"W", "a power"},
    {"V", "a voltage"},
    {"A", "a current"},
    {"K", "a temperature"},
}};

}  // namespace

std::optional<Conversion> udunits_conversion(std::string_view unit) {
  static UnitTable table;
  return table.find(unit);
}

void read_units_from(const std::filesystem::path& xml) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  if (carried_units().empty()) carried_units() = xml.string();
}

bool is_unit(std::string_view unit) { return find(unit).has_value(); }

double to_si(double number, std::string_view unit) {
  const auto conversion = find(unit).value();
  return number * conversion.factor / conversion.divisor + conversion.offset;
}

double from_si(double si, std::string_view unit) {
  const auto conversion = find(unit).value();
  return (si - conversion.offset) * conversion.divisor / conversion.factor;
}

bool same_dimension(std::string_view a, std::string_view b) {
  const auto first = find(a);
  const auto second = find(b);
  return first && second && first->dimension == second->dimension;
}

std::string si_unit(std::string_view unit) { return find(unit).value().dimension; }

std::string readable_si(std::string_view unit) {
  for (const auto& [known, name] : dimension_names)
    if (same_dimension(unit, known)) return std::string(known);
  return si_unit(unit);
}

std::string dimension_name(std::string_view unit) {
  if (unit == "%") return "a percentage";
  for (const auto& [known, name] : dimension_names) {
    if (same_dimension(unit, known)) return std::string(name);
  }
  return fmt::format("a quantity in {}", unit);
}

std::optional<ParsedQuantity> parse_quantity(std::string_view text) {
  const char* const end = text.data() + text.size();
  const char* start = text.data();
  if (text.starts_with("+") && !text.starts_with("+-")) ++start;
  const char* const digits = start != end && *start == '-' ? start + 1 : start;
  // from_chars would take "inf" and "nan" too.
  if (digits == end || (std::isdigit(static_cast<unsigned char>(*digits)) == 0 && *digits != '.')) return {};
  ParsedQuantity result;
  const auto read = std::from_chars(start, end, result.number);
  if (read.ec != std::errc() || !std::isfinite(result.number)) return {};
  const char* unit = read.ptr;
  while (unit != end && *unit == ' ') ++unit;
  const char* last = end;
  while (last != unit && last[-1] == ' ') --last;
  result.unit_offset = static_cast<std::size_t>(unit - text.data());
  result.unit.assign(unit, last);
  return result;
}

std::string format_quantity(double si, std::string_view unit) {
  const double number = from_si(si, unit);
  const std::string space = unit.empty() ? "" : " ";
  for (const int digits : {15, 16, 17}) {
    const auto text = fmt::format("{:.{}g}", number, digits);
    if (const auto back = parse_quantity(text); back && to_si(back->number, unit) == si) {
      return fmt::format("{}{}{}", text, space, unit);
    }
  }
  // No number in `unit` gives this very value: say it in SI.
  return fmt::format("{} {}", si, si_unit(unit));
}

}  // namespace drycut::sim::scenario
