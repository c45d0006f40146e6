#include "plants/pose_math.hpp"

#include <Eigen/Geometry>

namespace drycut::plants {

namespace {

// Eigen keeps a quaternion as Pose does: x y z w.
using Place = Eigen::Map<const Eigen::Vector3d>;
using Turn = Eigen::Map<const Eigen::Quaterniond>;

Pose pose_of(const Eigen::Vector3d& place, const Eigen::Quaterniond& turn) {
  return {{place.x(), place.y(), place.z()}, {turn.x(), turn.y(), turn.z(), turn.w()}};
}

Pose turned(double angle, const Eigen::Vector3d& axis) {
  return pose_of(Eigen::Vector3d::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)));
}

}  // namespace

Pose about_x(double angle) { return turned(angle, Eigen::Vector3d::UnitX()); }
Pose about_y(double angle) { return turned(angle, Eigen::Vector3d::UnitY()); }
Pose about_z(double angle) { return turned(angle, Eigen::Vector3d::UnitZ()); }

Pose operator*(const Pose& outer, const Pose& inner) {
  const Turn turn(outer.rotation.data());
  return pose_of(Place(outer.position.data()) + turn * Place(inner.position.data()),
                 turn * Turn(inner.rotation.data()));
}

PartPose Part::now() const {
  if (!frame) return offset;
  PartPose pose = frame();
  pose.pose = pose.pose * offset;
  return pose;
}

}  // namespace drycut::plants
