#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plants/plant.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// What a winding and its housing bear. Ambient is the 40 degC for which data sheets rate motors.
struct MotorHeatData {
  double winding_time_constant = 60;    ///< of the winding against its housing [s]
  double housing_time_constant = 2400;  ///< of the housing against the air [s]
  double temperature_rise = 100;        ///< of the winding over ambient, at stall torque for ever [K]
  double temperature_limit = 428.15;    ///< of the winding: its sensor trips the drive [K]
};

/// Rows of the groups `servo.` and `induction_motor.`.
Parameters motor_heat_parameters(MotorHeatData& data, std::string_view source);

/// Temperatures of a motor: winding, housing, air in a row. Of the thermal resistance from winding to air
/// 35 % lie before the housing (usual for flanged servo motors); capacities follow from the time constants.
class MotorHeat {
 public:
  static constexpr double ambient = 313.15;         ///< [K]
  static constexpr double copper = 0.00393;         ///< more resistance a kelvin over 20 degC
  static constexpr double reference = 293.15;       ///< 20 degC, at which resistances are given [K]
  static constexpr double share_of_winding = 0.35;  ///< of the thermal resistance

  /// At stall torque, the loss in the cold winding (20 degC) and what the rotor loses [W].
  MotorHeat(const MotorHeatData& data, double cold_loss, double rotor_loss);

  /// `seconds` with such a mean loss in the winding [W]. Short against the time constants.
  void warm(double loss, double seconds);

  [[nodiscard]] double winding() const { return winding_; }  ///< [K]
  [[nodiscard]] double housing() const { return housing_; }  ///< [K]
  /// Resistance of the winding now over that at 20 degC.
  [[nodiscard]] double resistance() const { return 1 + copper * (winding_ - reference); }
  /// Where the winding ends that has this loss when cold (20 degC) and `other` besides for ever [W]: [K],
  /// infinite where its resistance grows faster than it cools.
  [[nodiscard]] double steady(double cold_loss, double other) const;
  /// The inverse: loss in the cold winding that ends at `winding` [K], at least 0.
  [[nodiscard]] double cold_loss_for(double winding, double other) const;

  void visit(StateArchive& archive);

 private:
  double to_housing_;  // thermal resistance [K/W]
  double to_air_;
  double winding_capacity_;  // [J/K]
  double housing_capacity_;
  double winding_ = ambient;
  double housing_ = ambient;
};

/// Mains, rectifier, capacitor and brake resistor of a drive. Voltages of the link in shares of the rectified
/// mains (root 2 times the voltage between two phases), as they are alike in the classes of 200 and 400 V.
struct SupplyData {
  double voltage = 400;                ///< of the mains between two phases, rms [V]
  double frequency = 50;               ///< of the mains [Hz]
  double capacitance = 1e-3;           ///< of the link [F]
  double brake_voltage = 1.30;         ///< the resistor is switched on here
  double brake_hysteresis = 0.02;      ///< and off so far below
  double overvoltage = 1.45;           ///< trips
  double undervoltage = 0.70;          ///< trips
  double resistor = 40;                ///< brake resistor [ohm], 0 = none
  double resistor_power = 100;         ///< that it bears for ever [W]
  double resistor_time_constant = 60;  ///< thermal [s]
  double resistor_rise = 300;          ///< over ambient, at resistor_power for ever [K]
};

/// Rows of the groups `servo.supply.` and `inverter.supply.`.
Parameters supply_parameters(SupplyData& data);

/// The energy of a DC link. The rectifier is ideal: the link never stands below the mains' peak while they
/// feed it, and nothing goes back. Of three phases the ripple is left out; with one lost, two phases leave
/// the half waves of one voltage.
class DcLink {
 public:
  explicit DcLink(const SupplyData& data);

  /// `seconds` in which the drive takes `energy` [J] out of the link; negative: braking puts it in.
  void carry(double energy, double seconds);

  [[nodiscard]] double voltage() const;  ///< [V]
  /// Voltage over that of the rectified mains at their nominal voltage, at most 1: what is left of the
  /// motor's speeds at which torque falls.
  [[nodiscard]] double speed_share() const;
  [[nodiscard]] double stored() const { return energy_; }                  ///< in the capacitor [J]
  [[nodiscard]] double from_mains() const { return mains_; }               ///< since the start [J]
  [[nodiscard]] double in_resistor() const { return burnt_; }              ///< since the start [J]
  [[nodiscard]] double mains_power() const { return mains_power_; }        ///< now [W]
  [[nodiscard]] double resistor_power() const { return resistor_power_; }  ///< now [W]
  [[nodiscard]] double resistor_load() const { return load_; }   ///< thermal, 1 = all that it bears for ever
  [[nodiscard]] double resistor_temperature() const;             ///< [K]
  [[nodiscard]] bool over() const { return energy_ > over_; }    ///< overvoltage
  [[nodiscard]] bool under() const { return energy_ < under_; }  ///< undervoltage
  [[nodiscard]] bool mains_well() const;  ///< three phases of at least 85 % of their voltage
  [[nodiscard]] const SupplyData& data() const { return data_; }

  /// dip, phase_lost and outage of the mains, under the component name "mains". 0 clears each.
  void offer_faults(std::vector<Fault>& faults);

  void visit(StateArchive& archive);

