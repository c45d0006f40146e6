#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/cli/commands.hpp"
#include "sim/studies/bode/loop.hpp"

namespace drycut::sim::cli {

struct BodeOptions {
  std::filesystem::path scenario;
  studies::LoopRequest loop;
  bool limit_cycle = false;                ///< sweeps the amplitude too; shows the one with the least margin
  bool advise = false;                     ///< which filter the torque of the servo wants
  std::optional<double> min_phase_margin;  ///< [deg], less fails
  std::optional<double> min_gain_margin;   ///< [dB], less fails
  std::string fmi_step;                    ///< communication step of a master, "" = none
  std::string csv;                         ///< "" = none, "-" = standard output
  std::string png;                         ///< "" = none
  std::filesystem::path out;               ///< folder for report, plot and table, "" = none
  std::vector<std::string> set;            ///< overrides of the scenario: path=value
  bool force = false;                      ///< files that drycut did not write are replaced too
};
/// drycut bode: 0 measured, 1 not stable, open, not to be trusted or below a limit, 2 bad input, 3 the
/// simulation failed
int measure_bode(const BodeOptions& options);

}  // namespace drycut::sim::cli
