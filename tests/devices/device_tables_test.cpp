// What the tables of the positioners have in common: the public face as the manuals print it.
#include <gmock/gmock.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "devices/camming4/camming4.hpp"
#include "devices/epicpos/epicpos.hpp"
#include "devices/oopos2/oopos2.hpp"
#include "devices/qmove/catalogue.hpp"

namespace drycut::devices {
namespace {

struct Face {
  const DeviceType* type;
  const char* section;  ///< how the sections of its rows begin
  std::size_t states;
  const char* commands;
  const char* record;  ///< fields of its record in the .CNF
  int longest_period;  ///< [ms]
  std::vector<std::pair<const char*, const char*>> spellings;
};

constexpr const char* epicpos_commands =
    "INIT EMRG RESUME START STOP LOOPON LOOPOFF CNTLOCK CNTUNLOCK CNTREV CNTDIR PRESET CALON CALOFF MANFW "
    "MANBW REGOFF REGON DELCNT ";
const std::vector<std::pair<const char*, const char*>> epicpos_spellings = {
    {"cnratio", "cntratio"}, {"prsvl", "prsvel"},  {"prsvcl", "prsvel"},      {"sprsvl", "sprsvel"},
    {"sprsvcl", "sprsvel"},  {"spsvl", "sprsvel"}, {"prmdir", "prsdir"},      {"prsdire", "prsdir"},
    {"folterr", "follerr"},  {"intreg", "integ"},  {"feedforward", "feedfw"}, {"rampm", "rampmode"},
    {"setVel", "setvel"},    {"tolldly", "toldly"}};

const Face faces[] = {
    {&camming4::camming4_type,
     "000 1.",
     31,  // 000 1.9.6
          // 000 1.9.5, doubles counted once
     "INIT EMRG RESUME STOP START PRESET RSPRSOK PRESETM RSPRSM RSERR RSWRN LOOPON LOOPOFF MANFW MANBW CALON "
     "CALOFF CNTLOCK CNTUNLOCK CNTREV CNTDIR CNTLOCKM CNTUNLOCKM CNTREVM CNTDIRM STOPCAM STARTCAM REGOFF "
     "REGON ENBL INTENBL DSBL INTDSBL RSCAPT RSINTCAPT DELCNT DELCNTM ",
     "TCamp CountS CountMA CountMB IntL IAZero IntLM IAZeroM InG InGInt IoutA Out ",
     250,
     {}},
    {&epicpos::epicpos_type, "002 1.4.", 13, epicpos_commands, "TCamp ICont IntL IAZero IOutA ", 255,
     epicpos_spellings},
    {&eanpos::eanpos_type, "002 1.4.", 13, epicpos_commands, "TCamp ICont IntL IAZero IOutA ", 255,
     epicpos_spellings},
    {&oopos2::oopos2_type,
     "001 1.",
     15,
     "INIT STOP START CNTLOCK CNTUNLOCK CNTREV CNTDIR PRESET MANSFW MANSBW MANFFW MANFBW REGON REGOFF "
     "DELCNT ",
     "TCamp IQCTL ILine IAZero OutAva OutInd OutDir OutMov OutRal OutFre ",
     255,
     {{"tolp", "tollp"},
      {"toln", "tolln"},
      {"tin", "tinvt"},
      {"tinv", "tinvt"},
      {"slowly", "slowdly"},
      {"bkashmode", "bklashmode"},
      {"cnratio", "cntratio"},
      {"prmdir", "prsdir"},
      {"prsdire", "prsdir"},
      {"st_sttol", "st_sttoll"},
      {"movbwd", "st_movbwd"},
      {"SetPos", "setpos"}}},
};

class DeviceTables : public testing::TestWithParam<Face> {
 protected:
  const Face& face = GetParam();
  const DeviceType& type = *face.type;
};
INSTANTIATE_TEST_SUITE_P(Each, DeviceTables, testing::ValuesIn(faces),
                         [](const auto& face) { return std::string(face.param.type->name); });

TEST_P(DeviceTables, EveryRowHasItsOwnNameAMeaningAndASection) {
  std::set<std::string_view> names;
  const auto check = [&](const auto& rows) {
    for (const auto& row : rows) {
      EXPECT_TRUE(names.insert(row.name).second) << row.name;
      EXPECT_FALSE(row.meaning.empty()) << row.name;
      EXPECT_TRUE(row.section.starts_with(face.section) || row.section == "000 1.5") << row.name;
    }
  };
  check(type.variables);
  check(type.states);
  check(type.commands);
  EXPECT_EQ(type.states.size(), face.states);
}

TEST_P(DeviceTables, RangesHoldWhatTheSizeHolds) {
  for (const DeviceVariable& row : type.variables) {
    EXPECT_LE(row.min, row.max) << row.name;
    if (row.name == "errvalue" || row.name == "wrnvalue") continue;  // bytes that show rows up to 128
    EXPECT_EQ(wrap(row.size, static_cast<std::int64_t>(row.min)), row.min) << row.name;
    EXPECT_EQ(wrap(row.size, static_cast<std::int64_t>(row.max)), row.max) << row.name;
  }
}

TEST_P(DeviceTables, CommandsAndFieldsAreInTheManualsOrder) {
  const auto listed = [](const auto& rows) {
    std::string names;
    for (const auto& row : rows) names += std::string(row.name) + " ";
    return names;
  };
  EXPECT_EQ(listed(type.commands), face.commands);
  EXPECT_EQ(listed(type.fields), face.record);
  EXPECT_EQ(type.fields[0].min, 1);
  EXPECT_EQ(type.fields[0].max, face.longest_period);
}

TEST_P(DeviceTables, TakesTheManualsOtherSpellings) {
  for (const auto& [spelling, name] : face.spellings) {
    const auto symbol = find_symbol(type, spelling);
    ASSERT_TRUE(symbol) << spelling;
    EXPECT_EQ(name_of(type, *symbol), name);
  }
  for (const Alias& alias : type.aliases) EXPECT_TRUE(find_symbol(type, alias.name)) << alias.name;
}

TEST_P(DeviceTables, IsInTheCatalogueAndRunsUnwired) {
  bool found = false;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.type != &type) continue;
    found = true;
    Cards cards;
    Resources unused(type.fields.size());
    unused[0].number = face.longest_period;
    const auto device = entry.make(unused, cards);
    EXPECT_EQ(device->period_ms(), face.longest_period);
    for (const char* name :
         {"INIT", "START", "PRESET", "MANFW", "MANSFW", "REGOFF", "REGON", "CALON", "STARTCAM", "STOP"}) {
      if (const auto command = find_command(type, name)) device->command(*command);
      device->sample();
      device->interrupt(3, true);
    }
    EXPECT_EQ(device->read(*find_symbol(type, "st_init")), 1);
    device->power_up();
    EXPECT_EQ(device->read(*find_symbol(type, "st_init")), 0);
    EXPECT_TRUE(cards.counters.empty() && cards.analogue_outputs.empty() && cards.outputs.empty());
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace drycut::devices
