#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace drycut::sim::scenario {

/// Units of measure by UDUNITS-2, with the field's spellings added (deg, rev, Nm). Angle is a dimension of
/// its own where UDUNITS keeps it ("rad"); "" is the pure number. Safe to call from several threads.

/// A unit against SI: si = number * factor / divisor + offset.
struct Conversion {
  double factor = 1;
  double divisor = 1;
  double offset = 0;
  std::string dimension;  ///< SI base units, radian kept apart: "m.s-1"; "" = pure number
};
/// What UDUNITS says, everyday_units aside; nullopt if it does not know the unit.
std::optional<Conversion> udunits_conversion(std::string_view unit);

/// True if `unit` is one that is known.
bool is_unit(std::string_view unit);
/// SI value of `number` in `unit`. The unit must be known.
double to_si(double number, std::string_view unit);
/// `si` expressed in `unit`. The unit must be known.
double from_si(double si, std::string_view unit);
/// True if a quantity in unit `a` can be expressed in unit `b`.
bool same_dimension(std::string_view a, std::string_view b);
/// The SI base units of `unit`, which must be known: "m.s-1" for "m/min", "" for a pure number.
std::string si_unit(std::string_view unit);
/// The same as people write it: "m/s", "N m"; as si_unit() has it where no name is known.
std::string readable_si(std::string_view unit);
/// What quantity a unit measures, for messages: "a length", "a speed", "an inertia"; else "a quantity in
/// <unit>".
std::string dimension_name(std::string_view unit);

/// A number with an optional unit, "1200 mm", "-0.5", "60 m/min".
struct ParsedQuantity {
  double number = 0;
  std::string unit;
  std::size_t unit_offset = 0;  ///< where the unit starts in the text
};
/// nullopt if the text does not start with a number or has nothing but a number and a unit in it.
std::optional<ParsedQuantity> parse_quantity(std::string_view text);
/// `si` as a text in `unit`, shortest that reads back to the very same value.
std::string format_quantity(double si, std::string_view unit);

}  // namespace drycut::sim::scenario
