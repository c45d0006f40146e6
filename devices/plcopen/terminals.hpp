#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "devices/cards.hpp"
#include "devices/plcopen/axis_parameters.hpp"

namespace drycut::devices::plcopen {

/// What wires may lead to at an axis: `Knife.encoder`. The address of a terminal has the axis' number from 1
/// as its slot; a probe is the interrupt line of that number.
struct AxisTerminal {
  std::string_view name;
  Kind kind = Kind::input;
  int number = 1;            ///< tells the inputs of an axis apart
  std::array<bool, 3> on{};  ///< an axis of each AxisKind
  std::string_view meaning;

  [[nodiscard]] bool offered_by(AxisKind axis) const { return on.at(static_cast<std::size_t>(axis)); }
  [[nodiscard]] Address address(int axis) const;
};
std::span<const AxisTerminal> axis_terminal_table();

/// Numbers of the inputs of an axis.
inline constexpr int ready_input = 1;
inline constexpr int emergency_stop_input = 2;
inline constexpr int feed_enable_input = 3;
inline constexpr int feed_hold_input = 4;

/// A terminal as wiring writes it, its axis not looked up yet.
struct TerminalName {
  std::string axis;                        ///< "" for a BOOL of the program
  const AxisTerminal* terminal = nullptr;  ///< nullptr: the axis has no terminal called so
  Address address;                         ///< of a BOOL of the program: %IX0.3 is input 3, %QX1.0 output 8
};
/// Reads `Knife.encoder`, `IX0.0` or `%QX0.1`, any case; nullopt if `text` is written as none of them.
std::optional<TerminalName> parse_terminal(std::string_view text);
/// "IX0.0", "QX1.7".
std::string located_name(const Address& address);
/// Address of the program's BOOL at "IX0.3" or "%QX1.0", any case; nullopt if `text` is written otherwise.
std::optional<Address> located_address(std::string_view text);
/// BOOLs of the program that a number takes together, the lowest bit first.
struct LocatedBits {
  Address first;
  int count = 1;
};
/// "%IX0.3", or a whole number at "%IB3", "%QW1", "%ID0", "%IL0", any case: its number counts places of its
/// own size, so that %QW1 is %QX2.0 to %QX3.7. nullopt if `text` is written otherwise.
std::optional<LocatedBits> located_bits(std::string_view text);
/// "%IX0.3", "%QW1"
std::string place_name(const Address& first, int count);

}  // namespace drycut::devices::plcopen
