#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "sim/live/line.hpp"

namespace drycut::sim::live::modbus {

/// What would have to be there for the line's controller to have Modbus; "" if it has. Before the line runs.
std::string lacking(Line& line);

/// The line's controller as a Modbus TCP server: what an HMI finds at the machine. One thread serves all
/// connections; requests act between two cycles of the line, a bounded number each time. Writes are acts: a
/// record has them. Modbus knows no token: who reaches the port reads and writes.
///
/// A connection that sends what is no frame, or half of one for ten seconds, or does not read its answers, is
/// closed; of more than 64 the one that has been silent for longest.
class ModbusServer {
 public:
  struct Options {
    std::string address = "127.0.0.1";
    std::uint16_t port = 502;  ///< 0 = any free one
  };
  /// Where it listens is taken here. Throws CannotListen. The line may go on when it is gone.
  ModbusServer(Options options, Line& line);
  ~ModbusServer();
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;

 private:
  struct Core;
  struct Desk;
  std::shared_ptr<Desk> desk_;
  std::unique_ptr<Core> core_;
};

}  // namespace drycut::sim::live::modbus
