#pragma once
#include <memory>

#include "devices/device.hpp"

namespace drycut::devices::eanpos {

/// EANPOS: analogue positioner with trapezoidal ramps, or epicycloidal ones by `ramptype` (spec qem.md 7).
/// Its own tables are not to be had: it is EPICPOS without rtype and stopt (D17). With its counter on slot 1
/// and no other terminal it is the simulated master of CAMMING4 (000 1.5).
extern const DeviceType eanpos_type;

std::unique_ptr<Device> make_eanpos(const Resources& resources, Cards& cards);

}  // namespace drycut::devices::eanpos
