#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace drycut::devices {

/// The four tables of Modbus' data model, which functions 1, 2, 3 and 4 read.
enum class ModbusTable : std::uint8_t { coils, discrete_inputs, holding_registers, input_registers };

/// Whether an address of the table is a bit; else it is a word of 16.
constexpr bool has_bits(ModbusTable table) {
  return table == ModbusTable::coils || table == ModbusTable::discrete_inputs;
}

/// How a value of a controller lies in bits.
enum class ModbusFormat : std::uint8_t { bit, int16, uint16, int32, uint32, real32, real64 };

/// 1, 16, 32 or 64.
int width_of(ModbusFormat format);
/// A whole number is rounded, what is beyond the format's ends becomes the end, no number becomes 0.
std::uint64_t to_bits(ModbusFormat format, double value);
double from_bits(ModbusFormat format, std::uint64_t bits);

/// What stands at an address: a bit or a word of one of the controller's values.
struct ModbusPlace {
  std::string value;  ///< as Controller::find knows it; "" = memory that nothing stands in: reads 0
  ModbusFormat format = ModbusFormat::int16;
  int shift = 0;                ///< the bit, or the lowest one of the word, in the value
  std::int64_t settles_ns = 0;  ///< what is written has been taken that much later
};

/// What a controller shows to Modbus, and what it lets it write. The registers are device knowledge; frames,
/// functions and sockets are not.
class ModbusFace {
 public:
  ModbusFace() = default;
  virtual ~ModbusFace() = default;
  ModbusFace(const ModbusFace&) = delete;
  ModbusFace& operator=(const ModbusFace&) = delete;

  /// Nullopt where nothing can be read.
  [[nodiscard]] virtual std::optional<ModbusPlace> read(ModbusTable table, std::uint16_t address) const = 0;
  /// Nullopt where nothing can be written; of coils and holding registers.
  [[nodiscard]] virtual std::optional<ModbusPlace> written(ModbusTable table,
                                                           std::uint16_t address) const = 0;
  /// Whether it answers as this unit, now. Most take any: over TCP the address of the socket says who is
  /// meant.
  [[nodiscard]] virtual bool answers(std::uint8_t unit) const {
    (void)unit;
    return true;
  }
};

}  // namespace drycut::devices
