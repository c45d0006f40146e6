// What `drycut devices CAMMING4` says beside the tables that all devices have: the cam's codes, errors,
// warnings and the functions of its terminals.
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

#include "devices/camming4/messages.hpp"
#include "devices/camming4/sector.hpp"
#include "sim/cli/pages.hpp"

namespace drycut::sim::cli {

namespace {

namespace camming4 = devices::camming4;
using camming4::Use;

constexpr int largest_code = 100;  // of errors and warnings

std::string_view meaning_of(Use use) {
  switch (use) {
    case Use::unused:
      return "";
    case Use::master_space:
      return "master space";
    case Use::slave_space:
    case Use::slave_space_bits:
      return "slave space";
    case Use::master_coefficient:
      return "ratio, master side";
    case Use::slave_coefficient:
      return "ratio, slave side";
    case Use::master_count:
    case Use::master_count_bits:
      return "master count";
    case Use::slave_count:
    case Use::slave_count_bits:
      return "slave count";
    case Use::master_quota:
      return "master position";
    case Use::target_row:
      return "row to go to";
    case Use::times:
      return "number of jumps";
    case Use::times_done:
      return "jumps made, read-out";
    case Use::radius:
      return "radius: + short arc, - long arc";
    case Use::displacement_x:
      return "way in x";
    case Use::displacement_y:
      return "way in y";
    case Use::master_done:
      return "master space done, read-out";
    case Use::softening:
      return "softening: 0 none, 1 to 4 = 1/2 to 1/5 of the smaller sector";
    case Use::sector_type:
      return "0 a movement follows, 1 the axis stands next, 2 gearing";
  }
  return "";
}

std::string column_of(Use use) {
  const auto unit = camming4::unit_of(use);
  return fmt::format("{}{}", meaning_of(use), unit.empty() ? "" : fmt::format(" [{}]", unit));
}

Sheet code_sheet() {
  Sheet sheet("codes", "Codes of the cam's rows (000 1.2.13)",
              {"code", "name", "meaning", "codeQm", "codeQs", "codeQma", "codeQsa"});
  for (const auto& row : camming4::codes)
    sheet.add({row.code, row.mnemonic, row.meaning, column_of(row.qm), column_of(row.qs), column_of(row.qma),
               column_of(row.qsa)});
  return sheet;
}

Sheet error_sheet() {
  Sheet sheet("errors", "Errors in errcode, with the row in errvalue (000 1.3): RSERR, then RESUME",
              {"code=errcode", "meaning"});
  for (int code = 1; code <= largest_code; ++code)
    if (const auto text = camming4::error_text(code); !text.empty()) sheet.add({code, text});
  return sheet;
}

Sheet warning_sheet() {
  Sheet sheet("warnings", "Warnings in wrncode, with the row in wrnvalue (000 1.4): the axis goes on",
              {"code=wrncode", "priority=priority, 0 first", "meaning"});
  for (int code = 1; code <= largest_code; ++code)
    if (const auto text = camming4::warning_text(code); !text.empty())
      sheet.add({code, camming4::warning_priority(code), text});
  return sheet;
}

struct TerminalFunction {
  int number;
  std::string_view meaning;
};
constexpr std::array input_functions{
    TerminalFunction{0, "none"},
    TerminalFunction{1, "STOPCAM"},
    TerminalFunction{2, "STARTCAM, its origin where the counts were at the edge"},
    TerminalFunction{3, "delta1 takes encoder"},
    TerminalFunction{4, "delta2 takes encoderm"},
    TerminalFunction{5, "delta1 counts up"},
    TerminalFunction{6, "delta2 counts up"},
    TerminalFunction{7, "encoder takes delta1"},
    TerminalFunction{8, "encoderm takes delta2"},
    TerminalFunction{9, "3 and STARTCAM"},
    TerminalFunction{10, "4 and STARTCAM"},
    TerminalFunction{11, "9, and no STOPCAM for 25 ms"},
    TerminalFunction{12, "10, and no STOPCAM for 25 ms"},
};
constexpr std::array output_functions{
    TerminalFunction{0, "none: the output is the program's"},
    TerminalFunction{1, "off"},
    TerminalFunction{2, "on"},
    TerminalFunction{3, "st_toll"},
    TerminalFunction{4, "st_tpos"},
    TerminalFunction{5, "st_sync"},
    TerminalFunction{6, "codeMex is 1000"},
    TerminalFunction{7, "codeMex is 1000, and st_sync"},
    TerminalFunction{8, "codeMex is 1001"},
    TerminalFunction{9, "codeMex is 1002"},
};

template <std::size_t count>
Sheet function_sheet(const std::string& key, const std::string& title,
                     const std::array<TerminalFunction, count>& rows) {
  Sheet sheet(key, title, {"number", "meaning"});
  for (const auto& [number, meaning] : rows) sheet.add({number, meaning});
  return sheet;
}

}  // namespace

std::vector<Sheet> camming4_sheets() {
  return {
      code_sheet(), error_sheet(), warning_sheet(),
      function_sheet("input_functions", "Functions of the inputs, for funInp and funInt (000 1.7)",
                     input_functions),
      function_sheet("output_functions", "Functions of the output, for funOut (000 1.8)", output_functions)};
}

}  // namespace drycut::sim::cli
