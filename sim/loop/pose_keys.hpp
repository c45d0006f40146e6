#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "plants/plant.hpp"
#include "sim/record/recording.hpp"

namespace drycut::plants {
void visit(StateArchive& archive, PartPose& part);
}

namespace drycut::sim::loop {

/// Where a part was at an instant between two frames.
struct PoseKey {
  std::size_t part = 0;  ///< number in all plants' parts, in order
  Time time = 0;
  plants::PartPose pose;

  void visit(StateArchive& archive);
};

/// Looks at the parts between two frames, the more often the faster they turn, and keeps so many poses of
/// each that whoever goes straight from one to the next is nowhere far off: nothing turns by more than 30
/// degrees from pose to pose (if it does not turn further in one step), and its place is within 2 mm all the
/// way. What jumps, comes or goes does so between two looks.
class PoseKeys {
 public:
  /// A look is due at the first step at or after this time; never before the first look.
  [[nodiscard]] Time next() const { return next_; }
  /// Looks at the parts, always the same ones.
  void look(Time now, const std::vector<plants::Part>& parts);
  /// No looks any more.
  void close() { next_ = never; }

  /// Of all parts at the last look.
  [[nodiscard]] const std::vector<plants::PartPose>& poses() const { return last_; }
  /// A frame shows the poses of the last look: what has been kept since the frame before goes to `kept`,
  /// that of each part in order of time; how far each part with a pitch has turned [rad], in any direction,
  /// to `turned`.
  void begin_frame(std::vector<PoseKey>& kept, std::vector<double>& turned);
  void visit(StateArchive& archive);

 private:
  /// Of a part since the last pose of it that is kept.
  struct Course {
    plants::PartPose from;
    Time begin = 0;
    Eigen::Vector3d speed = {0, 0, 0};  ///< behind that pose [m/s]
    bool has_speed = false;

    void visit(StateArchive& archive);
  };

  void keep(std::size_t part, Time time, const plants::PartPose& pose);
  /// Follows a part to this look; how far it has turned since the last one [rad].
  double follow(std::size_t part, Time now, const plants::PartPose& pose);

  Time next_ = never;
  Time time_ = 0;                       ///< of the last look
  std::vector<plants::PartPose> last_;  ///< then
  std::vector<Course> courses_;
  std::vector<PoseKey> kept_;
  std::vector<double> turned_;  ///< of the parts with a pitch, since the last frame [rad]
};

}  // namespace drycut::sim::loop
