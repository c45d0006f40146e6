// Units of the line as EUInformation, by the codes of UNECE Recommendation 20.
import { EUInformation, makeEUInformation, standardUnits } from "./ua.mjs";

const unece = {
  "%": standardUnits.percent,
  A: standardUnits.ampere,
  Hz: standardUnits.hertz,
  J: standardUnits.joule,
  K: standardUnits.kelvin,
  N: standardUnits.newton,
  V: standardUnits.volt,
  W: standardUnits.watt,
  deg: standardUnits.degree,
  degC: standardUnits.degree_celsius,
  kW: standardUnits.kilowatt,
  kg: standardUnits.kilogram,
  m: standardUnits.metre,
  "m/s": standardUnits.metre_per_second,
  "m/s2": standardUnits.metre_per_second_squared,
  min: standardUnits.minute,
  mm: standardUnits.millimetre,
  ms: standardUnits.millisecond,
  rpm: standardUnits.revolutions_per_minute,
  s: standardUnits.second,
  us: standardUnits.microsecond,
  // Those that node-opcua does not have.
  "1/s": makeEUInformation("C97", "1/s", "reciprocal second"),
  "N m": makeEUInformation("NU", "N·m", "newton metre"),
  "N m/rad": makeEUInformation("M93", "N·m/rad", "newton metre per radian"),
  "N s/m": makeEUInformation("C58", "N·s/m", "newton second per metre"),
  "N/m": makeEUInformation("4P", "N/m", "newton per metre"),
  "V/s": makeEUInformation("H46", "V/s", "volt per second"),
  "deg/s": makeEUInformation("E96", "°/s", "degree per second"),
  "deg/s2": makeEUInformation("M45", "°/s²", "degree [unit of angle] per second squared"),
  "kg m2": makeEUInformation("B32", "kg·m²", "kilogram metre squared"),
  "m/min": makeEUInformation("2X", "m/min", "metre per minute"),
  "m/s3": makeEUInformation("M42", "m/s³", "metre per second cubed"),
  "mm/s": makeEUInformation("C16", "mm/s", "millimetre per second"),
  "mm/s2": makeEUInformation("M41", "mm/s²", "millimetre per second squared"),
  ohm: makeEUInformation("OHM", "Ω", "ohm"),
  "rad/s": makeEUInformation("2A", "rad/s", "radian per second"),
  uF: makeEUInformation("4O", "µF", "microfarad"),
  um: makeEUInformation("4H", "µm", "micrometre (micron)"),
};

/// Of a unit as the line writes it; undefined for "". What has no code (counts, bits x4, 0.1 um) has the
/// unitId -1.
export function engineering_unit(unit) {
  if (unit === "") return undefined;
  if (Object.hasOwn(unece, unit)) return unece[unit];
  return new EUInformation({
    namespaceUri: "urn:drycut:units",
    unitId: -1,
    displayName: { text: unit },
    description: { text: unit },
  });
}
