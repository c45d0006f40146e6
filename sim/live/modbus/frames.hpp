#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "devices/controller.hpp"

// Modbus as the standard has it (MODBUS Application Protocol V1.1b3, Messaging on TCP/IP V1.0b), without any
// socket: bytes to frames, requests to answers.
namespace drycut::sim::live::modbus {

using Bytes = std::vector<std::uint8_t>;

/// Exception codes (§7).
enum class Exception : std::uint8_t {
  none = 0,
  illegal_function = 1,
  illegal_data_address = 2,
  illegal_data_value = 3,
  server_device_failure = 4,
  gateway_target_failed = 11,
};

/// Where values are read and written: bits are 0 or 1, a value each.
class Data {
 public:
  Data() = default;
  virtual ~Data() = default;
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;

  /// All of them from `address` on, which the table has room for; after an exception `values` is worth
  /// nothing.
  virtual Exception read(devices::ModbusTable table, std::uint16_t address,
                         std::span<std::uint16_t> values) = 0;
  /// All at once, or none: of words the bits of `mask` only.
  virtual Exception write(devices::ModbusTable table, std::uint16_t address,
                          std::span<const std::uint16_t> values, std::uint16_t mask) = 0;
};

/// The answer to a request; both are PDUs: function and what belongs to it. A request of any bytes has one.
Bytes answer(std::span<const std::uint8_t> request, Data& data);
/// The answer that something is wrong.
Bytes refusal(std::span<const std::uint8_t> request, Exception exception);
/// How many bits and words a request is about at most: what it costs.
std::size_t cost_of(std::span<const std::uint8_t> request);

/// What goes over TCP.
struct ModbusFrame {
  std::uint16_t transaction = 0;
  std::uint8_t unit = 0;
  Bytes pdu;
};
Bytes bytes_of(const ModbusFrame& frame);

/// Frames out of the bytes of a connection, however they come.
class FrameReader {
 public:
  /// Not while it is broken.
  void take(std::span<const std::uint8_t> bytes);
  /// The next whole one. The stream is broken if what follows is none: its protocol is not 0, or no PDU has
  /// its length; where the next one begins nobody knows then.
  std::optional<ModbusFrame> next();
  [[nodiscard]] bool broken() const { return broken_; }
  /// A frame has begun and is not whole.
  [[nodiscard]] bool begun() const { return !bytes_.empty(); }

 private:
  Bytes bytes_;
  bool broken_ = false;
};

}  // namespace drycut::sim::live::modbus
