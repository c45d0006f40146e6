#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "base/text.hpp"
#include "devices/camming4/messages.hpp"
#include "devices/camming4/sector.hpp"
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/language.hpp"
#include "sim/cli/commands.hpp"
#include "tests/sim/command_bench.hpp"

// `drycut devices` marks readings of ours, with the place that leaves them open, in text and JSON.
namespace drycut::sim {
namespace {

using nlohmann::json;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

const json* row_of(const json& rows, const std::string& name) {
  for (const auto& row : rows)
    if (row.at("name") == name) return &row;
  ADD_FAILURE() << "no row " << name;
  return nullptr;
}

TEST(QmoveTables, ReadingsAreMarkedWithTheirRow) {
  const auto eanpos = printed("eanpos", false);
  EXPECT_THAT(eanpos, ContainsRegex("\n  ramptype .*ramps: 0 trapezoidal, 1 epicycloidal \\(\\*\\)\n"));
  EXPECT_THAT(eanpos, ContainsRegex("\n  ramptype +as CAMMING4's .*000 1.5 declares the device"));
  const auto epicpos = printed("EPICPOS", false);
  EXPECT_THAT(epicpos, ContainsRegex("\n  integ .*integral action \\(\\*\\)\n"));
  EXPECT_THAT(epicpos,
              ContainsRegex("\n  integ +the integral action is limited to \\+-1024 bits +002 1.4.3"));
  EXPECT_THAT(epicpos, ContainsRegex("\n  pgain .*in one TCamp\n"));  // the manual says all of it
}

TEST(QmoveTables, ReadingsStandInJson) {
  for (const auto& entry : devices::catalogue()) {
    const auto device = json::parse(printed(std::string(entry.type->name), true));
    std::size_t found = device.contains("readings") ? device.at("readings").size() : 0;
    for (const char* table : {"variables", "states", "commands"})
      for (const auto& row : device.at(table)) found += row.contains("reading") ? 1 : 0;
    EXPECT_EQ(found, entry.type->readings.size()) << entry.type->name;
  }
  const auto epicpos = json::parse(printed("EPICPOS", true));
  const json* derreg = row_of(epicpos.at("variables"), "derreg");
  ASSERT_TRUE(derreg);
  EXPECT_EQ(derreg->at("reading").at("manual"), "002 1.4.3 prints the range 0..1024 only");
  EXPECT_FALSE(row_of(epicpos.at("variables"), "pgain")->contains("reading"));
}

TEST(QmoveTables, TheLanguageIsATableToo) {
  const auto text = printed("qmove", false);
  EXPECT_THAT(text, ContainsRegex("\n  FOR \\(i = a, e, step\\) / NEXT .*how it closes is ours\n"));
  EXPECT_THAT(text, ContainsRegex("\n  END +the task ends\n"));
  EXPECT_THAT(printed("", false), HasSubstr("\nQMOVE          QEM QMOVE: the language QCL"));
  const auto table = json::parse(printed("QMOVE", true));
  EXPECT_EQ(table.at("language").size(), devices::qmove::language.size());
}

TEST(QmoveTables, CammingTellsItsCodesAndMessages) {
  const auto page = json::parse(printed("CAMMING4", true));
  ASSERT_EQ(page.at("codes").size(), devices::camming4::codes.size());
  for (std::size_t i = 0; i < devices::camming4::codes.size(); ++i)
    EXPECT_EQ(page.at("codes")[i].at("code"), devices::camming4::codes.at(i).code);
  const auto& dzmc = page.at("codes")[18];
  EXPECT_EQ(dzmc.at("name"), "DZMC");
  EXPECT_EQ(dzmc.at("codeQm"), "master space [Um]");
  EXPECT_EQ(dzmc.at("codeQsa"), "slave space [bits x4]");
  EXPECT_EQ(page.at("errors").size(), 9U);
  EXPECT_EQ(page.at("warnings").size(), 12U);
  for (const auto& row : page.at("warnings"))
    EXPECT_EQ(row.at("priority"), devices::camming4::warning_priority(row.at("code").get<int>()));
  EXPECT_EQ(page.at("input_functions").back().at("number"), 12);
  EXPECT_EQ(page.at("output_functions").back().at("number"), 9);
  EXPECT_THAT(printed("camming4", false),
              ContainsRegex("\n  137 +ABJ +goes on at another row +row to go to"));
}

// The sections that the page lists are those that a configuration may have.
TEST(QmoveTables, TheConfigurationIsATableToo) {
  Problems problems;
  devices::qmove::parse_configuration("SECTIONS\nEND\n", "x.cnf", devices::catalogue(), problems);
  ASSERT_FALSE(problems.empty());
  std::vector<std::string> names;
  const auto page = json::parse(printed("CNF", true));
  for (const auto& row : page.at("sections")) names.push_back(row.at("form"));
  EXPECT_THAT(problems.front().what + problems.front().remedy, HasSubstr(listed(names)));
}

}  // namespace
}  // namespace drycut::sim
