// What DECAM checks before it starts, and what it takes from the block.
#include <fmt/format.h>

#include "devices/lx3vp/decam.hpp"
#include "devices/lx3vp/ecamtbx.hpp"

namespace drycut::devices::lx3vp {

namespace {

constexpr int parameter = 6781;
constexpr int form = 6782;
constexpr std::uint16_t endless = 0xFFFF;

}  // namespace

std::optional<CamFault> Decam::wrong_operand() const {
  const auto wrong = [](std::string text) { return CamFault{parameter, 0, std::move(text)}; };
  const MasterSource& master = operands_.master;
  if (!has_block_)
    return wrong(fmt::format("the block of {} words at D{} goes beyond D{}", block_length, operands_.block,
                             last_block_word));
  if (master.kind == MasterSource::Kind::time && master.number < 1)
    return wrong(fmt::format("the time axis K{} does not move; write K1 (100 us) or more", master.number));
  if (operands_.output < 0 || operands_.output >= pulse_outputs)
    return wrong(fmt::format("Y{:o} gives no pulses; Y0 to Y3 do", operands_.output));
  if (operands_.direction == operands_.output)
    return wrong(fmt::format("Y{:o} is pulse and direction at once", operands_.output));
  return std::nullopt;
}

std::optional<CamFault> Decam::wrong_parameter(CamPort& port, bool taken) const {
  const auto wrong = [](std::string text) { return CamFault{parameter, 0, std::move(text)}; };
  const int at = operands_.block;
  if (taken) return wrong(fmt::format("another instruction gives pulses on Y{:o}", operands_.output));
  for (const int ratio :
       {word::slave_denominator, word::slave_numerator, word::master_denominator, word::master_numerator}) {
    if (block(port, ratio) == 0)
      return wrong(
          fmt::format("word {} (D{}), a term of a ratio, is 0; write 1 to 65535", ratio, at + ratio));
  }
  if (block(port, word::table_offset) != block_length)
    return wrong(fmt::format("word {} (D{}) is {}; the table begins at {}", word::table_offset,
                             at + word::table_offset, block(port, word::table_offset), block_length));
  const int output = block(port, word::sync_output);
  if (output >= terminals)
    return wrong(fmt::format("word {} (D{}) is {}; outputs are 0 to 255", word::sync_output,
                             at + word::sync_output, output));
  if ((block(port, word::live) & live::sync_output) == 0) return std::nullopt;
  if (output == operands_.output || output == operands_.direction)
    return wrong(fmt::format("the synchronous output Y{:o} of word {} (D{}) is the cam's own {}", output,
                             word::sync_output, at + word::sync_output,
                             output == operands_.output ? "pulse output" : "direction"));
  const std::uint32_t low = port.registers.u32(at + word::sync_low);
  const std::uint32_t high = port.registers.u32(at + word::sync_high);
  if (low > high)
    return wrong(fmt::format("the synchronous output is on from {} (D{}) to {} (D{}), which is lower", low,
                             at + word::sync_low, high, at + word::sync_high));
  return std::nullopt;
}

std::optional<CamFault> Decam::wrong_table(CamPort& port) const {
  const auto wrong = [](int row, std::string text) { return CamFault{form, row, std::move(text)}; };
  const int at = operands_.block;
  const int count = block(port, word::rows);
  if (count < min_rows || count > max_rows)
    return wrong(count, fmt::format("a table of {} rows in word {} (D{}); write {} to {}", count, word::rows,
                                    at + word::rows, min_rows, max_rows));
  const int room = (last_block_word + 1 - at - word::table) / row_words;
  if (count > room)
    return wrong(room, fmt::format("row {} of the table goes beyond D{}", room, last_block_word));
  for (int row = 0; row < count; ++row) {
    const int place = at + word::table + row_words * row;
    const std::int32_t master = port.registers.i32(place);
    if (row == 0 && master < 0)
      return wrong(row, fmt::format("the master of row 0 (D{}) is {}; it is not negative", place, master));
    if (row > 0 && master <= port.registers.i32(place - row_words))
      return wrong(row, fmt::format("the master of row {} (D{}) is {}, not above {} of the row before", row,
                                    place, master, port.registers.i32(place - row_words)));
  }
  return std::nullopt;
}

std::optional<CamFault> Decam::take_block(CamPort& port, bool taken) {
  if (auto fault = wrong_parameter(port, taken)) return fault;
  if (auto fault = wrong_table(port)) return fault;
  const Registers& registers = port.registers;
  const int at = operands_.block;
  cyclic_ = block(port, word::start) == 1;
  stops_by_itself_ = block(port, word::own_stop) == mid_cam_end;
  function_ = block(port, word::function);
  const std::uint16_t repeats = block(port, word::repeats);
  cycles_ = repeats == endless && !cyclic_ ? 0 : repeats + 1;
  delay_ = registers.u32(at + word::delay);
  resume_ = (function_ & function::resume) != 0;
  auto rows = read_rows(registers, at);
  const auto zoom = [&](unsigned bit, int numerator, int denominator) {
    if ((function_ & bit) == 0) return Zoom{};
    return Zoom{block(port, numerator), block(port, denominator)};
  };
  first_ = 0;
  if (!cyclic_ && (function_ & function::start_position) != 0) {
    const std::int64_t position = registers.u32(at + word::start_position);
    if (position < rows.front().master || position >= rows.back().master)
      return CamFault{
          parameter, 0,
          fmt::format("the start position {} (D{}) is outside the table; write {} to {}", position,
                      at + word::start_position, rows.front().master, rows.back().master - 1)};
    first_ = position - rows.front().master;
  }
  law_ =
      RowLaw(std::move(rows), zoom(function::master_zoom, word::master_numerator, word::master_denominator),
             zoom(function::slave_zoom, word::slave_numerator, word::slave_denominator));
  return std::nullopt;
}

}  // namespace drycut::devices::lx3vp
