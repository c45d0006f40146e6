#pragma once
#include <drycut/problem.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"

namespace drycut {

/// Characters of a UTF-8 text, each as wide as the next.
std::size_t characters(std::string_view text);

/// How many characters a line of standard output has: its terminal's; where it is none, what the variable
/// COLUMNS says; else 0, no limit: a row that goes into a pipe or a file stays one line.
std::size_t output_width();

/// Rows of cells as lines of text, every column as wide as its widest cell. Where that is more than `width`
/// characters (0 = no limit), the widest column gives way, as far as its longest word, and its cells go on
/// under themselves. `right` says which columns stand to the right; without it all stand to the left.
std::string in_columns(const std::vector<std::vector<std::string>>& rows, std::size_t width,
                       const std::vector<bool>& right = {});

/// A table with a title and named columns, written down once and shown as text, Markdown and JSON.
class Sheet {
 public:
  /// What stands in a row: a number stays one in JSON; null is absent there.
  struct Cell {
    Json value;
    std::string text;

    /// The same in both; a list is joined by commas.
    template <typename Value>
    Cell(const Value& both) : value(both), text(plain(value)) {}
    Cell(Json in_json, std::string in_text) : value(std::move(in_json)), text(std::move(in_text)) {}

   private:
    static std::string plain(const Json& value);
  };

  /// A key for JSON, a title for text; "" = not shown there. A column has a key and a heading likewise:
  /// "name=variable", "name" where both are the same, "rows=" for JSON alone, "=range" for text alone.
  Sheet(std::string key, std::string title, const std::vector<std::string>& columns);

  /// A cell a column. Where text or JSON would show nothing of a row, it is left out.
  void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }

  [[nodiscard]] const std::string& key() const { return key_; }
  /// The title and the rows under their headings, after an empty line; "" without rows.
  [[nodiscard]] std::string text(std::size_t width) const;
  /// The same in Markdown, with a heading of the second level; "" without rows.
  [[nodiscard]] std::string markdown() const;
  /// An array of an object a row.
  [[nodiscard]] Json json() const;

 private:
  /// Headings and rows as text shows them.
  [[nodiscard]] std::vector<std::vector<std::string>> shown() const;

  std::string key_;
  Prose title_;
  std::vector<std::string> keys_;
  std::vector<Prose> headings_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace drycut
