#include "sim/scenario/statistic.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/state_archive.hpp"

namespace drycut::sim::scenario {

const std::vector<std::string>& RunningStatistic::names() {
  static const std::vector<std::string> all = {"max", "min", "mean", "rms", "sd", "count", "settling", "pNN"};
  return all;
}

std::optional<RunningStatistic> RunningStatistic::named(std::string_view name) {
  RunningStatistic made;
  for (std::size_t i = 0; i + 1 < names().size(); ++i) {
    if (names()[i] != name) continue;
    made.function_ = static_cast<Function>(i);
    return made;
  }
  if (!name.starts_with('p') || name.size() < 2) return {};
  const char* const end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + 1, end, made.percent_, std::chars_format::fixed);
  if (read.ec != std::errc() || read.ptr != end || !(made.percent_ >= 0 && made.percent_ <= 100)) return {};
  made.function_ = Function::percentile;
  return made;
}

std::string RunningStatistic::unit(const std::string& unit) const {
  if (function_ == Function::count) return "";
  return function_ == Function::settling ? "s" : unit;
}

void RunningStatistic::start(double at) {
  start_ = at;
  count_ = 0;
  unknown_ = false;
  sum_ = 0;
  mean_ = 0;
  squares_ = 0;
  settled_ = at;
  beyond_ = false;
  numbers_.clear();
  stride_ = 1;
}

void RunningStatistic::take(double at, double number) {
  ++count_;
  unknown_ = unknown_ || std::isnan(number);
  switch (function_) {
    case Function::max:
      extreme_ = count_ == 1 ? number : std::max(extreme_, number);
      break;
    case Function::min:
      extreme_ = count_ == 1 ? number : std::min(extreme_, number);
      break;
    case Function::mean:
      sum_ += number;
      break;
    case Function::rms:
      sum_ += number * number;
      break;
    case Function::sd: {  // Welford's
      const double away = number - mean_;
      mean_ += away / static_cast<double>(count_);
      squares_ += away * (number - mean_);
      break;
    }
    case Function::count:
      break;
    case Function::settling:  // at the first instant inside after the last one outside
      if (beyond_ || std::abs(number) > band_) settled_ = at;
      beyond_ = std::abs(number) > band_;
      break;
    case Function::percentile:
      keep(number);
      break;
  }
}

void RunningStatistic::keep(double number) {
  if ((count_ - 1) % stride_ != 0) return;
  if (numbers_.size() == most_kept) {
    for (std::size_t i = 0; 2 * i < most_kept; ++i) numbers_[i] = numbers_[2 * i];
    numbers_.resize(most_kept / 2);
    stride_ *= 2;
  }
  numbers_.push_back(number);
}

double RunningStatistic::result() const {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto count = static_cast<double>(count_);
  if (function_ == Function::count) return count;
  if (count_ == 0 || unknown_) return nothing;
  switch (function_) {
    case Function::max:
    case Function::min:
      return extreme_;
    case Function::mean:
      return sum_ / count;
    case Function::rms:
      return std::sqrt(sum_ / count);
    case Function::sd:
      return count_ < 2 ? nothing : std::sqrt(squares_ / (count - 1));
    case Function::settling:
      return settled_ - start_;
    case Function::percentile:
      return percentile();
    case Function::count:
      break;
  }
  return nothing;
}

double RunningStatistic::percentile() const {
  auto numbers = numbers_;
  const double rank = percent_ / 100 * static_cast<double>(numbers.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const auto low = numbers.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(numbers.begin(), low, numbers.end());
  if (below + 1 == numbers.size()) return *low;
  const double next = *std::min_element(low + 1, numbers.end());
  return std::lerp(*low, next, rank - static_cast<double>(below));
}

void RunningStatistic::visit(StateArchive& archive) {
  STATE(archive, start_, count_, unknown_, extreme_, sum_, mean_, squares_, settled_, beyond_, numbers_,
        stride_);
}

}  // namespace drycut::sim::scenario
