#include <gmock/gmock.h>

#include <set>

#include "devices/camming4/camming4.hpp"
#include "devices/catalogue.hpp"

namespace drycut::devices::camming4 {
namespace {

const Variable& variable(std::string_view name) {
  return camming4_type.variables[find_symbol(camming4_type, name)->index];
}

TEST(Camming4Table, EveryRowHasItsOwnNameAMeaningAndASection) {
  std::set<std::string_view> names;
  const auto check = [&](const auto& rows) {
    for (const auto& row : rows) {
      EXPECT_TRUE(names.insert(row.name).second) << row.name;
      EXPECT_FALSE(row.meaning.empty()) << row.name;
      EXPECT_EQ(row.section.substr(0, 6), "000 1.") << row.name;
    }
  };
  check(camming4_type.variables);
  check(camming4_type.states);
  check(camming4_type.commands);
  EXPECT_EQ(camming4_type.states.size(), 31u);    // 000 1.9.6
  EXPECT_EQ(camming4_type.commands.size(), 37u);  // 000 1.9.5, doubles counted once
}

TEST(Camming4Table, RangesHoldWhatTheSizeHolds) {
  for (const Variable& row : camming4_type.variables) {
    EXPECT_LE(row.min, row.max) << row.name;
    if (row.access == Access::read) continue;  // errvalue and wrnvalue are bytes that show rows up to 128
    EXPECT_EQ(wrap(row.size, static_cast<std::int64_t>(row.min)), row.min) << row.name;
    EXPECT_EQ(wrap(row.size, static_cast<std::int64_t>(row.max)), row.max) << row.name;
  }
}

TEST(Camming4Table, HasTheCamTableOf128Rows) {
  for (const char* name : {"codeG128", "codeQm128", "codeQs128", "codeQma128", "codeQsa128", "codeM128"})
    EXPECT_TRUE(find_symbol(camming4_type, name)) << name;
  EXPECT_FALSE(find_symbol(camming4_type, "codeG129"));
  EXPECT_EQ(variable("codeG1").size, Size::W);
  EXPECT_EQ(find_symbol(camming4_type, "codeMex")->row, 0);
  EXPECT_EQ(variable("codeMex").rows, 1);
}

TEST(Camming4Table, CommandsAreInTheirOrderOfPriority) {
  const auto row = [](const char* name) { return *find_command(camming4_type, name); };
  EXPECT_EQ(row("INIT"), 0);
  EXPECT_LT(row("EMRG"), row("RESUME"));
  EXPECT_LT(row("STOP"), row("START"));
  EXPECT_LT(row("STOPCAM"), row("STARTCAM"));
  EXPECT_EQ(row("DELCNTM"), 36);
}

TEST(Camming4Table, FieldsAreThoseOfTheCnfRecord) {
  std::string record;
  for (const Field& field : camming4_type.fields) record += std::string(field.name) + " ";
  EXPECT_EQ(record, "TCamp CountS CountMA CountMB IntL IAZero IntLM IAZeroM InG InGInt IoutA Out ");
  EXPECT_EQ(camming4_type.fields[0].max, 250);
}

TEST(Camming4Table, IsInTheCatalogue) {
  bool found = false;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.type != &camming4_type) continue;
    found = true;
    Cards cards;
    Resources unused(entry.type->fields.size());
    unused[0].number = 4;
    const auto device = entry.make(unused, cards);
    EXPECT_EQ(device->period_ms(), 4);
    // Nothing wired: it runs all the same.
    device->command(0);
    device->sample();
    device->sample();
    EXPECT_EQ(device->read(*find_symbol(*entry.type, "st_init")), 1);
    EXPECT_TRUE(cards.counters.empty());
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace drycut::devices::camming4
