#pragma once

namespace drycut {
class StateArchive;
}

namespace drycut::plants {

/// What rounding took away from `sum`, the rounded a + b (two-sum of Knuth).
[[nodiscard]] inline double rounded_off(double a, double b, double sum) {
  const double virtual_b = sum - a;
  return (a - (sum - virtual_b)) + (b - virtual_b);
}

/// A running sum that keeps what rounding takes away: the sum of millions of steps is as exact as each of
/// them.
class ExactSum {
 public:
  explicit ExactSum(double start = 0) : high_(start) {}
  void add(double x) {
    const double sum = high_ + x;
    low_ += rounded_off(high_, x, sum);
    high_ = sum;
  }
  [[nodiscard]] double value() const { return high_ + low_; }

  void visit(StateArchive& archive);

 private:
  double high_;
  double low_ = 0;
};

}  // namespace drycut::plants
