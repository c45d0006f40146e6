#pragma once
#include <string>
#include <vector>

#include "plants/delayed_contact.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// A spring-applied brake on the motor's shaft.
struct HoldingBrakeData {
  double torque = 0;              ///< [N m], 0 = no brake
  double release_delay = 60e-3;   ///< from command to no torque left [s]
  double engage_delay = 40e-3;    ///< from command to full torque [s]
  double scatter = 0;             ///< standard deviation of both delays, from time to time [s]
  std::string control = "drive";  ///< what releases it: drive, output
};

/// Rows of the group `brake.`; `torque_from`: where a machine's default of the torque is from.
Parameters holding_brake_parameters(HoldingBrakeData& data, std::string_view torque_from);

/// The brake is released while its command is on and, under control of the drive, the drive moves the motor:
/// a brake coil fed from the motor's terminals or by the drive's own brake relay. It acts as dry friction: it
/// holds up to its torque and slips above it.
class HoldingBrake {
 public:
  /// `random`: what its delays scatter by.
  explicit HoldingBrake(const HoldingBrakeData& data, const Random& random = Random())
      : data_(data),
        contact_(data.release_delay, data.engage_delay, data.scatter),
        random_(random),
        applied_(data.torque) {
    release.level = true;
  }

  CommandPort release;  ///< high unless something is wired to it (strapped in the cabinet)

  /// Follows the commands at the start of a step of `h` seconds.
  void update(bool drive_moves, double h) {
    holds_ = !(release.level && (drive_moves || data_.control == "output"));
    contact_.update(!holds_, h, &random_);
    applied_ = torque();
  }

  /// Adds up what it did to `rotor` in the last step of `h` seconds; before update().
  void account(const Shaft& rotor, double h);

  /// Largest torque that it holds now [N m].
  [[nodiscard]] double torque() const { return released() ? 0 : data_.torque * (1 - worn_); }
  [[nodiscard]] bool released() const { return (contact_.closed() && !stuck_closed_) || stuck_open_; }
  [[nodiscard]] bool commanded_to_hold() const { return holds_; }

  // What it adds to a plant's lists, under "brake".
  void offer_channels(std::vector<Channel>& channels) const;
  void offer_faults(std::vector<Fault>& faults);

  void visit(StateArchive& archive);

 private:
  const HoldingBrakeData data_;
  DelayedContact contact_;  // closed = released
  Random random_;
  bool holds_ = true;
  bool stuck_open_ = false;
  bool stuck_closed_ = false;
  double worn_ = 0;  // share of the torque that is lost
  double applied_;   // torque in the step that runs [N m]
  bool held_ = true;
  double energy_ = 0;       // slip work since the start [J]
  double last_energy_ = 0;  // since it engaged last [J]
  int engagements_ = 0;     // at speed
};

}  // namespace drycut::plants
