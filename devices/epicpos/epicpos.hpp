#pragma once
#include <memory>

#include "devices/device.hpp"

namespace drycut::devices::epicpos {

/// EPICPOS: analogue positioner with epicycloidal ramps (002; spec qem.md 6).
extern const DeviceType epicpos_type;

std::unique_ptr<Device> make_epicpos(const Resources& resources, Cards& cards);

}  // namespace drycut::devices::epicpos
