#include "devices/camming4/cam.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace drycut::devices::camming4 {

void Cam::set(const CamSettings& settings) {
  settings_ = {usable(settings.master), usable(settings.slave), settings.decpt};
}

void Cam::write(int number, Column column, std::int32_t value) {
  assert(number >= 1 && number <= cam_rows);
  Row& row = stored(number);
  switch (column) {
    case Column::codeG:
      row.codeG = value;
      break;
    case Column::codeQm:
      row.codeQm = value;
      break;
    case Column::codeQs:
      row.codeQs = value;
      break;
    case Column::codeQma:
      row.codeQma = value;
      break;
    case Column::codeQsa:
      row.codeQsa = value;
      break;
    case Column::codeM:
      row.codeM = value;
      break;
  }
}

bool Cam::refuses(int number, Column column) const {
  if (!step_.running || number != step_.row) return false;
  const bool gearing = state_ == State::moving && sector().kind == Sector::Kind::gearing;
  return !gearing || (column != Column::codeQs && column != Column::codeQsa);
}

void Cam::start(const CamStart& start) {
  for (Row& row : table_)
    if (row.codeG == 190) row.codeQma = 0;
  step_ = {};
  step_.running = true;
  step_.row = 1;
  step_.codeM = table_[0].codeM;
  state_ = State::entering;
  current_ = 1;
  next_row_ = 0;
  master_origin_ = point(start.master_count, 0, settings_.master.measure);
  slave_origin_ = point(start.slave_bits, start.slave_fraction, settings_.slave.measure);
  loop_master_ = master_origin_;
  loop_slave_ = slave_origin_;
  speed_ = 0;
  softening_ = {};
  softening_due_ = jumped_ = adjacent_ = armed_ = false;
  beginning_ = true;
  zero_rows_ = update_rows_ = 0;
  last_master_ = start.master_count;
  hold(slave_origin_);
}

void Cam::stop() {
  state_ = State::idle;
  step_.running = step_.waiting = false;
  step_.row = 0;
  step_.codeM = 0;
}

const CamStep& Cam::advance(const CamSample& sample) {
  step_.ended = false;
  step_.error = {};
  step_.warning_count = step_.read_out_count = 0;
  step_.master_shift = step_.slave_shift = step_.recovery = 0;
  step_.recovery_row = 0;
  switch (state_) {
    case State::idle:
      step_.ratio = 0;
      break;
    case State::entering:
      run_rows(1, sample);
      break;
    case State::waiting:
      if (quota_passed(sample)) run_rows(current_ + 1, sample);
      break;
    case State::moving:
      follow(sample);
      break;
  }
  last_master_ = sample.master_count;
  return step_;
}

Space Cam::covered(std::int64_t master_count) const {
  return between(master_origin_, {master_count, 0, 0}, settings_.master.measure);
}

double Cam::master_um(const Space& length) const {
  return to_double(length) / static_cast<double>(settings_.master.pulse);
}

void Cam::follow(const CamSample& sample) {
  if (current().kind == Sector::Kind::gearing) {
    gear(sample);
    return;
  }
  const Space length = covered(sample.master_count);
  if (length.grains < 0)
    go_back(sample);
  else if (length < current().master)
    run_to(length, sample);
  else
    leave_forward(sample);
}

/// A sampling with the master inside the sector, `length` from its start.
void Cam::run_to(const Space& length, const CamSample& sample) {
  inside_ += 1;
  const CamMotion motion = show(master_um(length));
  const double gradient = motion.acceleration * sample.proven_speed * sample.proven_speed;
  const bool gains = motion.velocity * gradient > 0 || (motion.velocity == 0 && gradient != 0);
  bool& told = gains ? told_gain_ : told_loss_;
  if (told || std::abs(gradient) <= (gains ? limits_.acceleration : limits_.deceleration)) return;
  told = true;
  warn(gains ? 1 : 2, current_);
}

/// The master has passed into a sector, `beyond` its boundary by now; less than 0: it is about to.
void Cam::pass_boundary(const Space& beyond, bool backwards, const CamSample& sample) {
  const double bits = to_double(beyond) / static_cast<double>(settings_.master.measure);
  inside_ = sample.master_way > 0 ? bits / sample.master_way : 0;
  came_back_ = backwards;
}

