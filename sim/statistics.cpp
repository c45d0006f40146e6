#include "sim/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::sim {

std::array<double, 6> statistics(const std::vector<double>& numbers) {
  if (numbers.empty()) return {};
  const auto count = static_cast<double>(numbers.size());
  double sum = 0;
  for (const double number : numbers) sum += number;
  const double mean = sum / count;
  const double middle = (count - 1) / 2;
  double squares = 0;
  double cross = 0;
  double index_squares = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double away = numbers[i] - mean;
    const double index = static_cast<double>(i) - middle;
    squares += away * away;
    cross += index * away;
    index_squares += index * index;
  }
  const double sd = count > 1 ? std::sqrt(squares / (count - 1)) : 0;
  const double slope = count > 1 ? cross / index_squares : 0;
  const double residual = std::max(0.0, squares - slope * cross);
  const double slope_error = count > 2 ? std::sqrt(residual / (count - 2) / index_squares) : 0;
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  return {mean, *low, *high, sd, slope, slope_error};
}

}  // namespace drycut::sim
