#include "devices/slot_terminals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace drycut::devices {

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
  return names;
}

}  // namespace

std::variant<Address, TerminalFault> find_slot_terminal(const Cards& cards, const std::string& text) {
  const auto address = parse_address(text);
  if (!address)
    return TerminalFault{fmt::format("'{}' is not a terminal of the controller", text),
                         "write slot.CNTnn, slot.INPnn, slot.OUTnn, slot.ANnn or INTn"};
  if (!slot_takes_wire(*address))
    return TerminalFault{fmt::format("{} is a simulated counter of the CPU", to_string(*address)),
                         "nothing is wired to slot 1; wire a counter of another slot"};
  if (address->kind == Kind::interrupt) return *address;
  const auto known = used_terminals(cards, address->kind);
  if (std::find(known.begin(), known.end(), to_string(*address)) != known.end()) return *address;
  return TerminalFault{fmt::format("the configuration uses no {}", to_string(*address)),
                       fmt::format("its {} terminals are: {}", name_of(address->kind),
                                   known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")))};
}

bool slot_takes_wire(const Address& address) { return address.kind != Kind::counter || address.slot != 1; }

}  // namespace drycut::devices
