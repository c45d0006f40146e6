#pragma once
#include <cmath>
#include <vector>

#include "plants/linear_axis.hpp"
#include "plants/rotary_axis.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants::makers {

/// What a motion took, of the motor unless it says otherwise.
struct Measured {
  double accelerating = 0;  ///< torque [N m]
  double steady = 0;        ///< torque at constant speed [N m]
  double braking = 0;       ///< torque [N m]
  double rms = 0;           ///< torque, over the whole cycle [N m]
  double speed = 0;         ///< [rpm]
  double power = 0;         ///< at constant speed [W]
  double at_load = 0;       ///< on the carriage [N] or table [N m], accelerating
  double felt_inertia =
      0;               ///< of all behind the rotor, with the losses that it costs to accelerate it [kg m2]
  double inertia = 0;  ///< the same of the machine without losses [kg m2]
};

/// A unit that makers print, in those of Measured.
struct Unit {
  const char* name;
  double is;
};
namespace printed {
inline constexpr double inch = 0.0254;
inline constexpr double pound = 0.45359237;
inline constexpr Unit newton_metre = {"N m", 1};
inline constexpr Unit newton_millimetre = {"N mm", 1e-3};
inline constexpr Unit pound_inch = {"lb in", pound* gravity* inch};
inline constexpr Unit ounce_inch = {"oz in", pound* gravity* inch / 16};
inline constexpr Unit inertia = {"kg cm2", 1e-4};
inline constexpr Unit pound_inch_second2 = {"lb in s2", pound* gravity* inch};
inline constexpr Unit ounce_inch2 = {"oz in2", pound / 16 * inch* inch};
inline constexpr Unit kilonewton = {"kN", 1000};
inline constexpr Unit turns = {"rpm", 1};
inline constexpr Unit watt = {"W", 1};
}  // namespace printed

struct Figure {
  const char* what;
  double value;  ///< as printed
  Unit unit;
  double Measured::*is;
  double by_hand =
      0;  ///< where what is printed is wrong or counts otherwise: what it ought to be, as Measured
};

/// From standstill to `speed` and back.
struct Motion {
  double speed;  ///< of the motor [rpm]
  double ramp;   ///< up, and down [s]
  double steady = 0.5;
  double stop = 0;
};

struct Example {
  const char* name;
  Motion motion;
  void (*linear)(LinearAxisData&);  ///< one of the two
  void (*rotary)(RotaryAxisData&);
  std::vector<Figure> figures;
};

inline double cylinder(double mass, double diameter) { return mass * diameter * diameter / 8; }
inline double shaft(double density, double diameter, double length) {
  return pi / 32 * density * length * std::pow(diameter, 4);
}
inline double pounds_per_cubic_inch(double density) {
  return density * printed::pound / std::pow(printed::inch, 3);
}

