#pragma once
#include <span>
#include <string_view>

#include "devices/controller.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

/// A row of the PLC's Modbus addresses: Wecon, PLC Editor, 8.1 Communication (docs.we-con.com.cn), one
/// address a bit or word. The page ends M at 8256; the PLC has M8255. 32-bit counters take two words each,
/// the low word first as in D (003 3): the page gives their first address and leaves the order open.
struct ModbusRow {
  RegisterName first;
  int count = 0;
  bool bits = false;
  int address = 0;           ///< of the first
  bool may_write = true;     ///< inputs cannot be written
  std::string_view meaning;  ///< for `drycut devices`
};
std::span<const ModbusRow> modbus_rows();
/// How many addresses one of the row takes.
int addresses_each(const ModbusRow& row);

/// Functions 1 and 2 read the same bits, 3 and 4 the same words.
class RegisterFace final : public ModbusFace {
 public:
  /// Without power it does not answer; `powered` outlives it.
  explicit RegisterFace(const bool& powered) : powered_(powered) {}

  [[nodiscard]] std::optional<ModbusPlace> read(ModbusTable table, std::uint16_t address) const override;
  [[nodiscard]] std::optional<ModbusPlace> written(ModbusTable table, std::uint16_t address) const override;
  [[nodiscard]] bool answers(std::uint8_t) const override { return powered_; }

 private:
  const bool& powered_;
};

}  // namespace drycut::devices::lx3vp