/// 000 1.3: the master has run through the sector, of which `left` was left at the last sampling, in less
/// than a sampling time. Exactly one sampling time is long enough; 1e-9 of it is left to rounding.
bool Cam::over_too_soon(const Space& left, const CamSample& sample) const {
  const double bits = to_double(left) / static_cast<double>(settings_.master.measure);
  return (1 - inside_) * sample.master_way * (1 - 1e-9) > bits;
}

void Cam::leave_forward(const CamSample& sample) {
  const Sector& sector = current();
  if (!came_back_ && over_too_soon(sector.master + -covered(last_master_), sample)) {
    fail(4, current_);
    return;
  }
  if (sector.reads_out) read_out(sector.number, sector.arc.length);
  master_origin_ = moved(master_origin_, sector.master, settings_.master.measure);
  slave_origin_ = moved(slave_origin_, sector.slave, settings_.slave.measure);
  speed_ = sector.exit_speed;
  softening_ = sector.exit;
  softening_due_ = asks_softening(sector.row);
  adjacent_ = true;
  run_rows(sector.number + 1, sample);
}

// 000 1.10, limitation 5: back into the row before only if the master came from there; else the slave waits
// at the boundary.
void Cam::go_back(const CamSample& sample) {
  if (!current().entered_ahead) {
    hold(slave_origin_);
    pass_boundary(covered(sample.master_count), false, sample);
    return;
  }
  if (came_back_ && over_too_soon(covered(last_master_), sample)) {
    fail(4, current_);
    return;
  }
  next_ = current().row;
  next_row_ = current_;
  --current_;
  const Sector& sector = current();
  master_origin_ = moved(master_origin_, -sector.master, settings_.master.measure);
  slave_origin_ = moved(slave_origin_, -sector.slave, settings_.slave.measure);
  step_.row = sector.number;
  step_.codeM = sector.row.codeM;
  const Space length = covered(sample.master_count);
  pass_boundary(sector.master + -length, true, sample);
  told_gain_ = told_loss_ = false;
  if (length.grains >= 0)
    show(master_um(length));
  else if (sector.entered_ahead)
    fail(4, sector.number);
  else
    hold(slave_origin_);
}

// Gearing (000 1.2.3.2) runs in laps of its codeQm, so that the slave stays exact for ever.
void Cam::gear(const CamSample& sample) {
  Sector& sector = current();
  const Row& live = table_[static_cast<std::size_t>(current_ - 1)];
  const Space lap = sector.master;
  const std::int64_t travel = multiply(subtract(sample.master_count, last_master_), settings_.master.measure);
  if (std::abs(travel) >= lap.grains) {
    fail(4, sector.number);
    return;
  }
  if (live.codeQsa != 2) {
    rebase(last_master_);
    speed_ = live.codeQsa == 1 ? 0 : sector.exit_speed;
    softening_due_ = asks_softening(sector.row);
    adjacent_ = false;
    run_rows(current_ + 1, sample);
    return;
  }
  if (live.codeQs != sector.row.codeQs) change_ratio(live.codeQs);
  Space length = covered(sample.master_count);
  if (length.grains < 0 || length.grains >= lap.grains) {
    const std::int64_t laps = length.grains / lap.grains - (length.grains < 0 ? 1 : 0);
    if (laps < 0 && !regeared_ && laps_ == 0) {
      go_back(sample);
      return;
    }
    run_laps(laps);
    length = covered(sample.master_count);
  }
  show(master_um(length));
  wrap_counts(sample);
}

void Cam::run_laps(std::int64_t laps) {
  const Sector& sector = current();
  const Space master{multiply(laps, sector.master.grains), 0};
  const Space slave{multiply(laps, sector.slave.grains), 0};
  master_origin_ = moved(master_origin_, master, settings_.master.measure);
  slave_origin_ = moved(slave_origin_, slave, settings_.slave.measure);
  laps_ = add(laps_, laps);
}

// The new ratio holds from the last sampling's count.
void Cam::change_ratio(std::int32_t slave) {
  rebase(last_master_);
  Sector& sector = current();
  sector.row.codeQs = slave;
  sector.slave = {multiply(slave, settings_.slave.pulse), 0};
  sector.exit_speed = static_cast<double>(slave) / sector.row.codeQm;
  sector.law = constant(sector.row.codeQm, sector.exit_speed);
  regeared_ = true;
}

