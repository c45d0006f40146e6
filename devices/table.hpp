#pragma once
#include <array>
#include <initializer_list>
#include <string_view>

#include "devices/device.hpp"

// What every device's tables are written with and found in by name; all of it is done while compiling.
namespace drycut::devices {

// constexpr where a consteval function hands its own parameters on: Clang 14 takes no consteval call there.

/// Number of the row called `name`; a name that is not in the table does not compile.
template <typename Rows>
constexpr int find_row(const Rows& rows, std::string_view name) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].name == name) return static_cast<int>(i);
  throw "no such row";
}

/// The rows of `first`, then those of `then`.
template <typename Row, std::size_t N, std::size_t M>
consteval std::array<Row, N + M> joined(const std::array<Row, N>& first, const std::array<Row, M>& then) {
  std::array<Row, N + M> rows{};
  for (std::size_t i = 0; i < N; ++i) rows[i] = first[i];
  for (std::size_t i = 0; i < M; ++i) rows[N + i] = then[i];
  return rows;
}

/// The rows, in the manual's section where they name none.
template <typename Row, std::size_t N>
constexpr std::array<Row, N> in_section(std::string_view section, std::array<Row, N> rows) {
  for (Row& row : rows)
    if (row.section.empty()) row.section = section;
  return rows;
}
/// A row that the manual defines elsewhere than those around it.
template <typename Row>
constexpr Row elsewhere(std::string_view section, Row row) {
  row.section = section;
  return row;
}
/// Variables of a table that has so many rows.
template <std::size_t N>
constexpr std::array<Variable, N> of_rows(int number, std::array<Variable, N> variables) {
  for (Variable& variable : variables) variable.rows = number;
  return variables;
}

// The ends of a variable of size L.
inline constexpr double lowest = -2147483648.0;
inline constexpr double highest = 2147483647.0;

/// A parameter: programs write it where `write` holds, the retentive memory keeps it.
constexpr Variable kept(std::string_view name, Size size, std::string_view unit, double min, double max,
                        Condition write, std::string_view meaning) {
  return {name, size, unit, min, max, Access::read_write, Retention::retentive, write, meaning};
}
constexpr Variable kept(std::string_view name, Size size, std::string_view unit, double min, double max,
                        std::string_view meaning) {
  return kept(name, size, unit, min, max, {}, meaning);
}
/// The same of a value that begins at 0 with each power-up.
constexpr Variable zeroed(std::string_view name, Size size, std::string_view unit, double min, double max,
                          Condition write, std::string_view meaning) {
  return {name, size, unit, min, max, Access::read_write, Retention::zero, write, meaning};
}
constexpr Variable zeroed(std::string_view name, Size size, std::string_view unit, double min, double max,
                          std::string_view meaning) {
  return zeroed(name, size, unit, min, max, {}, meaning);
}
/// What the device shows; without a range any value of size L.
constexpr Variable shown(std::string_view name, Size size, std::string_view unit, double min, double max,
                         std::string_view meaning) {
  return {name, size, unit, min, max, Access::read, Retention::zero, {}, meaning};
}
constexpr Variable shown(std::string_view name, std::string_view unit, std::string_view meaning) {
  return shown(name, Size::L, unit, lowest, highest, meaning);
}

/// A command, and what it does to a state.
constexpr Command command(std::string_view name, Condition condition, std::string_view meaning,
                          Effect effect = {}) {
  return {name, condition, meaning, {}, effect};
}

/// needs({"st_init", "!st_emrg"}): the condition that these rows of `states` are 1, or 0 where the name
/// begins with '!'.
template <const auto& states>
struct Needs {
  consteval Condition operator()(std::initializer_list<std::string_view> names,
                                 std::string_view also = {}) const {
    Condition condition{0, 0, also};
    for (std::string_view name : names) {
      const bool off = name.starts_with('!');
      const std::uint64_t bit = std::uint64_t{1} << find_row(states, off ? name.substr(1) : name);
      condition.mask |= bit;
      if (!off) condition.value |= bit;
    }
    return condition;
  }
};

/// turns("st_emrg"): the effect that this row of `states` becomes 1, or 0 where the name begins with '!'.
/// `quiet`: see Effect.
template <const auto& states, bool quiet>
struct Turns {
  consteval Effect operator()(std::string_view name) const {
    const bool off = name.starts_with('!');
    return {find_row(states, off ? name.substr(1) : name), !off, quiet};
  }
};

/// Number of a row of `type`, which its name stands for; a name that is not in the table does not compile.
template <const DeviceType& type, auto rows>
class NamedRow {
 public:
  consteval NamedRow(const char* name) : number_(find_row(type.*rows, name)) {}
  constexpr explicit NamedRow(int number) : number_(number) {}
  constexpr operator int() const { return number_; }
  friend constexpr bool operator==(NamedRow a, NamedRow b) = default;

 private:
  int number_;
};

/// A device whose rows go by their names in `table`: value("pgain"), state("st_still").
template <const DeviceType& table>
class TableDevice : public Device {
 protected:
  using VariableRow = NamedRow<table, &DeviceType::variables>;
  using StateRow = NamedRow<table, &DeviceType::states>;
  using CommandRow = NamedRow<table, &DeviceType::commands>;
  using FieldRow = NamedRow<table, &DeviceType::fields>;

  /// `type` has at least the rows of `table`, in the same places.
  explicit TableDevice(const DeviceType& type = table) : Device(type) {}

  [[nodiscard]] bool state(StateRow row) const { return Device::state(row); }
  void set_state(StateRow row, bool on) { Device::set_state(row, on); }
  [[nodiscard]] std::int32_t& value(VariableRow variable, int row = 0) {
    return Device::value(variable, row);
  }
  [[nodiscard]] std::int32_t value(VariableRow variable, int row = 0) const {
    return Device::value(variable, row);
  }
  [[nodiscard]] std::string_view name_of(VariableRow variable) const {
    return type().variables[variable].name;
  }
  void report_outside(VariableRow variable, std::int32_t low, VariableRow high) {
    Device::report_outside(variable, low, high);
  }
};

}  // namespace drycut::devices
