#include "sim/scenario/unit_groups.hpp"

namespace drycut::sim::scenario {

const std::vector<UnitGroup>& unit_groups() {
  static const std::vector<UnitGroup> groups = {
      {"length", {"m", "mm", "um", "cm", "in", "ft", "mil"}},
      {"area", {"m2", "mm2", "in2", "ft2"}},
      {"time", {"s", "ms", "us", "min", "h"}},
      {"speed", {"m/s", "m/min", "mm/s", "in/s", "ips", "ft/min", "fpm", "ft/s"}},
      {"acceleration", {"m/s2", "mm/s2", "in/s2", "ft/s2"}},
      {"jerk", {"m/s3", "mm/s3", "in/s3"}},
      {"angle", {"rad", "deg", "rev", "turn"}},
      {"rotational speed", {"rad/s", "rpm", "krpm", "deg/s", "rev/s", "rev/min"}},
      {"angular acceleration", {"rad/s2", "deg/s2", "rev/s2"}},
      {"frequency", {"1/s", "1/min", "Hz", "kHz"}, "1 Hz is 1/s, not a turn a second: write rev/s or rpm"},
      {"mass", {"kg", "g", "t", "lb", "oz", "slug"}, "oz is the ounce of mass, 1/16 lb"},
      {"force", {"N", "kN", "lbf", "ozf", "kgf"}, "a pound of force is lbf: lb alone is a mass"},
      {"torque",
       {"N m", "Nm", "kNm", "mNm", "Ncm", "lbf in", "lb in", "in-lb", "lbf ft", "lb ft", "ft-lb", "ozf in",
        "oz in", "oz-in", "kgf cm", "kgf m"},
       "a pound or an ounce beside a length is the force: lb in is lbf in"},
      {"inertia",
       {"kg m2", "kg m^2", "kg cm2", "g cm2", "lb in2", "lb ft2", "oz in2", "lbf in s2", "lb in s2",
        "lb-in-s2", "lb ft s2", "ozf in s2", "oz in s2", "oz-in-s2", "kgf cm s2", "slug ft2"},
       "lb in2 is a mass times a length squared, lb in s2 a torque over an angular acceleration: 386 times "
       "as much"},
      {"power",
       {"W", "kW", "hp", "HP"},
       "the horsepower of 550 ft lbf/s, 745.7 W; 1 metric horsepower is 735.5 W"},
      {"energy", {"J", "kJ", "W h", "kW h"}},
      {"torque constant", {"N m/A", "Nm/A", "lb in/A", "oz in/A", "ozf in/A"}},
      {"voltage constant", {"V s/rad", "V/krpm", "V/rpm"}},
      {"stiffness", {"N/m", "N/mm", "N/um", "lbf/in"}, "lb/in is a mass per length, refused here"},
      {"damping", {"N s/m", "lbf s/in"}},
      {"torsional stiffness", {"N m/rad", "N m/deg", "lb in/rad", "lb in/deg"}},
      {"torsional damping", {"N m s/rad", "lb in s/rad"}},
      {"pressure, modulus", {"Pa", "bar", "MPa", "GPa", "N/mm2", "psi"}},
      {"density", {"kg/m3", "g/cm3", "lb/in3", "lb/ft3"}},
      {"mass per area", {"kg/m2", "g/m2", "oz/ft2"}},
      {"temperature", {"K", "degC", "celsius", "degF"}, "a temperature; a rise is in K"},
      {"voltage", {"V", "mV", "kV"}},
      {"current", {"A", "mA"}},
      {"resistance", {"ohm", "mohm", "kohm"}},
      {"capacitance", {"F", "mF", "uF"}},
      {"pure number",
       {"%", "line", "lines", "count", "counts", "pulse", "pulses", "bit", "bits", "piece", "pieces", "cut",
        "cuts", "blade", "blades"}},
  };
  return groups;
}

}  // namespace drycut::sim::scenario
