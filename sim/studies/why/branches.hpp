#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/state_archive.hpp"
#include "sim/studies/why/mixed_run.hpp"

namespace drycut::sim::studies {

/// A moment of the run that fails, kept in memory.
struct KeptBranch {
  double at = 0;  ///< [s]
  StateArchive::Bytes state;
};
/// The moments that were kept of a run, and what of it they are made of: who has other members cannot take
/// them.
struct KeptBranches {
  std::vector<KeptBranch> moments;
  std::vector<std::string> members;
};
/// The members of a run's state by their names, at its beginning.
std::vector<std::string> members_of(loop::Simulation& simulation);
/// Moments that are kept of a run, evenly.
inline constexpr int kept_branches = 64;

/// Until when taking differences away still saves the run.
struct PointOfReturn {
  std::optional<double> saved;  ///< [s] the last kept moment from which it passes; absent: it cannot be told
  std::optional<double> lost;   ///< [s] the next one, from which it fails
  std::string unknown;          ///< why it cannot be told; "" = it is

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("saved", self.saved);
    archive("lost", self.lost);
    archive("unknown", self.unknown);
  }
};

/// Branches off from moments of the good run with `cause`: from there on without it. Halves the stretch
/// between a moment from which the run passes and one from which it fails; each branch is a run of the
/// budget. `channels` are those of the run that was kept. `failed_at` [s]: later moments are lost.
PointOfReturn point_of_return(const Mixture& mixture, const Subset& cause, const KeptBranches& kept,
                              const std::vector<std::string>& channels, double failed_at,
                              const FailedCheck& check, MixedTrials& trials);

}  // namespace drycut::sim::studies
