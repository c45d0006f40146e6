#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plants/dc_link.hpp"
#include "plants/motor_heat.hpp"
#include "plants/plant.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// What an amplifier or inverter bears.
struct AmplifierData {
  double current = 0;        ///< for ever, rms; 0 = what the motor's continuous torque takes [A]
  double peak_current = 0;   ///< rms; 0 = what the motor's peak torque takes [A]
  double overload_time = 3;  ///< at the peak current from cold, then it trips [s]
};

/// Rows of the groups `servo.` and `inverter.`.
Parameters amplifier_parameters(AmplifierData& data, std::string_view source);
/// What is wrong with an amplifier and its supply taken together, as parameters of `group`.
std::vector<PlantDefinition::Objection> power_objections(const std::string& group,
                                                         const AmplifierData& amplifier,
                                                         const SupplyData& supply);

/// The rms current I of a motor and what it loses by it. A servo motor's follows its torque; that of an
/// induction motor what its rotor loses, which is torque times slip:
/// I^2 = no_load^2 + torque^2 per_torque_squared + rotor loss per_rotor_loss.
struct MotorCurrent {
  double per_torque_squared = 0;  ///< [A2/N2m2]
  double per_rotor_loss = 0;      ///< [A2/W]
  double no_load = 0;             ///< [A]
  double resistance = 1;          ///< loss in the cold windings (20 degC) over I^2 [ohm]
  double rated_rotor_loss = 0;    ///< at stall torque [W]
};

/// What a motor and its drive are rated for, over the speed of the motor [rad/s, either sign].
struct DriveRatings {
  double rotor_inertia = 0;        ///< [kg m2]
  double stall_torque = 0;         ///< for ever, at standstill [N m]
  double rated_torque = 0;         ///< for ever, at rated speed [N m]
  double peak_torque = 0;          ///< up to rated speed [N m]
  double torque_at_max_speed = 0;  ///< largest there, falling linearly from rated speed [N m]
  double rated_speed = 0;          ///< [rad/s]
  double max_speed = 0;            ///< [rad/s]; no driving torque is left 5 % above
  /// The torque limit acts in normal work: an inverter's ramp waits at it, a motor on the mains passes its
  /// pull-out torque whenever it starts.
  bool works_at_limit = false;

  [[nodiscard]] double continuous(double speed) const;  ///< torque for ever: S1 [N m]
  [[nodiscard]] double peak(double speed) const;        ///< largest driving torque [N m]

  bool operator==(const DriveRatings&) const = default;
  /// Names every member to `archive`, as archive(key, member).
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("rotor_inertia", self.rotor_inertia);
    archive("stall_torque", self.stall_torque);
    archive("rated_torque", self.rated_torque);
    archive("peak_torque", self.peak_torque);
    archive("torque_at_max_speed", self.torque_at_max_speed);
    archive("rated_speed", self.rated_speed);
    archive("max_speed", self.max_speed);
    archive("works_at_limit", self.works_at_limit);
  }
};

/// What a drive has done since the start.
struct DriveTotals {
  double time = 0;             ///< [s]
  double work = 0;             ///< of the motor on its shaft, braking counts against it [J]
  double copper = 0;           ///< lost in the motor: windings, and rotor of an induction motor [J]
  double rotor_loss = 0;       ///< of that in the rotor [J]
  double from_mains = 0;       ///< [J]
  double in_resistor = 0;      ///< [J]
  double torque_squared = 0;   ///< integral [N2 m2 s]
  double current_squared = 0;  ///< integral, of the motor [A2 s]
  double fed_squared = 0;      ///< integral, of the amplifier: of all motors that it feeds by turns [A2 s]
  double travel = 0;           ///< integral of the speed's size [rad]
  double saturated = 0;        ///< time in which the torque limit acted [s]

  [[nodiscard]] DriveTotals operator+(const DriveTotals& more) const { return combined(more, 1); }
  [[nodiscard]] DriveTotals operator-(const DriveTotals& less) const { return combined(less, -1); }

 private:
  [[nodiscard]] DriveTotals combined(const DriveTotals& other, double sign) const;
};

/// The largest of a drive since they were forgotten last.
struct DrivePeaks {
  double torque = 0;   ///< size [N m]
  double speed = 0;    ///< size [rad/s]
  double share = 0;    ///< of the torque that the motor has at its speed
  double voltage = 0;  ///< of the link [V]
  double i2t = 0;      ///< of the amplifier, 1 = it trips
  double winding = 0;  ///< temperature [K]
};

class PowerStage;

/// What the contactors between a drive and its motors connect.
struct Feed {
  bool open = false;            ///< nothing: the drive gives no current
  PowerStage* motor = nullptr;  ///< another motor of the same type, by its own stage; null = the drive's own
};

/// The electrical side of a drive: current, loss and heat of its motor, the amplifier's I2t, DC link, brake
/// resistor and mains, and what trips it. Sums up each step; heat and voltages follow every half millisecond.
/// Energy closes: mains in = work + copper + resistor + what the link stores more. Not in it: iron, friction
/// (a plant's own), and the amplifier's own losses.
class PowerStage {
 public:
  /// `link`: none for a motor on contactors, which feeds back into the mains.
  PowerStage(const MotorCurrent& current, const MotorHeatData& heat, const DriveRatings& ratings,
             const std::optional<AmplifierData>& amplifier, const std::optional<SupplyData>& link);

