#include "renders/contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <map>

namespace drycut::renders {
namespace {

/// An edge of the grid: from its corner to the right, or up.
struct CellEdge {
  std::size_t corner;
  bool up;
  auto operator<=>(const CellEdge&) const = default;
};

class ValueGrid {
 public:
  ValueGrid(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& values,
            double level)
      : x_(x), y_(y), values_(values), level_(level) {}

  /// The pieces of the lines in all cells, each from an edge to an edge.
  [[nodiscard]] std::vector<std::pair<CellEdge, CellEdge>> pieces() const {
    std::vector<std::pair<CellEdge, CellEdge>> found;
    for (std::size_t row = 0; row + 1 < y_.size(); ++row)
      for (std::size_t column = 0; column + 1 < x_.size(); ++column)
        add_cell(row * x_.size() + column, found);
    return found;
  }

  /// Where a line crosses an edge.
  [[nodiscard]] std::pair<double, double> place(const CellEdge& edge) const {
    const std::size_t other = edge.corner + (edge.up ? x_.size() : 1);
    const double from = values_[edge.corner];
    const double share = (level_ - from) / (values_[other] - from);
    const auto column = edge.corner % x_.size();
    const auto row = edge.corner / x_.size();
    return edge.up ? std::pair{x_[column], y_[row] + share * (y_[row + 1] - y_[row])}
                   : std::pair{x_[column] + share * (x_[column + 1] - x_[column]), y_[row]};
  }

 private:
  void add_cell(std::size_t corner, std::vector<std::pair<CellEdge, CellEdge>>& found) const {
    const std::size_t above = corner + x_.size();
    const std::array<double, 4> corners = {values_[corner], values_[corner + 1], values_[above + 1],
                                           values_[above]};
    if (!std::all_of(corners.begin(), corners.end(), [](double v) { return std::isfinite(v); })) return;
    const std::array<CellEdge, 4> edges = {CellEdge{corner, false}, CellEdge{corner + 1, true},
                                           CellEdge{above, false}, CellEdge{corner, true}};
    std::vector<CellEdge> crossed;
    for (std::size_t i = 0; i < 4; ++i)
      if (over(corners[i]) != over(corners[(i + 1) % 4])) crossed.push_back(edges[i]);
    if (crossed.size() == 2) found.emplace_back(crossed[0], crossed[1]);
    if (crossed.size() != 4) return;
    // A saddle: the lines part the corners that are unlike the middle.
    const double middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
    const bool first_alone = over(corners[0]) != over(middle);
    found.emplace_back(crossed[first_alone ? 3 : 0], crossed[first_alone ? 0 : 1]);
    found.emplace_back(crossed[first_alone ? 1 : 2], crossed[first_alone ? 2 : 3]);
  }
  [[nodiscard]] bool over(double value) const { return value >= level_; }

  const std::vector<double>& x_;
  const std::vector<double>& y_;
  const std::vector<double>& values_;
  double level_;
};

}  // namespace

std::vector<Polyline> contours(const std::vector<double>& x, const std::vector<double>& y,
                               const std::vector<double>& values, double level) {
  const ValueGrid grid(x, y, values, level);
  const auto pieces = grid.pieces();
  std::multimap<CellEdge, std::size_t> at;  // an edge has one piece in each of its two cells
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    at.emplace(pieces[i].first, i);
    at.emplace(pieces[i].second, i);
  }
  std::vector<bool> used(pieces.size());
  const auto follow = [&](CellEdge edge, const auto& add) {
    while (true) {
      const auto [begin, end] = at.equal_range(edge);
      const auto next = std::find_if(begin, end, [&](const auto& entry) { return !used[entry.second]; });
      if (next == end) return;
      used[next->second] = true;
      const auto& [first, second] = pieces[next->second];
      edge = first == edge ? second : first;
      add(edge);
    }
  };
  std::vector<Polyline> lines;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (used[i]) continue;
    used[i] = true;
    std::deque<CellEdge> edges = {pieces[i].first, pieces[i].second};
    follow(pieces[i].second, [&](const CellEdge& edge) { edges.push_back(edge); });
    follow(pieces[i].first, [&](const CellEdge& edge) { edges.push_front(edge); });
    auto& line = lines.emplace_back();
    line.reserve(edges.size());
    for (const CellEdge& edge : edges) line.push_back(grid.place(edge));
  }
  return lines;
}

}  // namespace drycut::renders
