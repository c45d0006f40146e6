#include "plants/transmission.hpp"

#include <cmath>

#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/stiff_pair.hpp"

namespace drycut::plants {

namespace {

constexpr double no_backlash = 1e-10;  // [rad]: less play than this is none

}  // namespace

double transmission_torque(const TransmissionData& data, double twist, double twist_rate) {
  const double damper = data.damping * twist_rate;
  if (data.backlash <= no_backlash) return data.stiffness * twist + damper;
  const double half = data.backlash / 2;
  if (twist > half) {
    const double spring = data.stiffness * (twist - half);
    return std::max(0.0, spring + std::min(spring, damper));
  }
  if (twist < -half) {
    const double spring = data.stiffness * (twist + half);
    return std::min(0.0, spring + std::max(spring, damper));
  }
  return 0;
}

void Transmission::visit(StateArchive& archive) { STATE(archive, twist_, rate_, torque_); }

double resonance(const TransmissionData& data, double motor_inertia, double load_inertia) {
  return std::sqrt(data.stiffness / reduced(motor_inertia * data.ratio * data.ratio, load_inertia));
}

TransmissionData with_stiffness(TransmissionData data, double motor_inertia, double load_inertia) {
  if (data.stiffness > 0) return data;
  constexpr double frequency = 200;  // [Hz]
  constexpr double damping_ratio = 0.05;
  const double omega = units::turn * frequency;
  const double inertia = reduced(motor_inertia * data.ratio * data.ratio, load_inertia);
  data.stiffness = omega * omega * inertia;
  data.damping = 2 * damping_ratio * omega * inertia;
  return data;
}

Parameters transmission_parameters(TransmissionData& data, const TransmissionSources& from) {
  return joined(
      Parameters{
          row("ratio", "", "turns of the motor for one of the load", data.ratio, 0.01, 1000, from.ratio),
          live(row("stiffness", "N m/rad",
                   "torsional stiffness of gear, shaft and coupling, seen at the load; 0 = not known: motor "
                   "and load "
                   "swing at 200 Hz, with 5 % of critical damping",
                   data.stiffness, 0, 1e7, from.stiffness)),
          live(row("damping", "N m s/rad", "torsional damping, seen at the load", data.damping, 0, 1e5,
                   from.damping)),
          live(row("backlash", "deg", "play between the flanks, seen at the load", data.backlash, 0, 10,
                   "none: set it to study its effect")),
          preset_row("type", "kind of gear, whose efficiency and back_efficiency are the defaults", data.type,
                     gear_types(), "none is named: losses are not counted"),
      },
      efficiency_parameters(data.efficiency, "gear.type"));
}

}  // namespace drycut::plants