  /// What a drive says of its last step.
  struct Step {
    double torque = 0;      ///< on the rotor [N m]
    double rotor_loss = 0;  ///< of an induction motor [W]
    double asked = 0;       ///< torque over what the limit let through, at most 1 where it let all through
    bool energised = false;
    const PowerStage* motor = nullptr;  ///< whose torque it was, see Feed
  };
  /// Accounts for the last step of `h` seconds.
  void account(const Step& step, const Shaft& rotor, double h) {
    if (edge_) clear_edges();
    const double speed = 0.5 * (rotor.speed_before + rotor.speed);
    if (step.motor != nullptr) {
      feed(step, speed, h);
    } else {
      sum_.work += step.torque * speed * h;
      sum_.torque_squared += step.torque * step.torque * h;
      sum_.travel += std::abs(speed) * h;
      sum_.rotor_loss += step.rotor_loss * h;
      if (step.energised) sum_.energised += h;
      torque_ = step.torque;
      speed_ = speed;
    }
    if (step.asked > 1) saturate(step.asked, h);
    if (++steps_ >= every_) settle(h);
  }

  /// The drive is switched off by its own protection; until reset().
  [[nodiscard]] bool tripped() const { return tripped_; }
  void reset() { tripped_ = false; }
  /// Switched off by what another motor on it has told.
  void switch_off() { tripped_ = true; }
  /// Its motor has lost its load (PulloutWatch), with such a speed and slip [rad/s].
  void pulled_out(double speed, double slip);
  /// It never trips from now on: for who measures a loop for longer than a drive would bear.
  void disarm() { armed_ = false; }
  /// Share of its speeds that the link's voltage leaves to the motor, at most 1.
  [[nodiscard]] double speed_share() const { return speed_share_; }

  [[nodiscard]] const DriveRatings& ratings() const { return ratings_; }
  [[nodiscard]] const std::optional<AmplifierData>& amplifier() const { return amplifier_; }
  [[nodiscard]] const std::optional<DcLink>& link() const { return link_; }
  [[nodiscard]] const MotorHeat& heat() const { return heat_; }
  [[nodiscard]] const DriveTotals& totals() const { return totals_; }
  [[nodiscard]] const DrivePeaks& peaks() const { return peaks_; }
  void forget_peaks() { peaks_ = {}; }
  /// Temperature of the winding with these means for ever [K]: current squared [A2], loss in the rotor [W].
  [[nodiscard]] double steady_temperature(double current_squared, double rotor_loss) const {
    return heat_.steady(current_.resistance * current_squared, rotor_loss);
  }
  /// Mean square of the current that brings the winding to its limit, with such a loss in the rotor [A2].
  [[nodiscard]] double current_squared_for_ever(double rotor_loss) const {
    return heat_.cold_loss_for(limit_, rotor_loss) / current_.resistance;
  }
  [[nodiscard]] double temperature_limit() const { return limit_; }  ///< of the winding [K]
  [[nodiscard]] double torque() const { return torque_; }            ///< of the last step [N m]
  [[nodiscard]] double speed() const { return speed_; }              ///< its mean [rad/s]
  [[nodiscard]] double i2t() const { return i2t_; }                  ///< of the amplifier, trips at 1
  [[nodiscard]] double loss() const { return loss_; }                ///< copper loss now [W]

  SignalPort ready;     ///< its supply is there and it has not tripped
  SignalPort mains_ok;  ///< three phases of at least 85 % of their voltage

  // What it adds to a plant's lists; ports under the name of the drive, "servo" or "drive".
  void offer_ports(std::vector<Port>& ports, const std::string& drive);
  void offer_channels(std::vector<Channel>& channels) const;
  void offer_faults(std::vector<Fault>& faults);
  static void offer_events(std::vector<EventType>& types);
  [[nodiscard]] bool has_events() const { return !events_.empty(); }
  [[nodiscard]] std::vector<Event> take_events() { return std::exchange(events_, {}); }

 private:
  void prepare(double h);
  void feed(const Step& step, double speed, double h);
  void saturate(double asked, double h);
  void settle(double h);
  void end_saturation();
  void watch(bool energised);
  void trip(std::string_view event, std::vector<Event::Value> values);
  void show();
  void clear_edges();

  DriveRatings ratings_;
  std::optional<AmplifierData> amplifier_;
  std::optional<DcLink> link_;
  MotorCurrent current_;
  MotorHeat heat_;
  double limit_;  // temperature of the winding that trips [K]

  // Steps that are summed up, and what they sum up to.
  int every_ = 1;
  int steps_ = 0;
  double h_ = 0;  // the step for which every_ and i2t_share_ hold
  double i2t_share_ = 0;
  struct Sum {
    double work = 0;
    double torque_squared = 0;
    double travel = 0;
    double rotor_loss = 0;
    double energised = 0;
  } sum_;
  Sum elsewhere_;                      // of another motor
  const PowerStage* other_ = nullptr;  // that motor, where it had torque since the last settling

  DriveTotals totals_;
  DrivePeaks peaks_;
  double torque_ = 0;
  double speed_ = 0;
  double i2t_ = 0;
  double loss_ = 0;
  double speed_share_ = 1;
  bool tripped_ = false;
  bool armed_ = true;
  bool edge_ = false;  // on a port in the last step

  struct Saturation {
    bool on = false;
    double begin = 0;  // [s]
    double end = 0;    // so far [s]
    double asked = 0;  // largest
  } saturation_;
  std::vector<Event> events_;
};

}  // namespace drycut::plants
