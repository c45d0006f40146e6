#include "devices/qmove/catalogue.hpp"

#include <array>

#include "devices/camming4/camming4.hpp"
#include "devices/epicpos/epicpos.hpp"
#include "devices/modbus/modbus.hpp"
#include "devices/oopos2/oopos2.hpp"

namespace drycut::devices {

std::span<const CatalogueEntry> catalogue() {
  static constexpr std::array entries = {
      CatalogueEntry{&camming4::camming4_type, camming4::make_camming4},
      CatalogueEntry{&eanpos::eanpos_type, eanpos::make_eanpos},
      CatalogueEntry{&epicpos::epicpos_type, epicpos::make_epicpos},
      CatalogueEntry{&modbus::modbus_type, modbus::make_modbus},
      CatalogueEntry{&oopos2::oopos2_type, oopos2::make_oopos2},
  };
  return entries;
}

}  // namespace drycut::devices
