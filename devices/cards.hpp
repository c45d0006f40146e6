#pragma once
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace drycut {
class StateArchive;
}

namespace drycut::devices {

/// What a terminal of the controller's cards is.
enum class Kind : std::uint8_t {
  counter,    ///< CNT: bidirectional quadrature counter, x4
  input,      ///< INP: digital input
  output,     ///< OUT: digital output
  analogue,   ///< AN: 16-bit signed DAC, +-10 V
  interrupt,  ///< INT: interrupt line 1..8, latches the counters at its edges
};

/// A terminal: `2.CNT01` is counter 1 of the card in slot 2; interrupt lines belong to no slot and are
/// written `INT5`. Slot 1 is the CPU: its counters are simulated, nothing is wired to them.
/// (spec qem.md §3; `2.IN01` and `2.OUT3` are accepted spellings.)
/// Slot 0 is the base unit of an LX3VP: inputs `X0`..`X377` and outputs `Y0`..`Y377`, octal as printed on it
/// (X10 is number 8), and the terminals of the high-speed counters together, by the counter: `C235`..`C255`.
struct Address {
  Kind kind = Kind::counter;
  int slot = 0;
  int number = 0;
  auto operator<=>(const Address&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// Reads the address of a terminal in a slot or of an interrupt line, any case; nullopt if `text` is none.
std::optional<Address> parse_address(std::string_view text);
/// Reads a terminal of a base unit, any case; nullopt if `text` is none.
std::optional<Address> parse_base_terminal(std::string_view text);
std::string to_string(const Address& address);
/// "counter", "digital input", ... for messages.
std::string_view name_of(Kind kind);

struct Counter {
  std::int64_t count = 0;    ///< bits x4 since power-up, never wraps
  std::int64_t latched = 0;  ///< the exact count at the last edge of an interrupt line
  int movers = 0;            ///< devices that move it themselves: slot 1 only, and more than one is a slip

  void visit(StateArchive& archive);
};
struct DigitalInput {
  bool level = false;

  void visit(StateArchive& archive);
};
struct DigitalOutput {
  bool level = false;
  bool held = false;  ///< a device moves an axis with it: devices that share an output take turns

  void visit(StateArchive& archive);
};
struct AnalogueOutput {
  std::int16_t word = 0;  ///< -32767..32767 = -10..+10 V
  bool held = false;      ///< a device regulates on it: devices that share a DAC take turns

  void visit(StateArchive& archive);
};

/// A pulse train. Its direction is an output of its own.
struct PulseTrain {
  std::int64_t count = 0;  ///< pulses since the start, each one counted whatever its direction

  void visit(StateArchive& archive);
};

/// The terminals of the controller that something uses. References stay valid while terminals are added.
/// The simulation writes counters and input levels before devices run and reads outputs after;
/// devices and programs do the reverse.
struct Cards {
  std::map<Address, Counter> counters;
  std::map<Address, DigitalInput> inputs;
  std::map<Address, DigitalOutput> outputs;
  std::map<Address, AnalogueOutput> analogue_outputs;
  std::map<Address, PulseTrain> pulse_outputs;  ///< outputs of a base unit that give pulses
  std::map<int, DigitalInput> interrupt_lines;  ///< by line number 1..8, present level

  /// The terminals that the state has must all be there, and no others.
  void visit(StateArchive& archive);
};

/// Calls `use` with the terminals of a slot's kind and the key of `address` among them.
template <typename Use>
auto with_terminals(auto& cards, const Address& address, Use use) {
  switch (address.kind) {
    case Kind::counter:
      return use(cards.counters, address);
    case Kind::input:
      return use(cards.inputs, address);
    case Kind::output:
      return use(cards.outputs, address);
    case Kind::analogue:
      return use(cards.analogue_outputs, address);
    case Kind::interrupt:
      break;
  }
  return use(cards.interrupt_lines, address.number);
}

/// Full scale of the DAC [bits] and [V].
inline constexpr int dac_full_scale = 32767;
inline constexpr double dac_full_scale_volts = 10.0;

/// A device's part in an output that several devices may name: they take turns with REGON and REGOFF and must
/// never drive it at once (001 1.4.1, 002 1.3.1). The output keeps `held`, that one of them holds it.
class OutputTurn {
 public:
  /// The device drives the output in this sample. True once if another one does too: in two samples on end,
  /// since a turn that changes hands within one is in order.
  bool take(bool& held) {
    if (!held) held = holds_ = true;
    contested_ = holds_ ? 0 : contested_ + 1;
    return contested_ == 2;
  }
  /// Leaves the output to the others.
  void release(bool& held) {
    if (holds_) held = holds_ = false;
    contested_ = 0;
  }
  void visit(StateArchive& archive);

 private:
  bool holds_ = false;          ///< it is this device that holds the output
  std::int64_t contested_ = 0;  ///< samples on end in which another device was there too
};

}  // namespace drycut::devices
