#include "plants/changeover.hpp"

#include <algorithm>
#include <cstddef>

#include "base/state_archive.hpp"

namespace drycut::plants {

// Contacts in order, the drive's own first. A coil has voltage while all others are open.
int Changeover::update(double h) {
  const bool selected = std::any_of(motors_.begin(), motors_.end(),
                                    [](const Motor& other) { return other.motor->select.level; });
  const auto others_closed = [&](const SharedMotor* but) {
    return std::any_of(motors_.begin(), motors_.end(), [&](const Motor& other) {
      return other.motor != but && other.motor->contact().closed();
    });
  };
  own_.update(!selected && !others_closed(nullptr), h);
  for (const Motor& one : motors_)
    one.motor->contact().update(one.motor->select.level && !own_.closed() && !others_closed(one.motor), h);
  if (own_.closed()) return own;
  for (std::size_t i = 0; i < motors_.size(); ++i)
    if (motors_[i].motor->contact().closed()) return static_cast<int>(i) + 1;
  return nothing;
}

bool Changeover::take_trip() {
  bool tripped = false;
  for (const Motor& one : motors_) {
    if (!one.motor->power().tripped()) continue;
    one.motor->power().reset();
    tripped = true;
  }
  return tripped;
}

void Changeover::offer_channels(std::vector<Channel>& channels) const {
  if (!shared()) return;
  channels.push_back({"shared.closed", "", [this] { return own_closed() ? 1.0 : 0.0; },
                      "1 while the contactor connects the motor to the drive"});
}

void Changeover::offer_faults(std::vector<Fault>& faults) {
  if (shared()) own_.offer_faults(faults, "shared");
}

void SharedMotor::visit(StateArchive& archive) { STATE(archive, select, power_, contact_, given_, last_); }

void Changeover::visit(StateArchive& archive) { STATE(archive, own_); }

Parameters shared_drive_parameters(SharedDriveData& data, std::string_view type) {
  return {
      row("drive",
          "drive: shared: the axis whose drive the motor is switched to, by a contactor; its motor is of the "
          "type of that axis' motor",
          data.drive, type, "it has a drive of its own", false),
      row("close_delay", "ms",
          "from coil on to contacts closed, of the contactor between a shared drive and this motor",
          data.close_delay, 0, 1000, "usual: contactors of the 2 kW class"),
      row("open_delay", "ms", "from coil off to the end of the arc", data.open_delay, 0, 1000,
          "usual: contactors of the 2 kW class"),
  };
}

}  // namespace drycut::plants
