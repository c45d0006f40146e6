#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/json.hpp"

namespace drycut {

/// A column of a table. Programs find it by its key, people by its heading.
struct Column {
  std::string key;   ///< "knife.cut.accuracy"
  std::string name;  ///< "knife.cut accuracy"
  std::string unit = {};
  int digits = 9;            ///< of its numbers in files, significant ones
  std::string meaning = {};  ///< a sentence, where the name does not say all

  /// "knife.cut accuracy [mm]"
  [[nodiscard]] std::string heading() const { return unit.empty() ? name : name + " [" + unit + "]"; }
  /// The same quantity in the same unit.
  [[nodiscard]] bool is_same(const Column& other) const { return key == other.key && unit == other.unit; }
};

/// Rows of numbers and words under columns, made once; terminal, files and pages print them.
class Table {
 public:
  /// No number is none.
  using Cell = std::variant<double, std::string>;

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// A cell a column; columns at the end without one are empty.
  void add(std::vector<Cell> row);
  /// Adds the columns that this one does not have, and the rows of the other.
  void append(const Table& other);

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<std::vector<Cell>>& rows() const { return rows_; }
  /// Where the column with this key is.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view key) const;

  [[nodiscard]] std::vector<std::string> headings() const;
  /// A row as people read it: numbers in six digits at most.
  [[nodiscard]] std::vector<std::string> shown(std::size_t row) const;

  /// Headings and rows, as wide as they are up to `width` characters (0 = no limit).
  [[nodiscard]] std::string text(std::size_t width) const;
  [[nodiscard]] std::string csv() const;
  [[nodiscard]] std::string markdown() const;
  /// An object a row by the columns' keys; what is none is null.
  [[nodiscard]] Json json() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace drycut
