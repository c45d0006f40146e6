#include "devices/plcopen/terminals.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>

#include "base/text.hpp"

namespace drycut::devices::plcopen {
namespace {

constexpr std::array table{
    AxisTerminal{"encoder", Kind::counter, 1, {true, false, true}, "actual position, counts x4"},
    AxisTerminal{
        "reference", Kind::analogue, 1, {true, false, false}, "speed reference of the drive, +-10 V"},
    AxisTerminal{"enable", Kind::output, 1, {true, false, false}, "on while the axis regulates"},
    AxisTerminal{"ready",
                 Kind::input,
                 ready_input,
                 {true, false, false},
                 "off: the drive no longer follows; not wired: on"},
    AxisTerminal{"emergency_stop",
                 Kind::input,
                 emergency_stop_input,
                 {true, true, false},
                 "on: the axis brakes into Errorstop; not wired: off"},
    AxisTerminal{"feed_enable",
                 Kind::input,
                 feed_enable_input,
                 {true, true, false},
                 "off: movements slow down to a stop, couplings let go; not wired: on"},
    AxisTerminal{"feed_hold",
                 Kind::input,
                 feed_hold_input,
                 {true, true, false},
                 "on: movements slow down to a stop; not wired: off"},
    AxisTerminal{"probe",
                 Kind::interrupt,
                 1,
                 {true, false, true},
                 "a rising edge latches the exact count for MC_TouchProbe"},
};

constexpr int bits_per_byte = 8;

}  // namespace

std::optional<Address> located_address(std::string_view text) {
  if (text.starts_with('%')) text.remove_prefix(1);
  if (text.size() < 5 || std::toupper(static_cast<unsigned char>(text[1])) != 'X') return std::nullopt;
  const int letter = std::toupper(static_cast<unsigned char>(text[0]));
  if (letter != 'I' && letter != 'Q') return std::nullopt;
  const char* const end = text.data() + text.size();
  unsigned byte = 0;
  unsigned bit = 0;
  constexpr unsigned last_byte = 65535;
  const auto first = std::from_chars(text.data() + 2, end, byte);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != '.' || byte > last_byte)
    return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, bit);
  if (second.ec != std::errc() || second.ptr != end || bit >= bits_per_byte) return std::nullopt;
  return Address{letter == 'Q' ? Kind::output : Kind::input, 0, static_cast<int>(bits_per_byte * byte + bit)};
}

std::optional<LocatedBits> located_bits(std::string_view text) {
  if (const auto bit = located_address(text)) return LocatedBits{*bit, 1};
  const std::string name = upper(text);
  constexpr std::string_view sizes = "BWDL";
  const std::size_t size = name.size() > 3 ? sizes.find(name[2]) : std::string_view::npos;
  if (name[0] != '%' || size == std::string_view::npos || (name[1] != 'I' && name[1] != 'Q'))
    return std::nullopt;
  const int count = bits_per_byte << size;
  constexpr int last_bit = bits_per_byte * 65535 + bits_per_byte - 1;
  int number = 0;
  const char* const end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + 3, end, number);
  if (read.ec != std::errc() || read.ptr != end || number < 0 || number > last_bit / count)
    return std::nullopt;
  return LocatedBits{{name[1] == 'Q' ? Kind::output : Kind::input, 0, number * count}, count};
}

std::string place_name(const Address& first, int count) {
  if (count == 1) return "%" + located_name(first);
  constexpr std::string_view sizes = "BWDL";
  std::size_t size = 0;
  while (bits_per_byte << size < count) ++size;
  return fmt::format("%{}{}{}", first.kind == Kind::output ? 'Q' : 'I', sizes[size], first.number / count);
}

Address AxisTerminal::address(int axis) const {
  return {kind, axis + 1, kind == Kind::interrupt ? axis + 1 : number};
}

std::span<const AxisTerminal> axis_terminal_table() { return table; }

std::optional<TerminalName> parse_terminal(std::string_view text) {
  if (const auto located = located_address(text)) return TerminalName{"", nullptr, *located};
  const auto dot = text.find('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 1 == text.size()) return std::nullopt;
  if (std::isdigit(static_cast<unsigned char>(text[dot + 1])) != 0) return std::nullopt;  // IX0.8
  TerminalName name{std::string(text.substr(0, dot)), nullptr, {}};
  for (const AxisTerminal& terminal : table)
    if (terminal.name == lower(text.substr(dot + 1))) name.terminal = &terminal;
  return name;
}

std::string located_name(const Address& address) {
  return fmt::format("{}X{}.{}", address.kind == Kind::output ? 'Q' : 'I', address.number / bits_per_byte,
                     address.number % bits_per_byte);
}

}  // namespace drycut::devices::plcopen
