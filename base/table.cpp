#include "base/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/json.hpp"
#include "base/sheet.hpp"
#include "base/text.hpp"

namespace drycut {

namespace {

constexpr int shown_digits = 6;

std::string text_of_cell(const Table::Cell& cell, int digits) {
  if (const auto* words = std::get_if<std::string>(&cell)) return *words;
  const double number = std::get<double>(cell);
  return std::isnan(number) ? "" : fmt::format("{:.{}g}", number, digits);
}

std::string shown_cell(const Table::Cell& cell) {
  const auto* number = std::get_if<double>(&cell);
  return number != nullptr && !std::isfinite(*number) ? "" : text_of_cell(cell, shown_digits);
}

bool is_of_numbers(const std::vector<std::vector<Table::Cell>>& rows, std::size_t column) {
  return std::ranges::all_of(rows,
                             [&](const auto& row) { return std::holds_alternative<double>(row[column]); });
}

}  // namespace

void Table::add(std::vector<Cell> row) {
  row.resize(columns_.size(), std::string());
  rows_.push_back(std::move(row));
}

void Table::append(const Table& other) {
  std::vector<std::size_t> places;
  for (const auto& column : other.columns_) {
    const auto found = std::ranges::find_if(columns_, [&](const auto& own) { return own.is_same(column); });
    places.push_back(static_cast<std::size_t>(found - columns_.begin()));
    if (found == columns_.end()) columns_.push_back(column);
  }
  for (auto& row : rows_) row.resize(columns_.size(), std::string());
  for (const auto& row : other.rows_) {
    add({});
    for (std::size_t i = 0; i < row.size(); ++i) rows_.back()[places[i]] = row[i];
  }
}

std::optional<std::size_t> Table::find(std::string_view key) const {
  const auto found = std::ranges::find(columns_, key, &Column::key);
  if (found == columns_.end()) return {};
  return static_cast<std::size_t>(found - columns_.begin());
}

std::vector<std::string> Table::headings() const {
  std::vector<std::string> headings;
  for (const auto& column : columns_) headings.push_back(column.heading());
  return headings;
}

std::vector<std::string> Table::shown(std::size_t row) const {
  std::vector<std::string> cells;
  for (const auto& cell : rows_[row]) cells.push_back(shown_cell(cell));
  return cells;
}

std::string Table::text(std::size_t width) const {
  std::vector<std::vector<std::string>> lines = {headings()};
  std::vector<bool> right;
  for (std::size_t i = 0; i < rows_.size(); ++i) lines.push_back(shown(i));
  for (std::size_t i = 0; i < columns_.size(); ++i) right.push_back(is_of_numbers(rows_, i));
  return in_columns(lines, width, right);
}

std::string Table::csv() const {
  std::string text;
  const auto add_line = [&](const auto& cells, const auto& cell_text) {
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i > 0 ? "," : "") + csv_cell(cell_text(i));
    text += '\n';
  };
  add_line(columns_, [&](std::size_t i) { return columns_[i].heading(); });
  for (const auto& row : rows_)
    add_line(row, [&](std::size_t i) { return text_of_cell(row[i], columns_[i].digits); });
  return text;
}

std::string Table::markdown() const {
  Sheet sheet("", "", headings());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    std::vector<Sheet::Cell> cells;
    for (auto& cell : shown(i)) cells.emplace_back(std::move(cell));
    sheet.add(std::move(cells));
  }
  return sheet.markdown();
}

Json Table::json() const {
  auto made = Json::array();
  for (const auto& row : rows_) {
    auto object = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      auto& value = object[columns_[i].key];
      if (const auto* words = std::get_if<std::string>(&row[i]))
        value = *words;
      else if (const double number = std::get<double>(row[i]); std::isfinite(number))
        value = number;
    }
    made.push_back(std::move(object));
  }
  return made;
}

}  // namespace drycut
