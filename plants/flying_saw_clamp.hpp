#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// Two jaws that grip the running material and take it and the carriage along with each other.
struct ClampData {
  double force = 6000;       ///< of a jaw on the material [N]
  double friction = 0.2;     ///< Coulomb, jaw on material
  double close_time = 0.03;  ///< from the command until the jaws grip [s]
  double open_time = 0.02;   ///< from the command's end until they let go [s]
};

/// Rows of the group `clamp.`.
Parameters clamp_parameters(ClampData& data);

class Clamp {
 public:
  explicit Clamp(const ClampData& data) : data_(data) {}

  CommandPort command;
  SignalPort closed;  ///< the jaws grip

  /// Friction between carriage and material for the coming step of `h` seconds, on both: as large as takes
  /// away their difference of speed within the step, up to its limit. Call it last: it answers to all other
  /// forces on both.
  void drive(Slide& carriage, Slide& material, double h);
  /// How far they have slipped on each other in the last step.
  void sense(const Slide& carriage, const Slide& material, double h);

  [[nodiscard]] double normal() const {  ///< force of a jaw now [N]
    return closed_ ? data_.force * (1 - lost_) : 0;
  }
  [[nodiscard]] double limit() const { return 2 * data_.friction * normal(); }  ///< of the friction [N]
  [[nodiscard]] double friction() const { return friction_; }  ///< on the carriage in the last step [N]
  [[nodiscard]] double slip() const { return slip_; }  ///< carriage ahead of the material since closed [m]
  [[nodiscard]] bool has_gripped() const { return gripped_; }  ///< in the last step
  [[nodiscard]] bool has_let_go() const { return let_go_; }    ///< in the last step

  /// force_loss under the component name `component`.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);

  void visit(StateArchive& archive);

 private:
  void move_jaws(double h);

  const ClampData data_;
  double stroke_ = 0;  // of the jaws: 0 open .. 1 at the material
  bool closed_ = false;
  bool gripped_ = false;
  bool let_go_ = false;
  double friction_ = 0;
  double slip_ = 0;
  double lost_ = 0;  // share of the force
};

}  // namespace drycut::plants
