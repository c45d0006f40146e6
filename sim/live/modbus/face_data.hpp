#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "devices/controller.hpp"
#include "sim/live/modbus/frames.hpp"
#include "sim/time.hpp"

namespace drycut::sim::live::modbus {

/// What is asked of whoever runs the controller.
struct Host {
  std::function<std::optional<devices::ControllerValue>(const std::string& name)> find;
  /// Sets all of them at once, at now(), as a timeline does; false, and none set, if one does not fit.
  std::function<bool(const std::vector<std::pair<std::string, double>>& values)> act;
  std::function<Time()> now;
};

/// The values of a controller as the tables of Modbus. What has been written and not yet taken reads as
/// written: an HMI that writes and looks finds it, also while the line stands still.
class FaceData final : public Data {
 public:
  /// `face` outlives it.
  FaceData(const devices::ModbusFace& face, Host host);

  Exception read(devices::ModbusTable table, std::uint16_t address, std::span<std::uint16_t> values) override;
  Exception write(devices::ModbusTable table, std::uint16_t address, std::span<const std::uint16_t> values,
                  std::uint16_t mask) override;

 private:
  /// What stands at an address, looked up once.
  struct Bound {
    bool there = false;
    devices::ModbusPlace place;
    std::function<double()> read;  ///< empty: memory without a value
  };
  const Bound& bound(devices::ModbusTable table, std::uint16_t address, bool writing);
  [[nodiscard]] std::uint64_t bits_now(const Bound& bound) const;
  void forget_taken();

  const devices::ModbusFace& face_;
  Host host_;
  std::unordered_map<std::uint32_t, Bound> bound_;
  struct Pending {
    double number = 0;
    Time until = 0;  ///< it has been taken then
  };
  std::unordered_map<std::string, Pending> pending_;  ///< by value
};

}  // namespace drycut::sim::live::modbus