/// What a maker does not say is what follows from `data` left as it is: no friction, a gear of 1 without
/// losses, a screw without inertia, a rotor of 46.8 kg cm2.
inline std::vector<Example> makers_examples() {
  using namespace printed;
  using M = Measured;
  constexpr auto thk_vertical = [](LinearAxisData& d) {
    d.mass = 50;
    d.lead = 0.01;
    d.screw_inertia = 3.12e-5;
    d.inclination = pi / 2;
    d.efficiency.driving = 0.9;
    d.guide_friction.coulomb = 20;
    d.drive.servo.rotor_inertia = 5e-5;
  };
  return {
      // Example Ball Screw Selection, B15-69 ff.: WTF2040-2, 1 m every 3.75 s.
      // https://tech.thk.com/en/products/pdf/en_b15_069.pdf
      {"THK, ball screw, horizontal",
       {.speed = 1500, .ramp = 0.15, .steady = 0.85, .stop = 2.6},
       [](LinearAxisData& d) {
         d.mass = 80;
         d.lead = 0.04;
         d.screw_inertia = 1.48e-4;
         d.efficiency.driving = 0.9;
         d.guide_coefficient = 0.003;
         d.guide_friction.coulomb = 15;
         d.drive.servo.rotor_inertia = 1e-3;
       },
       nullptr,
       {{"load inertia", 33.9, inertia, &M::inertia},
        {"rms torque of the cycle", 1305, newton_millimetre, &M::rms},
        {"torque at constant speed", 120, newton_millimetre, &M::steady, 17.35 * 0.04 / turn / 0.9},
        {"torque accelerating", 4730, newton_millimetre, &M::accelerating,
         0.123 + (1e-3 + 1.48e-4 + 3.242e-3 / 0.9) * 1047.2},
        {"torque braking", -4490, newton_millimetre, &M::braking,
         -(1e-3 + 1.48e-4) * 1047.2 - 516 * 0.04 / turn * (2 - 1 / 0.9)}}},
      // The same, B15-83 ff.: BLK1510-5.6, 0.6 m up and down.
      {"THK, ball screw, vertical, up",
       {.speed = 1800, .ramp = 0.2, .steady = 1.8},
       thk_vertical,
       nullptr,
       {{"load inertia", 1.58, inertia, &M::inertia},
        {"torque accelerating", 1100, newton_millimetre, &M::accelerating},
        {"torque at constant speed", 900, newton_millimetre, &M::steady},
        {"torque braking", 700, newton_millimetre, &M::braking}}},
      {"THK, ball screw, vertical, down",
       {.speed = -1800, .ramp = 0.2, .steady = 1.8},
       thk_vertical,
       nullptr,
       {{"torque at constant speed", 830, newton_millimetre, &M::steady, 470 * 0.01 / turn * (2 - 1 / 0.9)}}},
      // Technical Guide for Servo Motor Selection, pages 12 and 13: R88M-U20030 direct on the screw.
      // https://www.ia.omron.com/data_pdf/guide/14/servo_selection_tg_e_1_1_3-13(further_info).pdf
      {"Omron, ball screw",
       {.speed = 1800, .ramp = 0.2, .steady = 1.0, .stop = 0.2},
       [](LinearAxisData& d) {
         d.mass = 5;
         d.lead = 0.01;
         d.screw_inertia = cylinder(3, 0.02);
         d.guide_coefficient = 0.1;
         d.drive.servo.rotor_inertia = 1.23e-5;
       },
       nullptr,
       {{"load inertia", 1.63, inertia, &M::inertia},
        {"torque at constant speed", 7.8e-3, newton_metre, &M::steady},
        {"torque accelerating", 0.173, newton_metre, &M::accelerating},
        {"rms torque of the cycle", 0.0828, newton_metre, &M::rms}}},
      // E-V-MD Series User's Manual, 2.2.2, page 2-5; gear and coupling turn with the motor.
      // https://manualshive.com/en/manual/yaskawa/e-v-md-series/3588034?page=30
      {"Yaskawa, ball screw behind a gear",
       {.speed = 3000, .ramp = 0.1, .steady = 1.0},
       [](LinearAxisData& d) {
         d.mass = 250;
         d.lead = 0.01;
         d.gear.ratio = 2;
         d.gear.efficiency.driving = 0.9;
         d.screw_inertia = shaft(7870, 0.02, 1) + 0.4e-4 * 4;
         d.guide_coefficient = 0.2;
         d.drive.servo.rotor_inertia = 2.6e-5;
       },
       nullptr,
       {{"load inertia", 2.29, inertia, &M::inertia},
        {"torque at constant speed", 0.43, newton_metre, &M::steady},
        {"power at constant speed", 135, watt, &M::power}}},
      // JUNMA Series, Selection of Servomotor Size, page 38: two pulleys and gear B on the belt's shaft with
      // 0.05 N m, gear A and coupling on the motor's.
      // https://manualshive.com/en/manual/yaskawa/junma-series/907670?page=36
      {"Yaskawa, timing belt behind a gear",
       {.speed = 745, .ramp = 0.1, .steady = 0.9},
       [](LinearAxisData& d) {
         d.mass = 4;
         d.lead = 0.064 * pi;
         d.gear.ratio = 5;
         d.gear.efficiency.driving = 0.9;
         d.screw_inertia = 2 * shaft(2690, 0.064, 0.02) + shaft(7870, 0.1, 0.02) +
                           25 * (cylinder(0.3, 0.03) + shaft(7870, 0.02, 0.02));
         d.guide_coefficient = 0.2;
         d.guide_friction.coulomb = 0.05 / 0.032;
         d.drive.servo.rotor_inertia = 2.6e-5;
       },
       nullptr,
       {{"load inertia", 2.69, inertia, &M::inertia},
        {"torque at constant speed", 0.0669, newton_metre, &M::steady}}},
      // Servo Motor Instruction Manual HG-SR, HG-MR, App. 5.9, App. 22 to 25: gears of 25 and 40 mm.
      // https://www.manualslib.com/manual/1309045/Mitsubishi-Electric-Hg-Mr.html?page=372
      {"Mitsubishi, ball screw behind a gear",
       {.speed = 3000, .ramp = 0.15},
       [](LinearAxisData& d) {
         d.mass = 60;
         d.lead = 0.016;
         d.gear.ratio = 1.6;
         d.gear.efficiency.driving = 0.8;
         d.screw_inertia =
             shaft(7800, 0.02, 0.5) + shaft(7800, 0.04, 0.01) + 1.6 * 1.6 * shaft(7800, 0.025, 0.01);
         d.guide_coefficient = 0.2;
         d.drive.servo.rotor_inertia = 0.221e-4;
       },
       nullptr,
       {{"load inertia", 1.9, inertia, &M::inertia}}},
      // AC Servo Motor αi Series Descriptions, B-65262EN/03, 3.2.1, page 46: a gib presses with 490 N, the
      // nut
      // takes 0.8 N m. http://cncmanuals.com/fanuc/41/ac-servo-motor-alpha-i-is-series-descriptions/page/64
      {"Fanuc, table of a machine tool",
       {.speed = 3000, .ramp = 0.2},
       [](LinearAxisData& d) {
         d.mass = 1200;
         d.lead = 0.02;
         d.screw_inertia = 1.96e-3;
         d.efficiency.driving = 0.9;
         d.guide_coefficient = 0.05;
         d.guide_friction.coulomb = 0.05 * 490;
         d.motor_friction.coulomb = 0.8;
         d.drive.servo.rotor_inertia = 7.59e-3;
       },
       nullptr,
       {{"torque at constant speed", 3.0, newton_metre, &M::steady}}},
      // SIMOVERT MASTERDRIVES Motion Control Compendium, 6SE7087-6QX70, page 11-28. Mass, friction and the
      // gear's inertia are read back from the 179.2, 27.47 and 0.914 N m that it prints for them.
      // https://www.easymanua.ls/siemens/simovert-masterdrives/manual/673775?p=928
      {"Siemens, rack and pinion behind a gear",
       {.speed = 914 * 0.2 * rpm, .ramp = 0.2},
       [](LinearAxisData& d) {
         d.mass = 179.2 / 0.07 / (91.4 * 0.07);
         d.lead = 0.14 * pi;
         d.gear.ratio = 10;
         d.gear.efficiency.driving = 0.95;
         d.efficiency.driving = 0.9;
         d.screw_inertia = 0.914 / 914 * 100;
         d.guide_friction.coulomb = 27.47 / 0.07;
         d.drive.servo.rotor_inertia = 6.5e-3;
       },
       nullptr,
       {{"torque accelerating", 31.03, newton_metre, &M::accelerating}}},
      // Atlanta Drive Systems, Rack and Pinion Drive Calculations and Selection, C-54 and C-55; any pinion.
      {"Atlanta, rack, travelling",
       {.speed = 2 / (0.1 * pi) * 60, .ramp = 1},
       [](LinearAxisData& d) {
         d.mass = 820;
         d.lead = 0.1 * pi;
         d.guide_coefficient = 0.1;
         d.drive.servo.rotor_inertia = 0.5;
       },
       nullptr,
       {{"force accelerating", 2.44, kilonewton, &M::at_load}}},
      {"Atlanta, rack, lifting",
       {.speed = 1.08 / (0.1 * pi) * 60, .ramp = 0.27},
       [](LinearAxisData& d) {
         d.mass = 300;
         d.lead = 0.1 * pi;
         d.inclination = pi / 2;
         d.drive.servo.rotor_inertia = 0.2;
       },
       nullptr,
       {{"force accelerating", 4.1, kilonewton, &M::at_load}}},
      // SureServo User Manual, 2nd edition, revision B, appendix B, B-11 to B-13: 50 in within 4 s.
      {"AutomationDirect, belt behind a gear",
       {.speed = 50.0 / 3 / turn * 60 * 10, .ramp = 1, .steady = 2},
       [](LinearAxisData& d) {
         d.mass = 90 * pound;
         d.lead = 2 * inch * pi;
         d.gear.ratio = 10;
         d.efficiency.driving = 0.8;
         d.screw_inertia = 2 * shaft(pounds_per_cubic_inch(0.098), 2 * inch, 0.75 * inch);
         d.guide_coefficient = 0.05;
         d.drive.servo.rotor_inertia = 0.0029 / 9.6 * pound_inch.is;
       },
       nullptr,
       {{"speed", 1592, turns, &M::speed},
        {"load inertia over efficiency", 0.0029, pound_inch_second2, &M::felt_inertia},
        {"torque at constant speed", 0.5, pound_inch, &M::steady, 0.05 * 90 / 10 / 0.8 * pound_inch.is}}},
      // The same, B-14 to B-16: 45 deg in 0.5 s, a quarter of it each ramp.
      {"AutomationDirect, index table behind a gear",
       {.speed = 120, .ramp = 0.125, .steady = 0.25},
       nullptr,
       [](RotaryAxisData& d) {
         d.inertia = shaft(pounds_per_cubic_inch(0.28), 12 * inch, 3.25 * inch);
         d.gear.ratio = 6;
         d.drive.servo.rotor_inertia = 0.014 * pound_inch.is;
       },
       {{"load inertia", 0.133, pound_inch_second2, &M::inertia},
        {"torque accelerating", 13.68, pound_inch, &M::accelerating,
         0.147 * (120 / rpm / 0.125) * pound_inch.is}}},
      // General Catalogue 2003/2004, Technical Reference, F-8, at the gearhead's shaft.
      // https://alaakhamis.org/teaching/SPC418/reading/Motor Sizing Calculations.pdf
      {"Oriental Motor, belt conveyor",
       {.speed = 7 / (4 * pi) * 60, .ramp = 0.5},
       [](LinearAxisData& d) {
         d.mass = 30 * pound;
         d.lead = 4 * inch * pi;
         d.screw_inertia = 2 * cylinder(35.27 / 16 * pound, 4 * inch);
         d.efficiency.driving = 0.9;
         d.guide_coefficient = 0.3;
       },
       nullptr,
       {{"speed", 33.4, turns, &M::speed},
        {"load inertia", 2061, ounce_inch2, &M::inertia},
        {"torque at constant speed", 320, ounce_inch, &M::steady}}},
      // 7 Steps to Help You Choose the Most Suitable Harmonic Gear Rotary Actuator, step 2.
      // https://www.honpine.com/news/Product-News/7-Steps-to-Help-You-Choose-the-Most-Suitable-Harmonic-Gear-Rotary-Actuator.html
      {"Honpine, arm on a harmonic gear",
       {.speed = 3000, .ramp = 0.12},
       nullptr,
       [](RotaryAxisData& d) {
         d.inertia = 0.88;
         d.gear.ratio = 101;
         d.drive.servo.rotor_inertia = 1e-4;
       },
       {{"torque of the gear accelerating", 22.8, newton_metre, &M::at_load}}},
      // WISE WSDV-11020PSB, 3.5.2.2, page 28.
      // https://manualshive.com/ru/manual/weihong/wise-wsdv-11020psb/952565?page=34
      {"Weihong, belt",
       {.speed = 318, .ramp = 0.1},
       [](LinearAxisData& d) {
         d.mass = 10;
         d.lead = 0.05 * pi;
         d.screw_inertia = 2 * cylinder(0.5, 0.05);
         d.drive.servo.rotor_inertia = 0.87e-4;
       },
       nullptr,
       {{"load inertia", 15.6, inertia, &M::inertia, 10 * 0.025 * 0.025 + 3.125e-4}}},
  };
}

}  // namespace drycut::plants::makers
