#include "devices/modbus_face.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

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

}  // namespace drycut::devices
