#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "devices/cards.hpp"
#include "devices/device.hpp"
#include "devices/qmove/program.hpp"

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
};
std::string_view name_of(RunTimeError error);

/// What programs work on: memory, timers, terminals and devices of one controller.
struct Machine {
  std::vector<std::int32_t> cells;   ///< laid out by SymbolTable; a single is kept by its bits
  std::vector<std::int64_t> timers;  ///< when each timer elapses [ns]
  std::vector<const DigitalInput*> inputs;
  std::vector<DigitalOutput*> outputs;
  std::vector<std::unique_ptr<Device>> devices;
  std::int64_t now = 0;  ///< [ns]
};

/// A program on its way.
struct Task {
  int at = 0;              ///< next instruction
  bool ended = false;      ///< END was reached
  std::vector<int> calls;  ///< where CALLs return to
};

/// Instructions that a task may execute in one turn; a program that loops without WAIT comes to more.
inline constexpr int max_instructions = 1'000'000;

/// Runs `task` for one turn: until WAIT or END, or until a device that it reads is not settled.
/// After an error task.at is the instruction at fault.
RunTimeError run_turn(const Program& program, Task& task, Machine& machine);

}  // namespace drycut::devices::qmove
