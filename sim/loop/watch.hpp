#pragma once
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/loop/names.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/expression.hpp"

namespace drycut::sim::loop {

/// A set of readings with a slot each. `update` takes all of them at one instant; expressions, recorder and
/// captions look at the slots. Slots do not move.
class Watch {
 public:
  explicit Watch(Names& names) : names_(names) {}

  /// The slot of a reading, added at first use; nullptr if nothing has this name.
  const double* slot(const std::string& name);
  /// The same for an expression, with its unit.
  scenario::Expression::Operand operand(const std::string& name);
  /// Records a reading as a channel; false if nothing has this name. One that is recorded twice is recorded
  /// once.
  bool record(const std::string& name, record::Recording& recording);
  /// Unit of a reading that has a slot.
  [[nodiscard]] const std::string& unit(const std::string& name) const {
    return readings_[index_.at(name)].unit;
  }

  /// Lets a slot show another number until the next update().
  void show(const double* slot, double number);
  void update() {
    auto slot = slots_.begin();
    for (const auto& reading : readings_) *slot++ = reading.read();
  }
  /// What has a slot, and where.
  void each(const std::function<void(const Reading&, const double*)>& use) const {
    for (std::size_t i = 0; i < readings_.size(); ++i) use(readings_[i], &slots_[i]);
  }
  [[nodiscard]] bool empty() const { return readings_.empty(); }
  void visit(StateArchive& archive);
  /// The first reading that is not a finite number, or "".
  [[nodiscard]] std::string not_finite() const;

 private:
  Names& names_;
  std::map<std::string, std::size_t> index_;
  std::vector<Reading> readings_;
  std::deque<double> slots_;
};

}  // namespace drycut::sim::loop
