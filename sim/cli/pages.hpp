#pragma once
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/sheet.hpp"

namespace drycut::sim::cli {

/// What `drycut devices NAME` or `drycut plants NAME` shows.
struct Page {
  std::string name;
  std::string summary;
  std::string preamble;  ///< lines of text before the tables; "" = none
  std::vector<Sheet>
      sheets;          ///< in their order; readings of ours, where a manual leaves it open, are the last
  Json aliases = {};   ///< other spellings and what they stand for, for JSON alone
  bool listed = true;  ///< in the short list of all; else another page names it
};

/// What a list of pages is of, for messages: {"drycut plants", "plant type"}.
struct PageKind {
  std::string command;
  std::string what;
};
/// Prints the page of that name, in any case, or all of them in short: `overview` if it is given, else a line
/// each. The exit status: 2 where there is none of that name, which is told.
int show(const PageKind& kind, const std::vector<Page>& pages, const std::string& name, bool json,
         const std::vector<Sheet>& overview = {});

/// A page for each device of QMOVE, QMOVE, the language of its tasks, and CNF, its configuration.
std::vector<Page> qmove_pages();
/// Of CAMMING4: the codes of a cam's rows, errors, warnings, functions of inputs and output.
std::vector<Sheet> camming4_sheets();
/// PLCOPEN, blocks and errors, AXIS, values, parameters and terminals, ST, the language of its programs, and
/// each function block with its pins.
std::vector<Page> plcopen_pages();
/// DECAM, the parameter block of an electronic cam, ECAMTBX, its parameter lists, and LX3VP, special
/// registers and instructions.
std::vector<Page> lx3vp_pages();
/// All of these, in this order.
std::vector<Page> device_pages();
/// The keys of scenario files, and of scenes that compare.
std::vector<Page> scenario_pages();
/// The keys and columns of all kinds of cam tables.
Page cam_table_page();
/// A page for each plant type.
std::vector<Page> plant_pages();
/// A table of units for each quantity.
std::vector<Sheet> unit_tables();
/// A table of servo motors and one of induction motors that come with the program.
std::vector<Sheet> motor_tables();

}  // namespace drycut::sim::cli
