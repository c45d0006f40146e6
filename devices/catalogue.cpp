#include "devices/catalogue.hpp"

#include <array>

#include "devices/camming4/camming4.hpp"
#include "devices/eanpos/eanpos.hpp"
#include "devices/epicpos/epicpos.hpp"

namespace drycut::devices {

std::span<const CatalogueEntry> catalogue() {
  static constexpr std::array entries = {
      CatalogueEntry{&camming4::camming4_type, camming4::make_camming4},
      CatalogueEntry{&eanpos::eanpos_type, eanpos::make_eanpos},
      CatalogueEntry{&epicpos::epicpos_type, epicpos::make_epicpos},
  };
  return entries;
}

}  // namespace drycut::devices
