#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/record/outcome.hpp"
#include "sim/studies/compare/run_folder.hpp"

namespace drycut::sim::studies {

/// How far a number may lie from that of the first run and still be kept.
struct Allowance {
  std::string name;       ///< of what; "" = of everything that no other is for
  double number = 0;      ///< in `unit`; of a relative one a fraction of the largest that the first run has
  std::string unit = {};  ///< "-" = a pure number
  bool relative = true;
  int column = 1;  ///< of its value in the option
};

/// What --tolerance says. A name is a channel ("knife.speed"), a value of events ("length", "cut.length",
/// "knife.cut.length"), a figure ("knife.cut length: mean"), a check, whose margin it is for, or "time", when
/// events happen.
struct Allowances {
  /// Trace and events have nine digits: ten units of the last one are rounding.
  Allowance usual = {"", 1e-7};
  std::vector<Allowance> named = {};

  [[nodiscard]] const Allowance* find(const std::string& name) const;
  /// In the channel's unit; `largest` is the largest that the first run has.
  [[nodiscard]] double of_channel(const std::string& name, const std::string& unit, double largest) const;
  /// Of a value of knife, cut.
  [[nodiscard]] double of_value(const std::string& source, const std::string& event, const std::string& value,
                                const std::string& unit, double largest) const;
  [[nodiscard]] double of_time(double end) const;  ///< [s]
  /// Of a check's margin, as the first run has it: that of the check's name, else the widest of what its
  /// expectation speaks of, else the usual one.
  [[nodiscard]] double of_margin(const record::CheckResult& check, const ComparedRun& first) const;
};

/// Reads NAME=0.01mm, NAME=0.1%, NAME=1e-6 (both of the largest value) and the same without NAME. What is
/// wrong goes to `problems` by option and column.
Allowances read_allowances(const std::vector<std::string>& texts, Problems& problems);
/// Tells names that nothing in the runs has, and units that do not fit.
void check_allowances(const Allowances& allowances, const std::vector<ComparedRun>& runs,
                      const std::vector<std::pair<std::string, std::string>>& figures, Problems& problems);

}  // namespace drycut::sim::studies
