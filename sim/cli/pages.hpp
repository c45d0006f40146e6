#pragma once
#include <string>
#include <vector>

#include "base/sheet.hpp"

namespace drycut::sim::cli {

/// What `drycut devices NAME` or `drycut plants NAME` shows.
struct Page {
  std::string name;
  std::string summary;
  std::string preamble;  ///< lines of text before the tables; "" = none
  std::vector<Sheet>
      sheets;  ///< in their order; readings of ours, where a manual leaves it open, are the last
  nlohmann::ordered_json aliases = {};  ///< other spellings and what they stand for, for JSON alone
  bool listed = true;                   ///< in the short list of all; else another page names it
};

/// A page for each device of QMOVE, and QMOVE, the language of its tasks.
std::vector<Page> qmove_pages();
/// PLCOPEN, blocks and errors, AXIS, values, parameters and terminals, and each function block with its pins.
std::vector<Page> plcopen_pages();
/// DECAM, the parameter block of an electronic cam, ECAMTBX, its parameter lists, and LX3VP, special
/// registers and instructions.
std::vector<Page> lx3vp_pages();
/// All of these, in this order.
std::vector<Page> device_pages();
/// A page for each plant type.
std::vector<Page> plant_pages();

}  // namespace drycut::sim::cli
