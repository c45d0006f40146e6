// Formulas of checks, conditions and metrics.
#include "sim/scenario/expression.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  static const double value = 1.5;
  const auto resolve = [](const std::string& name) -> sim::scenario::Expression::Operand {
    if (name == "x") return nullptr;
    return {&value, name == "y" ? "mm" : "N m"};
  };
  std::vector<sim::scenario::ExpressionFault> faults;
  auto formula = sim::scenario::Expression::compile(text, resolve, {"AxisX.posit", "knife.angle"}, faults,
                                                    sim::scenario::Expression::Kind::condition, resolve);
  if (!formula && faults.empty()) fuzz::broken("a formula that does not compile has a fault");
  for (const auto& fault : faults)
    if (fault.offset > text.size() || fault.what.empty()) fuzz::broken("a fault stands in the text");
  if (!formula) return;
  formula->start(0);
  formula->take(1);
  formula->finish();
  if (formula->evaluate().term < 0) fuzz::broken("a value is of one of the terms");
}

}  // namespace drycut
