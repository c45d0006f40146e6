#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/loop/signs.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::studies {

/// What a check leaves of its limit, over time [s]; negative beyond it.
using RoomOverTime = std::vector<std::pair<double, double>>;
/// Of a check that looks at record instants or single events, as far as what it names was recorded; else
/// nothing.
RoomOverTime room_over_time(const scenario::Scenario& scenario, const std::string& check,
                            const record::Recording& recording);

/// When the room began to shrink for the last time before the check failed, and what there was of it.
struct Slide {
  double at = 0;  ///< [s]
  double room = 0;
  double failed_at = 0;  ///< [s] where there was none any more
};
std::optional<Slide> slide_of(const RoomOverTime& room);

/// What happened in a run that may announce something.
loop::Signs signs_of(const record::Recording& recording);

/// The channel in which two runs are no longer the same first.
struct Parting {
  std::string channel;
  std::string unit;
  double at = 0;  ///< [s]
  double good = 0;
  double failed = 0;

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("channel", self.channel);
    archive("unit", self.unit);
    archive("at", self.at);
    archive("good", self.good);
    archive("failed", self.failed);
  }
};
/// How far a channel may be from the good run's before it has parted, as a share of that one's range.
inline constexpr double parted = 0.001;
std::optional<Parting> first_parting(const record::Recording& good, const record::Recording& failed);

}  // namespace drycut::sim::studies
