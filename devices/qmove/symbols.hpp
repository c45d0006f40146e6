#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "devices/qmove/cnf.hpp"

namespace drycut::devices::qmove {

/// What a name of the configuration stands for, and where its value lives.
struct NamedThing {
  enum class Kind : std::uint8_t {
    constant,
    scalar,
    array,         ///< name[1..length]
    group_static,  ///< name[1..recipes]
    group_step,    ///< name[1..recipes, 1..steps]
    group,         ///< the datagroup itself
    timer,
    input,
    output,
    device
  };
  Kind kind = Kind::scalar;
  std::string name;  ///< as declared
  Size size = Size::L;
  int index = 0;      ///< first memory cell, or number of the timer, input, output, device
  int length = 0;     ///< array length or recipes
  int steps = 0;      ///< steps of a group_step
  double value = 0;   ///< of a constant
  bool real = false;  ///< a constant written with a decimal point
};

/// "a timer", "an array" ... for messages.
std::string_view name_of(NamedThing::Kind kind);

/// The names of a configuration, any case, and the layout of the controller's memory: one cell a value,
/// first those that are zeroed at each start, then the retentive ones. The same configuration always gives
/// the same layout, so that modules are compiled apart from the controller that runs them.
class SymbolTable {
 public:
  explicit SymbolTable(const Configuration& configuration);
  [[nodiscard]] const NamedThing* find(std::string_view name) const;
  /// In the order of declaration.
  [[nodiscard]] const std::vector<NamedThing>& things() const { return things_; }
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] int cells() const { return cells_; }
  [[nodiscard]] int volatile_cells() const { return volatile_cells_; }

 private:
  void add(NamedThing thing);
  void add_values(const Configuration& configuration, bool retentive);

  std::vector<NamedThing> things_;
  std::map<std::string, std::size_t> by_name_;
  int cells_ = 0;
  int volatile_cells_ = 0;
};

/// Number of cells of an array or datagroup variable; 1 for a scalar.
int cell_count(const NamedThing& thing);

}  // namespace drycut::devices::qmove
