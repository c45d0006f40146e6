#pragma once
#include <gmock/gmock.h>

#include <utility>
#include <vector>

#include "devices/lx3vp/pulse_unit.hpp"

namespace drycut::devices::lx3vp {

/// The pulse unit without a PLC around it: a cam with its block at D2000, pulses on Y0, direction Y4, master
/// D100, start signal X2. What a scan would do is done by hand, tick by tick.
class CamBench {
 public:
  static constexpr int block = 2000;
  static constexpr int master_register = 100;
  static constexpr int start_input = 2;
  static constexpr int direction = 4;
  static constexpr int step = 7;

  CamBench() {
    operands.master = {MasterSource::Kind::word, master_register};
    operands.block = block;
    operands.start = {true, start_input};
    operands.output = 0;
    operands.direction = direction;
    initialise(block);
    table({{0, 0}, {1000, 1000}});
  }

  /// One that `start` has started, with these bits of its function word.
  explicit CamBench(int mode, unsigned functions = 0) : CamBench() {
    set(word::function, static_cast<int>(functions));
    start(mode);
  }

  /// The manual's initial values of a block.
  void initialise(int at) {
    for (const BlockWord& word : block_words()) {
      if (word.offset >= block_length || word.access == BlockWord::Access::read) continue;
      if (word.words == 2)
        registers.set_i32(at + word.offset, static_cast<std::int32_t>(word.set_up));
      else
        registers.put(at + word.offset, static_cast<std::uint16_t>(word.set_up));
    }
  }
  void table(const std::vector<std::pair<std::int32_t, std::int32_t>>& rows, int at = block) {
    set(word::rows, static_cast<int>(rows.size()), at);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const int place = at + word::table + row_words * static_cast<int>(i);
      registers.set_i32(place, rows[i].first);
      registers.set_i32(place + 2, rows[i].second);
    }
  }
  void set(int offset, int value, int at = block) {
    registers.put(at + offset, static_cast<std::uint16_t>(value));
  }
  void set_wide(int offset, std::int32_t value, int at = block) { registers.set_i32(at + offset, value); }
  [[nodiscard]] int get(int offset, int at = block) const {
    return registers.d[static_cast<std::size_t>(at + offset)];
  }
  [[nodiscard]] std::int32_t get_wide(int offset, int at = block) const { return registers.i32(at + offset); }
  [[nodiscard]] std::vector<std::int32_t> wide_words(std::initializer_list<int> offsets) const {
    std::vector<std::int32_t> values;
    for (const int offset : offsets) values.push_back(get_wide(offset));
    return values;
  }
  /// Whether bits of the status are all on, and others all off.
  [[nodiscard]] testing::AssertionResult flag(unsigned on, unsigned off = 0) const {
    const auto status = static_cast<unsigned>(get(word::status));
    if ((status & on) == on && (status & off) == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "the status is " << status;
  }

  CamPort port() { return {registers, inputs, high_speed, outputs}; }
  void enable(bool on = true) {
    CamPort cams = port();
    unit.decam(step, operands, on, cams);
  }
  /// The output after so many ticks.
  std::int32_t tick(int count = 1) {
    CamPort cams = port();
    for (int i = 0; i < count; ++i) unit.tick(cams);
    return output();
  }
  /// Enables the cam and starts it as word 5 says; it waits for its start signal, or its master counts from
  /// the next tick on.
  void start(int mode) {
    enable();
    set(word::start, mode);
    tick(3);
  }
  /// Stops the cam by word 5 and starts it anew.
  void restart(int mode) {
    set(word::start, 0);
    tick(2);
    set(word::start, mode);
    tick(3);
  }
  void zoom(Zoom master, Zoom slave) {
    set(word::master_numerator, master.numerator);
    set(word::master_denominator, master.denominator);
    set(word::slave_numerator, slave.numerator);
    set(word::slave_denominator, slave.denominator);
  }
  /// Rising edge of X2, taken in a tick.
  void trigger() {
    inputs[start_input] = true;
    tick();
    inputs[start_input] = false;
  }
  /// Moves the master and lets a tick pass; the output then.
  std::int32_t move(std::int32_t counts) {
    const auto now = static_cast<std::uint32_t>(registers.i32(master_register));
    registers.set_u32(master_register, now + static_cast<std::uint32_t>(counts));
    return tick();
  }
  /// The same, and ticks until the output has given all that it owes: it gives 20 pulses a tick at most.
  std::int32_t travel(std::int32_t counts) {
    move(counts);
    for (std::int32_t before = output() + 1; before != output();) {
      before = output();
      tick(2);
    }
    return output();
  }
  /// Pulses given, less those backwards, as the special register of Y0 tells.
  [[nodiscard]] std::int32_t output() const { return registers.i32(8140); }
  [[nodiscard]] bool level(int y) const { return outputs[static_cast<std::size_t>(y)]; }
  /// Messages since the last call: "6781: ...", or the text of a warning.
  std::vector<std::string> notes() {
    std::vector<std::string> texts;
    for (const PulseNote& note : unit.take_notes())
      texts.push_back(note.code <= 0 ? note.text : std::to_string(note.code) + ": " + note.text);
    return texts;
  }

  Registers registers;
  std::array<bool, terminals> inputs{};
  std::array<bool, terminals> outputs{};
  std::array<std::int64_t, counters> high_speed{};
  PulseUnit unit;
  DecamOperands operands;
};

}  // namespace drycut::devices::lx3vp
