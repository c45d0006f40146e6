#pragma once
#include <string>
#include <variant>

#include "devices/controller.hpp"

namespace drycut::devices {

/// Terminals of cards in slots: wiring may name those that the configuration uses, and every interrupt line.
std::variant<Address, TerminalFault> find_slot_terminal(const Cards& cards, const std::string& text);

/// False for the CPU's simulated counters: nothing is wired to them.
bool slot_takes_wire(const Address& address);

}  // namespace drycut::devices
