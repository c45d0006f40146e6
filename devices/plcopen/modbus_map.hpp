#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "devices/controller.hpp"

namespace drycut::devices::plcopen {

/// A place in the memory %M as a variable's AT names it. Its number counts places of its own size, and two
/// words or four have the low word first. Coils and registers are memories of their own, as in Modbus: %MX3.5
/// is coil 29 (3 x 8 + 5), %MW10 register 10, %MD10 the registers 20 and 21, %ML10 those from 40 to 43.
struct MemoryPlace {
  char size = 'W';  ///< X, W, D or L
  int number = 0;   ///< of the bit, word, double or long word
};
/// "%MX3.5", "%MW10", any case; nullopt if `text` names none, or one beyond coil or register 65535.
std::optional<MemoryPlace> parse_memory_place(std::string_view text);
/// "%MX3.5"
std::string to_string(const MemoryPlace& place);
/// Addresses of Modbus that one of the size takes: 1, 1, 2, 4.
int addresses_of(const MemoryPlace& place);

/// What a program's AT %M and a scenario's map put at Modbus addresses. Where a table has gaps they read 0,
/// as memory in which nothing stands, and cannot be written.
class MemoryFace final : public ModbusFace {
 public:
  /// Without power it does not answer; `powered` outlives it.
  explicit MemoryFace(const bool& powered) : powered_(powered) {}

  /// Puts a value at its address and, if it is wide, at the next ones. What stands at one of them already, ""
  /// = nothing: it is taken then. `low_first`: the low word has the lowest address. The addresses are within
  /// the table.
  std::string add(ModbusTable table, int address, const std::string& value, ModbusFormat format,
                  bool low_first);
  [[nodiscard]] bool empty() const { return places_.empty(); }

  [[nodiscard]] std::optional<ModbusPlace> read(ModbusTable table, std::uint16_t address) const override;
  [[nodiscard]] std::optional<ModbusPlace> written(ModbusTable table, std::uint16_t address) const override;
  [[nodiscard]] bool answers(std::uint8_t) const override { return powered_; }

 private:
  const bool& powered_;
  std::map<std::pair<ModbusTable, int>, ModbusPlace> places_;
};

}  // namespace drycut::devices::plcopen
