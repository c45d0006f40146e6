#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plants/delayed_contact.hpp"
#include "plants/plant.hpp"
#include "plants/power_stage.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// The contactor of a motor that shares a drive with others.
struct SharedDriveData {
  std::string drive = std::string(no_plant);  ///< the axis whose drive it is, none: its own
  double close_delay = 20e-3;                 ///< [s]
  double open_delay = 15e-3;                  ///< [s]
};

/// Rows of the group `shared.`; `type`: the plant whose drive may be shared.
Parameters shared_drive_parameters(SharedDriveData& data, std::string_view type);

/// What a motor has that is switched to the drive of another axis: its contactor, its windings and their
/// heat. The drive's axis sees to its current.
class SharedMotor {
 public:
  SharedMotor(const SharedDriveData& data, const MotorCurrent& current, const MotorHeatData& heat,
              const DriveRatings& ratings)
      : power_(current, heat, ratings, {}, {}), contact_(data.close_delay, data.open_delay) {}

  CommandPort select;  ///< closes the contactor

  /// Takes what the drive has given for the coming step of `h` seconds.
  void drive(const Shaft& rotor, double h) {
    power_.account(last_, rotor, h);
    last_ = given_;
    given_ = {};
  }
  void give(const PowerStage::Step& step) { given_ = step; }
  [[nodiscard]] double torque() const { return last_.torque; }  ///< on the rotor [N m]
  /// It is connected to a drive that is on.
  [[nodiscard]] bool moving() const { return last_.energised; }
  [[nodiscard]] DelayedContact& contact() { return contact_; }
  [[nodiscard]] const DelayedContact& contact() const { return contact_; }
  [[nodiscard]] PowerStage& power() { return power_; }
  [[nodiscard]] const PowerStage& power() const { return power_; }

  void visit(StateArchive& archive);

 private:
  PowerStage power_;
  DelayedContact contact_;
  PowerStage::Step given_;
  PowerStage::Step last_;
};

/// The contactors between one drive and several motors. The drive's own motor has the rest position: its
/// contactor closes while no other is selected. Auxiliary contacts keep each from closing while another is
/// closed, so that a changeover takes the one's opening and then the other's closing; of several that are
/// selected the first in order closes.
class Changeover {
 public:
  explicit Changeover(const SharedDriveData& data) : own_(data.close_delay, data.open_delay) {}

  void add(SharedMotor& motor, Shaft& rotor) { motors_.push_back({&motor, &rotor}); }
  [[nodiscard]] bool shared() const { return !motors_.empty(); }

  // What is connected: nothing, the drive's own motor, or the n-th other one.
  static constexpr int nothing = -1;
  static constexpr int own = 0;
  /// That in the coming step of `h` seconds.
  int update(double h);
  /// The other motor that is connected, null where none is.
  [[nodiscard]] SharedMotor* other(int connected) const {
    return connected > own ? motors_[static_cast<std::size_t>(connected) - 1].motor : nullptr;
  }
  /// Its rotor, else the drive's own.
  [[nodiscard]] Shaft& rotor(int connected, Shaft& own_rotor) const {
    return connected > own ? *motors_[static_cast<std::size_t>(connected) - 1].rotor : own_rotor;
  }
  [[nodiscard]] bool own_closed() const { return own_.closed(); }
  /// Another motor's sensor has told of an overload.
  bool take_trip();

  // What it adds to a plant's lists, where the drive is shared.
  void offer_channels(std::vector<Channel>& channels) const;
  void offer_faults(std::vector<Fault>& faults);

  void visit(StateArchive& archive);

 private:
  struct Motor {
    SharedMotor* motor;
    Shaft* rotor;
  };
  DelayedContact own_;
  std::vector<Motor> motors_;
};

}  // namespace drycut::plants
