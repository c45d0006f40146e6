#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "devices/plcopen/cam_laws.hpp"
#include "devices/plcopen/cam_table.hpp"
#include "devices/problem.hpp"

namespace drycut::devices::plcopen {

/// Reads a cam table of the ISG kernel, `*.tab`: header lines `Tablename = ...`, `Tabletype`, `Table-ID`,
/// `Functiontype` (may be missing) and `Lines`, then `Begintable`, one line a row of numbers between blanks,
/// with decimal comma or point, and `EndTable`. `#` begins a comment. Faults go to `problems`; nullopt if
/// there is one.
std::optional<CamTable> parse_tab(std::string_view text, const std::string& file, Problems& problems);

/// A cam as CSV, for use without a controller: the table and the axes that it is meant for.
struct CamCsv {
  CamTable table;
  Interpolation interpolation = Interpolation::linear;
  Endless endless = Endless::no;
  double master_modulo = 3'600'000;  ///< [0.0001 deg]
  double slave_modulo = 3'600'000;   ///< 0 = linear slave
};

/// Reads a cam as CSV: `# key: value` lines (interpolation, endless, master_modulo, slave_modulo, name, id),
/// a header `slave`, `master,slave` or `a0,a1,a2,a3`, then the rows; with `;` between the columns a decimal
/// comma is taken too. The table is checked as MC_CamIn does, with its error ids. Nullopt if there is a
/// fault.
std::optional<CamCsv> parse_cam_csv(std::string_view text, const std::string& file, Problems& problems);

}  // namespace drycut::devices::plcopen
