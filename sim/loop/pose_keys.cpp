#include "sim/loop/pose_keys.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/state_archive.hpp"

namespace drycut::sim::loop {

namespace {

constexpr double furthest_turn = std::numbers::pi / 6;  // from pose to pose
constexpr double turn_of_look = furthest_turn / 3;      // what a look should find at most
constexpr double furthest_stray = 1e-3;                 // [m]
constexpr Time longest_look = millisecond;

double turn_between(const plants::PartPose& a, const plants::PartPose& b) {
  const Eigen::Map<const Eigen::Vector4d> from(a.pose.rotation.data());
  const Eigen::Map<const Eigen::Vector4d> to(b.pose.rotation.data());
  return 2 * std::acos(std::min(1.0, std::abs(from.dot(to))));
}

Eigen::Vector3d way_between(const plants::PartPose& a, const plants::PartPose& b) {
  return Eigen::Map<const Eigen::Vector3d>(b.pose.position.data()) -
         Eigen::Map<const Eigen::Vector3d>(a.pose.position.data());
}

}  // namespace

void PoseKeys::keep(std::size_t part, Time time, const plants::PartPose& pose) {
  kept_.push_back({part, time, pose});
  courses_[part] = {pose, time};
}

double PoseKeys::follow(std::size_t part, Time now, const plants::PartPose& pose) {
  const auto& last = last_[part];
  auto& course = courses_[part];
  const bool comes_or_goes = pose.visible != last.visible;
  if (!pose.visible && !comes_or_goes) return 0;
  const double turn = comes_or_goes ? 0 : turn_between(last, pose);
  const double since = seconds(now - course.begin);
  const bool strays =
      comes_or_goes || turn_between(course.from, pose) > furthest_turn ||
      (course.has_speed && (way_between(course.from, pose) - since * course.speed).norm() > furthest_stray);
  // At the last look it was still near enough.
  if (strays && course.begin < time_) keep(part, time_, last);
  if (comes_or_goes) {
    keep(part, now, pose);
  } else if (!course.has_speed) {
    course.speed = way_between(last, pose) / seconds(now - time_);
    course.has_speed = true;
  }
  return turn;
}

void PoseKeys::look(Time now, const std::vector<plants::Part>& parts) {
  const bool first = last_.size() != parts.size();
  if (first) {
    last_.clear();
    for (const auto& part : parts) last_.push_back(part.now());
    courses_.assign(parts.size(), {});
    turned_.assign(static_cast<std::size_t>(std::count_if(parts.begin(), parts.end(),
                                                          [](const auto& part) { return part.pitch > 0; })),
                   0);
    for (std::size_t i = 0; i < parts.size(); ++i) courses_[i] = {last_[i], now};
    time_ = now;
    next_ = now + 1;  // the next step tells how fast they are
    return;
  }
  if (now == time_) return;
  double furthest = 0;
  std::size_t with_pitch = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool counts = parts[i].pitch > 0;
    if (!parts[i].frame) {  // it stands on the floor
      with_pitch += counts ? 1 : 0;
      continue;
    }
    const auto pose = parts[i].now();
    const double turn = follow(i, now, pose);
    if (counts) turned_[with_pitch++] += turn;
    furthest = std::max(furthest, turn);
    last_[i] = pose;
  }
  const auto soon = static_cast<double>(now - time_) * turn_of_look / std::max(furthest, 1e-9);
  next_ = now + (soon < longest_look ? static_cast<Time>(soon) : longest_look);
  time_ = now;
}

void PoseKeys::begin_frame(std::vector<PoseKey>& kept, std::vector<double>& turned) {
  kept.swap(kept_);
  kept_.clear();
  turned = turned_;
  std::fill(turned_.begin(), turned_.end(), 0);
  for (std::size_t i = 0; i < last_.size(); ++i) courses_[i] = {last_[i], time_};
}

void PoseKey::visit(StateArchive& archive) { STATE(archive, part, time, pose); }

void PoseKeys::Course::visit(StateArchive& archive) {
  STATE(archive, from, begin, speed.x(), speed.y(), speed.z(), has_speed);
}

void PoseKeys::visit(StateArchive& archive) { STATE(archive, next_, time_, last_, courses_, kept_, turned_); }

}  // namespace drycut::sim::loop

void drycut::plants::visit(StateArchive& archive, PartPose& part) {
  STATE(archive, part.pose.position, part.pose.rotation, part.visible, part.scale);
}
