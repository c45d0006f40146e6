#include "devices/epicpos/epicpos.hpp"

#include "devices/epicpos/positioner.hpp"

namespace drycut::devices::eanpos {

std::unique_ptr<Device> make_eanpos(const Resources& resources, Cards& cards) {
  return std::make_unique<epicpos::Positioner>(eanpos_type, resources, cards);
}

}  // namespace drycut::devices::eanpos
