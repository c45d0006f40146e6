#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "devices/camming4/cam_table.hpp"
#include "sim/cams/kinds.hpp"

namespace drycut::sim::cams {

/// A sector as it ran once, or the wait of sector 160. Positions count on from the start of the cam, whatever
/// loops and counter updates do to the device's counts.
struct CamVisit {
  int row = 0;
  int pass = 1;              ///< 1, 2 ... as the cam comes round
  bool waiting = false;      ///< sector 160: no law, the slave stands
  double master_start = 0;   ///< [master Um]
  double master_length = 0;  ///< a gearing's: until it was released
  double slave_start = 0;    ///< [slave Um]
  double slave_length = 0;
  devices::camming4::Sector sector;

  [[nodiscard]] double master_end() const { return master_start + master_length; }
  /// Its law: a piece for each of its phases.
  [[nodiscard]] std::vector<devices::CamPiece> pieces() const;
  [[nodiscard]] double entry_speed() const { return waiting ? 0 : sector.entry_speed; }
  [[nodiscard]] double exit_speed() const { return waiting ? 0 : sector.exit_speed; }
};
/// Between which positions the slave is during a visit [slave Um].
devices::CamExtremes reach_of(const CamVisit& visit);
/// Largest |speed| [slave Um per master Um] and largest |acceleration| [slave Um per master Um2] of a visit.
double peak_speed(const CamVisit& visit);
double peak_gradient(const CamVisit& visit);

/// An error or a warning of the engine, and where in the run it came.
struct CamEngineEvent {
  bool error = false;
  int number = 0;
  int row = 0;
  int pass = 1;
  std::size_t visits = 0;  ///< sectors begun before or by it
  double speed = 0;        ///< slave's ratio as the sector before left it
};

/// The rows without master space that were passed over from one sector to the next, in order.
struct CamPassage {
  std::vector<int> rows;
  int pass = 1;            ///< in which it began
  std::size_t visits = 0;  ///< sectors run before it
};

/// A cam run without a machine; its course is that of the passes asked for.
struct CamRun : CamCourse {
  enum class End {
    ended,       ///< met 136
    came_round,  ///< ran the passes asked for
    failed,      ///< an error stopped it
    held,        ///< 160 waits for ever
    geared,      ///< a gearing runs until the program releases it, and nothing follows
    cut_short    ///< more than most_visits sectors
  };
  static constexpr std::size_t most_visits = 20000;

  End end = End::ended;
  std::vector<CamVisit> visits;  ///< of the passes asked for, and of one more, which is only judged
  std::size_t shown = 0;         ///< number of the visits that belong to the passes asked for
  std::vector<CamPassage> passages;
  std::vector<CamEngineEvent> events;
  double master_growth = 0;  ///< of the device's counts from pass to pass [Um]; 0: it did not come round
  double slave_growth = 0;
  double end_speed = 0;       ///< slave's ratio when 136 released it
  std::vector<int> released;  ///< gearings that were left after one lap, in the program's stead
};

/// The law of the first `count` visits; sectors that were only entered at their end are left out.
devices::CamLaw law_of(const std::vector<CamVisit>& visits, std::size_t count);

/// Um per second of one unit of the table's speeds.
double um_per_second(const CammingTable& table);
/// "Um/s", "Um/min"; with decimals "unit/s", "unit/min", 1 unit = 10^decpt Um.
std::string speed_unit(const CammingTable& table);

/// Runs CAMMING4's cam engine over the table behind a master that advances slowly from 0, `passes` times
/// round (137 or 138 back to a row before is once round; 190 runs its times), and once more to judge how the
/// cam closes.
CamRun run_cam(const CammingTable& table, const CamDuty& duty, int passes);

}  // namespace drycut::sim::cams
