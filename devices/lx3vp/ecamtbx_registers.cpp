#include "devices/lx3vp/ecamtbx_registers.hpp"

#include <cmath>

#include "devices/lx3vp/block.hpp"

namespace drycut::devices::lx3vp {

namespace {

bool is_s_curve(std::int32_t type) {
  return type == static_cast<int>(EcamType::s_curve_0) || type == static_cast<int>(EcamType::s_curve_1);
}

EcamResult make(const Registers& registers, int list, std::int32_t type) {
  if (is_s_curve(type))
    return make_s_curve(static_cast<EcamType>(type), read_s_curve_parameters(registers, list));
  if (type == static_cast<int>(EcamType::rotary_saw))
    return make_rotary_saw(read_saw_parameters(registers, list));
  if (type == static_cast<int>(EcamType::fly_saw)) return make_fly_saw(read_saw_parameters(registers, list));
  EcamResult result;
  result.error = EcamError::type;
  return result;
}

void write_block(Registers& registers, int block, bool has_sync_zone, const EcamResult& result) {
  registers.set_i16(block + word::rows, static_cast<std::int16_t>(result.rows.size()));
  registers.set_i16(block + word::table_offset, cam_block_words);
  int at = block + cam_block_words;
  for (const auto& row : result.rows) {
    registers.set_i32(at, row.master);
    registers.set_i32(at + 2, row.slave);
    at += row_words;
  }
  std::uint16_t& flags = registers.d[static_cast<std::size_t>(block + word::live)];
  if (result.profile.stops) flags |= live::stop_after_cycle;
  if (!has_sync_zone || (flags & live::sync_output) == 0) return;
  registers.set_u32(block + word::sync_low,
                    static_cast<std::uint32_t>(std::llround(result.profile.sync_begin)));
  registers.set_u32(block + word::sync_high,
                    static_cast<std::uint32_t>(std::llround(result.profile.sync_end)));
}

/// P8 to P11 of K0 and K1.
void report_s_curve(Registers& registers, int list, const EcamResult& result) {
  registers.set_i32(list + 10, result.rows.back().master);
  registers.set_i32(list + 12, result.rows.back().slave);
  registers.set_i32(list + 14, result.uniform_time);
  registers.set_i32(list + 16, result.speed_reached);
}

}  // namespace

SawParameters read_saw_parameters(const Registers& registers, int first) {
  const auto word = [&](int offset) { return static_cast<std::uint16_t>(registers.i16(first + offset)); };
  return {.master_length = registers.i32(first),
          .slave_length = registers.i32(first + 2),
          .sync_length = registers.i32(first + 4),
          .sync_ratio = registers.f32(first + 6),
          .max_ratio = registers.f32(first + 8),
          .acceleration = word(10),
          .curve = word(11),
          .resolution = word(12)};
}

SCurveParameters read_s_curve_parameters(const Registers& registers, int first) {
  return {.length = registers.i32(first),
          .top_speed = registers.i32(first + 2),
          .acceleration = registers.i16(first + 6),
          .deceleration = registers.i16(first + 7),
          .resolution = static_cast<std::uint16_t>(registers.i16(first + 8))};
}

void run_ecamtbx(Registers& registers, int list, std::int32_t type, int block, int result) {
  auto made = make(registers, list, type);
  const auto end = block + cam_block_words + row_words * static_cast<int>(made.rows.size());
  if (made.ok() && end > first_special) made.error = EcamError::area;
  if (made.ok()) write_block(registers, block, !is_s_curve(type), made);
  if (is_s_curve(type)) {
    constexpr int result_word = 19;  // P13
    if (made.ok()) report_s_curve(registers, list, made);
    registers.set_i16(list + result_word, static_cast<std::int16_t>(made.code()));
  }
  registers.set_i32(result, made.code());
}

}  // namespace drycut::devices::lx3vp
