#include "devices/lx3vp/cam_law.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "base/state_archive.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

namespace {

Wide floor_of(Wide numerator, Wide denominator) {
  // Nearly always both fit the 64 bit that a processor divides by itself.
  const auto above = static_cast<std::int64_t>(numerator);
  const auto below = static_cast<std::int64_t>(denominator);
  if (above == numerator && below == denominator) {
    const std::int64_t quotient = above / below;
    return quotient * below > above ? quotient - 1 : quotient;
  }
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

void CamTableRow::visit(StateArchive& archive) { STATE(archive, master, slave); }
void Zoom::visit(StateArchive& archive) { STATE(archive, numerator, denominator); }
void RowLaw::Place::visit(StateArchive& archive) { STATE(archive, cycle, part); }
void RowLaw::Slave::visit(StateArchive& archive) { STATE(archive, pulses, before, position); }
void RowLaw::visit(StateArchive& archive) { STATE(archive, rows_, master_, slave_); }

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

std::int64_t RowLaw::length() const {
  return (std::int64_t{rows_.back().master} - rows_.front().master) * master_.denominator;
}

RowLaw::Place RowLaw::place(std::int64_t counts, std::int64_t first) const {
  // The limit keeps all products below 128 bit; a counter takes years to reach it.
  constexpr Wide most = Wide{1} << 61;
  const Wide travelled = std::clamp(Wide{first} * master_.denominator + Wide{counts} * master_.numerator,
                                    -most * master_.denominator, most * master_.denominator);
  // Floor, not truncation: a master that runs backwards leaves cycle 0 for cycle -1 at its end.
  const Wide cycle = floor_of(travelled, length());
  return {limited(cycle), static_cast<std::int64_t>(travelled - cycle * length())};
}

RowLaw::Fraction RowLaw::in_cycle(std::int64_t part) const {
  const std::int64_t unit = master_.denominator;
  const std::int64_t first = rows_.front().master;
  const auto after = [](std::int64_t at, const Row& row) { return at < row.master; };
  auto next = std::upper_bound(rows_.begin(), rows_.end(), first + part / unit, after);
  if (next == rows_.end()) --next;  // the end of the last piece
  const Row& to = *next;
  const Row& from = *(next - 1);
  const std::int64_t length = (std::int64_t{to.master} - from.master) * unit;
  const std::int64_t rise = std::int64_t{to.slave} - from.slave;
  const std::int64_t base = std::int64_t{from.slave} - rows_.front().slave;
  return {Wide{base} * length + Wide{rise} * (part - (from.master - first) * unit), length};
}

std::int64_t RowLaw::pulses(std::int64_t cycle, const Fraction& in_cycle) const {
  const std::int64_t a_cycle = std::int64_t{rows_.back().slave} - rows_.front().slave;
  const Wide total = Wide{cycle} * a_cycle * in_cycle.denominator + in_cycle.numerator;
  return limited(nearest_to(total * slave_.numerator, Wide{in_cycle.denominator} * slave_.denominator));
}

RowLaw::Slave RowLaw::slave(const Place& place) const {
  const Fraction at = in_cycle(place.part);
  return {pulses(place.cycle, at), pulses(place.cycle, {0, 1}),
          rows_.front().slave + static_cast<std::int64_t>(nearest_to(at.numerator, at.denominator))};
}

std::int64_t RowLaw::master_position(const Place& place) const {
  return rows_.front().master + place.part / master_.denominator;
}

}  // namespace drycut::devices::lx3vp
