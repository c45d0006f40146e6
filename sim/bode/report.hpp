#pragma once
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "sim/bode/sweep.hpp"

namespace drycut::sim {

/// A sweep with what its text needs.
struct BodeResult {
  std::string scenario;  ///< name of the file
  std::string wire;      ///< "knife.servo.reference"
  std::string terminal;  ///< "2.AN01"
  std::string speed;     ///< channel, "" = none
  std::string speed_unit;
  SweepPlan plan;
  Sweep sweep;
  Margins margins;
};

/// Doubt of a point (BodePoint::doubt) above which it is not to be trusted.
inline constexpr double bode_error_limit = 0.05;

/// What keeps the measurement from being trusted, a line each; empty if nothing does.
std::vector<std::string> bode_doubts(const BodeResult& result);
/// Table and margins as text.
std::string bode_report(const BodeResult& result);
/// One row a frequency: gains and phases of open loop, closed loop, sensitivity and speed.
std::string bode_csv(const BodeResult& result);
/// Gain and phase over the logarithm of the frequency.
renders::Plot bode_plot(const BodeResult& result, const std::string& name);

}  // namespace drycut::sim
