#pragma once

namespace drycut::plants {

/// A running sum that keeps what rounding takes away (two-sum of Knuth): the sum of millions of steps is as
/// exact as each of them.
class ExactSum {
 public:
  explicit ExactSum(double start = 0) : high_(start) {}
  void add(double x) {
    const double sum = high_ + x;
    const double virtual_x = sum - high_;
    low_ += (high_ - (sum - virtual_x)) + (x - virtual_x);
    high_ = sum;
  }
  [[nodiscard]] double value() const { return high_ + low_; }

 private:
  double high_;
  double low_ = 0;
};

}  // namespace drycut::plants
