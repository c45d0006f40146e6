#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plants/contactor_drive.hpp"
#include "plants/inverter.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {

constexpr double sync = 1500 / rpm;  // of the default motor [rad/s]

/// Kloss and its inverse by hand: pull-out slip of the default winding [rad/s].
inline double pullout_slip(const WindingData& w) {
  const double r = w.pullout_torque / w.rated_torque;
  return (w.synchronous_speed - w.rated_speed) / (r - std::sqrt(r * r - 1));
}
inline double kloss(const WindingData& w, double slip) {
  const double s = slip / pullout_slip(w);
  return 2 * w.pullout_torque / (s + 1 / s);
}

/// A drive on a free rotor with a load torque.
template <class Drive, class Data>
struct Stand {
  World world;
  Shaft& rotor;
  Drive drive;
  double load = 0;  // against positive motion [N m]
  int steps = 0;
  explicit Stand(const Data& data = {}, double inertia = 0.05)
      : rotor(world.add_shaft({.name = "rotor", .inertia = inertia})), drive(data, InductionMotorData{}) {}
  void step() {
    drive.drive(rotor, h);
    rotor.add_torque(-load);
    world.step(h);
    ++steps;
  }
  void run(double seconds) {
    for (long i = std::lround(seconds / h); i > 0; --i) step();
    ASSERT_EQ(world.failure(), "");
  }
  std::vector<Fault> faults() {
    std::vector<Fault> list;
    drive.offer_faults(list);
    return list;
  }
};
using InverterStand = Stand<Inverter, InverterData>;
using ContactorStand = Stand<ContactorDrive, ContactorData>;

}  // namespace drycut::plants
