#pragma once
#include <memory>
#include <span>

#include "devices/device.hpp"

namespace drycut::devices {

/// A device type that a .CNF may name, and how to make one: `resources` in the order of DeviceType::fields.
struct CatalogueEntry {
  const DeviceType* type;
  std::unique_ptr<Device> (*make)(const Resources& resources, Cards& cards);
};

/// Every device type there is, by name.
std::span<const CatalogueEntry> catalogue();

}  // namespace drycut::devices
