#include <gmock/gmock.h>

#include <set>

#include "devices/catalogue.hpp"
#include "devices/eanpos/eanpos.hpp"
#include "devices/epicpos/epicpos.hpp"

namespace drycut::devices::epicpos {
namespace {

using eanpos::eanpos_type;

class EpicposTable : public testing::TestWithParam<const DeviceType*> {};
INSTANTIATE_TEST_SUITE_P(Both, EpicposTable, testing::Values(&epicpos_type, &eanpos_type),
                         [](const auto& type) { return std::string(type.param->name); });

const Variable& variable(const DeviceType& type, std::string_view name) {
  return type.variables[static_cast<std::size_t>(find_symbol(type, name).value().index)];
}

TEST_P(EpicposTable, EveryRowHasItsOwnNameAMeaningAndASection) {
  std::set<std::string_view> names;
  const auto check = [&](const auto& rows) {
    for (const auto& row : rows) {
      EXPECT_TRUE(names.insert(row.name).second) << row.name;
      EXPECT_FALSE(row.meaning.empty()) << row.name;
      EXPECT_TRUE(row.section.starts_with("002 1.4.") || row.section == "000 1.5") << row.name;
    }
  };
  check(GetParam()->variables);
  check(GetParam()->states);
  check(GetParam()->commands);
  EXPECT_EQ(GetParam()->states.size(), 13u);    // 002 1.4.4
  EXPECT_EQ(GetParam()->commands.size(), 19u);  // 002 1.4.2
}

TEST_P(EpicposTable, RangesHoldWhatTheSizeHolds) {
  for (const Variable& row : GetParam()->variables) {
    EXPECT_LE(row.min, row.max) << row.name;
    EXPECT_EQ(wrap(row.size, static_cast<std::int64_t>(row.min)), row.min) << row.name;
    EXPECT_EQ(wrap(row.size, static_cast<std::int64_t>(row.max)), row.max) << row.name;
  }
}

TEST_P(EpicposTable, CommandsAreInTheManualsOrder) {
  std::string order;
  for (const Command& command : GetParam()->commands) order += std::string(command.name) + " ";
  EXPECT_EQ(order,
            "INIT EMRG RESUME START STOP LOOPON LOOPOFF CNTLOCK CNTUNLOCK CNTREV CNTDIR PRESET CALON CALOFF "
            "MANFW MANBW REGOFF REGON DELCNT ");
}

TEST_P(EpicposTable, FieldsAreThoseOfTheCnfRecord) {
  std::string record;
  for (const Field& field : GetParam()->fields) record += std::string(field.name) + " ";
  EXPECT_EQ(record, "TCamp ICont IntL IAZero IOutA ");
  EXPECT_EQ(GetParam()->fields[0].min, 1);
  EXPECT_EQ(GetParam()->fields[0].max, 255);
}

TEST_P(EpicposTable, TakesTheManualsOtherSpellings) {
  const std::pair<const char*, const char*> spellings[] = {
      {"cnratio", "cntratio"}, {"prsvl", "prsvel"},  {"prsvcl", "prsvel"},      {"sprsvl", "sprsvel"},
      {"sprsvcl", "sprsvel"},  {"spsvl", "sprsvel"}, {"prmdir", "prsdir"},      {"prsdire", "prsdir"},
      {"folterr", "follerr"},  {"intreg", "integ"},  {"feedforward", "feedfw"}, {"rampm", "rampmode"},
      {"setVel", "setvel"},    {"tolldly", "toldly"}};
  for (const auto& [spelling, name] : spellings) {
    const auto symbol = find_symbol(*GetParam(), spelling);
    ASSERT_TRUE(symbol) << spelling;
    EXPECT_EQ(name_of(*GetParam(), *symbol), name);
  }
  for (const Alias& alias : GetParam()->aliases)
    EXPECT_TRUE(find_symbol(*GetParam(), alias.name)) << alias.name;
}

TEST_P(EpicposTable, RangesAreTheManuals) {
  EXPECT_EQ(variable(*GetParam(), "cntratio").min, 374);  // D1: the print's 347 is a slip
  EXPECT_EQ(variable(*GetParam(), "cntratio").max, 400000);
  EXPECT_EQ(variable(*GetParam(), "tinvt").max, 999);
  EXPECT_EQ(variable(*GetParam(), "pgain").max, 32767);
  EXPECT_EQ(variable(*GetParam(), "vout").retention, Retention::zero);
  EXPECT_EQ(variable(*GetParam(), "posit").retention, Retention::retentive);
  EXPECT_EQ(variable(*GetParam(), "integ").max, 1024);
}

TEST_P(EpicposTable, IsInTheCatalogueAndRunsUnwired) {
  bool found = false;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.type != GetParam()) continue;
    found = true;
    Cards cards;
    Resources unused(entry.type->fields.size());
    unused[0].number = 255;
    const auto device = entry.make(unused, cards);
    EXPECT_EQ(device->period_ms(), 255);
    for (const char* command : {"INIT", "PRESET", "MANFW", "CALON"}) {
      device->command(*find_command(*entry.type, command));
      device->sample();
      device->interrupt(3, true);
    }
    EXPECT_EQ(device->read(*find_symbol(*entry.type, "st_init")), 1);
    device->power_up();
    EXPECT_EQ(device->read(*find_symbol(*entry.type, "st_init")), 0);
    EXPECT_TRUE(cards.counters.empty());
    EXPECT_TRUE(cards.analogue_outputs.empty());
  }
  EXPECT_TRUE(found);
}

TEST(EpicposTables, DifferInTheRampsAlone) {
  const auto has = [](const DeviceType& type, const char* name) {
    return find_symbol(type, name).has_value();
  };
  for (const char* name : {"rtype", "stopt"}) {
    EXPECT_TRUE(has(epicpos_type, name)) << name;
    EXPECT_FALSE(has(eanpos_type, name)) << name;
  }
  EXPECT_TRUE(has(eanpos_type, "ramptype"));
  EXPECT_FALSE(has(epicpos_type, "ramptype"));
  EXPECT_EQ(epicpos_type.variables.size(), 38u);  // 002 1.4.3
  EXPECT_EQ(eanpos_type.variables.size(), 37u);
}

}  // namespace
}  // namespace drycut::devices::epicpos
