#include "devices/lx3vp/ecamtbx_registers.hpp"

#include <fmt/format.h>

#include <cmath>

#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

namespace {

void write_block(Registers& registers, int block, bool has_sync_zone, const EcamResult& result) {
  take_initial_values(registers, block);  // told when a cam starts with them: the program may still write
  registers.put(block + word::own_stop, result.profile.stops ? mid_cam_end : left_cam);
  registers.set_i16(block + word::rows, static_cast<std::int16_t>(result.rows.size()));
  registers.set_i16(block + word::table_offset, cam_block_words);
  int at = block + cam_block_words;
  for (const auto& row : result.rows) {
    registers.set_i32(at, row.master);
    registers.set_i32(at + 2, row.slave);
    at += row_words;
  }
  const unsigned flags = registers.d[static_cast<std::size_t>(block + word::live)];
  if (!has_sync_zone || (flags & live::sync_output) == 0) return;
  registers.set_u32(block + word::sync_low,
                    static_cast<std::uint32_t>(std::llround(result.profile.sync_begin)));
  registers.set_u32(block + word::sync_high,
                    static_cast<std::uint32_t>(std::llround(result.profile.sync_end)));
}

/// P8 to P11 of K0 and K1.
void report_s_curve(Registers& registers, int list, const EcamResult& result) {
  registers.set_i32(list + s_curve_word::last_master, result.rows.back().master);
  registers.set_i32(list + s_curve_word::last_slave, result.rows.back().slave);
  registers.set_i32(list + s_curve_word::uniform_time, result.uniform_time);
  registers.set_i32(list + s_curve_word::speed_reached, result.speed_reached);
}

}  // namespace

SawParameters read_saw_parameters(const Registers& registers, int first) {
  const auto word = [&](int offset) { return static_cast<std::uint16_t>(registers.i16(first + offset)); };
  return {.master_length = registers.i32(first + saw_word::master_length),
          .slave_length = registers.i32(first + saw_word::slave_length),
          .sync_length = registers.i32(first + saw_word::sync_length),
          .sync_ratio = registers.f32(first + saw_word::sync_ratio),
          .max_ratio = registers.f32(first + saw_word::max_ratio),
          .acceleration = word(saw_word::acceleration),
          .curve = word(saw_word::curve),
          .resolution = word(saw_word::resolution)};
}

SCurveParameters read_s_curve_parameters(const Registers& registers, int first) {
  return {.length = registers.i32(first + s_curve_word::length),
          .top_speed = registers.i32(first + s_curve_word::top_speed),
          .acceleration = registers.i16(first + s_curve_word::acceleration),
          .deceleration = registers.i16(first + s_curve_word::deceleration),
          .resolution = static_cast<std::uint16_t>(registers.i16(first + s_curve_word::resolution))};
}

EcamtbxReport run_ecamtbx(Registers& registers, int list, std::int32_t type, int block, int result) {
  const auto wanted = static_cast<EcamType>(type);
  auto made =
      make_table(wanted, read_saw_parameters(registers, list), read_s_curve_parameters(registers, list));
  const auto end = block + cam_block_words + row_words * static_cast<int>(made.rows.size());
  if (made.ok() && end > first_special) made.error = EcamError::area;
  EcamtbxReport report{made.code(), {}};
  // Before the result is written: it may lie in the list.
  if (made.error == EcamError::area)
    report.fault = fmt::format("the table of {} rows from D{} on ends at D{}, beyond D{}", made.rows.size(),
                               block + cam_block_words, end - 1, last_block_word);
  else if (!made.ok())
    report.fault = ecamtbx_fault(registers, list, type, made.error);
  if (made.ok()) write_block(registers, block, !is_s_curve(wanted), made);
  if (is_s_curve(wanted)) {
    if (made.ok()) report_s_curve(registers, list, made);
    registers.set_i16(list + s_curve_word::result, static_cast<std::int16_t>(made.code()));
  }
  registers.set_i32(result, made.code());
  return report;
}

}  // namespace drycut::devices::lx3vp
