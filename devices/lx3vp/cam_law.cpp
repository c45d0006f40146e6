#include "devices/lx3vp/cam_law.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "devices/lx3vp/block.hpp"

namespace drycut::devices::lx3vp {

namespace {

Wide floor_of(Wide numerator, Wide denominator) {
  const Wide quotient = numerator / denominator;
  return quotient * denominator > numerator ? quotient - 1 : quotient;
}
Wide nearest_to(Wide numerator, Wide denominator) {
  return floor_of(2 * numerator + denominator, 2 * denominator);
}
// Far beyond what an output can ever give.
std::int64_t limited(Wide value) {
  constexpr Wide most = std::numeric_limits<std::int64_t>::max() / 4;
  return static_cast<std::int64_t>(std::clamp(value, -most, most));
}

}  // namespace

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
}

Wide RowLaw::length() const {
  return (Wide{rows_.back().master} - rows_.front().master) * master_.denominator;
}

RowLaw::Place RowLaw::place(std::int64_t counts, std::int64_t first) const {
  // The limit keeps all products below 128 bit; a counter takes years to reach it.
  constexpr Wide most = Wide{1} << 61;
  const Wide travelled = std::clamp(Wide{first} * master_.denominator + Wide{counts} * master_.numerator,
                                    -most * master_.denominator, most * master_.denominator);
  // Floor, not truncation: a master that runs backwards leaves cycle 0 for cycle -1 at its end.
  const Wide cycle = floor_of(travelled, length());
  return {limited(cycle), travelled - cycle * length()};
}

RowLaw::Fraction RowLaw::slave(Wide part) const {
  const Wide unit = master_.denominator;
  const std::int64_t first = rows_.front().master;
  auto next = std::upper_bound(rows_.begin(), rows_.end(), part, [&](Wide at, const Row& row) {
    return at < (Wide{row.master} - first) * unit;
  });
  if (next == rows_.end()) --next;  // the end of the last piece
  const Row& to = *next;
  const Row& from = *(next - 1);
  const Wide length = Wide{to.master} - from.master;
  const Wide rise = Wide{to.slave} - from.slave;
  const Wide base = Wide{from.slave} - rows_.front().slave;
  return {base * length * unit + rise * (part - (Wide{from.master} - first) * unit), length * unit};
}

std::int64_t RowLaw::pulses(const Place& place) const {
  const Fraction in_cycle = slave(place.part);
  const Wide a_cycle = Wide{rows_.back().slave} - rows_.front().slave;
  const Wide total = place.cycle * a_cycle * in_cycle.denominator + in_cycle.numerator;
  return limited(nearest_to(total * slave_.numerator, in_cycle.denominator * slave_.denominator));
}

std::int64_t RowLaw::master_position(const Place& place) const {
  return rows_.front().master + static_cast<std::int64_t>(floor_of(place.part, master_.denominator));
}

std::int64_t RowLaw::slave_position(const Place& place) const {
  const Fraction in_cycle = slave(place.part);
  return rows_.front().slave +
         static_cast<std::int64_t>(nearest_to(in_cycle.numerator, in_cycle.denominator));
}

}  // namespace drycut::devices::lx3vp
