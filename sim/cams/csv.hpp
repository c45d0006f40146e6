#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/problem.hpp"
#include "devices/cam/table.hpp"

namespace drycut::sim::cams {

// What the cam tables of all devices share as texts: cells with their columns, settings `# key: value` above
// the header, problems with line and column.

/// A piece of a line and where it stands.
struct Cell {
  std::string_view text;
  int column = 1;
};
/// Without the blanks around it.
Cell trimmed(Cell cell);
/// The cells between the commas of a line.
std::vector<Cell> split_cells(std::string_view line);

/// The problems of one table; after 1000 of them the rest is not told.
class TableProblems {
 public:
  TableProblems(std::string file, Problems& problems)
      : file_(std::move(file)), problems_(problems), before_(problems.size()) {}
  void add(Code code, int line, int column, std::string what, std::string remedy);
  [[nodiscard]] bool full() const { return full_; }
  [[nodiscard]] bool none() const { return problems_.size() == before_; }

 private:
  std::string file_;
  Problems& problems_;
  std::size_t before_;
  bool full_ = false;
};

/// What a number may be.
struct CamKeyRange {
  double low = 0;
  double high = 0;
};
/// "0 to 5".
std::string range_text(CamKeyRange range);
/// A whole number in its range, or a problem.
std::optional<std::int64_t> whole_number(const Cell& cell, int line, std::string_view name, CamKeyRange range,
                                         TableProblems& problems);
/// A number or a fraction of two (5/3), or a problem.
std::optional<double> real_number(const Cell& cell, int line, std::string_view name, CamKeyRange range,
                                  TableProblems& problems);

/// A key or a column of a table, as the reference tells it.
struct CamKey {
  std::string name;
  std::string values;    ///< "0 to 5"
  std::string fallback;  ///< where it is not given; "" = nothing stands for it
  std::string meaning;
};

/// The settings of a table, comment lines `# key: value` above its header; `##` and prose are remarks.
class Settings {
 public:
  using Take = std::function<void(const Cell& value, int line)>;
  explicit Settings(TableProblems& problems) : problems_(problems) {}
  void add(CamKey key, Take take) {
    settings_.emplace(key.name, std::move(take));
    keys_.push_back(std::move(key));
  }
  /// A setting that is a whole number in its range; `target` holds its default.
  template <typename Target>
  void whole(const std::string& name, CamKeyRange range, Target& target, std::string meaning) {
    CamKey key{name, range_text(range), "", std::move(meaning)};
    if constexpr (std::is_integral_v<Target>)
      if (target >= range.low && target <= range.high) key.fallback = std::to_string(target);
    add(std::move(key), [this, name, range, &target](const Cell& value, int line) {
      const auto number = whole_number(value, line, name, range, problems_);
      if (!number) return;
      if constexpr (std::is_integral_v<Target>)
        target = static_cast<Target>(*number);
      else
        target = static_cast<double>(*number);
    });
  }
  /// Two settings, the lower end of the travel and the upper one.
  void travel(const std::string& least, const std::string& most, CamKeyRange range,
              devices::CamTravel& travel);
  /// Tells ends of the travel that were given the wrong way round.
  void check_travel() const;
  /// Reads a comment line; `above` is false once the header was read.
  void read(const Cell& comment, int line, bool above);
  /// All of them, in the order in which they were added.
  [[nodiscard]] const std::vector<CamKey>& keys() const { return keys_; }
  /// Line that gave a setting, 0 = none did.
  [[nodiscard]] int line_of(std::string_view name) const;

 private:
  void refuse(const Cell& key, int line);
  void read_without_colon(const Cell& comment, int line);

  TableProblems& problems_;
  std::map<std::string, Take, std::less<>> settings_;
  std::map<std::string, int, std::less<>> given_;
  std::vector<CamKey> keys_;
  const devices::CamTravel* travel_ = nullptr;
  std::string least_;  ///< name of its lower end
  std::string most_;
};

/// Where the columns of a table stand in its lines.
class Header {
 public:
  /// `columns` in the order of the places; the first `needed` of them must be there.
  Header(std::vector<std::string> columns, std::size_t needed)
      : columns_(std::move(columns)), needed_(needed) {}
  /// Reads the header; false if the line is none but begins with a number: then the columns stand as they are
  /// named, and a problem was told.
  bool read(const std::vector<Cell>& cells, int line, TableProblems& problems);
  [[nodiscard]] bool is_read() const { return !places_.empty(); }
  [[nodiscard]] bool has(std::size_t column) const { return places_[column] >= 0; }
  /// The cell of a column; empty if the line or the header ends before it.
  [[nodiscard]] Cell cell_of(const std::vector<Cell>& cells, std::size_t column) const;
  /// Tells a cell that is in no column.
  void check_width(const std::vector<Cell>& cells, int line, TableProblems& problems) const;
  /// "sector,codeG,..."
  [[nodiscard]] std::string text() const;

 private:
  void read_name(const Cell& cell, int place, int line, TableProblems& problems);

  std::vector<std::string> columns_;
  std::size_t needed_;
  std::vector<int> places_;
  std::size_t width_ = 0;
};

}  // namespace drycut::sim::cams
