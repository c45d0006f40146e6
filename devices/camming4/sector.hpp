#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "devices/camming4/laws.hpp"

namespace drycut::devices::camming4 {

// Exact positions (spec qem.md 1.4, 8.4). An axis has `measure` Um for every `pulse` bits x4. Both a whole Um
// and a whole bit are whole numbers of the *grain*, 1/(measure*pulse) of `measure` Um: 1 Um = `pulse` grains,
// 1 bit = `measure` grains. A device's posit is trunc(grains / pulse), its count is grains / measure.

/// Resolution of one axis. Values outside 1..2^30 act as the nearest of the two, so that nothing overflows.
struct GrainResolution {
  std::int64_t measure = 1;  ///< [Um], and grains a bit
  std::int64_t pulse = 1;    ///< [bits x4], and grains a Um
  bool operator==(const GrainResolution&) const = default;
  void visit(StateArchive& archive);
};
GrainResolution usable(GrainResolution resolution);

/// A length in grains. The fraction, 0 <= fraction < 1, is other than 0 only after arcs, whose length is
/// irrational, and after a change of a gearing's ratio.
struct Space {
  std::int64_t grains = 0;
  double fraction = 0;
  bool operator==(const Space&) const = default;
  void visit(StateArchive& archive);
};

/// A position: whole bits x4 and a remainder, 0 <= part < measure, 0 <= fraction < 1 [grains]. Bits and
/// remainder are apart so that no run, however long, leaves 64 bits.
struct Point {
  std::int64_t bits = 0;
  std::int64_t part = 0;
  double fraction = 0;
  bool operator==(const Point&) const = default;
  void visit(StateArchive& archive);
};

/// Sums, differences and products that stay at +-2^61 where they would pass it: hostile tables are wrong, not
/// undefined.
inline constexpr std::int64_t grain_limit = std::int64_t{1} << 61;
std::int64_t add(std::int64_t a, std::int64_t b);
std::int64_t subtract(std::int64_t a, std::int64_t b);
std::int64_t multiply(std::int64_t a, std::int64_t b);

/// A length of `grains`, any real number, limited to +-2^61.
Space space(double grains);
Space operator+(Space a, Space b);
Space operator-(Space a);
bool operator<(const Space& a, const Space& b);
double to_double(const Space& length);  ///< [grains]

/// The point `length` further on.
Point moved(const Point& point, Space length, std::int64_t measure);
/// The point of a bit count with a fraction of a bit.
Point point(std::int64_t bits, double fraction, std::int64_t measure);
/// Length from `from` to `to`.
Space between(const Point& from, const Point& to, std::int64_t measure);

/// What the cam engine does with a row.
enum class CodeClass : std::uint8_t {
  no_operation,      ///< passed over
  movement,          ///< consumes master space
  end,               ///< leaves the cam
  jump,              ///< goes to another row
  loop,              ///< goes to row 1 and takes the executed spaces off the counts
  conditional_jump,  ///< jumps a number of times, then goes on
  count_update,      ///< changes the counts, not the axes
  start_sync,        ///< waits for a master quota
  recovery,          ///< asks for a correction beside the cam
};

/// What a row's column means to a code.
enum class Use : std::uint8_t {
  unused,
  master_space,        ///< [master Um]
  slave_space,         ///< [slave Um]
  slave_space_bits,    ///< [slave bits x4]
  master_coefficient,  ///< ratio's master side, not run
  slave_coefficient,   ///< ratio's slave side, not run
  master_count,        ///< new count or count to take off [master Um]
  slave_count,         ///< [slave Um]
  master_count_bits,   ///< [master bits x4]
  slave_count_bits,    ///< [slave bits x4]
  master_quota,        ///< absolute master position [master Um]
  target_row,          ///< 1..128
  times,               ///< number of jumps
  times_done,          ///< read-out: jumps made
  radius,              ///< + short arc, - long arc [Um]
  displacement_x,      ///< [Um]
  displacement_y,      ///< [Um]
  master_done,         ///< read-out: master space executed [master Um]
  softening,           ///< 0 none, 1..4 = 1/2..1/5 of the smaller sector
  sector_type,         ///< 0 movement follows, 1 axis stationary next, 2 gearing
};
/// Unit of a column for tables and messages: "Um", "bits x4", "".
std::string_view unit_of(Use use);

/// One operating instruction of the cam table (000 1.2.13).
struct Code {
  int code = 0;
  std::string_view mnemonic;
  CodeClass what = CodeClass::no_operation;
  bool epicycloidal = false;
  bool zero_start = false;  ///< starts from slave speed 0: error 2 or warning 6 if the slave moves
  Use qm = Use::unused;
  Use qs = Use::unused;
  Use qma = Use::unused;
  Use qsa = Use::unused;
  std::string_view meaning;  ///< one line
};

/// Every code, ascending: what the engine, `drycut cam`, the documentation and the tests walk.
extern const std::array<Code, 39> codes;
/// The row of `codes`, or nullptr if there is no such code.
const Code* find_code(int code);

/// One row of the cam table, as the program wrote it; any 32-bit values.
struct Row {
  std::int32_t codeG = 0;
  std::int32_t codeQm = 0;
  std::int32_t codeQs = 0;
  std::int32_t codeQma = 0;
  std::int32_t codeQsa = 0;
  std::int32_t codeM = 0;
  bool operator==(const Row&) const = default;
  void visit(StateArchive& archive);
};

/// What the laws need besides the table.
struct CamSettings {
  GrainResolution master;  ///< measurem, pulsem
  GrainResolution slave;   ///< measure, pulse
  int decpt = 0;           ///< 0..3: the tangent axis counts 360*10^decpt Um a turn
  bool operator==(const CamSettings&) const = default;
  void visit(StateArchive& archive);
};

/// An error or a warning with the row that caused it (000 1.3, 1.4); code 0 = none.
struct CamEvent {
  int code = 0;
  int row = 0;
  bool operator==(const CamEvent&) const = default;
  void visit(StateArchive& archive);
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

  void visit(StateArchive& archive);
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
