#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "renders/plots.hpp"

namespace drycut::renders {

/// Points of a curve [units of its axes]; a point with a number that is not finite is a gap in the line.
struct Points {
  std::vector<double> x;
  std::vector<double> y;
};

/// The pixels that a curve is drawn on, and the range of each axis that they show.
struct PixelGrid {
  double x_low = 0, x_high = 1;
  double y_low = 0, y_high = 1;
  int columns = 1;
  int rows = 1;
};

/// What is left of a curve so that it looks the same. Lines and steps: of consecutive samples within one
/// pixel column the first, lowest, highest and last, so at most four a column for a curve that runs from left
/// to right. Points: one a pixel. Gaps stay gaps.
Points decimated(const Curve& curve, const PixelGrid& grid);

/// What is left of a path in a plane, which may run any way: a point that is less than half a pixel from the
/// last one kept is left out, the last of a stretch stays. Gaps stay gaps.
Points thinned_path(const Curve& curve, const PixelGrid& grid);

/// More samples of a curve than this are thinned before they are drawn or put into a report.
inline constexpr std::size_t kMostSamples = 50'000;
/// To the lowest and highest of each of so many equal stretches.
inline constexpr std::size_t kStretches = 10'000;

/// Takes the samples of a curve from left to right and keeps a bounded number of them, so that every peak
/// stays: see kMostSamples.
class Extremes {
 public:
  /// `samples`: how many are to come.
  explicit Extremes(std::size_t samples)
      : stretch_(samples <= kMostSamples ? 1 : (samples + kStretches - 1) / kStretches) {}
  /// Samples in a stretch; 1: all are kept.
  [[nodiscard]] std::size_t stretch() const { return stretch_; }
  void add(double x, double y);
  /// What is left.
  Points take();

 private:
  struct Sample {
    double x = 0, y = 0;
  };
  void close();

  std::size_t stretch_;
  std::size_t count_ = 0;  // in the present stretch
  Sample low_, high_;
  Points kept_;
};

/// The samples of a whole curve.
void thin(std::vector<double>& x, std::vector<double>& y);

/// Takes the points of a path or a cloud in a plane. Of more than kMostSamples only those are kept that lie
/// in a cell of the plane where none lay before: a path that is run again and again is drawn once. What
/// is left out of a path is a gap.
class Cloud {
 public:
  /// `samples` points are to come, all between these bounds.
  Cloud(std::size_t samples, const PixelGrid& bounds, bool path);
  void add(double x, double y);
  /// Interrupts a path.
  void gap();
  Points take() { return std::move(kept_); }

 private:
  PixelGrid grid_;
  bool path_;
  std::vector<bool> taken_;  // empty: all are kept
  std::size_t last_ = 0;     // cell
  Points kept_;
};

/// A lane's state from `from` to `until`.
struct LaneState {
  double from = 0;
  double until = 0;
  double value = 0;
  bool mixed = false;  ///< several states, each too short to be told from the next
};

/// The states of a lane, one after the other, from its first sample to its last. Samples that are not finite
/// are a gap.
std::vector<LaneState> lane_states(const Lane& lane);

/// True if no sample is anything but 0 or 1.
bool is_digital(const Lane& lane);

/// Where a digital lane is high, no narrower than `pixel` [units of x]: a short pulse is not lost, and pulses
/// that are closer than that join.
std::vector<LaneState> high_states(const std::vector<LaneState>& states, double pixel);

/// The states with those shorter than `pixel` [units of x] joined into mixed ones.
std::vector<LaneState> told_apart(const std::vector<LaneState>& states, double pixel);

}  // namespace drycut::renders
