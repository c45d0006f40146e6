#include "devices/controller.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/state_archive.hpp"

namespace drycut::devices {

namespace {

template <typename Whole>
std::uint64_t whole_bits(double value, std::uint64_t mask) {
  const double limited = std::clamp(std::round(value), static_cast<double>(std::numeric_limits<Whole>::min()),
                                    static_cast<double>(std::numeric_limits<Whole>::max()));
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(limited)) & mask;
}

constexpr std::uint64_t word_mask = 0xFFFF;
constexpr std::uint64_t long_mask = 0xFFFFFFFF;

}  // namespace

int width_of(ModbusFormat format) {
  switch (format) {
    case ModbusFormat::bit:
      return 1;
    case ModbusFormat::int16:
    case ModbusFormat::uint16:
      return 16;
    case ModbusFormat::int32:
    case ModbusFormat::uint32:
    case ModbusFormat::real32:
      return 32;
    case ModbusFormat::real64:
      break;
  }
  return 64;
}

std::uint64_t to_bits(ModbusFormat format, double value) {
  if (std::isnan(value)) return 0;
  switch (format) {
    case ModbusFormat::bit:
      return value != 0 ? 1 : 0;
    case ModbusFormat::int16:
      return whole_bits<std::int16_t>(value, word_mask);
    case ModbusFormat::uint16:
      return whole_bits<std::uint16_t>(value, word_mask);
    case ModbusFormat::int32:
      return whole_bits<std::int32_t>(value, long_mask);
    case ModbusFormat::uint32:
      return whole_bits<std::uint32_t>(value, long_mask);
    case ModbusFormat::real32: {
      constexpr double most = std::numeric_limits<float>::max();
      return std::bit_cast<std::uint32_t>(static_cast<float>(std::clamp(value, -most, most)));
    }
    case ModbusFormat::real64:
      break;
  }
  return std::bit_cast<std::uint64_t>(value);
}

double from_bits(ModbusFormat format, std::uint64_t bits) {
  switch (format) {
    case ModbusFormat::bit:
      return static_cast<double>(bits & 1);
    case ModbusFormat::int16:
      return static_cast<std::int16_t>(bits);
    case ModbusFormat::uint16:
      return static_cast<std::uint16_t>(bits);
    case ModbusFormat::int32:
      return static_cast<std::int32_t>(bits);
    case ModbusFormat::uint32:
      return static_cast<std::uint32_t>(bits);
    case ModbusFormat::real32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case ModbusFormat::real64:
      break;
  }
  return std::bit_cast<double>(bits);
}

namespace {

std::vector<std::string> used_terminals(const Cards& cards, Kind kind) {
  std::vector<std::string> names;
  const auto collect = [&](const auto& terminals) {
    for (const auto& [address, terminal] : terminals)
      if (address.kind == kind && slot_takes_wire(address)) names.push_back(to_string(address));
  };
  collect(cards.counters);
  collect(cards.inputs);
  collect(cards.outputs);
  collect(cards.analogue_outputs);
  if (kind == Kind::interrupt)
    for (const auto& [line, level] : cards.interrupt_lines)
      names.push_back(to_string(Address{kind, 0, line}));
  return names;
}

}  // namespace

std::variant<Address, TerminalFault> find_slot_terminal(const Cards& cards, const std::string& text) {
  const auto address = parse_address(text);
  if (!address)
    return TerminalFault{"wiring.no-terminal"_code,
                         fmt::format("'{}' is not a terminal of the controller", text),
                         "write slot.CNTnn, slot.INPnn, slot.OUTnn, slot.ANnn or INTn"};
  if (!slot_takes_wire(*address))
    return TerminalFault{"wiring.no-terminal"_code,
                         fmt::format("{} is a simulated counter of the CPU", to_string(*address)),
                         "nothing is wired to slot 1; wire a counter of another slot"};
  const auto known = used_terminals(cards, address->kind);
  if (std::find(known.begin(), known.end(), to_string(*address)) != known.end()) return *address;
  return TerminalFault{"wiring.no-terminal"_code,
                       fmt::format("the configuration uses no {}", to_string(*address)),
                       fmt::format("its {} terminals are: {}", name_of(address->kind),
                                   known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")))};
}

bool slot_takes_wire(const Address& address) { return address.kind != Kind::counter || address.slot != 1; }

void ControllerEvent::visit(StateArchive& archive) { STATE(archive, source, event, text); }

}  // namespace drycut::devices
