#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

struct DesignOptions {
  std::string kind;  ///< rotary_knife, flying_saw, feed
  // Quantities with their units, "" = not given.
  std::string length;
  std::string circumference;
  int blades = 1;
  std::string feed;
  std::string sync;
  std::string thickness;
  std::string speed;
  std::string max_velocity;
  std::string max_acceleration;
  std::string max_travel;
  std::string inertia;
  std::string viscous;
  std::string coulomb;
  bool no_reverse = false;
  std::string minimise = "rms";
  std::string device;        ///< camming4, lx3vp, mc_camin; "" = the cam alone
  std::string table;         ///< file for the device's table, "" = none
  std::string scene;         ///< in which the table is to run: a scenario beside it, "" = none
  std::string master_pulse;  ///< "500 mm/10000"; "" = the scene's, without one 0.01 mm
  std::string slave_pulse;   ///< "" = the scene's, without one 0.02 mm
  std::optional<int> decpt = {};
  std::filesystem::path out;  ///< folder for the picture, "" = none
  bool force = false;         ///< files that drycut did not write are replaced too
};
/// drycut design: 0 designed, 1 `drycut cam` finds fault with the table, 2 bad input or a job that cannot be
/// done, 3 a result could not be written
int design_cam(const DesignOptions& options);

}  // namespace drycut::sim::cli
