#pragma once
#include <cstdint>
#include <vector>

#include "devices/device.hpp"

namespace drycut::devices {

/// For each command of `type` the commands that want the opposite of it, a bit each: those whose effect is
/// the other value of the same state (EMRG and RESUME, LOOPON and LOOPOFF), what begins a movement and what
/// ends it (START and STOP, STARTCAM and STOPCAM), and two that begin different movements (MANFW and MANBW).
std::vector<std::uint64_t> contradictions(const DeviceType& type);

}  // namespace drycut::devices
