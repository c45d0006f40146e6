#include "plants/line_drive.hpp"

#include <algorithm>

#include "base/state_archive.hpp"

namespace drycut::plants {

LineDrive::LineDrive(const LineDriveData& data)
    : data_(data), set_speed_(data.speed), roll_speed_(data.speed) {}

void LineDrive::drive(Slide& web, double h) {
  // The draw follows what roll and web did in the last step: a spring that lags its body by a step would feed
  // the oscillation. Where the force is at its limit the roll slips on the web and winds up no further.
  const double most = data_.max_force / data_.stiffness;
  draw_ = std::clamp(draw_ + (roll_speed_ - web.speed) * h, -most, most);
  const double change = data_.acceleration * h;
  roll_speed_ += std::clamp(set_speed_ - roll_speed_, -change, change);
  force_ = std::clamp(data_.stiffness * draw_ + data_.damping * (roll_speed_ - web.speed), -data_.max_force,
                      data_.max_force);
  web.add_force(force_);
}

void LineDrive::visit(StateArchive& archive) { STATE(archive, set_speed_, roll_speed_, draw_, force_); }

}  // namespace drycut::plants
