#pragma once
#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problem.hpp"

namespace drycut {
class StateArchive;
}

namespace drycut::sim::scenario {

struct Scenario;
struct Text;

/// What is wrong with an expression, and at which byte of its text.
struct ExpressionFault {
  enum class Of { syntax, names, values };
  Code code;
  std::size_t offset = 0;
  Prose what;
  Prose remedy;
  Of of = Of::syntax;
};

/// What an expression says at one instant.
struct Evaluation {
  bool holds = false;  ///< never while a name it uses, or its value, is not a number (NaN)
  /// Room left to the nearest limit, negative beyond it; only where has_margin().
  std::optional<double> margin;
  int term = 0;  ///< the term with the least margin, or the first that does not hold
};

/// A statistic in an expression, over what was taken into it: rms(knife.motor.torque).
struct ExpressionStatistic {
  struct Name {
    std::string text;
    std::size_t offset = 0;  ///< where it stands first, in the expression
  };
  std::string text;         ///< as it stands there
  std::string unit;         ///< of its value, "" if it has none or none that could be said
  std::vector<Name> names;  ///< what it looks at, each once
  double value = std::numeric_limits<double>::quiet_NaN();
};

/// A formula over named numbers: arithmetic, comparisons, &&, ||, !, ?: and functions (abs, min, max, sqrt,
/// sign, rint, sin ...). A name is letters, digits, underscores and dots, with an index if it has one:
/// `AxisX.posit`, `2.AN01`, `table[3]`, `recipe[2,5]`.
///
/// A number with a unit (`9.5 N m`) is put into the unit of what it meets in a sum or a comparison; one
/// without is in that unit already. Names are never converted.
///
/// Statistics look at a window of instants: max(x), min(x), mean(x), rms(x), sd(x), count(x), p99(x),
/// settling(x, band). take() gives them an instant, finish() what evaluate() sees of them.
///
/// The terms of a conjunction (a && b) are kept apart: if all of them compare by < <= > >=, the expression
/// has a margin, the least distance of a term to its limit.
///
/// One object must not be used by two threads at once.
class Expression {
 public:
  enum class Kind {
    condition,  ///< holds or not
    limit,      ///< terms that compare by < <= > >=: has a margin
    number      ///< any number
  };
  /// What a name means.
  struct Operand {
    const double* number = nullptr;      ///< nullptr: nothing is called so. It must outlive the expression
    std::optional<std::string> unit;     ///< of the number; absent: not known yet
    std::optional<ExpressionFault> why;  ///< why the name cannot stand here; its offset is not used
    Operand(const double* lives, std::optional<std::string> in = {}) : number(lives), unit(std::move(in)) {}
    static Operand refused(Code code, std::string what, std::string remedy) {
      Operand operand(nullptr);
      operand.why = ExpressionFault{code, 0, std::move(what), std::move(remedy)};
      return operand;
    }
  };
  using Resolver = std::function<Operand(const std::string& name)>;

  /// Compiles `text`; every fault that can be told is added to `faults` (names are suggested from `known`),
  /// and then nothing is returned. `inside` resolves names inside statistics; without it there are none.
  static std::optional<Expression> compile(std::string_view text, const Resolver& resolve,
                                           const std::vector<std::string>& known,
                                           std::vector<ExpressionFault>& faults, Kind kind = Kind::condition,
                                           const Resolver& inside = {});
  /// The same for a condition of a scenario file: faults become problems at their place there,
  /// once, whoever finds them first. A text that the file does not have compiles to nothing.
  static std::optional<Expression> compile(const Text& text, const Scenario& scenario,
                                           const Resolver& resolve, const std::vector<std::string>& known,
                                           Problems& problems, const Resolver& inside = {});

  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  [[nodiscard]] Evaluation evaluate() const;
  /// How much of the limit of a term (as Evaluation::term counts) the last evaluate() found used: 1 = all of
  /// it, above: beyond it. Of `a < 100` that is a / 100, of `a > 100` 100 / a; where another term limits the
  /// same from the other side, its distance from the middle. Absent where a limit of 0 leaves nothing to
  /// share.
  [[nodiscard]] std::optional<double> used(int term) const;
  /// The range in which the terms leave a name's number: those that compare it, or the size of its distance
  /// to a number, with a number: `length < 800.1`, `abs(length - 800) <= 0.1`. Open where nothing limits it.
  [[nodiscard]] std::pair<double, double> range_of(const double* name) const;
  /// Of Kind::number; NaN if it is none.
  [[nodiscard]] double value() const;
  /// The terms as they stand in the text; one if it is no conjunction.
  [[nodiscard]] const std::vector<std::string>& terms() const;
  /// A factor that is 0 or not, as `(gbStep == 2) * abs(axis.speed)` has one, and was 0 whenever it was
  /// evaluated: then nothing was judged. "" = there is none.
  [[nodiscard]] std::string unmet() const;
  /// True if all terms compare by < <= > >=.
  [[nodiscard]] bool has_margin() const;

  [[nodiscard]] const std::deque<ExpressionStatistic>& statistics() const;
  /// A window begins at a time [s], of all statistics or of one.
  void start(double at);
  void start(std::size_t statistic, double at);
  /// Takes the names' present numbers into all statistics, or into one of them.
  void take(double at);
  void take(std::size_t statistic, double at);
  /// Gives the statistics their values over what was taken.
  void finish();
  /// What was taken and evaluated so far.
  void visit(StateArchive& archive);

 private:
  struct Compiled;
  explicit Expression(std::unique_ptr<Compiled> compiled);
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace drycut::sim::scenario
