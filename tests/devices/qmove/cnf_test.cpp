#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/devices/qmove/support.hpp"
#include "tests/findings.hpp"

namespace drycut::devices::qmove {
namespace {

using testing::puppets;
using testing::text_of;
using testing::usual_cnf;

Configuration parsed(const std::string& text) {
  Problems problems;
  Configuration configuration = parse_configuration(text, "t.cnf", puppets(), problems);
  EXPECT_TRUE(problems.empty()) << text_of(problems);
  return configuration;
}

std::string faults(const std::string& text) {
  Problems problems;
  parse_configuration(text, "t.cnf", puppets(), problems);
  return text_of(problems);
}

TEST(QmoveCnf, ReadsEverySection) {
  const Configuration c = parsed(std::string(usual_cnf));
  ASSERT_EQ(c.constants.size(), 3U);
  EXPECT_EQ(c.constants[0].value, 10);
  EXPECT_FALSE(c.constants[0].real);
  EXPECT_EQ(c.constants[1].value, 0.5);
  EXPECT_TRUE(c.constants[1].real);
  EXPECT_EQ(c.constants[2].value, -3);
  ASSERT_EQ(c.scalars.size(), 14U);
  EXPECT_EQ(c.scalars[0].name, "slR");
  EXPECT_TRUE(c.scalars[0].retentive);
  EXPECT_EQ(c.scalars[8].name, "glI");
  EXPECT_FALSE(c.scalars[8].retentive);
  EXPECT_EQ(c.scalars[8].size, Size::L);
  ASSERT_EQ(c.arrays.size(), 3U);
  EXPECT_TRUE(c.arrays[0].retentive);
  EXPECT_EQ(c.arrays[2].length, 5);
  EXPECT_FALSE(c.arrays[2].retentive);
  ASSERT_EQ(c.timers.size(), 1U);
  ASSERT_EQ(c.groups.size(), 1U);
  EXPECT_EQ(c.groups[0].recipes, 2);
  EXPECT_EQ(c.groups[0].steps, 3);
  EXPECT_EQ(c.groups[0].statics.size(), 1U);
  EXPECT_EQ(c.groups[0].stepped.size(), 2U);
  ASSERT_EQ(c.slots.size(), 2U);
  EXPECT_EQ(c.slots[1].card, "1MIXA");
  EXPECT_EQ(c.slots[1].firmware, "00");
  ASSERT_EQ(c.inputs.size(), 2U);
  EXPECT_EQ(c.inputs[1].address, (Address{Kind::input, 2, 2}));
  ASSERT_EQ(c.outputs.size(), 2U);
  ASSERT_EQ(c.devices.size(), 1U);
  EXPECT_EQ(c.devices[0].type, 0U);
  ASSERT_EQ(c.devices[0].resources.size(), 6U);
  EXPECT_EQ(c.devices[0].resources[0].number, 4);
  EXPECT_EQ(c.devices[0].resources[1].address, (Address{Kind::counter, 2, 1}));
  EXPECT_EQ(c.devices[0].resources[2].number, 5);
}

TEST(QmoveCnf, EntriesKnowTheirPlaces) {
  const Configuration c = parsed("\n; title\nGLOBAL\n   glA L ; one\nEND\n");
  ASSERT_EQ(c.scalars.size(), 1U);
  EXPECT_EQ(c.scalars[0].place.line, 4);
  EXPECT_EQ(c.scalars[0].place.column, 4);
}

TEST(QmoveCnf, TakesTheSpellingsOfTheManuals) {
  const Configuration c = parsed(
      "CONST\nTIMER\n;DATAGROUP\nglobal\r\nglA l\r\nSystem\nslA\tL;close\nBUS\n  1    1CPUB    02\n  2 1MIXA "
      "00\n  3 .\n"
      "  4 :\n5\nINPUT\nin1 F 2.IN1\nOUTPUT\nINTDEVICE\nAx puppet 0004 2.cnt01 X X.X x.x 2.OUT3\nEND\n\n; "
      "after END\n");
  EXPECT_EQ(c.scalars.size(), 2U);
  ASSERT_EQ(c.slots.size(), 5U);
  EXPECT_TRUE(c.slots[2].card.empty());
  EXPECT_TRUE(c.slots[4].card.empty());
  ASSERT_EQ(c.devices.size(), 1U);
  EXPECT_EQ(c.devices[0].resources[0].number, 4);
  EXPECT_EQ(c.devices[0].resources[2].number, 0);
  EXPECT_FALSE(c.devices[0].resources[3].address);
  EXPECT_EQ(c.devices[0].resources[5].address, (Address{Kind::output, 2, 3}));
}

TEST(QmoveCnf, DatagroupCountsMayStandOnTheNextLine) {
  const Configuration c =
      parsed("DATAGROUP\ndgA\nDATAPROGRAM\n10\nddA L\nSTEP\n128\nddB B\ndgB\nDATAPROGRAM 3\nddC S\nEND\n");
  ASSERT_EQ(c.groups.size(), 2U);
  EXPECT_EQ(c.groups[0].recipes, 10);
  EXPECT_EQ(c.groups[0].steps, 128);
  EXPECT_EQ(c.groups[0].stepped.size(), 1U);
  EXPECT_EQ(c.groups[1].recipes, 3);
  EXPECT_EQ(c.groups[1].statics.size(), 1U);
}

// The manual's own record lacks CountMB (spec D6): what stands fourth has no '.', so it is X.X.
TEST(QmoveCnf, ElevenFieldsOfCamming4LackCountMb) {
  const std::string eleven = "AxisX CAMMING4 2 2.CNT01 2.CNT01 1 2.INP01 2 2.INP02 2.INP03 5 2.AN01 2.OUT01";
  const std::string twelve =
      "AxisX CAMMING4 2 2.CNT01 2.CNT01 2.CNT02 1 2.INP01 2 2.INP02 2.INP03 5 2.AN01 2.OUT01";
  const Configuration short_form = parsed("INTDEVICE\n" + eleven + "\nEND\n");
  const Configuration long_form = parsed("INTDEVICE\n" + twelve + "\nEND\n");
  EXPECT_THAT(
      sentences(short_form.notes),
      ::testing::ElementsAre("t.cnf:2:26: CountS and CountMA of AxisX are the same counter, 2.CNT01"));
  ASSERT_EQ(short_form.devices[0].resources.size(), 12U);
  EXPECT_FALSE(short_form.devices[0].resources[3].address);
  EXPECT_EQ(long_form.devices[0].resources[3].address, (Address{Kind::counter, 2, 2}));
  for (std::size_t i = 4; i < 12; ++i) {
    EXPECT_EQ(short_form.devices[0].resources[i].number, long_form.devices[0].resources[i].number) << i;
    EXPECT_EQ(short_form.devices[0].resources[i].address, long_form.devices[0].resources[i].address) << i;
  }
  // Eleven fields with an address in fourth place lack another field.
  EXPECT_NE(faults("INTDEVICE\nA CAMMING4 2 2.CNT01 2.CNT01 X.X 1 2.INP01 2 2.INP02 2.INP03 5 2.AN01\nEND\n")
                .find("t.cnf:2:64: CAMMING4 'A' has 12 fields after its name and type, found 11"),
            std::string::npos);
}

struct Fault {
  std::string text;
  std::string said;
};

TEST(QmoveCnf, NamesEachFaultAtItsPlace) {
  const std::vector<Fault> cases = {
      {"GLOBAL\nglA L\n", "t.cnf:2:6: the configuration has no END; write END"},
      {"", "t.cnf:1:1: the configuration has no END"},
      {"GLOBEL\nglA L\nEND\n",
       "t.cnf:1:1: unknown section 'GLOBEL'; did you mean 'GLOBAL'? [cnf.unknown-name]"},
      {"GLOBAL\nglA L\nINPTU\nx\nEND\n",
       "t.cnf:3:1: unknown section 'INPTU'; did you mean 'INPUT'? [cnf.unknown-name]"},
      {"REGISTERS\nEND\n", "t.cnf:1:1: unknown section 'REGISTERS'; sections are CONST, SYSTEM,"},
      {"glA L\nEND\n", "t.cnf:1:1: 'glA' stands before any section; begin with one of CONST"},
      {"GLOBAL gfA F\nEND\n", "t.cnf:1:8: unexpected 'gfA' after GLOBAL; GLOBAL stands alone"},
      {"END\nglA L\n", "t.cnf:2:1: 'glA' stands after END; only comments may follow END"},
      {"CONST\ncA\nEND\n", "t.cnf:2:1: 'cA' has no value; write: <name> <number> [cnf.syntax]"},
      {"CONST\ncA ten\nEND\n", "t.cnf:2:4: 'ten' is not a number; write a decimal number"},
      {"CONST\ncA 1.\nEND\n", "t.cnf:2:4: '1.' is not a number"},
      {"CONST\ncA -\nEND\n", "t.cnf:2:4: '-' is not a number"},
      {"CONST\ncA 2147483648\nEND\n",
       "t.cnf:2:4: '2147483648' is out of range; a long goes from -2147483648"},
      {"CONST\ncA -99999999999999999999\nEND\n", "t.cnf:2:4: '-99999999999999999999' is out of range"},
      {"CONST\ncA 1 2\nEND\n", "t.cnf:2:6: unexpected '2'; write: <name> <number>"},
      {"SYSTEM\n1sl L\nEND\n", "t.cnf:2:1: '1sl' is not a name; a name is letters, digits and _"},
      {"SYSTEM\nsl\xE4 L\nEND\n", "t.cnf:2:1: 'sl\\xE4' is not a name; a name is letters"},
      {"SYSTEM\nwait L\nEND\n",
       "t.cnf:2:1: 'wait' is a word of the language; choose another name [cnf.syntax]"},
      {"SYSTEM\nQMOS L\nEND\n", "t.cnf:2:1: 'QMOS' is a word of the language"},
      {"SYSTEM\nslA Q\nEND\n", "t.cnf:2:5: unknown type 'Q'; the type is F, B, W, L or S [cnf.unknown-name]"},
      {"SYSTEM\nslA LONG\nEND\n", "t.cnf:2:5: unknown type 'LONG'"},
      {"SYSTEM\nslA\nEND\n", "t.cnf:2:1: 'slA' has no type; write: <name> <type>"},
      {"SYSTEM\nslA L 3\nEND\n", "t.cnf:2:7: unexpected '3'; write: <name> <type>"},
      {"SYSTEM\nslA L\nGLOBAL\nSLA F\nEND\n",
       "t.cnf:4:1: 'SLA' is declared twice; the first stands in line 2"},
      {"CONST\ncA 1\nTIMER\ncA\nEND\n", "t.cnf:4:1: 'cA' is declared twice; the first stands in line 2"},
      {"TIMER\ntmA L\nEND\n", "t.cnf:2:5: unexpected 'L'; write: <name>, a timer has no type"},
      {"ARRGBL\nagA L\nEND\n", "t.cnf:2:1: 'agA' has no length; write: <name> <type> <length>"},
      {"ARRGBL\nagA L 0\nEND\n",
       "t.cnf:2:7: '0' cannot be the length of an array; write a whole number from 1"},
      {"ARRSYS\nagA L 65536\nEND\n", "t.cnf:2:7: '65536' cannot be the length of an array"},
      {"ARRSYS\nagA L -1\nEND\n", "t.cnf:2:7: '-1' cannot be the length of an array"},
      {"DATAGROUP\nDATAPROGRAM 2\nddA L\nEND\n", "t.cnf:2:1: DATAPROGRAM before the name of a datagroup"},
      {"DATAGROUP\ndgA\nddA L\nEND\n",
       "t.cnf:3:1: 'ddA' instead of DATAPROGRAM; write DATAPROGRAM <recipes>"},
      {"DATAGROUP\ndgA\nEND\n", "t.cnf:2:1: the datagroup 'dgA' has no DATAPROGRAM; write DATAPROGRAM"},
      {"DATAGROUP\ndgA\nDATAPROGRAM\nEND\n", "t.cnf:2:1: the datagroup 'dgA' has no DATAPROGRAM count"},
      {"DATAGROUP\ndgA\nDATAPROGRAM 1\nddA L\nSTEP\nEND\n",
       "t.cnf:2:1: the datagroup 'dgA' has no STEP count"},
      {"DATAGROUP\ndgA\nDATAPROGRAM x\nddA L\nEND\n", "t.cnf:3:13: 'x' cannot be the number of recipes"},
      {"DATAGROUP\ndgA\nDATAPROGRAM 2\nddA L\nSTEP 0\nEND\n", "t.cnf:5:6: '0' cannot be the number of steps"},
      {"DATAGROUP\ndgA\nDATAPROGRAM 2\nSTEP 3\nddA L\nDATAPROGRAM 3\nEND\n",
       "t.cnf:6:1: DATAPROGRAM out of place"},
      {"DATAGROUP\ndgA\nDATAPROGRAM 60000\nSTEP 60000\nddA L\nEND\n",
       "t.cnf:5:1: 'ddA' does not fit: 3600000000 values are declared with it; a configuration holds at "
       "most"},
      {"BUS\nCPU 1CPUB 02\nEND\n", "t.cnf:2:1: 'CPU' is not a slot number; write: <slot> <card> <firmware>"},
      {"BUS\n0 1CPUB 02\nEND\n", "t.cnf:2:1: '0' is not a slot number"},
      {"BUS\n1 1CPUB\nEND\n", "t.cnf:2:3: the card '1CPUB' has no firmware number"},
      {"BUS\n1 1CPUB 02\n1 1MIXA 00\nEND\n",
       "t.cnf:3:1: slot 1 is declared twice; the first stands in line 2 [cnf.declared-twice]"},
      {"BUS\n3 . 00\nEND\n", "t.cnf:2:5: unexpected '00'"},
      {"INPUT\nifA F\nEND\n", "t.cnf:2:1: 'ifA' has no address; write: <name> F <slot>.INPnn [cnf.syntax]"},
      {"INPUT\nifA F 2.OUT01\nEND\n", "t.cnf:2:7: '2.OUT01' is not the address of a digital input"},
      {"OUTPUT\nofA F 2.INP01\nEND\n", "t.cnf:2:7: '2.INP01' is not the address of a digital output"},
      {"OUTPUT\nofA B 2.OUT01\nEND\n",
       "t.cnf:2:5: a digital output is one bit, not 'B'; its type is F [cnf.value]"},
      {"BUS\n1 1CPUB 02\n3 :\nINPUT\nifA F 2.INP01\nifB F 3.INP01\nEND\n",
       "t.cnf:5:7: '2.INP01': BUS has no slot 2"},
      {"BUS\n1 1CPUB 02\n3 :\nINPUT\nifB F 3.INP01\nEND\n",
       "t.cnf:5:7: '3.INP01': slot 3 is empty; use a slot with"},
      {"INTDEVICE\nAx\nEND\n", "t.cnf:2:1: 'Ax' has no device type"},
      {"INTDEVICE\nAx PUPET 4 2.CNT01 5 2.INP08 2.AN01 2.OUT08\nEND\n",
       "t.cnf:2:4: unknown device type 'PUPET'; did you mean 'PUPPET'? [cnf.unknown-name]"},
      {"INTDEVICE\nAx OOPOS9 4\nEND\n",
       "t.cnf:2:4: unknown device type 'OOPOS9'; known types are PUPPET, CAMMING4 [cnf.unknown-name]"},
      {"INTDEVICE\nAx PUPPET 4 2.CNT01 5 2.INP08 2.AN01\nEND\n",
       "t.cnf:2:31: PUPPET 'Ax' has 6 fields after its name and type, found 5; write: <name> PUPPET TCamp "
       "Count IntL"},
      {"INTDEVICE\nAx PUPPET 4 2.CNT01 5 2.INP08 2.AN01 2.OUT08 7\nEND\n",
       "t.cnf:2:46: PUPPET 'Ax' has 6 fields"},
      {"INTDEVICE\nAx PUPPET 0 2.CNT01 5 2.INP08 2.AN01 2.OUT08\nEND\n",
       "t.cnf:2:11: TCamp of PUPPET cannot be '0'; write the sampling time in ms, from 1 to 250 [cnf.value]"},
      {"INTDEVICE\nAx PUPPET 251 2.CNT01 5 2.INP08 2.AN01 2.OUT08\nEND\n", "TCamp of PUPPET cannot be '251'"},
      {"INTDEVICE\nAx PUPPET X 2.CNT01 5 2.INP08 2.AN01 2.OUT08\nEND\n", "TCamp of PUPPET cannot be 'X'"},
      {"INTDEVICE\nAx PUPPET 4 2.CNT01 9 2.INP08 2.AN01 2.OUT08\nEND\n",
       "t.cnf:2:21: IntL of PUPPET cannot be '9'; write an interrupt line from 1 to 8, or X if unused "
       "[cnf.value]"},
      {"INTDEVICE\nAx PUPPET 4 2.INP01 5 2.INP08 2.AN01 2.OUT08\nEND\n",
       "t.cnf:2:13: Count of PUPPET: '2.INP01' is a digital input; write the address of a counter such as "
       "2.CNT01"},
      {"INTDEVICE\nAx PUPPET 4 2.CNT01 5 2.INP08 2.OUT01 2.OUT08\nEND\n",
       "IoutA of PUPPET: '2.OUT01' is a digital output; write the address of an analogue output such as "
       "2.AN01"},
      {"INTDEVICE\nAx PUPPET 4 2.CNT01 5 8 2.AN01 2.OUT08\nEND\n", "IAZero of PUPPET: '8' is no address"},
  };
  for (const Fault& c : cases) {
    const std::string said = faults(c.text);
    EXPECT_NE(said.find(c.said), std::string::npos) << c.text << "said:\n" << said << "wanted:\n" << c.said;
  }
}

TEST(QmoveCnf, ListsAllFaultsOfAFileInOneRunInOrder) {
  const std::string said = faults(
      "GLOBAL\nglA Q\nglB L\nglB L\nBUS\n1 1CPUB 02\nINPUT\nifA F 2.INP01\nINTDEVICE\nAx PUPET 1\nEND\n");
  EXPECT_EQ(said,
            "t.cnf:2:5: unknown type 'Q'; the type is F, B, W, L or S [cnf.unknown-name]\n"
            "t.cnf:4:1: 'glB' is declared twice; the first stands in line 3; choose another name "
            "[cnf.declared-twice]\n"
            "t.cnf:8:7: '2.INP01': BUS has no slot 2; use a slot that BUS gives a card, or add it to BUS "
            "[cnf.value]\n"
            "t.cnf:10:4: unknown device type 'PUPET'; did you mean 'PUPPET'? [cnf.unknown-name]\n");
}

TEST(QmoveCnf, OneFaultIsSaidOnce) {
  const std::string said = faults("GLOBAL\nglA Q\nEND\n");
  EXPECT_EQ(said, "t.cnf:2:5: unknown type 'Q'; the type is F, B, W, L or S [cnf.unknown-name]\n");
  // Entries of a section that is none cannot be judged.
  Problems problems;
  parse_configuration("REGISTERS\nglA Q\nglB 1 2 3\nEND\n", "t.cnf", puppets(), problems);
  EXPECT_EQ(problems.size(), 1U) << text_of(problems);
}

}  // namespace
}  // namespace drycut::devices::qmove
