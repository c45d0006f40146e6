#pragma once
#include <memory>
#include <string>

#include "devices/controller.hpp"
#include "devices/modbus/table.hpp"

namespace drycut::devices::modbus {

std::unique_ptr<Device> make_modbus(const Resources& resources, Cards& cards);

/// The tables of a MODBUS device as a master sees them: it reads oword and writes iword.
class ExchangeFace final : public ModbusFace {
 public:
  /// The device's name in the .CNF, itself, and whether the controller has power; they outlive it.
  ExchangeFace(std::string name, const Device& device, const bool& powered)
      : name_(std::move(name)), device_(device), powered_(powered) {}

  [[nodiscard]] std::optional<ModbusPlace> read(ModbusTable table, std::uint16_t address) const override;
  [[nodiscard]] std::optional<ModbusPlace> written(ModbusTable table, std::uint16_t address) const override;
  [[nodiscard]] bool answers(std::uint8_t unit) const override;

 private:
  [[nodiscard]] std::optional<ModbusPlace> place(ModbusTable table, std::uint16_t address,
                                                 std::string_view word) const;

  const std::string name_;
  const Device& device_;
  const bool& powered_;
};

}  // namespace drycut::devices::modbus