 private:
  [[nodiscard]] double rectified(double time) const;  // energy up to which the mains fill the link [J]

  const SupplyData data_;
  const double nominal_;  // energies at the voltages of the data [J]
  const double brake_on_;
  const double brake_off_;
  const double over_;
  const double under_;
  double energy_;
  double mains_ = 0;
  double burnt_ = 0;
  double mains_power_ = 0;
  double resistor_power_ = 0;
  double load_ = 0;
  double time_ = 0;
  bool braking_ = false;
  double dip_ = 0;  // share of the voltage that is missing
  bool phase_lost_ = false;
  bool outage_ = false;
};

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
/// A servo motor's grows faster above its rated torque, where its sheet has currents for more torque.
struct MotorCurrent {
  struct Point {
    double torque = 0;   ///< [N m]
    double current = 0;  ///< rms [A]
  };
  double per_torque_squared = 0;  ///< [A2/N2m2]
  /// Rated, at standstill, largest, with straight lines between them; rated.torque 0: there are none.
  Point rated = {};
  Point stall = {};
  Point peak = {};
  double per_rotor_loss = 0;    ///< [A2/W]
  double no_load = 0;           ///< [A]
  double resistance = 1;        ///< loss in the cold windings (20 degC) over I^2 [ohm]
  double rated_rotor_loss = 0;  ///< at stall torque [W]

  [[nodiscard]] bool bends() const { return rated.torque > 0; }
  /// By the points of a motor that bends, beyond the last one on its line [A].
  [[nodiscard]] double amperes(double torque) const;
  /// The inverse [N m].
  [[nodiscard]] double torque_of(double amperes) const;
  /// What the square of the current has more than the torque's square says [A2].
  [[nodiscard]] double more_squared(double torque) const {
    const double current = amperes(torque);
    return current * current - torque * torque * per_torque_squared;
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

  void visit(StateArchive& archive);

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

  void visit(StateArchive& archive);
};

class PowerStage;

/// How contactors between a drive and several motors stand.
struct Feed {
  bool open = false;  ///< they connect nothing: the drive gives no current
  // In the last step:
  const Shaft* turned = nullptr;      ///< what turned; null = the rotor of now
  const PowerStage* other = nullptr;  ///< whose it was, see PowerStage::account
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

    void visit(StateArchive& archive);
  };
  /// Accounts for the last step of `h` seconds. `other`: whose torque it was, another motor of the same type,
  /// by its own stage.
  void account(const Step& step, const Shaft& rotor, double h, const PowerStage* other = nullptr) {
    if (edge_) clear_edges();
    const double speed = 0.5 * (rotor.speed_before + rotor.speed);
    if (other != nullptr) {
      feed(step, *other, speed, h);
    } else {
      sum_.work += step.torque * speed * h;
      sum_.torque_squared += step.torque * step.torque * h;
      if (current_.bends()) sum_.more_current += current_.more_squared(step.torque) * h;
      sum_.travel += std::abs(speed) * h;
      sum_.rotor_loss += step.rotor_loss * h;
      if (step.energised) sum_.energised += h;
      torque_ = step.torque;
      speed_ = speed;
      if (std::abs(torque_) > std::abs(sum_.torque)) {
        sum_.torque = torque_;
        sum_.speed_then = speed;
      }
      sum_.speed = std::max(sum_.speed, std::abs(speed));
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
  void forget_peaks() {
    peaks_ = {};
    sum_.torque = sum_.speed_then = sum_.speed = 0;
  }
  /// Time in which mains_ok was off, for a phase or more than 15 % of the voltage was missing [s].
  [[nodiscard]] double without_mains() const { return without_mains_; }
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
  [[nodiscard]] std::vector<MachineEvent> take_events() { return std::exchange(events_, {}); }

  /// Between two steps, as its events have been taken.
  void visit(StateArchive& archive);

 private:
  void prepare(double h);
  void feed(const Step& step, const PowerStage& other, double speed, double h);
  void saturate(double asked, double h);
  void settle(double h);
  void end_saturation();
  void watch(bool energised);
  void trip(std::string_view event, std::vector<MachineEvent::Value> values);
  void show();
  void clear_edges();

  const DriveRatings ratings_;
  const std::optional<AmplifierData> amplifier_;
  std::optional<DcLink> link_;
  const MotorCurrent current_;
  MotorHeat heat_;
  const double limit_;  // temperature of the winding that trips [K]

  // Steps that are summed up, and what they sum up to.
  int every_ = 1;
  int steps_ = 0;
  double h_ = 0;  // the step for which every_ and i2t_share_ hold
  double i2t_share_ = 0;
  struct Sum {
    double work = 0;
    double torque_squared = 0;
    double more_current = 0;  // [A2 s]
    double torque = 0;        // of the largest size [N m], and the speed then [rad/s]
    double speed_then = 0;
    double speed = 0;  // largest size [rad/s]
    double travel = 0;
    double rotor_loss = 0;
    double energised = 0;

    void visit(StateArchive& archive);
  } sum_;
  Sum elsewhere_;                    // of another motor
  double elsewhere_resistance_ = 0;  // of its winding over that at 20 degC; 0: it had no torque

  DriveTotals totals_;
  double without_mains_ = 0;
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

    void visit(StateArchive& archive);
  } saturation_;
  std::vector<MachineEvent> events_;
};

}  // namespace drycut::plants
