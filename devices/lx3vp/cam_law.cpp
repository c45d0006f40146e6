#include "devices/lx3vp/cam_law.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/state_archive.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

namespace {

// Of 64 bits, which a processor divides by itself, or of more.
template <typename Integer>
Integer floor_of(Integer numerator, Integer denominator) {
  const Integer quotient = numerator / denominator;
  return quotient * denominator > numerator ? quotient - 1 : quotient;
}
template <typename Integer>
Integer nearest_to(Integer numerator, Integer denominator) {
  return floor_of<Integer>(2 * numerator + denominator, 2 * denominator);
}
bool is_within(std::int64_t value, std::int64_t limit) { return -limit < value && value < limit; }
// Far beyond what an output can ever give.
std::int64_t limited(Wide value) {
  constexpr Wide most = std::numeric_limits<std::int64_t>::max() / 4;
  return static_cast<std::int64_t>(std::clamp(value, -most, most));
}
std::int64_t limited(std::int64_t value) {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() / 4;
  return std::clamp(value, -most, most);
}

}  // namespace

void CamTableRow::visit(StateArchive& archive) { STATE(archive, master, slave); }
void Zoom::visit(StateArchive& archive) { STATE(archive, numerator, denominator); }
void RowLaw::Place::visit(StateArchive& archive) { STATE(archive, cycle, part); }
void RowLaw::Slave::visit(StateArchive& archive) { STATE(archive, pulses, before, position); }
void RowLaw::visit(StateArchive& archive) {
  STATE(archive, rows_, master_, slave_);
  if (archive.restores()) prepare();
}

std::vector<CamTableRow> read_rows(const Registers& registers, int block) {
  std::vector<CamTableRow> rows(registers.d[static_cast<std::size_t>(block + word::rows)]);
  int at = block + word::table;
  for (auto& row : rows) {
    row = {registers.i32(at), registers.i32(at + 2)};
    at += row_words;
  }
  return rows;
}

CamLaw straight_law(const std::vector<CamTableRow>& rows) {
  CamLaw law;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double length = static_cast<double>(rows[i].master) - rows[i - 1].master;
    const double rise = static_cast<double>(rows[i].slave) - rows[i - 1].slave;
    if (length <= 0) return {};
    const double ratio = rise / length;
    law.pieces.push_back(
        {law.master_length, length, law.slave_length, static_cast<int>(i), CamTransition{ratio, ratio}});
    law.master_length += length;
    law.slave_length += rise;
  }
  return law;
}

RowLaw::RowLaw(std::vector<Row> rows, Zoom master, Zoom slave)
    : rows_(std::move(rows)), master_(master), slave_(slave) {
  assert(rows_.size() >= 2);
  prepare();
}

// The largest product is that of slave_in: twice the pulses as a fraction, and its denominator.
void RowLaw::prepare() {
  last_piece_ = 1;
  narrow_cycles_ = 0;
  if (rows_.size() < 2) return;
  double slave = 1;
  double piece = 1;
  for (std::size_t i = 1; i < rows_.size(); ++i) {
    slave = std::max(slave, std::abs(static_cast<double>(rows_[i].slave) - rows_.front().slave));
    piece = std::max(piece, static_cast<double>(begin_of(rows_[i]) - begin_of(rows_[i - 1])));
  }
  constexpr double most = 0x1p62;
  constexpr double most_cycles = 0x1p40;
  const double a_cycle = 4 * slave * piece * std::max(slave_.numerator, slave_.denominator);
  constexpr double in_cycle = 4;  // a fraction within a cycle is no more than so many cycles
  narrow_cycles_ = static_cast<std::int64_t>(std::clamp(most / a_cycle - in_cycle, 0.0, most_cycles));
}

RowLaw::Place RowLaw::place(std::int64_t counts, std::int64_t first) const {
  // Floor, not truncation: a master that runs backwards leaves cycle 0 for cycle -1 at its end.
  constexpr std::int64_t narrow = std::int64_t{1} << 44;
  if (is_within(counts, narrow) && is_within(first, narrow)) {
    const std::int64_t travelled = first * master_.denominator + counts * master_.numerator;
    const std::int64_t cycle = floor_of(travelled, length());
    return {cycle, travelled - cycle * length()};
  }
  // The limit keeps all products below 128 bit; a counter takes years to reach it.
  constexpr Wide most = Wide{1} << 61;
  const Wide travelled = std::clamp(Wide{first} * master_.denominator + Wide{counts} * master_.numerator,
                                    -most * master_.denominator, most * master_.denominator);
  const Wide cycle = floor_of<Wide>(travelled, length());
  return {limited(cycle), static_cast<std::int64_t>(travelled - cycle * length())};
}

// The row behind a place; the last one at the end of a cycle. A master that goes on is where it was last, or
// in the next piece.
std::size_t RowLaw::piece_at(std::int64_t part) const {
  const auto lies_in = [&](std::size_t piece) {
    return piece < rows_.size() && begin_of(rows_[piece - 1]) <= part && part < begin_of(rows_[piece]);
  };
  if (lies_in(last_piece_)) return last_piece_;
  if (lies_in(last_piece_ + 1)) return ++last_piece_;
  const auto next = std::upper_bound(rows_.begin(), rows_.end() - 1, part,
                                     [&](std::int64_t at, const Row& row) { return at < begin_of(row); });
  last_piece_ = static_cast<std::size_t>(next - rows_.begin());
  return last_piece_;
}

template <typename Integer>
RowLaw::Slave RowLaw::slave_in(const Place& place) const {
  const std::size_t piece = piece_at(place.part);
  const Row& from = rows_[piece - 1];
  const Row& to = rows_[piece];
  const std::int64_t length = begin_of(to) - begin_of(from);
  const Integer rise = Integer{to.slave} - from.slave;
  const Integer base = Integer{from.slave} - rows_.front().slave;
  const Integer in_cycle = base * length + rise * (place.part - begin_of(from));
  const Integer whole = place.cycle * (Integer{rows_.back().slave} - rows_.front().slave);
  const auto pulses = [&](Integer numerator, Integer denominator) {
    return limited(nearest_to<Integer>(numerator * slave_.numerator, denominator * slave_.denominator));
  };
  const auto position = static_cast<std::int64_t>(nearest_to<Integer>(in_cycle, length));
  // Without a zoom pulses are positions, and those of whole cycles need no rounding.
  if (slave_.numerator == slave_.denominator) {
    const std::int64_t before = limited(whole);
    return {limited(whole + position), before, rows_.front().slave + position};
  }
  return {pulses(whole * length + in_cycle, length), pulses(whole, 1), rows_.front().slave + position};
}

RowLaw::Slave RowLaw::slave(const Place& place) const {
  return is_within(place.cycle, narrow_cycles_) ? slave_in<std::int64_t>(place) : slave_in<Wide>(place);
}

std::int64_t RowLaw::master_position(const Place& place) const {
  return rows_.front().master + place.part / master_.denominator;
}

}  // namespace drycut::devices::lx3vp
