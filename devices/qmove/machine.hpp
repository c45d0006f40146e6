#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "devices/cards.hpp"
#include "devices/device.hpp"
#include "devices/qmove/program.hpp"

namespace drycut {
class StateArchive;
}

namespace drycut::devices {
struct Counts;
}

namespace drycut::devices::qmove {

/// Run-time errors, numbered as QMOS oserr reports them (spec 4.5).
enum class RunTimeError : std::uint8_t {
  none = 0,
  index_out_of_bound = 3,
  recipe_out_of_range = 4,
  step_out_of_range = 5,
  division_by_zero = 6,
  watchdog = 8,
  stack = 9,
  assertion = 255,  ///< of tests: no controller has it
};
std::string_view name_of(RunTimeError error);

/// What programs work on: memory, timers, terminals and devices of one controller.
struct QclMachine {
  std::vector<std::int32_t> cells;   ///< laid out by SymbolTable; a single is kept by its bits
  std::vector<std::int64_t> timers;  ///< when each timer elapses [ns]
  std::vector<const DigitalInput*> inputs;
  std::vector<DigitalOutput*> outputs;
  std::vector<std::unique_ptr<Device>> devices;
  std::int64_t now = 0;  ///< [ns]

  /// A store of which the variable could not keep all.
  struct Cut {
    int at;  ///< instruction
    std::int32_t value;
    std::int32_t kept;
  };
  std::optional<Cut> cut = {};  ///< the last one of a turn; no state: told when the turn ends

  /// Writes and commands to devices so far: each has its number, from 1.
  std::uint64_t posts = 0;
  std::vector<std::uint64_t> oldest_post;  ///< by device: the first of those that wait for its next sample
  /// Counts a write or command that is about to go to `device`.
  void post(std::size_t device) {
    ++posts;
    if (devices[device]->settled()) oldest_post[device] = posts;
  }
};

/// A program on its way.
struct Task {
  int at = 0;              ///< next instruction
  bool ended = false;      ///< END was reached
  std::vector<int> calls;  ///< where CALLs return to

  // A read that waits (spec §2): for what was posted up to `reached`, never for what comes later.
  enum class Wait : std::uint8_t {
    none,
    own,    ///< among it is something of this task
    others  ///< all of it came from other tasks or the scenario
  };
  Wait wait = Wait::none;
  std::uint64_t reached = 0;             ///< Machine::posts when the reading statement was reached
  std::vector<std::uint64_t> last_post;  ///< by device: the task's last write or command
  std::int64_t turned = 0;               ///< when it last came to WAIT or END [ns]
  std::set<int> cuts;                    ///< lines that have been told to cut a value off
  bool told = false;                     ///< that it has not come there for long
  bool in_turn = false;                  ///< its turn goes on when there is time for its next statement
  int left = 0;                          ///< work that is left for this turn then
  int waits_at = -1;             ///< the condition of the WAIT, or the END, at which it stands; -1: at none
  std::int64_t waits_since = 0;  ///< [ns]

  void visit(StateArchive& archive);
};

/// Work that a task may do in one turn [instructions]; a program that loops without WAIT comes to more.
inline constexpr int max_work = 1'000'000;
/// What a write or a command to a device costs of it: the device checks, converts and answers each.
inline constexpr int device_work = 100;

/// Runs `task` for one turn: until WAIT or END, or until a read has to wait for a device's sample.
/// After an error task.at is the instruction at fault. What runs is counted in `counts`, if there are any.
RunTimeError run_turn(const QclProgram& program, Task& task, QclMachine& machine, Counts* counts = nullptr);
/// The same where statements take time: as far as `statements` of them go, which are counted down. The turn
/// goes on with the next call while task.in_turn.
RunTimeError run_statements(const QclProgram& program, Task& task, QclMachine& machine,
                            std::int64_t& statements, Counts* counts = nullptr);

}  // namespace drycut::devices::qmove
