// `drycut devices` for the PLCopen controller: the device room's own tables, nothing left out.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "devices/plcopen/axis.hpp"
#include "devices/plcopen/errors.hpp"
#include "devices/plcopen/pins.hpp"
#include "devices/plcopen/readings.hpp"
#include "devices/plcopen/st/language.hpp"
#include "devices/plcopen/st/lexer.hpp"
#include "devices/plcopen/st/values.hpp"
#include "devices/plcopen/terminals.hpp"
#include "sim/cli/commands.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim {
namespace {

namespace plcopen = devices::plcopen;
using testing::HasSubstr;
using testing::Not;

TEST(PlcopenTables, TheShortListNamesTheAxisAndTheBlocksTogether) {
  const auto list = printed("", false);
  EXPECT_THAT(list, HasSubstr("\nPLCOPEN        PLCopen motion controller"));
  EXPECT_THAT(list, HasSubstr("\nAXIS           axis of the PLCopen controller"));
  EXPECT_THAT(list, Not(HasSubstr("MC_CamIn")));
}

TEST(PlcopenTables, AnAxisIsItsParametersValuesAndTerminals) {
  const auto text = printed("axis", false);
  const auto json = nlohmann::json::parse(printed("AXIS", true));
  EXPECT_EQ(json.at("parameters").size(), plcopen::axis_parameter_table().size());
  EXPECT_EQ(json.at("values").size(), plcopen::axis_value_table().size());
  EXPECT_EQ(json.at("terminals").size(), plcopen::axis_terminal_table().size());
  for (const auto& row : plcopen::axis_parameter_table()) EXPECT_THAT(text, HasSubstr(std::string(row.name)));
  for (const auto& row : plcopen::axis_value_table()) EXPECT_THAT(text, HasSubstr(std::string(row.name)));
  EXPECT_THAT(text, HasSubstr("drive | virtual | encoder"));
  const auto& modulo = json.at("parameters").at(1);
  EXPECT_EQ(modulo.at("name"), "modulo");
  EXPECT_EQ(modulo.at("default"), "360 deg");
  EXPECT_EQ(modulo.at("unit"), "mm or deg");
  EXPECT_EQ(modulo.at("kernel_unit"), "0.1 um, 0.0001 deg");
}

TEST(PlcopenTables, EveryBlockListsItsPins) {
  for (const auto& type : plcopen::block_types()) {
    const auto json = nlohmann::json::parse(printed(std::string(type.name), true));
    ASSERT_EQ(json.at("pins").size(), type.pins.size()) << type.name;
    const auto text = printed(std::string(type.name), false);
    for (const auto& pin : type.pins) EXPECT_THAT(text, HasSubstr(std::string(pin.name))) << type.name;
  }
  const auto json = nlohmann::json::parse(printed("plcopen", true));
  EXPECT_EQ(json.at("blocks").size(), plcopen::block_types().size());
  EXPECT_EQ(json.at("errors").size(), plcopen::error_table.size());
  const auto text = printed("PLCOPEN", false);
  EXPECT_THAT(text, HasSubstr("60251   the slave of a cam must be homed"));
  EXPECT_THAT(text, HasSubstr("HLI_CI_F_PERIODIC"));
}

bool named(const auto& rows, const std::string& word) {
  return std::ranges::any_of(rows, [&](const auto& row) {
    const auto words = " " + std::string(row.form) + " ";
    return words.find(" " + word + " ") != std::string::npos || row.form.starts_with(word + "(");
  });
}

TEST(PlcopenTables, TheLanguageHasEveryStandardFunctionAndBlock) {
  for (const auto& name : plcopen::st::standard_function_names())
    EXPECT_TRUE(named(plcopen::st::standard_functions, name)) << name;
  const std::string blocks(plcopen::st::standard_blocks());
  const std::string opens = "FUNCTION_BLOCK ";
  int found = 0;
  for (auto at = blocks.find("\n" + opens); at != std::string::npos; at = blocks.find("\n" + opens, at + 1)) {
    const auto from = at + 1 + opens.size();
    const auto name = blocks.substr(from, blocks.find('\n', from) - from);
    EXPECT_TRUE(named(plcopen::st::standard_function_blocks, name)) << name;
    ++found;
  }
  EXPECT_EQ(found, 25);  // three counters of six types among them
  const auto text = printed("st", false);
  EXPECT_THAT(text, HasSubstr("PERSISTENT"));
  EXPECT_THAT(text, HasSubstr("AND and OR take both sides"));  // a reading
}

TEST(PlcopenTables, ReadingsStandWithWhatTheyAreAbout) {
  for (const auto& reading : plcopen::readings) {
    const bool of_block = std::ranges::any_of(plcopen::block_types(),
                                              [&](const auto& type) { return type.name == reading.of; });
    const bool of_axis = std::ranges::any_of(plcopen::axis_parameter_table(),
                                             [&](const auto& row) { return row.name == reading.of; });
    EXPECT_TRUE(of_block || of_axis || reading.of == "cam table" || reading.of == "ST") << reading.of;
    EXPECT_FALSE(reading.manual.empty()) << reading.text;
    EXPECT_THAT(printed("PLCOPEN", false), HasSubstr(std::string(reading.text)));
    if (of_block || of_axis) {
      EXPECT_THAT(printed(of_block ? std::string(reading.of) : "AXIS", false),
                  HasSubstr(std::string(reading.text)));
    }
  }
  EXPECT_EQ(nlohmann::json::parse(printed("PLCOPEN", true)).at("readings").size(), plcopen::readings.size());
  EXPECT_EQ(nlohmann::json::parse(printed("MC_CamOut", true)).at("readings").size(), 1u);
  EXPECT_THAT(printed("MC_Power", false), Not(HasSubstr("Readings")));
}

}  // namespace
}  // namespace drycut::sim
