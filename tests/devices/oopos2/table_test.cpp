#include <gmock/gmock.h>

#include <set>

#include "devices/catalogue.hpp"
#include "devices/oopos2/oopos2.hpp"

namespace drycut::devices::oopos2 {
namespace {

/// A variable as 001 1.6.3 and spec qem.md 9.1 have it: size, access, retentive (R) or zero (0), range.
struct VariableRule {
  const char* name;
  char size;
  const char* access;
  char retention;
  double min;
  double max;
};

constexpr double most = 2147483647;
constexpr double least = -2147483648;

constexpr VariableRule variable_rules[] = {
    {"cntratio", 'L', "RW", 'R', 374, 400000},  // D1: the print's 347 is a slip
    {"posit", 'L', "RW", 'R', -999999, 999999},
    {"minpos", 'L', "RW", 'R', -999999, 999999},
    {"maxpos", 'L', "RW", 'R', -999999, 999999},
    {"slowpos", 'W', "RW", 'R', 0, 9999},
    {"tollp", 'W', "RW", 'R', 0, 9999},
    {"tolln", 'W', "RW", 'R', 0, 9999},
    {"tinvt", 'W', "RW", 'R', 0, 999},
    {"slowdly", 'W', "RW", 'R', 0, 999},
    {"tbrake", 'W', "RW", 'R', 0, 999},
    {"overpos", 'W', "RW", 'R', 0, 9999},
    {"bklashmode", 'B', "RW", 'R', 0, 4},
    {"ninert", 'B', "RW", 'R', 1, 8},
    {"maxiner", 'W', "RW", 'R', 0, 9999},
    {"toldly", 'W', "RW", 'R', 0, 9999},
    {"inertmode", 'B', "RW", 'R', 0, 2},
    {"tool", 'L', "RW", 'R', -999999, 999999},
    {"setpos", 'L', "RW", 'R', -999999, 999999},
    {"iner01", 'W', "RW", 'R', 0, 32767},
    {"iner02", 'W', "RW", 'R', 0, 32767},
    {"iner03", 'W', "RW", 'R', 0, 32767},
    {"iner04", 'W', "RW", 'R', 0, 32767},
    {"iner05", 'W', "RW", 'R', 0, 32767},
    {"iner06", 'W', "RW", 'R', 0, 32767},
    {"iner07", 'W', "RW", 'R', 0, 32767},
    {"iner08", 'W', "RW", 'R', 0, 32767},
    {"iner09", 'W', "RW", 'R', 0, 32767},
    {"iner10", 'W', "RW", 'R', 0, 32767},
    {"iner11", 'W', "RW", 'R', 0, 32767},
    {"iner12", 'W', "RW", 'R', 0, 32767},
    {"iner13", 'W', "RW", 'R', 0, 32767},
    {"iner14", 'W', "RW", 'R', 0, 32767},
    {"iner15", 'W', "RW", 'R', 0, 32767},
    {"iner16", 'W', "RW", 'R', 0, 32767},
    {"dobiner", 'B', "RW", 'R', 0, 1},
    {"enstol", 'B', "RW", 'R', 0, 1},
    {"prsmode", 'B', "RW", 'R', 0, 2},
    {"prspos", 'L', "RW", 'R', -999999, 999999},
    {"prsdir", 'B', "RW", 'R', 0, 3},
    {"actiner", 'B', "R", 'R', 0, 7},
    {"delta", 'L', "RW", 'R', -999999, 999999},
    {"decpt", 'B', "RW", 'R', 0, 3},
    {"unitvel", 'B', "RW", 'R', 0, 1},
    {"frq", 'L', "R", '0', least, most},
    {"vel", 'L', "R", '0', least, most},
    {"breaktype", 'B', "RW", 'R', 0, 1},
    {"slowtype", 'B', "RW", 'R', 0, 2},
    {"maxvel", 'L', "RW", 'R', 0, 999999},
    {"maxslow", 'W', "RW", 'R', 0, 9999},
    {"minslow", 'W', "RW", 'R', 0, 9999},
    {"exeslow", 'W', "R", '0', 0, 9999},
};

TEST(Oopos2Table, VariablesAreThoseOfTheManual) {
  ASSERT_EQ(std::size(variable_rules), oopos2_type.variables.size());
  for (std::size_t i = 0; i < std::size(variable_rules); ++i) {
    const VariableRule& rule = variable_rules[i];
    const Variable& variable = oopos2_type.variables[i];
    EXPECT_EQ(variable.name, rule.name);
    EXPECT_EQ(static_cast<char>(variable.size), rule.size) << rule.name;
    EXPECT_EQ(variable.access == Access::read, std::string(rule.access) == "R") << rule.name;
    EXPECT_EQ(variable.retention == Retention::retentive, rule.retention == 'R') << rule.name;
    EXPECT_EQ(variable.min, rule.min) << rule.name;
    EXPECT_EQ(variable.max, rule.max) << rule.name;
    EXPECT_EQ(variable.rows, 1) << rule.name;
    // Only posit has a condition (001 1.6.3).
    EXPECT_EQ(variable.write.mask, std::string(rule.name) == "posit" ? 1u : 0u) << rule.name;
  }
}

TEST(Oopos2Table, StatesAreThoseOfTheManual) {
  std::string names;
  for (const State& state : oopos2_type.states) {
    names += std::string(state.name) + " ";
    const bool kept = state.name == "st_cntlock" || state.name == "st_cntrev";
    EXPECT_EQ(state.retention, kept                       ? Retention::retentive
                               : state.name == "st_still" ? Retention::one
                                                          : Retention::zero)
        << state.name;
  }
  EXPECT_EQ(names,
            "st_init st_cntlock st_cntrev st_movfwd st_movbwd st_movslow st_toll st_brake st_movdir st_still "
            "st_erin st_sttoll st_prsok st_prson st_regoff ");
}

TEST(Oopos2Table, StopStandsBeforeStartAndTheOthersInTheManualsOrder) {
  std::string order;
  for (const Command& command : oopos2_type.commands) order += std::string(command.name) + " ";
  EXPECT_EQ(order,
            "INIT STOP START CNTLOCK CNTUNLOCK CNTREV CNTDIR PRESET MANSFW MANSBW MANFFW MANFBW REGON REGOFF "
            "DELCNT ");
}

TEST(Oopos2Table, EveryRowHasItsOwnNameAMeaningAndASection) {
  std::set<std::string_view> names;
  const auto check = [&](const auto& rows) {
    for (const auto& row : rows) {
      EXPECT_TRUE(names.insert(row.name).second) << row.name;
      EXPECT_FALSE(row.meaning.empty()) << row.name;
      EXPECT_TRUE(row.section.starts_with("001 1.")) << row.name;
    }
  };
  check(oopos2_type.variables);
  check(oopos2_type.states);
  check(oopos2_type.commands);
}

TEST(Oopos2Table, FieldsAreThoseOfTheCnfRecord) {
  std::string record;
  for (const Field& field : oopos2_type.fields) record += std::string(field.name) + " ";
  EXPECT_EQ(record, "TCamp IQCTL ILine IAZero OutAva OutInd OutDir OutMov OutRal OutFre ");
  EXPECT_EQ(oopos2_type.fields[0].min, 1);
  EXPECT_EQ(oopos2_type.fields[0].max, 255);
}

TEST(Oopos2Table, TakesTheManualsOtherSpellings) {
  const std::pair<const char*, const char*> spellings[] = {
      {"tolp", "tollp"},     {"toln", "tolln"},           {"tin", "tinvt"},        {"tinv", "tinvt"},
      {"slowly", "slowdly"}, {"bkashmode", "bklashmode"}, {"cnratio", "cntratio"}, {"prmdir", "prsdir"},
      {"prsdire", "prsdir"}, {"st_sttol", "st_sttoll"},   {"movbwd", "st_movbwd"}, {"SetPos", "setpos"}};
  for (const auto& [spelling, name] : spellings) {
    const auto symbol = find_symbol(oopos2_type, spelling);
    ASSERT_TRUE(symbol) << spelling;
    EXPECT_EQ(name_of(oopos2_type, *symbol), name);
  }
}

TEST(Oopos2Table, IsInTheCatalogueAndRunsUnwired) {
  bool found = false;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.type != &oopos2_type) continue;
    found = true;
    Cards cards;
    Resources unused(entry.type->fields.size());
    unused[0].number = 255;
    const auto device = entry.make(unused, cards);
    EXPECT_EQ(device->period_ms(), 255);
    for (const char* command : {"INIT", "START", "MANSFW", "REGOFF", "REGON", "PRESET", "STOP"}) {
      device->command(*find_command(*entry.type, command));
      device->sample();
      device->interrupt(3, true);
    }
    EXPECT_EQ(device->read(*find_symbol(*entry.type, "st_init")), 1);
    device->power_up();
    EXPECT_EQ(device->read(*find_symbol(*entry.type, "st_init")), 0);
    EXPECT_TRUE(cards.counters.empty());
    EXPECT_TRUE(cards.outputs.empty());
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace drycut::devices::oopos2
