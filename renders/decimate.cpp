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

std::size_t cell_of(double x, double y, const PixelGrid& grid) {
  const int column = pixel(x, grid.x_low, grid.x_high, grid.columns) + 1;
  const int row = pixel(y, grid.y_low, grid.y_high, grid.rows) + 1;
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns + 2) +
         static_cast<std::size_t>(column);
}

Points thinned_points(const Curve& curve, const PixelGrid& grid) {
  Points kept;
  std::vector<bool> taken(static_cast<std::size_t>(grid.columns + 2) *
                          static_cast<std::size_t>(grid.rows + 2));
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!drawn(curve.x[i], curve.y[i])) continue;
    const std::size_t place = cell_of(curve.x[i], curve.y[i], grid);
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

void Extremes::add(double x, double y) {
  if (stretch_ == 1) {
    kept_.x.push_back(x);
    kept_.y.push_back(y);
    return;
  }
  if (count_ == 0 || y < low_.y || !std::isfinite(low_.y)) low_ = {x, y};
  if (count_ == 0 || y > high_.y || !std::isfinite(high_.y)) high_ = {x, y};
  if (++count_ == stretch_) close();
}

void Extremes::close() {
  const bool falls = high_.x < low_.x;
  for (const Sample& sample : {falls ? high_ : low_, falls ? low_ : high_}) {
    if (!kept_.x.empty() && low_.x == high_.x && kept_.x.back() == sample.x) continue;
    kept_.x.push_back(sample.x);
    kept_.y.push_back(sample.y);
  }
  count_ = 0;
}

Points Extremes::take() {
  if (count_ > 0) close();
  return std::move(kept_);
}

void thin(std::vector<double>& x, std::vector<double>& y) {
  if (x.size() <= kMostSamples) return;
  Extremes envelope(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) envelope.add(x[i], y[i]);
  Points kept = envelope.take();
  x = std::move(kept.x);
  y = std::move(kept.y);
}

Cloud::Cloud(std::size_t samples, const PixelGrid& bounds, bool path) : grid_(bounds), path_(path) {
  constexpr int cells = 2000;  // across and up: finer than any picture
  grid_.columns = grid_.rows = cells;
  if (samples > kMostSamples) taken_.resize(static_cast<std::size_t>(cells + 2) * (cells + 2));
}

void Cloud::add(double x, double y) {
  if (!taken_.empty()) {
    const std::size_t cell = cell_of(x, y, grid_);
    const bool same = cell == last_;
    last_ = cell;
    if (taken_[cell]) {
      if (path_ && !same) gap();
      return;
    }
    taken_[cell] = true;
  }
  kept_.x.push_back(x);
  kept_.y.push_back(y);
}

void Cloud::gap() {
  if (kept_.x.empty() || !drawn(kept_.x.back(), kept_.y.back())) return;
  kept_.x.push_back(std::numeric_limits<double>::quiet_NaN());
  kept_.y.push_back(std::numeric_limits<double>::quiet_NaN());
}

std::vector<LaneState> lane_states(const Lane& lane) {
  std::vector<LaneState> states;
  bool open = false;
  for (std::size_t i = 0; i < lane.x.size(); ++i) {
    if (open) states.back().until = lane.x[i];
    if (!std::isfinite(lane.y[i])) {
      open = false;
      continue;
    }
    if (open && states.back().value == lane.y[i]) continue;
    states.push_back({lane.x[i], lane.x[i], lane.y[i]});
    open = true;
  }
  return states;
}

bool is_digital(const Lane& lane) {
  return std::all_of(lane.y.begin(), lane.y.end(),
                     [](double y) { return !std::isfinite(y) || y == 0 || y == 1; });
}

std::vector<LaneState> high_states(const std::vector<LaneState>& states, double pixel) {
  std::vector<LaneState> high;
  for (const LaneState& state : states) {
    if (state.value == 0) continue;
    const double until = std::max(state.until, state.from + pixel);
    if (!high.empty() && state.from - high.back().until < pixel) {
      high.back().until = until;
    } else {
      high.push_back({state.from, until, state.value});
    }
  }
  return high;
}

std::vector<LaneState> told_apart(const std::vector<LaneState>& states, double pixel) {
  std::vector<LaneState> apart;
  for (const LaneState& state : states) {
    const bool narrow = state.until - state.from < pixel;
    const bool beside = !apart.empty() && apart.back().until == state.from;
    if (narrow && beside && apart.back().mixed) {
      apart.back().until = state.until;
    } else {
      apart.push_back({state.from, state.until, state.value, narrow});
    }
  }
  return apart;
}

}  // namespace drycut::renders
