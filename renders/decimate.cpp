#include "renders/decimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace drycut::renders {
namespace {

bool drawn(double x, double y) { return std::isfinite(x) && std::isfinite(y); }

int pixel(double value, double low, double high, int pixels) {
  const double at = std::floor((value - low) / (high - low) * pixels);
  return static_cast<int>(std::clamp(at, -1.0, static_cast<double>(pixels)));
}

Points thinned_points(const Curve& curve, const PixelGrid& grid) {
  Points kept;
  std::vector<bool> taken(static_cast<std::size_t>(grid.columns + 2) *
                          static_cast<std::size_t>(grid.rows + 2));
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!drawn(curve.x[i], curve.y[i])) continue;
    const int column = pixel(curve.x[i], grid.x_low, grid.x_high, grid.columns) + 1;
    const int row = pixel(curve.y[i], grid.y_low, grid.y_high, grid.rows) + 1;
    const auto place = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns + 2) +
                       static_cast<std::size_t>(column);
    if (taken[place]) continue;
    taken[place] = true;
    kept.x.push_back(curve.x[i]);
    kept.y.push_back(curve.y[i]);
  }
  return kept;
}

/// Consecutive samples within one pixel column: their first, lowest, highest and last.
class Run {
 public:
  void add(std::size_t i, double y) {
    if (empty_) {
      empty_ = false;
      first_ = lowest_ = highest_ = last_ = i;
      low_ = high_ = y;
      return;
    }
    last_ = i;
    if (y < low_) {
      low_ = y;
      lowest_ = i;
    }
    if (y > high_) {
      high_ = y;
      highest_ = i;
    }
  }

  void flush(const Curve& curve, Points& kept) {
    if (empty_) return;
    std::array<std::size_t, 4> chosen = {first_, lowest_, highest_, last_};
    std::sort(chosen.begin(), chosen.end());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      if (k > 0 && chosen[k] == chosen[k - 1]) continue;
      kept.x.push_back(curve.x[chosen[k]]);
      kept.y.push_back(curve.y[chosen[k]]);
    }
    empty_ = true;
  }

 private:
  bool empty_ = true;
  std::size_t first_ = 0, lowest_ = 0, highest_ = 0, last_ = 0;
  double low_ = 0, high_ = 0;
};

}  // namespace

Points decimated(const Curve& curve, const PixelGrid& grid) {
  if (curve.style == Curve::Style::points) return thinned_points(curve, grid);
  Points kept;
  Run run;
  int column = 0;
  bool gap = true;  // nothing to separate yet
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!drawn(curve.x[i], curve.y[i])) {
      run.flush(curve, kept);
      if (!gap) {
        kept.x.push_back(std::numeric_limits<double>::quiet_NaN());
        kept.y.push_back(std::numeric_limits<double>::quiet_NaN());
      }
      gap = true;
      continue;
    }
    const int here = pixel(curve.x[i], grid.x_low, grid.x_high, grid.columns);
    if (gap || here != column) run.flush(curve, kept);
    column = here;
    gap = false;
    run.add(i, curve.y[i]);
  }
  run.flush(curve, kept);
  return kept;
}

Points thinned_path(const Curve& curve, const PixelGrid& grid) {
  constexpr double nearest = 0.5;  // [pixels]
  const double x_pixel = (grid.x_high - grid.x_low) / grid.columns;
  const double y_pixel = (grid.y_high - grid.y_low) / grid.rows;
  Points kept;
  const auto keep = [&kept](double x, double y) {
    kept.x.push_back(x);
    kept.y.push_back(y);
  };
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double x = curve.x[i];
    const double y = curve.y[i];
    if (!drawn(x, y)) {
      if (!kept.x.empty() && drawn(kept.x.back(), kept.y.back())) {
        keep(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN());
      }
      continue;
    }
    const bool first = kept.x.empty() || !drawn(kept.x.back(), kept.y.back());
    const bool last = i + 1 == curve.x.size() || !drawn(curve.x[i + 1], curve.y[i + 1]);
    if (first || last ||
        std::hypot((x - kept.x.back()) / x_pixel, (y - kept.y.back()) / y_pixel) >= nearest) {
      keep(x, y);
    }
  }
  return kept;
}

}  // namespace drycut::renders
