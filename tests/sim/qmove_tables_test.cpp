#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "devices/catalogue.hpp"
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

}  // namespace
}  // namespace drycut::sim
