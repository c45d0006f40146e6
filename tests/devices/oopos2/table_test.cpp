#include <gtest/gtest.h>

#include "devices/oopos2/oopos2.hpp"
#include "tests/devices/variable_rule.hpp"

namespace drycut::devices::oopos2 {
namespace {

/// 001 1.6.3 and spec qem.md 9.1.
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
  expect_variables(oopos2_type, variable_rules);
  for (const DeviceVariable& variable : oopos2_type.variables) {
    EXPECT_EQ(variable.rows, 1) << variable.name;
    // Only posit has a condition (001 1.6.3).
    EXPECT_EQ(variable.write.mask, variable.name == "posit" ? 1u : 0u) << variable.name;
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

}  // namespace
}  // namespace drycut::devices::oopos2
