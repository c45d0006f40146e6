#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/cam/law.hpp"

namespace drycut::sim::cams {

/// What a cam is judged at. Speeds are in the table's own unit: of CAMMING4 10^decpt Um (the unit that the
/// decimal point makes) per unitvel time, as the device's maxvel; of LX3VP pulses per second; of MC_CamIn deg
/// or mm per second.
struct CamDuty {
  std::optional<double> master_speed = {};
  std::optional<double> max_velocity = {};      ///< of the slave
  std::optional<double> max_acceleration = {};  ///< of the slave, [Um/s2, pulses/s2, deg/s2 or mm/s2]
};

/// A cam without a machine, behind a master that runs evenly on from where the cam begins.
struct CamCourse {
  devices::CamLaw law;      ///< of a cycle, from its own first master position on; no pieces if nothing runs
  double first_master = 0;  ///< where the table counts that
  double first_slave = 0;
  int loops = 1;         ///< cycles, one after the other
  int passes = 0;        ///< times round that the law has in itself; 0: it is the one that is repeated
  int drawn = 0;         ///< parts of each row that are drawn at least
  bool holds = false;    ///< each piece holds the slave up to the next one, the last one to the next cycle
  bool lets_go = false;  ///< behind its end the slave stands
  std::optional<double> master_speed = {};  ///< [master's unit/s]

  [[nodiscard]] bool runs() const { return !law.pieces.empty(); }
  [[nodiscard]] double master_total() const { return loops * law.master_length; }
  [[nodiscard]] double slave_total() const { return loops * law.slave_length; }
  /// Where in the cycle a piece is in force: the first one may begin before it and the last one end behind
  /// it.
  [[nodiscard]] double begin_of(std::size_t piece) const;
  [[nodiscard]] double end_of(std::size_t piece) const;
  /// Largest absolute value over the cycle.
  [[nodiscard]] double peak(devices::CamOrder order) const;
};

/// Largest absolute value over pieces.
double peak_of(const std::vector<devices::CamPiece>& pieces, devices::CamOrder order);
/// Between which positions pieces reach; there is one at least.
devices::CamExtremes reach_of(const std::vector<devices::CamPiece>& pieces);

/// A cam at one master position: full precision, before any quantisation. Positions in the table's unit (Um,
/// pulses, increments).
struct CamPoint : devices::CamMotion {
  double master = 0;  ///< counts on across loops and counter updates
  int row = 0;  ///< sector, or row of the table, that begins the piece; 0: the cam has released the slave
};
/// 1000 points a pass, evenly spaced, and every boundary of pieces; where something jumps, before and after.
/// With `both_sides`, for drawing, before and after at every boundary, and `drawn` parts of each row.
std::vector<CamPoint> sample_cam(const CamCourse& course, bool both_sides = false);
/// At the given positions, each within the course, in the order of running; a boundary belongs to the piece
/// that it begins.
std::vector<CamPoint> sample_cam_at(const CamCourse& course, std::vector<double> masters);

/// A stretch of a cam: a sector, a phase, a segment.
struct CamZone {
  double from = 0;  ///< master, in the table's unit
  double to = 0;
  std::string name;          ///< "2 RSC synchronism"
  bool synchronous = false;  ///< the slave runs with the web: at the master's speed, or at a steady ratio
};

/// Names a stretch by the slave's speeds at its ends, in masters: "acceleration", "synchronism", "dwell" ...
/// `steady`: they do not change between.
std::string motion_name(double entry, double exit, bool steady);
/// True at the speed of the master itself.
bool is_master_speed(double speed);

/// Master positions that a run of a cam came over.
struct MasterRange {
  double first = 0;
  double last = 0;
};

/// A cam by the exact laws of its table in double precision: what a run is compared with. Nothing of the
/// device's own arithmetic is in it. Positions in the table's unit.
struct IdealCam {
  std::string master_unit;  ///< to be shown: "Um", "pulses", "mm"
  std::string slave_unit;
  double shown = 1;             ///< of a shown unit in one of the table's
  std::string error_unit;       ///< in which errors are told: "bits x4", "pulses", "deg"
  double error_step = 1;        ///< the least that the device can count, in that unit
  double error_scale = 1;       ///< of them in one of the table's unit of the slave
  double speed_scale = 1;       ///< CamDuty::master_speed of one of the table's master units a second
  std::vector<double> cycles;   ///< where each cycle begins and the last one ends, ascending [master]
  std::vector<double> origins;  ///< where the slave counts a cycle from, one for each of `cycles` [slave]
  std::vector<CamZone> zones;   ///< of all these cycles, in order
  std::function<double(double master)> slave;  ///< not a number where the table alone does not say it
  std::string silence;                         ///< why it does not, "" if it always does

  [[nodiscard]] bool runs() const { return cycles.size() > 1; }
};

/// Fills in the cycles of a cam that goes on for ever, over `range`, in each of them `zones`, which are those
/// of the first one. After a million cycles the rest is left out.
void repeat(IdealCam& ideal, const CamCourse& course, MasterRange range, const std::vector<CamZone>& zones);

}  // namespace drycut::sim::cams
