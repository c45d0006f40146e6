#include "devices/catalogue.hpp"

#include <array>

#include "devices/camming4/camming4.hpp"

namespace drycut::devices {

std::span<const CatalogueEntry> catalogue() {
  static constexpr std::array entries = {
      CatalogueEntry{&camming4::camming4_type, camming4::make_camming4},
  };
  return entries;
}

}  // namespace drycut::devices
