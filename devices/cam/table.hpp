#pragma once
#include <any>
#include <optional>
#include <string_view>
#include <utility>

namespace drycut {
class StateArchive;
}

namespace drycut::devices {

/// From where to where the slave's machine lets it go, in its unit, from the place where the cam counts 0.
/// No device watches it in a cam; `drycut cam` does, before a carriage meets its end stop.
struct CamTravel {
  std::optional<double> least = {};
  std::optional<double> most = {};

  [[nodiscard]] bool is_given() const { return least || most; }
  bool operator==(const CamTravel&) const = default;
  void visit(StateArchive& archive);
};

/// A cam with all that its law needs, as a controller holds it or a file gives it. What it consists of is the
/// business of its kind: a copyable and comparable type with its name in `kind` and a visit of all that it
/// holds.
struct CamTable {
  CamTable() = default;
  template <typename Table>
  requires requires { Table::kind; }
  CamTable(Table table)
      : kind_(Table::kind),
        table_(std::move(table)),
        same_([](const std::any& a, const std::any& b) {
          return std::any_cast<const Table&>(a) == std::any_cast<const Table&>(b);
        }),
        visit_([](std::any& table, StateArchive& archive) { std::any_cast<Table&>(table).visit(archive); }) {}

  /// As `drycut cam --device` has it; "" of no table.
  [[nodiscard]] std::string_view kind() const { return kind_; }
  /// The table as its own kind, and no other, knows it.
  template <typename Table>
  [[nodiscard]] const Table& as() const {
    return std::any_cast<const Table&>(table_);
  }
  template <typename Table>
  [[nodiscard]] Table& as() {
    return std::any_cast<Table&>(table_);
  }
  /// All that it holds, of a table that has its kind already.
  void visit(StateArchive& archive) {
    if (visit_ != nullptr) visit_(table_, archive);
  }
  bool operator==(const CamTable& other) const {
    return kind_ == other.kind_ && (same_ == nullptr || same_(table_, other.table_));
  }

 private:
  std::string_view kind_;
  std::any table_;
  bool (*same_)(const std::any&, const std::any&) = nullptr;
  void (*visit_)(std::any&, StateArchive&) = nullptr;
};

}  // namespace drycut::devices
