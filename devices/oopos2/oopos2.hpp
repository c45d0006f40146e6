#pragma once
#include <memory>

#include "devices/device.hpp"

namespace drycut::devices::oopos2 {

/// OOPOS2: on/off positioner, outputs forward, backward and slowdown by the position (001; spec qem.md 9).
extern const DeviceType oopos2_type;

std::unique_ptr<Device> make_oopos2(const Resources& resources, Cards& cards);

}  // namespace drycut::devices::oopos2
