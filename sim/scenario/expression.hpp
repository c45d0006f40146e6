#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"

namespace drycut::sim::scenario {

struct Scenario;
struct Text;

/// What is wrong with an expression, and at which byte of its text.
struct ExpressionFault {
  std::size_t offset = 0;
  std::string what;
  std::string remedy;
};

/// What an expression says at one instant.
struct Evaluation {
  bool holds = false;  ///< never while a name it uses, or its value, is not a number (NaN)
  /// Room left to the nearest limit, negative beyond it; only where has_margin().
  std::optional<double> margin;
  int term = 0;  ///< the term with the least margin, or the first that does not hold
};

/// A formula over named numbers: arithmetic, comparisons, &&, ||, !, ?: and the functions of muParser (abs,
/// min, max, sqrt, sign, rint, sin ...). A name is letters, digits, underscores and dots, with an index if it
/// has one: `AxisX.posit`, `2.AN01`, `table[3]`, `recipe[2,5]`. Numbers are in the unit of the name that they
/// are compared with.
///
/// The terms of a conjunction (a && b) are kept apart: if all of them compare by < <= > >=, the expression
/// has a margin, the least distance of a term to its limit.
///
/// One object must not be evaluated by two threads at once.
class Expression {
 public:
  /// Where the number called so lives, or nullptr if nothing is called so. It must outlive the expression.
  using Resolver = std::function<const double*(const std::string& name)>;

  /// Compiles `text`; every fault that can be told is added to `faults` (names are suggested from `known`),
  /// and then nothing is returned.
  static std::optional<Expression> compile(std::string_view text, const Resolver& resolve,
                                           const std::vector<std::string>& known,
                                           std::vector<ExpressionFault>& faults);
  /// The same for a text of a scenario file: faults become problems at their place there,
  /// once, whoever finds them first. A text that the file does not have compiles to nothing.
  static std::optional<Expression> compile(const Text& text, const Scenario& scenario,
                                           const Resolver& resolve, const std::vector<std::string>& known,
                                           Problems& problems);

  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  [[nodiscard]] Evaluation evaluate() const;
  /// The terms as they stand in the text; one if it is no conjunction.
  [[nodiscard]] const std::vector<std::string>& terms() const;
  /// True if all terms compare by < <= > >=.
  [[nodiscard]] bool has_margin() const;

 private:
  struct Compiled;
  explicit Expression(std::unique_ptr<Compiled> compiled);
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace drycut::sim::scenario
