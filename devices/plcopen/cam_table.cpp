#include "devices/plcopen/cam_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include "base/state_archive.hpp"
#include "base/text.hpp"

namespace drycut::devices::plcopen {
namespace {

constexpr double word_limit = std::numeric_limits<std::int16_t>::max();
constexpr double long_limit = std::numeric_limits<std::int32_t>::max();

constexpr std::array table_types{
    TableType{1, 1, true, word_limit, "slave positions, SGN16"},
    TableType{2, 1, true, long_limit, "slave positions, SGN32"},
    TableType{3, 1, false, 0, "slave positions, REAL64"},
    TableType{4, 4, true, long_limit, "a0 a1 a2 a3 of a polynomial, SGN32"},
    TableType{5, 4, false, 0, "a0 a1 a2 a3 of a polynomial, REAL64"},
    TableType{6, 0, false, 0, "motion patterns of the maker"},
    TableType{7, 2, true, long_limit, "master and slave positions, SGN32"},
};

constexpr std::array<std::string_view, 7> names{
    "STEP_DIRECT", "LINEAR", "POLYNOM_3", "POLYNOM_3_KOEFF", "LINE_POLY5", "POLY5_LINE", "TABLE_DEFINED"};

/// Farthest position: 100 km, where an increment is still far above the rounding.
constexpr double farthest = 1e12;
/// Least distance of two masters: 0.1 deg.
constexpr double least_gap = 1000;
constexpr std::size_t most_pairs = 360;

ErrorId check_pairs(const McCamTable& table, double modulo) {
  const std::size_t lines = table.lines();
  // An odd number would put two segments of a kind at both sides of point 0.
  if (lines < 2 || lines > most_pairs || lines % 2 != 0) return ErrorId::table_line_count;
  return disordered_rows(table, modulo).empty() ? ErrorId::none : ErrorId::table_master_order;
}

}  // namespace

std::string_view name_of(Interpolation interpolation) {
  return names[static_cast<std::size_t>(interpolation)];
}

std::optional<Interpolation> parse_interpolation(std::string_view text) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (same_word(text, names[i]) || (text.size() == 1 && text[0] == static_cast<char>('0' + i)))
      return static_cast<Interpolation>(i);
  return std::nullopt;
}

const TableType* table_type(int number) {
  if (number < 1 || number > static_cast<int>(table_types.size())) return nullptr;
  return &table_types[static_cast<std::size_t>(number) - 1];
}

int McCamTable::columns() const {
  const TableType* row = table_type(type);
  return row == nullptr ? 0 : row->columns;
}

std::size_t McCamTable::lines() const {
  const auto width = static_cast<std::size_t>(columns());
  return width == 0 ? 0 : values.size() / width;
}

std::optional<Interpolation> interpolation_of(const McCamTable& table, std::uint32_t wanted) {
  if (wanted > static_cast<std::uint32_t>(Interpolation::table_defined)) return std::nullopt;
  auto interpolation = static_cast<Interpolation>(wanted);
  if (interpolation == Interpolation::table_defined) interpolation = table.interpolation;
  if (interpolation == Interpolation::table_defined) return std::nullopt;
  return interpolation;
}

ErrorId check(const McCamTable& table, Interpolation interpolation, double modulo) {
  const TableType* type = table_type(table.type);
  if (type == nullptr) return ErrorId::table_type_unknown;
  int needed = 1;
  if (interpolation == Interpolation::polynom_3_koeff) needed = 4;
  if (interpolation == Interpolation::line_poly5 || interpolation == Interpolation::poly5_line) needed = 2;
  if (type->columns != needed) return ErrorId::table_type_mismatch;
  const auto too_far = [](double value) { return !(std::abs(value) <= farthest); };
  if (std::any_of(table.values.begin(), table.values.end(), too_far)) return ErrorId::position_range;
  if (needed == 2) return check_pairs(table, modulo);
  return table.lines() == 0 ? ErrorId::too_few_lines : ErrorId::none;
}

std::vector<std::size_t> disordered_rows(const McCamTable& table, double modulo) {
  std::vector<std::size_t> rows;
  const std::size_t lines = table.lines();
  for (std::size_t i = 0; i < lines; ++i) {
    const double here = table.value(i, 0);
    const bool close = i > 0 && here - table.value(i - 1, 0) < least_gap;
    const bool closing = i + 1 == lines && table.value(0, 0) + modulo - here < least_gap;
    const bool begins = i == 0 && (here < 0 || here >= modulo);
    if (close || closing || begins) rows.push_back(i + 1);
  }
  return rows;
}

ErrorId CamTables::add(McCamTable table) {
  if (table.id == 0) return ErrorId::table_id;
  const TableType* type = table_type(table.type);
  if (type == nullptr || type->columns == 0) return ErrorId::table_type_unknown;
  if (table.values.size() % static_cast<std::size_t>(type->columns) != 0) return ErrorId::too_few_columns;
  Entry& entry = entries_[table.id];
  entry.table = std::move(table);
  ++entry.revision;
  return ErrorId::none;
}

ErrorId CamTables::write(std::uint16_t id, std::size_t line, int column, double value) {
  if (find(id) == nullptr) return ErrorId::no_such_table;
  Entry& entry = entries_[id];
  if (line >= entry.table.lines()) return ErrorId::too_few_lines;
  if (column < 0 || column >= entry.table.columns()) return ErrorId::too_few_columns;
  const TableType& type = *table_type(entry.table.type);
  if (!std::isfinite(value) ||
      (type.whole && (value != std::round(value) || value > type.limit || value < -type.limit - 1)))
    return ErrorId::position_range;
  entry.table.values[line * static_cast<std::size_t>(type.columns) + static_cast<std::size_t>(column)] =
      value;
  ++entry.revision;
  return ErrorId::none;
}

ErrorId CamTables::begin_change(std::uint16_t id) {
  if (find(id) == nullptr) return ErrorId::no_such_table;
  entries_[id].changing = true;
  return ErrorId::none;
}

void CamTables::end_change(std::uint16_t id) {
  if (const auto entry = entries_.find(id); entry != entries_.end()) entry->second.changing = false;
}

const McCamTable* CamTables::find(std::uint16_t id) const {
  const auto entry = entries_.find(id);
  return entry == entries_.end() || entry->second.revision == 0 ? nullptr : &entry->second.table;
}

const McCamTable* CamTables::find_file(std::string_view file) const {
  for (const auto& [id, entry] : entries_)
    if (!entry.table.file.empty() && entry.table.file == file) return &entry.table;
  return nullptr;
}

bool CamTables::busy(std::uint16_t id) const {
  const auto entry = entries_.find(id);
  return entry != entries_.end() && entry->second.changing;
}

std::uint64_t CamTables::revision(std::uint16_t id) const {
  const auto entry = entries_.find(id);
  return entry == entries_.end() ? 0 : entry->second.revision;
}

void CamTables::Entry::visit(StateArchive& archive) { STATE(archive, table.values, revision, changing); }

void CamTables::visit(StateArchive& archive) {
  for (auto& [id, entry] : entries_) archive.named(fmt::format("table{}", id), entry);
}

void CamCurve::visit(StateArchive& archive) {
  CamLaw::visit(archive);
  STATE(archive, turns);
}

}  // namespace drycut::devices::plcopen
