#pragma once
#include <string>
#include <vector>

#include "plants/end_stop.hpp"
#include "plants/plant.hpp"
#include "plants/stiff_pair.hpp"
#include "plants/transducers.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// The saw head on its vertical guide, moved by a pneumatic cylinder with throttled exhaust. Its depth is 0
/// at the upper end and grows downwards.
struct SawHeadData {
  double mass = 12;             ///< with spindle and blade [kg]
  double stroke = 0.08;         ///< between the cylinder's ends [m]
  double clearance = 0.015;     ///< of the blade's lowest point over the material with the head up [m]
  double down_force = 350;      ///< of the cylinder [N]
  double up_force = 600;        ///< [N]
  double down_throttle = 600;   ///< [N s/m]
  double up_throttle = 500;     ///< [N s/m]
  double valve_delay = 8e-3;    ///< from the command until the force begins to change [s]
  double fill_time = 5e-3;      ///< time constant of the force [s]
  double switch_margin = 2e-3;  ///< the end switches are on so far before the ends [m]
  double switch_delay = 1e-3;   ///< of the end switches [s]
};

/// Rows of the group `head.`.
Parameters saw_head_parameters(SawHeadData& data);

/// Speed at which the cylinder's force, the weight and the throttle balance with the blade in the air [m/s].
[[nodiscard]] double plunge_speed(const SawHeadData& data);
[[nodiscard]] double return_speed(const SawHeadData& data);
/// The head on the cushion at either end of its cylinder.
[[nodiscard]] StiffPair head_cushion(const SawHeadData& data);

class SawHead {
 public:
  SawHead(const SawHeadData& data, World& world);

  CommandPort plunge;

  /// Forces for the coming step of `h` seconds; `resistance` of the material: force against downward motion
  /// for its speed [N s/m].
  void drive(double h, double resistance);
  /// Switches after the step.
  void sense(double h);

  [[nodiscard]] const Slide& body() const { return body_; }  ///< position: depth [m]
  [[nodiscard]] Slide& body() { return body_; }

  /// Angle of the spinning blade as pictures show it [rad].
  [[nodiscard]] double blade_turn() const { return blade_turn_; }

  // What it adds to a plant's lists.
  void offer_ports(std::vector<Port>& ports);
  void offer_channels(std::vector<Channel>& channels) const;
  void offer_faults(std::vector<Fault>& faults);

  void visit(StateArchive& archive);

 private:
  void valve(double h);

  const SawHeadData data_;
  Slide& body_;
  EndStop upper_;
  EndStop lower_;
  PositionSwitch up_;
  PositionSwitch down_;
  bool valve_down_ = false;   // position of the valve
  double valve_waiting_ = 0;  // since the command differs from it [s]
  double force_;
  double h_ = 0;  // the step for which the share below holds
  double fill_share_ = 1;
  double pressure_loss_ = 0;  // share
  double blade_turn_ = 0;
};

}  // namespace drycut::plants
