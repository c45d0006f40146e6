#include "plants/line_drive.hpp"

#include <algorithm>

namespace drycut::plants {

LineDrive::LineDrive(const LineDriveData& data)
    : data_(data), set_speed_(data.speed), roll_speed_(data.speed) {}

void LineDrive::drive(Slide& web, double h) {
  const double change = data_.acceleration * h;
  roll_speed_ += std::clamp(set_speed_ - roll_speed_, -change, change);
  const double difference = roll_speed_ - web.speed;
  force_ =
      std::clamp(data_.stiffness * draw_ + data_.damping * difference, -data_.max_force, data_.max_force);
  web.add_force(force_);
  // Where the force is at its limit the roll slips on the web and winds up no further.
  const double most = data_.max_force / data_.stiffness;
  draw_ = std::clamp(draw_ + difference * h, -most, most);
}

}  // namespace drycut::plants
