#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/controller.hpp"
#include "devices/lx3vp/cam_law.hpp"
#include "devices/lx3vp/instructions.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

/// What the cams share with the rest of the PLC in a tick.
struct CamPort {
  Registers& registers;
  const std::array<bool, terminals>& inputs;             ///< levels of X, this tick's
  const std::array<std::int64_t, counters>& high_speed;  ///< pulses of high-speed counters since power-up
  std::array<bool, terminals>& outputs;                  ///< levels of Y, given at once
  bool changed = false;                                  ///< one of them has

  void give(int y, bool level) {
    bool& output = outputs[static_cast<std::size_t>(y)];
    changed = changed || output != level;
    output = level;
    registers.y[static_cast<std::size_t>(y)] = level;
  }
};

/// An error of DECAM: code 6781, 6782 or 6783, and what is wrong with what.
struct CamFault {
  int code = 0;
  int row = 0;  ///< 6782: of the table
  std::string text;
  void visit(StateArchive& archive);
};

/// Something to tell that is no error.
struct CamNote {
  bool warns = true;  ///< else it only informs
  std::string text;
  void visit(StateArchive& archive);
};

/// What moves the master, as counts from tick to tick.
class CamMaster {
 public:
  CamMaster() = default;
  explicit CamMaster(MasterSource source) : source_(source) {}
  /// Counts from here on.
  void begin(const CamPort& port);
  /// Counts since the last call.
  std::int64_t advance(const CamPort& port);
  void visit(StateArchive& archive);

 private:
  [[nodiscard]] bool counts_pulses(const CamPort& port) const;
  [[nodiscard]] std::int64_t value(const CamPort& port) const;

  MasterSource source_;
  std::int64_t last_ = 0;
  std::int32_t ticks_ = 0;  ///< of the time axis, since its last count
};

/// One electronic cam: what an enabled DECAM does every 100 us (003 3, 4, 5).
///
/// Word 5 of the block starts it. It takes the block at that tick, sets bit 0 of word 1 at the next, and from
/// the one after that the master counts: at once if cyclic, from the start signal on if non-cyclic. Where the
/// manual is silent: without `external start` a non-cyclic cam runs once for each time that word 5 starts it;
/// after a stop by M8145.., an error or `stop after cycle`, word 5 has to be 0 for two ticks before it starts
/// again; `resume` after a run that came to its end begins anew.
class Decam {
 public:
  /// The instruction gets power. A fault that is given keeps the cam from starting until it gets power again.
  void enable(const DecamOperands& operands, CamPort& port, const std::optional<CamFault>& fault);
  /// The instruction loses power: stops at once.
  void disable(CamPort& port);
  [[nodiscard]] bool enabled() const { return enabled_; }
  /// It cannot start until it gets power again.
  [[nodiscard]] bool refused() const { return refusal_.has_value(); }
  [[nodiscard]] const DecamOperands& operands() const { return operands_; }
  /// True from the start signal until the cam has come to its end or was stopped.
  [[nodiscard]] bool running() const { return state_ == State::delay || state_ == State::run; }
  /// True if it gives pulses, or owes some.
  [[nodiscard]] bool uses(const PulseOutput& output) const {
    return running() || (state_ != State::idle && target_ != output.position());
  }
  /// Starts of a run so far, and what the last one took from the block.
  [[nodiscard]] std::uint64_t starts() const { return starts_; }
  [[nodiscard]] const RowLaw& law() const { return law_; }
  [[nodiscard]] bool cyclic() const { return repeats_for_ever(); }
  /// The run in table units, from the first row on: the master by its counts, the slave by the pulses given.
  [[nodiscard]] CamMoment moment(const PulseOutput& output) const;
  /// The plain number of the Y that is now its synchronous output.
  [[nodiscard]] std::optional<int> sync_output() const { return sync_output_; }

  /// A tick. `stop` is the flag of its output, `taken` tells that another instruction gives pulses there.
  PulseTick tick(CamPort& port, PulseOutput& output, bool stop, bool taken);

