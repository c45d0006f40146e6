#include <cmath>

#include "devices/camming4/cam.hpp"

namespace drycut::devices::camming4 {
namespace {

constexpr int most_zero_rows = 9;    ///< 000 1.2.11
constexpr int most_update_rows = 4;  ///< 000 1.2.12

}  // namespace

// Rows without master space are done at the boundary, in the same sampling, until one takes time.
void Cam::run_rows(int number, const CamSample& sample) {
  while (number > 0) number = execute(number, sample);
  if (state_ != State::moving) return;
  const Space length = covered(sample.master_count);
  pass_boundary(length, false, sample);
  if (length.grains < 0)
    hold(slave_origin_);
  else if (length < current().master)
    show(master_um(length));
  else
    fail(4, current_);
}

/// Does row `number`; the row to do next, or 0.
int Cam::execute(int number, const CamSample& sample) {
  if (number > cam_rows) return fail(6, cam_rows);
  const Row row = take(number);
  const Code* code = find_code(row.codeG);
  if (code == nullptr) return fail(3, number);
  if (code->what == CodeClass::movement && !is_empty_movement(*code, row))
    return enter(*code, row, number, sample);
  adjacent_ = false;
  if (code->what == CodeClass::start_sync) return wait_for_quota(row, number, sample);
  const bool update = code->what == CodeClass::count_update;
  if (update ? ++update_rows_ > most_update_rows : ++zero_rows_ > most_zero_rows) return fail(1, number);
  switch (code->what) {
    case CodeClass::end:
      end();
      return 0;
    case CodeClass::jump:
      return jump_to(row.codeQm, number);
    case CodeClass::conditional_jump:
      return conditional_jump(row, number);
    case CodeClass::loop:
      close_loop();
      return jump_to(1, number);
    case CodeClass::count_update:
      update_counts(row, sample);
      break;
    case CodeClass::recovery:
      beginning_ = false;  // it moves the slave: too early for a 160 (000 1.2.13)
      step_.recovery += row.codeQs;
      step_.recovery_row = number;
      break;
    default:
      break;
  }
  return number + 1;
}

int Cam::enter(const Code& code, const Row& row, int number, const CamSample& sample) {
  if (code.zero_start && jumped_ && !is_standstill(speed_)) return fail(2, number);
  fetch_next(number);
  const SectorEntry entry{.speed = speed_,
                          .softening = adjacent_ ? softening_ : Softening{},
                          .next = next_row_ != 0 ? &next_ : nullptr};
  const SectorResult result = make_sector(code, row, number, settings_, entry);
  for (int i = 0; i < result.warning_count; ++i) warn(result.warnings[static_cast<std::size_t>(i)], number);
  if (result.error != 0) return fail(result.error, number);
  if (softening_due_ && entry.softening.half_width <= 0 && code.qma == Use::softening) warn(10, number);

  current_ = number;
  current() = result.sector;
  current().entered_ahead = adjacent_;
  state_ = State::moving;
  step_.waiting = false;
  step_.row = number;
  step_.codeM = row.codeM;
  softening_due_ = jumped_ = beginning_ = regeared_ = false;
  zero_rows_ = update_rows_ = 0;
  laps_ = 0;
  // A ramp made exactly as steep as the limit is within it, whatever rounding says.
  const double square = sample.master_speed * sample.master_speed * (1 - 1e-9);
  told_gain_ = peak_acceleration(result.sector) * square > limits_.acceleration;
  told_loss_ = peak_deceleration(result.sector) * square > limits_.deceleration;
  if (told_gain_) warn(1, number);
  if (told_loss_) warn(2, number);
  return 0;
}

// 000 1.2.5
int Cam::wait_for_quota(const Row& row, int number, const CamSample& sample) {
  if (!beginning_) return fail(7, number);
  beginning_ = false;
  zero_rows_ = update_rows_ = 0;
  fetch_next(number);
  current_ = number;
  state_ = State::waiting;
  step_.waiting = true;
  step_.row = number;
  step_.codeM = row.codeM;
  quota_ = multiply(row.codeQm, settings_.master.pulse);
  armed_ = master_value(master_origin_, sample) <= quota_;
  if (!armed_) warn(9, number);
  hold(slave_origin_);
  return quota_passed(sample) ? number + 1 : 0;
}

// The master's way past the quota belongs to the next row.
bool Cam::quota_passed(const CamSample& sample) {
  const Point now{sample.master_count, 0, 0};
  const std::int64_t beyond = subtract(master_value(now, sample), quota_);
  if (beyond < 0) armed_ = true;
  if (beyond < 0 || !armed_) return false;
  master_origin_ = moved(now, {-beyond, 0}, settings_.master.measure);
  loop_master_ = master_origin_;
  step_.waiting = false;
  return true;
}

int Cam::jump_to(std::int32_t target, int from) {
  if (target < 1 || target > cam_rows) return fail(6, from);
  jumped_ = true;
  beginning_ = false;
  return target;
}

// 000 1.2.8 [D22]
int Cam::conditional_jump(const Row& row, int number) {
  if (row.codeQma >= row.codeQs) {
    read_out(number, 0);
    return number + 1;
  }
  const int target = jump_to(row.codeQm, number);
  if (target != 0) read_out(number, row.codeQma + 1);
  return target;
}

// 000 1.2.12: by subtraction at the exact boundary, so that what the master has run beyond it stays.
void Cam::update_counts(const Row& row, const CamSample& sample) {
  const std::int32_t code = row.codeG;
  const bool in_bits = code >= 143;
  const std::int64_t master =
      multiply(row.codeQm, in_bits ? settings_.master.measure : settings_.master.pulse);
  const std::int64_t slave = multiply(row.codeQs, in_bits ? settings_.slave.measure : settings_.slave.pulse);
  const bool subtracts = code == 139 || code == 143;
  const bool sets_master = code == 140 || code == 142 || code == 144 || code == 146;
  const bool sets_slave = code == 141 || code == 142 || code == 145 || code == 146;
  if (subtracts || sets_master) {
    const std::int64_t shift = subtracts ? master : subtract(master_value(master_origin_, sample), master);
    step_.master_shift = add(step_.master_shift, shift);
  }
  if (subtracts || sets_slave) {
    const std::int64_t shift = subtracts ? slave : subtract(slave_value(slave_origin_, sample), slave);
    step_.slave_shift = add(step_.slave_shift, shift);
  }
}

// 000 1.2.9. Counts shift by whole grains; a fraction, if arcs left one, is kept for the next loop.
void Cam::close_loop() {
  const Space master{between(loop_master_, master_origin_, settings_.master.measure).grains, 0};
  const Space slave{between(loop_slave_, slave_origin_, settings_.slave.measure).grains, 0};
  step_.master_shift = add(step_.master_shift, master.grains);
  step_.slave_shift = add(step_.slave_shift, slave.grains);
  loop_master_ = moved(loop_master_, master, settings_.master.measure);
  loop_slave_ = moved(loop_slave_, slave, settings_.slave.measure);
}

/// The row as it stands, or as it stood when the row before it was entered (000 1.10, limitation 4).
Row Cam::take(int number) {
  const bool fetched = number == next_row_;
  next_row_ = 0;
  return fetched ? next_ : stored(number);
}

void Cam::fetch_next(int number) {
  next_row_ = number < cam_rows ? number + 1 : 0;
  if (next_row_ != 0) next_ = stored(next_row_);
}

void Cam::end() {
  stop();
  step_.ended = true;
  hold(slave_origin_);
}

}  // namespace drycut::devices::camming4
