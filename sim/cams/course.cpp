#include "sim/cams/course.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drycut::sim::cams {

namespace {

constexpr int points_a_pass = 1000;
constexpr double no_speed = 1e-9;  // of a master

CamPoint point_at(const CamCourse& course, int loop, std::size_t piece, double master) {
  const auto& law = course.law;
  auto motion = at(law, piece, master);
  motion.position = course.first_slave + loop * law.slave_length + motion.position;
  return {motion, course.first_master + loop * law.master_length + master, law.pieces[piece].row};
}

bool jumps(const CamPoint& before, const CamPoint& after) {
  constexpr double same = 1e-9;
  return std::abs(after.position - before.position) > 0.01 ||
         std::abs(after.velocity - before.velocity) >
             same * std::max({1.0, std::abs(before.velocity), std::abs(after.velocity)});
}

/// The even places of a cycle, from its beginning to its end.
class Grid {
 public:
  explicit Grid(const CamCourse& course) : course_(course) {}

  /// Those inside (begin, end), in the order of asking.
  std::vector<double> inside(double begin, double end) {
    const double same = 1e-12 * course_.law.master_length;
    std::vector<double> places;
    while (next_ < count_ && place(next_) <= begin + same) ++next_;
    for (; next_ < count_ && place(next_) < end - same; ++next_) places.push_back(place(next_));
    return places;
  }

 private:
  /// Rounded as the samples of each kind always were, to the last digit.
  [[nodiscard]] double place(int k) const {
    const double length = course_.law.master_length;
    return course_.passes > 0 ? length * k / (count_ - 1) : k * (length / (count_ - 1));
  }
  const CamCourse& course_;
  int count_ = points_a_pass * std::max(1, course_.passes);
  int next_ = 0;
};

/// From where to where the pieces of the same row around one reach.
std::pair<double, double> row_of(const CamCourse& course, std::size_t piece) {
  const auto& pieces = course.law.pieces;
  std::size_t first = piece;
  std::size_t last = piece;
  while (first > 0 && pieces[first - 1].row == pieces[piece].row) --first;
  while (last + 1 < pieces.size() && pieces[last + 1].row == pieces[piece].row) ++last;
  return {course.begin_of(first), course.end_of(last)};
}

/// Where the slave is behind the end of the course, if its last point does not say it.
std::optional<CamPoint> behind(const CamCourse& course) {
  if (course.lets_go) return CamPoint{{course.slave_total()}, course.master_total(), 0};
  if (course.holds) return point_at(course, course.loops, 0, course.begin_of(0));
  return {};
}

}  // namespace

double CamCourse::begin_of(std::size_t piece) const { return std::max(0.0, law.pieces[piece].master); }

double CamCourse::end_of(std::size_t piece) const {
  return piece + 1 < law.pieces.size() ? law.pieces[piece + 1].master : law.master_length;
}

double CamCourse::peak(devices::CamOrder order) const { return peak_of(law.pieces, order); }

std::vector<CamPoint> sample_cam(const CamCourse& course, bool both_sides) {
  constexpr double hair = 1e-9;
  std::vector<CamPoint> points;
  const std::size_t count = course.law.pieces.size();
  for (int loop = 0; loop < course.loops; ++loop) {
    Grid grid(course);
    for (std::size_t i = 0; i < count; ++i) {
      const double begin = course.begin_of(i);
      const double end = course.end_of(i);
      auto places = grid.inside(begin, end);
      places.push_back(begin);
      const auto [from, to] = both_sides ? row_of(course, i) : std::pair(begin, end);
      for (int k = 1; both_sides && k < course.drawn; ++k)
        if (const double place = from + (to - from) * k / course.drawn; place > begin && place < end)
          places.push_back(place);
      std::sort(places.begin(), places.end());
      for (const double place : places) points.push_back(point_at(course, loop, i, place));
      const bool wraps = i + 1 == count;
      // Inside a row a hair before its end, so that a step of acceleration is drawn upright.
      const auto last = point_at(course, loop, i, to > end ? end - hair * (to - from) : end);
      const bool is_last = wraps && loop + 1 == course.loops;
      const std::size_t next = wraps ? 0 : i + 1;
      if (is_last || both_sides ||
          jumps(last, point_at(course, loop + (wraps ? 1 : 0), next, course.begin_of(next))))
        points.push_back(last);
    }
  }
  if (count == 0) return points;
  if (const auto after = behind(course); after && jumps(points.back(), *after)) points.push_back(*after);
  return points;
}

std::vector<CamPoint> sample_cam_at(const CamCourse& course, std::vector<double> masters) {
  std::sort(masters.begin(), masters.end());
  std::vector<CamPoint> points;
  if (!course.runs()) return points;
  const double cycle = course.law.master_length;
  for (const double master : masters) {
    const double along = master - course.first_master;
    const int loop =
        cycle > 0 ? std::clamp(static_cast<int>(std::floor(along / cycle)), 0, course.loops - 1) : 0;
    const double inside = std::max(0.0, along - loop * cycle);
    const bool held = course.holds && inside >= cycle;
    points.push_back(held ? *behind(course) : point_at(course, loop, piece_at(course.law, inside), inside));
    points.back().master = master;
  }
  return points;
}

double peak_of(const std::vector<devices::CamPiece>& pieces, devices::CamOrder order) {
  double most = 0;
  for (const auto& piece : pieces) most = std::max(most, piece.peak(order));
  return most;
}

devices::CamExtremes reach_of(const std::vector<devices::CamPiece>& pieces) {
  auto reach = pieces.front().extremes(devices::CamOrder::position);
  for (const auto& piece : pieces) {
    const auto found = piece.extremes(devices::CamOrder::position);
    reach = {std::min(reach.low, found.low), std::max(reach.high, found.high)};
  }
  return reach;
}

bool is_master_speed(double speed) { return std::abs(speed - 1) <= no_speed; }

std::string motion_name(double entry, double exit, bool steady) {
  if (steady && std::abs(entry) <= no_speed) return "dwell";
  if (steady) return is_master_speed(entry) ? "synchronism" : entry < 0 ? "return" : "constant speed";
  if (std::abs(exit) > std::abs(entry) + no_speed) return "acceleration";
  if (std::abs(exit) < std::abs(entry) - no_speed) return "deceleration";
  return "compensation";
}

}  // namespace drycut::sim::cams
