#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

namespace drycut::sim {

/// A table of the LX3VP for `drycut devices`: it has registers and instructions where a QMOVE has devices.
struct Lx3vpTable {
  std::string_view name;
  std::string_view summary;
  void (*print)();
  nlohmann::ordered_json (*json)();
};
/// DECAM, the parameter block of an electronic cam, ECAMTBX, its parameter lists, and LX3VP, special
/// registers and instructions.
std::span<const Lx3vpTable> lx3vp_tables();

}  // namespace drycut::sim
