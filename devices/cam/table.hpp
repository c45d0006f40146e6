#pragma once
#include <variant>

#include "devices/camming4/cam_table.hpp"
#include "devices/lx3vp/ecam_table.hpp"
#include "devices/plcopen/tab_file.hpp"

namespace drycut::devices {

/// A cam with all that its law needs, as a controller holds it or a file gives it.
struct CamTable : std::variant<camming4::CamTable, lx3vp::EcamTable, plcopen::CamFile> {
  using variant::variant;
};

}  // namespace drycut::devices