void Cam::rebase(std::int64_t master_count) {
  const double slave = at(current(), master_um(covered(master_count))).position;
  const Space length = space(slave * static_cast<double>(settings_.slave.pulse));
  slave_origin_ = moved(slave_origin_, length, settings_.slave.measure);
  master_origin_ = point(master_count, 0, settings_.master.measure);
}

// positm stays below codeQm and posit below codeQs while a gearing runs [D27]. A LOOP that comes after it
// takes off no lap a second time.
void Cam::wrap_counts(const CamSample& sample) {
  const Sector& sector = current();
  const std::int64_t master = master_value({sample.master_count, 0, 0}, sample);
  const std::int64_t master_lap = sector.master.grains;
  if (std::abs(master) >= master_lap) {
    const std::int64_t laps = master - master % master_lap;
    step_.master_shift = add(step_.master_shift, laps);
    loop_master_ = moved(loop_master_, {laps, 0}, settings_.master.measure);
  }
  const std::int64_t slave_lap = std::abs(sector.slave.grains);
  if (slave_lap == 0) return;
  const auto part =
      static_cast<std::int64_t>(step_.slave_fraction * static_cast<double>(settings_.slave.measure));
  const std::int64_t slave = slave_value({step_.slave_bits, part, 0}, sample);
  if (std::abs(slave) < slave_lap) return;
  const std::int64_t laps = slave - slave % slave_lap;
  step_.slave_shift = add(step_.slave_shift, laps);
  loop_slave_ = moved(loop_slave_, {laps, 0}, settings_.slave.measure);
}

std::int64_t Cam::master_value(const Point& point, const CamSample& sample) const {
  const std::int64_t ahead =
      add(multiply(subtract(point.bits, sample.master_count), settings_.master.measure), point.part);
  return add(subtract(sample.master_grains, step_.master_shift), ahead);
}

std::int64_t Cam::slave_value(const Point& point, const CamSample& sample) const {
  const std::int64_t ahead =
      add(multiply(subtract(point.bits, sample.slave_count), settings_.slave.measure), point.part);
  return add(subtract(sample.slave_grains, step_.slave_shift), ahead);
}

CamMotion Cam::show(double m) {
  const Sector& sector = current();
  const CamMotion motion = at(sector, m);
  const auto measure = static_cast<double>(settings_.slave.measure);
  const double bits = (static_cast<double>(slave_origin_.part) + slave_origin_.fraction +
                       motion.position * static_cast<double>(settings_.slave.pulse)) /
                      measure;
  constexpr auto limit = static_cast<double>(grain_limit);
  const double bounded = std::clamp(bits, -limit, limit);
  auto whole = static_cast<std::int64_t>(bounded);
  if (static_cast<double>(whole) > bounded) --whole;
  step_.slave_bits = slave_origin_.bits + whole;
  step_.slave_fraction = bounded - static_cast<double>(whole);
  if (step_.slave_fraction >= 1) {  // a hair below a whole bit
    step_.slave_fraction = 0;
    ++step_.slave_bits;
  }
  step_.ratio = motion.velocity;
  if (sector.reads_out) read_out(sector.number, m);
  return motion;
}

void Cam::hold(const Point& slave) {
  step_.slave_bits = slave.bits;
  constexpr double below_one = 1 - std::numeric_limits<double>::epsilon();
  const double part = static_cast<double>(slave.part) + slave.fraction;
  step_.slave_fraction = std::min(part / static_cast<double>(settings_.slave.measure), below_one);
  step_.ratio = 0;
}

/// Ends the cam with an error; always 0: no row is next.
int Cam::fail(int code, int number) {
  stop();
  step_.ratio = 0;
  step_.error = {code, number};
  return 0;
}

void Cam::warn(int code, int number) {
  assert(step_.warning_count < static_cast<int>(step_.warnings.size()));
  step_.warnings[static_cast<std::size_t>(step_.warning_count++)] = {code, number};
}

void Cam::read_out(int number, double um) {
  const auto value = static_cast<std::int32_t>(std::min(um, 2147483647.0));
  Row& row = stored(number);
  if (row.codeQma == value) return;
  row.codeQma = value;
  assert(step_.read_out_count < static_cast<int>(step_.read_outs.size()));
  step_.read_outs[static_cast<std::size_t>(step_.read_out_count++)] = {number, value};
}

}  // namespace drycut::devices::camming4
