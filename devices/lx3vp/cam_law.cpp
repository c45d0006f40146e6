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
  piece_ = {};
  narrow_cycles_ = 0;
  length_ = 0;
  if (rows_.size() < 2) return;
  length_ = begin_of(rows_.back());
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

// The last one at the end of a cycle.
const RowLaw::Piece& RowLaw::piece_at(std::int64_t part) const {
  if (part < piece_.begin || part >= piece_.end) look_for_piece(part);
  return piece_;
}

// A master that goes on is in the next piece.
void RowLaw::look_for_piece(std::int64_t part) const {
  const std::size_t next = piece_.row + 1;
  const bool goes_on =
      piece_.row > 0 && next < rows_.size() && part >= piece_.end && part < begin_of(rows_[next]);
  const auto found =
      goes_on ? rows_.begin() + static_cast<std::ptrdiff_t>(next)
              : std::upper_bound(rows_.begin(), rows_.end() - 1, part,
                                 [&](std::int64_t at, const Row& row) { return at < begin_of(row); });
  const Row& from = *(found - 1);
  piece_ = {static_cast<std::size_t>(found - rows_.begin()), begin_of(from), begin_of(*found),
            std::int64_t{from.slave} - rows_.front().slave, std::int64_t{found->slave} - from.slave};
}

template <typename Integer>
RowLaw::Slave RowLaw::slave_in(const Place& place) const {
  const Piece& piece = piece_at(place.part);
  const std::int64_t length = piece.end - piece.begin;
  const Integer in_piece = Integer{piece.rise} * (place.part - piece.begin);
  const Integer whole = place.cycle * (Integer{rows_.back().slave} - rows_.front().slave);
  const std::int64_t position = piece.base + static_cast<std::int64_t>(nearest_to<Integer>(in_piece, length));
  // Without a zoom pulses are positions, and those of whole cycles need no rounding.
  if (slave_.numerator == slave_.denominator) {
    const std::int64_t before = limited(whole);
    return {limited(whole + position), before, rows_.front().slave + position};
  }
  const auto pulses = [&](Integer numerator, Integer denominator) {
    return limited(nearest_to<Integer>(numerator * slave_.numerator, denominator * slave_.denominator));
  };
  const Integer in_cycle = Integer{piece.base} * length + in_piece;
  return {pulses(whole * length + in_cycle, length), pulses(whole, 1), rows_.front().slave + position};
}

RowLaw::Slave RowLaw::slave(const Place& place) const {
  return is_within(place.cycle, narrow_cycles_) ? slave_in<std::int64_t>(place) : slave_in<Wide>(place);
}

std::int64_t RowLaw::master_position(const Place& place) const {
  return rows_.front().master + place.part / master_.denominator;
}

}  // namespace drycut::devices::lx3vp
