#include "devices/lx3vp/decam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/state_archive.hpp"

namespace drycut::devices::lx3vp {

namespace {

constexpr int ticks_between_runs = 50;  // 5 ms (003 4.2.1)
constexpr int ticks_of_zero = 2;        // more than 100 us (003 4.1.2)
constexpr unsigned shared_bits = status::initialised | status::completed | status::cycle_completed;

}  // namespace

void CamFault::visit(StateArchive& archive) { STATE(archive, code, row, text); }
void CamNote::visit(StateArchive& archive) { STATE(archive, warns, text); }
void CamMaster::visit(StateArchive& archive) { STATE(archive, source_, last_, ticks_); }

void Decam::visit(StateArchive& archive) {
  STATE(archive, operands_, enabled_, has_block_, refusal_, fault_, state_, status_, zero_ticks_,
        last_signal_);
  STATE(archive, cyclic_, stops_by_itself_, function_, cycles_, delay_, first_, law_);
  STATE(archive, master_, resume_, ended_, starts_, counts_, delayed_, cycle_, base_, target_, place_, slave_,
        pause_ticks_, sync_output_, told_late_, notes_);
}

void CamMaster::begin(const CamPort& port) {
  last_ = value(port);
  ticks_ = 0;
}

bool CamMaster::counts_pulses(const CamPort& port) const {
  return source_.kind == MasterSource::Kind::counter &&
         port.registers.counts_pulses[static_cast<std::size_t>(source_.number)];
}

std::int64_t CamMaster::value(const CamPort& port) const {
  if (source_.kind == MasterSource::Kind::time) return 0;
  if (source_.kind == MasterSource::Kind::word) return port.registers.i32(source_.number);
  const auto number = static_cast<std::size_t>(source_.number);
  return counts_pulses(port) ? port.high_speed[number] : port.registers.c[number].value;
}

std::int64_t CamMaster::advance(const CamPort& port) {
  if (source_.kind == MasterSource::Kind::time) {
    if (++ticks_ < source_.number) return 0;
    ticks_ = 0;
    return 1;
  }
  const std::int64_t now = value(port);
  const std::int64_t counts = now - std::exchange(last_, now);
  // A register passes from 2147483647 to -2147483648 as a counter does.
  return counts_pulses(port) ? counts : static_cast<std::int32_t>(static_cast<std::uint32_t>(counts));
}

std::uint16_t& Decam::block(CamPort& port, int word) const {
  return port.registers.d[static_cast<std::size_t>(operands_.block + word)];
}

void Decam::raise(CamPort& port, unsigned bits) const {
  block(port, word::status) |= static_cast<std::uint16_t>(bits);
}
void Decam::lower(CamPort& port, unsigned bits) const {
  block(port, word::status) &= static_cast<std::uint16_t>(~bits);
}

bool Decam::start_level(const CamPort& port) const {
  const auto number = static_cast<std::size_t>(operands_.start.number);
  return operands_.start.is_input ? port.inputs[number] : port.registers.m[number];
}

void Decam::enable(const DecamOperands& operands, CamPort& port, const std::optional<CamFault>& fault) {
  operands_ = operands;
  enabled_ = true;
  state_ = State::idle;
  status_ = 0;
  zero_ticks_ = ticks_of_zero;
  has_block_ = operands.block >= 0 && operands.block + block_length - 1 <= last_block_word;
  refusal_ = fault ? fault : wrong_operand();
  if (has_block_) {
    lower(port, status::initialised);
    block(port, word::version) = 1;
  }
  if (refusal_) fail(port, *refusal_);
  if (has_block_) show_status(port);
}

void Decam::disable(CamPort& port) {
  enabled_ = false;
  state_ = State::idle;
  if (!has_block_) return;
  drive_sync_output(port);
  lower(port, status::initialised);
  status_ &= status::stopped | status::parameter_error | status::table_error | status::delayed;
  block(port, word::status) = static_cast<std::uint16_t>((block(port, word::status) & shared_bits) | status_);
}

void Decam::fail(CamPort& port, CamFault fault) {
  state_ = State::idle;
  if (has_block_) {
    status_ |= status::stopped;
    if (fault.code == 6781) status_ |= status::parameter_error;
    if (fault.code == 6782) status_ |= status::table_error;
    block(port, word::error) = static_cast<std::uint16_t>(fault.code == 6782 ? fault.row : fault.code);
  }
  fault_ = std::move(fault);
}

std::optional<CamFault> Decam::take_fault() { return std::exchange(fault_, std::nullopt); }

bool Decam::stops_after_cycle(CamPort& port) const {
  return stops_by_itself_ || (block(port, word::live) & live::stop_after_cycle) != 0;
}

PulseTick Decam::tick(CamPort& port, PulseOutput& output, bool stop, bool taken) {
  if (!enabled_ || !has_block_) return {0, output.forwards(), false};
  const bool level = start_level(port);
  const bool edge = !std::exchange(last_signal_, level) && level;
  bool may_start = state_ == State::armed;  // from the tick after bit 0 has gone on
  obey_start_word(port, output, stop, taken);
  if (state_ == State::pause && --pause_ticks_ == 0) {
    raise(port, status::initialised);
    state_ = State::armed;
    may_start = true;
  }
  if (state_ == State::armed) {
    if (may_start) wait_for_start(port, edge);
  } else if (state_ == State::delay) {
    count_delay(port);
  } else if (state_ == State::run) {
    run(port, master_.advance(port));
  }
  PulseTick tick{0, output.forwards(), false};
  if (state_ != State::idle) {
    const std::int32_t most = port.registers.i32(operands_.block + word::max_frequency);
    tick = output.follow(target_, most < 0 || most > max_frequency_hz ? max_frequency_hz : most);
    if (tick.late) {
      status_ |= status::delayed;
      tell_late(port);
    }
    if (state_ != State::init && state_ != State::armed)
      show_positions(port, output.position() - base_ - slave_.before);
  }
  drive_sync_output(port);
  show_status(port);
  return tick;
}

// Once a start.
void Decam::tell_late(CamPort& port) {
  if (std::exchange(told_late_, true)) return;
  const int limit = operands_.block + word::max_frequency;
  if (port.registers.i32(limit) == 0)
    notes_.push_back({true, fmt::format("D{} is 0: nothing comes out of Y{:o}; write 1 to {}", limit,
                                        operands_.output, max_frequency_hz)});
  else
    notes_.push_back(
        {true, fmt::format("the frequency limit of D{} holds back pulses of Y{:o}; they come later", limit,
                           operands_.output)});
}

// Word 5 starts and stops; the flag of the output stops too, and lasts until word 5 starts anew.
void Decam::obey_start_word(CamPort& port, PulseOutput& output, bool stop_pulses, bool taken) {
  const int command = block(port, word::start);
  const bool start = command == 1 || command == 2;
  if (state_ == State::init) {
    raise(port, status::initialised);
    state_ = State::armed;
    last_signal_ = start_level(port);
    if (start && !stop_pulses) return;  // the start comes with the next tick
  }
  if (!start || stop_pulses) {
    if (state_ != State::idle) stop(port, output);
    zero_ticks_ = start ? 0 : std::min(zero_ticks_ + 1, ticks_of_zero);
    return;
  }
  if (state_ == State::idle && zero_ticks_ >= ticks_of_zero && !refusal_) begin(port, output, taken);
  zero_ticks_ = 0;
}

void Decam::begin(CamPort& port, PulseOutput& output, bool taken) {
  status_ = 0;
  block(port, word::error) = 0;
  if (const auto given = take_initial_values(port.registers, operands_.block); !given.empty())
    notes_.push_back({false, fmt::format("the block D{} has the initial values of its words that nothing has "
                                         "written: {}",
                                         operands_.block, given)});
  if (auto fault = take_block(port, taken)) {
    fail(port, std::move(*fault));
    return;
  }
  state_ = State::init;
  told_late_ = false;
  target_ = output.position();
  output.halt();
  output.face(true);
  master_ = CamMaster(operands_.master);
}

void Decam::stop(CamPort& port, PulseOutput& output) {
  state_ = State::idle;
  target_ = output.position();
  output.halt();
  lower(port, status::initialised);
}

void Decam::wait_for_start(CamPort& port, bool edge) {
  if ((function_ & function::external_start) != 0 && !edge) return;
  start(port);
}

// The master counts from here; the slave stays where it is, at the place of the table where the run begins.
void Decam::start(CamPort& port) {
  ++starts_;
  master_.begin(port);
  const std::uint32_t registered = port.registers.u32(operands_.block + word::master_counts);
  const bool went_on = !ended_ || registered != static_cast<std::uint32_t>(counts_);
  const bool resumed = std::exchange(resume_, false) && went_on;
  // The registers hold 32 bit of a longer count: the nearest such count is meant.
  counts_ =
      resumed ? counts_ + static_cast<std::int32_t>(registered - static_cast<std::uint32_t>(counts_)) : 0;
  ended_ = false;
  go(port);
  slave_ = law_.slave(place_);
  cycle_ = place_.cycle;
  const std::int64_t in_cycle =
      resumed ? port.registers.i32(operands_.block + word::slave_pulses) : slave_.pulses - slave_.before;
  base_ = target_ - in_cycle - slave_.before;
  delayed_ = 0;
  state_ = !cyclic_ && (function_ & function::delayed_start) != 0 && delay_ > 0 ? State::delay : State::run;
}

void Decam::count_delay(CamPort& port) {
  delayed_ += master_.advance(port);
  if (delayed_ < delay_) return;
  state_ = State::run;
  run(port, delayed_ - delay_);
}

void Decam::run(CamPort& port, std::int64_t counts) {
  counts_ += counts;
  const RowLaw::Place before = place_;
  const bool at_end = go(port);
  if (place_ != before) slave_ = law_.slave(place_);
  target_ = base_ + slave_.pulses;
  if (place_.cycle > cycle_)
    raise(port, repeats_for_ever() ? status::completed | status::cycle_completed : status::cycle_completed);
  cycle_ = place_.cycle;
  if (at_end) finish(port);
}

CamMoment Decam::moment(const PulseOutput& output) const {
  if (state_ != State::run) return {};
  const auto ratio = [](const Zoom& zoom) {
    return static_cast<double>(zoom.numerator) / static_cast<double>(zoom.denominator);
  };
  const CamTableRow& first = law_.rows().front();
  CamMoment moment;
  moment.follows = true;
  moment.master =
      first.master + static_cast<double>(first_) + static_cast<double>(counts_) * ratio(law_.master_zoom());
  moment.set = first.slave + static_cast<double>(output.position() - base_) / ratio(law_.slave_zoom());
  return moment;
}

bool Decam::go(CamPort& port) {
  place_ = law_.place(counts_, first_);
  return limit(port);
}

bool Decam::limit(CamPort& port) {
  // A non-cyclic cam has nothing before its first row.
  if (!repeats_for_ever() && place_.cycle < 0) place_ = {0, 0};
  if (stops_after_cycle(port) && state_ == State::run && place_.cycle != cycle_) {
    place_ = {cycle_, place_.cycle > cycle_ ? law_.length() : 0};
    return true;
  }
  if (repeats_for_ever() || place_.cycle < cycles_) return false;
  place_ = {cycles_ - 1, law_.length()};
  return true;
}

void Decam::finish(CamPort& port) {
  raise(port, status::completed | status::cycle_completed);
  lower(port, status::initialised);
  ended_ = true;
  const bool again = !cyclic_ && !stops_after_cycle(port) && (function_ & function::external_start) != 0;
  state_ = again ? State::pause : State::done;
  pause_ticks_ = ticks_between_runs;
}

void Decam::show_positions(CamPort& port, std::int64_t pulses) const {
  std::uint16_t* const words = &block(port, 0);
  const auto show = [words](int first, std::int64_t value) {
    words[first] = static_cast<std::uint16_t>(value);
    words[first + 1] = static_cast<std::uint16_t>(value >> 16);
  };
  show(word::slave_pulses, pulses);
  show(word::slave_position, slave_.position);
  show(word::master_position, law_.master_position(place_));
  show(word::master_counts, counts_);
}

void Decam::show_status(CamPort& port) {
  status_ &= ~(status::cyclic | status::non_cyclic | status::in_window | status::time_axis);
  const bool active = state_ != State::idle && state_ != State::done;
  const bool turned = cycles_ == 0 && running();
  if (active) status_ |= cyclic_ || turned ? status::cyclic : status::non_cyclic;
  if (sync_output_ && port.outputs[static_cast<std::size_t>(*sync_output_)]) status_ |= status::in_window;
  if (operands_.master.kind == MasterSource::Kind::time) status_ |= status::time_axis;
  block(port, word::status) = static_cast<std::uint16_t>((block(port, word::status) & shared_bits) | status_);
}

// The output is the cam's while it runs with the synchronous output enabled; else the program's.
void Decam::drive_sync_output(CamPort& port) {
  const int number = block(port, word::sync_output);
  const bool works =
      state_ == State::run && (block(port, word::live) & live::sync_output) != 0 && number < terminals;
  if (sync_output_ && (!works || *sync_output_ != number)) port.give(*sync_output_, false);
  const bool begins = works && !sync_output_;
  sync_output_.reset();
  if (!works) return;
  sync_output_ = number;
  const std::int64_t position = law_.master_position(place_);
  const std::int64_t low = port.registers.u32(operands_.block + word::sync_low);
  const std::int64_t high = port.registers.u32(operands_.block + word::sync_high);
  if (begins) judge_thresholds(low, high);
  port.give(number, low <= position && position <= high);
}

void Decam::judge_thresholds(std::int64_t low, std::int64_t high) {
  const std::int64_t last = law_.rows().back().master;
  if (high <= last) return;
  const int at = operands_.block + (low > last ? word::sync_low : word::sync_high);
  notes_.push_back(
      {true,
       fmt::format("the threshold {} of the synchronous output (D{}) lies beyond the table's "
                   "last master {}: {}; write up to {}",
                   low > last ? low : high, at, last,
                   low > last ? "the output never comes on" : "the output stays on to the end of the cycle",
                   last)});
}

}  // namespace drycut::devices::lx3vp
