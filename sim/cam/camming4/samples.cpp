#include "sim/cam/camming4/samples.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::sim {

namespace {

constexpr int points_a_pass = 1000;

CamPoint point_at(const CamVisit& visit, double m) {
  const auto motion = visit.at(m);
  return {visit.master_start + m,
          visit.slave_start + motion.position,
          motion.velocity,
          motion.acceleration,
          motion.jerk,
          visit.row};
}

bool steps(double before, double after) {
  return std::abs(after - before) > 1e-9 * std::max({1.0, std::abs(before), std::abs(after)});
}

/// Positions inside a sector, from its start, where its law changes over.
std::vector<double> phases(const CamVisit& visit) {
  std::vector<double> places;
  if (visit.waiting) return places;
  const auto& law = visit.sector.law;
  for (int i = 1; i < law.count; ++i) {
    const double place = law.ramps[static_cast<std::size_t>(i)].from;
    if (place > 0 && place < visit.master_length) places.push_back(place);
  }
  return places;
}

/// The even grid over the run, handed out sector by sector.
class Grid {
 public:
  Grid(double total, int passes) : total_(total), count_(std::int64_t{points_a_pass} * passes) {}

  /// Grid points inside (begin, end), from begin; none so near to a `boundary` that they are the same point.
  std::vector<double> inside(double begin, double end, const std::vector<double>& boundaries) {
    std::vector<double> places;
    const double same = 1e-12 * total_;
    for (; next_ < count_ && place(next_) < end - same; ++next_) {
      const double m = place(next_) - begin;
      const bool taken = m <= same || std::any_of(boundaries.begin(), boundaries.end(),
                                                  [&](double b) { return std::abs(b - m) <= same; });
      if (!taken) places.push_back(m);
    }
    return places;
  }

 private:
  [[nodiscard]] double place(std::int64_t k) const {
    return total_ * static_cast<double>(k) / static_cast<double>(count_ - 1);
  }
  double total_;
  std::int64_t count_;
  std::int64_t next_ = 0;
};

void sample_visit(const CamVisit& visit, Grid& grid, bool both_sides, std::vector<CamPoint>& points) {
  const auto boundaries = phases(visit);
  auto places = grid.inside(visit.master_start, visit.master_end(), boundaries);
  places.push_back(0);
  places.insert(places.end(), boundaries.begin(), boundaries.end());
  if (both_sides) {
    // A hair before each change of phase, so that a step of acceleration is drawn upright; and enough points
    // for the shape of a short sector.
    constexpr int least = 64;
    for (const double place : boundaries) places.push_back(place - 1e-9 * visit.master_length);
    for (int i = 1; i < least; ++i) places.push_back(visit.master_length * i / least);
  }
  std::sort(places.begin(), places.end());
  for (const double place : places) points.push_back(point_at(visit, place));
}

}  // namespace

std::vector<CamPoint> sample_cam(const CamRun& run, bool both_sides) {
  std::vector<CamPoint> points;
  Grid grid(run.master_total, run.passes);
  std::size_t shown = run.shown;  // without a last sector that was only entered
  while (shown > 0 && run.visits[shown - 1].master_length <= 0) --shown;
  for (std::size_t i = 0; i < shown; ++i) {
    const CamVisit& visit = run.visits[i];
    sample_visit(visit, grid, both_sides, points);
    CamPoint end = point_at(visit, visit.master_length);
    const bool is_last = i + 1 == shown;
    if (!is_last) end.master = run.visits[i + 1].master_start;  // the same to the last bit
    const double after = is_last ? 0 : point_at(run.visits[i + 1], 0).velocity;
    if (is_last || both_sides || steps(end.velocity, after)) points.push_back(end);
  }
  const bool released = run.end == CamRun::End::ended && run.shown == run.visits.size();
  if (released && !points.empty() && steps(points.back().velocity, 0))
    points.push_back({run.master_total, run.slave_total, 0, 0, 0, 0});
  return points;
}

std::vector<CamPoint> sample_cam_at(const CamRun& run, std::vector<double> masters) {
  std::sort(masters.begin(), masters.end());
  std::vector<CamPoint> points;
  std::size_t i = 0;
  for (const double master : masters) {
    while (i + 1 < run.shown && master >= run.visits[i + 1].master_start) ++i;
    if (i < run.shown) points.push_back(point_at(run.visits[i], master - run.visits[i].master_start));
    if (!points.empty()) points.back().master = master;
  }
  return points;
}

}  // namespace drycut::sim