  /// There is a fault or a note to take.
  [[nodiscard]] bool has_news() const { return fault_ || !notes_.empty(); }
  /// What has gone wrong since the last call; nothing if the code is 0.
  std::optional<CamFault> take_fault();
  /// What is worth telling since the last call.
  std::vector<CamNote> take_notes() { return std::exchange(notes_, {}); }

  void visit(StateArchive& archive);

 private:
  enum class State : std::uint8_t {
    idle,
    init,   ///< the block is taken
    armed,  ///< bit 0 is on: waits for its start
    delay,  ///< counts the delay
    run,
    pause,  ///< non-cyclic: 5 ms to the next start
    done    ///< waits for word 5 to be 0
  };
  [[nodiscard]] std::uint16_t& block(CamPort& port, int word) const;
  [[nodiscard]] bool start_level(const CamPort& port) const;
  [[nodiscard]] std::optional<CamFault> wrong_operand() const;
  [[nodiscard]] std::optional<CamFault> wrong_parameter(CamPort& port, bool taken) const;
  [[nodiscard]] std::optional<CamFault> wrong_table(CamPort& port) const;
  [[nodiscard]] std::optional<CamFault> take_block(CamPort& port, bool taken);
  void fail(CamPort& port, CamFault fault);

  void obey_start_word(CamPort& port, PulseOutput& output, bool stop, bool taken);
  void begin(CamPort& port, PulseOutput& output, bool taken);
  void stop(CamPort& port, PulseOutput& output);
  void wait_for_start(CamPort& port, bool edge);
  void start(CamPort& port);
  void count_delay(CamPort& port);
  void run(CamPort& port, std::int64_t counts);
  /// Cyclic, or non-cyclic with HFFFF repeats.
  [[nodiscard]] bool repeats_for_ever() const { return cyclic_ || cycles_ == 0; }
  /// The present cycle is the last.
  [[nodiscard]] bool stops_after_cycle(CamPort& port) const;
  /// The master to the place of the present counts, within what the cam may do; true if it is at its end.
  bool go(CamPort& port);
  bool limit(CamPort& port);
  void finish(CamPort& port);
  void show_positions(CamPort& port, std::int64_t pulses) const;
  void show_status(CamPort& port);
  void drive_sync_output(CamPort& port);
  void tell_late(CamPort& port);
  void judge_thresholds(std::int64_t low, std::int64_t high);
  void raise(CamPort& port, unsigned bits) const;
  void lower(CamPort& port, unsigned bits) const;

  DecamOperands operands_;
  bool enabled_ = false;
  bool has_block_ = false;           ///< S2 leaves room for one
  std::optional<CamFault> refusal_;  ///< of this DECAM, until it gets power again
  std::optional<CamFault> fault_;    ///< not yet told
  State state_ = State::idle;
  unsigned status_ = 0;  ///< the bits of word 1 that only the cam writes
  int zero_ticks_ = 0;   ///< ticks that word 5 has stopped the cam; 2 are enough
  bool last_signal_ = false;

  // Taken from the block at the start.
  bool cyclic_ = false;
  bool stops_by_itself_ = false;  ///< the table is one of midCAMend
  unsigned function_ = 0;
  std::int64_t cycles_ = 1;  ///< of a run; 0 = endless
  std::int64_t delay_ = 0;
  std::int64_t first_ = 0;  ///< master position at which a run begins, from row 0 [table units]
  RowLaw law_;

  // The run.
  CamMaster master_;
  bool resume_ = false;  ///< the next run goes on where the registers say
  bool ended_ = false;   ///< the last run came to its end
  std::uint64_t starts_ = 0;
  std::int64_t counts_ = 0;  ///< of the master since the start
  std::int64_t delayed_ = 0;
  std::int64_t cycle_ = 0;   ///< present one
  std::int64_t base_ = 0;    ///< output position at the start of cycle 0
  std::int64_t target_ = 0;  ///< output position that is due
  RowLaw::Place place_;
  RowLaw::Slave slave_;  ///< there
  int pause_ticks_ = 0;
  std::optional<int> sync_output_;
  bool told_late_ = false;
  std::vector<CamNote> notes_;
};

}  // namespace drycut::devices::lx3vp
