#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace drycut::devices::camming4 {

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

}  // namespace drycut::devices::camming4
