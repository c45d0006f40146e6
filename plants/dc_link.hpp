#pragma once
#include <string>
#include <vector>

#include "plants/plant.hpp"

namespace drycut::plants {

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

 private:
  [[nodiscard]] double rectified(double time) const;  // energy up to which the mains fill the link [J]

  SupplyData data_;
  double nominal_;  // energies at the voltages of the data [J]
  double brake_on_;
  double brake_off_;
  double over_;
  double under_;
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

}  // namespace drycut::plants
