#pragma once
#include <cmath>
#include <functional>
#include <string>

#include "sim/loop/names.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::studies {

/// The two runs of a scenario in step, and what they differ by at the wire.
class Twins {
 public:
  /// `wire`: of Bus::analogue_wires(); `speed`: channel of the motor's speed, "" = not measured.
  Twins(loop::Simulation& excited, loop::Simulation& still, std::size_t wire, const std::string& speed)
      : excited_(excited),
        still_(still),
        wire_(excited.bus().analogue_wires().at(wire)),
        still_wire_(still.bus().analogue_wires().at(wire)) {
    if (speed.empty()) return;
    speed_ = excited.names().reading(speed)->read;
    still_speed_ = still.names().reading(speed)->read;
  }

  /// One step with `volts` added to the wire of the excited one.
  bool advance(double volts) {
    wire_.added = volts;
    const bool whole = excited_.advance();
    return still_.advance() && whole;
  }
  /// Waits for the first instant of the device's sampling from `from` on: what is added then changes when the
  /// controller's output does.
  void wait_for_sampling(Time from, Time sampling) {
    while (failure().empty() && (time() < from || time() % sampling != 0)) (void)advance(0);
  }
  [[nodiscard]] Time time() const { return excited_.time(); }
  [[nodiscard]] double output() const { return wire_.output() - still_wire_.output(); }  ///< [V]
  [[nodiscard]] double total() const { return wire_.total() - still_wire_.total(); }     ///< [V]
  [[nodiscard]] double plug() const { return wire_.to->volts - still_wire_.to->volts; }  ///< [V]
  [[nodiscard]] bool has_speed() const { return static_cast<bool>(speed_); }
  [[nodiscard]] double speed() const { return speed_() - still_speed_(); }
  [[nodiscard]] double own() const { return still_wire_.output(); }  ///< undisturbed output [V]
  [[nodiscard]] bool saturated() const { return std::abs(wire_.from->word) >= devices::dac_full_scale; }
  [[nodiscard]] std::string failure() const {
    return excited_.failure().empty() ? still_.failure() : excited_.failure();
  }

 private:
  loop::Simulation& excited_;
  loop::Simulation& still_;
  loop::Bus::AnalogueWire& wire_;
  loop::Bus::AnalogueWire& still_wire_;
  std::function<double()> speed_;
  std::function<double()> still_speed_;
};

}  // namespace drycut::sim::studies
