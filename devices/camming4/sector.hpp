#pragma once
#include <array>
#include <cstdint>

#include "devices/camming4/arc.hpp"
#include "devices/camming4/codes.hpp"
#include "devices/camming4/exact.hpp"
#include "devices/camming4/laws.hpp"

namespace drycut::devices::camming4 {

/// One row of the cam table, as the program wrote it; any 32-bit values.
struct Row {
  std::int32_t codeG = 0;
  std::int32_t codeQm = 0;
  std::int32_t codeQs = 0;
  std::int32_t codeQma = 0;
  std::int32_t codeQsa = 0;
  std::int32_t codeM = 0;
  bool operator==(const Row&) const = default;
};

/// What the laws need besides the table.
struct CamSettings {
  Resolution master;  ///< measurem, pulsem
  Resolution slave;   ///< measure, pulse
  int decpt = 0;      ///< 0..3: the tangent axis counts 360*10^decpt Um a turn
  bool operator==(const CamSettings&) const = default;
};

/// An error or a warning with the row that caused it (000 1.3, 1.4); code 0 = none.
struct CamEvent {
  int code = 0;
  int row = 0;
  bool operator==(const CamEvent&) const = default;
};

/// A movement sector made ready to run: its law and its exact spaces.
struct Sector {
  enum class Kind : std::uint8_t { ramps, arc_x, arc_y, gearing };
  Kind kind = Kind::ramps;
  int number = 0;              ///< row of the table
  Row row;                     ///< as it was when the sector was made
  bool reads_out = false;      ///< codeQma shows the executed master space
  bool entered_ahead = false;  ///< entered from the movement row before it: the master may go back
  Law law;
  Arc arc;
  Space master;  ///< exact master space; a gearing's: of one lap
  Space slave;   ///< exact slave space
  double entry_speed = 0;
  double exit_speed = 0;
  Softening exit;  ///< of a softened change into the next row
};

/// Slave motion of a sector at master position m [Um].
CamMotion at(const Sector& sector, double m);
double peak_acceleration(const Sector& sector);
double peak_deceleration(const Sector& sector);

/// A sector with what its law reported.
struct SectorResult {
  Sector sector;
  int error = 0;  ///< 0, 4, 50, 51
  std::array<int, 4> warnings{};
  int warning_count = 0;
};

/// What a sector takes over from the rows around it.
struct SectorEntry {
  double speed = 0;           ///< exit speed of the movement sector before
  Softening softening;        ///< of the change of ratio from the row before
  const Row* next = nullptr;  ///< the row that follows, for a softened exit
};

/// True for a speed that is only what rounding leaves of a sum of ratios.
bool is_standstill(double speed);
/// True for a 154/254 whose codeQma asks for a softened change into the next row.
bool asks_softening(const Row& row);
/// True if the row takes no master space although its code is a movement (133, 134, arcs with zeros).
bool is_empty_movement(const Code& code, const Row& row);
/// Makes the sector of a movement row (spec qem.md 8.4-8.6). Warnings 5, 6 and 7; 1 and 2 need the master's
/// speed, 10 the rows between, and are the caller's.
SectorResult make_sector(const Code& code, const Row& row, int number, const CamSettings& settings,
                         const SectorEntry& entry);

}  // namespace drycut::devices::camming4
