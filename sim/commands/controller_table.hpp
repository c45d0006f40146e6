#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace drycut::sim {

/// A table for `drycut devices` of a controller that has no devices of QMOVE's kind: registers and
/// instructions, axes and function blocks.
struct ControllerTable {
  std::string_view name;
  std::string_view summary;
  std::function<void()> print;
  std::function<nlohmann::ordered_json()> json;
  bool listed = true;  ///< in the short list of all; else another table names it
};

/// QMOVE, the language of its tasks; its devices have tables of their own.
std::vector<ControllerTable> qmove_tables();
/// DECAM, the parameter block of an electronic cam, ECAMTBX, its parameter lists, and LX3VP, special
/// registers and instructions.
std::vector<ControllerTable> lx3vp_tables();
/// PLCOPEN, blocks and errors, AXIS, values, parameters and terminals, and each function block with its pins.
std::vector<ControllerTable> plcopen_tables();

}  // namespace drycut::sim
