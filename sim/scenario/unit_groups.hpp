#pragma once
#include <string_view>
#include <vector>

namespace drycut::sim::scenario {

/// Units of one quantity as the page of units lists them, the SI unit first: each can be expressed in every
/// other. A pound or an ounce is a mass, but beside a length ("lb in", "oz-in s2", "ft lb") the force: so
/// torques and inertias are written on American sheets.
struct UnitGroup {
  std::string_view quantity;  ///< "torque"
  std::vector<std::string_view> units;
  std::string_view remark = {};  ///< what to beware of; "" = nothing
};
/// What a machine's data sheets use; UDUNITS knows more.
const std::vector<UnitGroup>& unit_groups();

}  // namespace drycut::sim::scenario
