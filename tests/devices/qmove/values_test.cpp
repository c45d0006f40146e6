#include <gmock/gmock.h>
#include <cmath>
#include <string>
#include <vector>

#include "tests/devices/qmove/support.hpp"

// Values as scenarios find, read and write them.
namespace drycut::devices::qmove {
namespace {

using testing::Bench;
using ::testing::Contains;
using ::testing::Not;

TEST(QmoveValues, AreFoundByNameInAnyCase) {
  Bench bench({"END\n"});
  for (const std::string name :
       {"SLR",           "glI",        "gfdone",       "agtemp[5]",  "asKept [ 3 ]", "ddlHead[2]",
        "ddbcode[2, 3]", "tmWait",     "ifStart",      "ofLamp",     "axis.POSIT",   "Axis:posit",
        "Axis.quota",    "Axis.code4", "Axis.st_init", "2.CNT01",    "2.inp1",       "2.INP08",
        "2.OUT08",       "2.AN01",     "INT5",         "qmos.oserr", "QMOS.osmode"})
    EXPECT_TRUE(bench.controller->find(name)) << name;
  for (const std::string name : {"",
                                 "slX",
                                 "agTemp",
                                 "agTemp[0]",
                                 "agTemp[6]",
                                 "agTemp[1,1]",
                                 "agTemp[",
                                 "agTemp[]",
                                 "agTemp[1",
                                 "agTemp[x]",
                                 "slR[1]",
                                 "ddbCode[1]",
                                 "ddbCode[3,1]",
                                 "ddbCode[1,4]",
                                 "ddlHead[1,1]",
                                 "dgCam",
                                 "cTen",
                                 "Axis",
                                 "Axis.",
                                 ".posit",
                                 "Axis.nope",
                                 "Axis.code5",
                                 "slR.posit",
                                 "QMOS.taskmedtime",
                                 "2.AN02",
                                 "INT4",
                                 "[1]"})
    EXPECT_FALSE(bench.controller->find(name)) << name;
}

TEST(QmoveValues, HaveTheDeclaredNameAndTheUnitOfTheTable) {
  Bench bench({"END\n"});
  EXPECT_EQ(bench.controller->find("AXIS:QUOTA")->name, "Axis.posit");
  EXPECT_EQ(bench.controller->find("axis.code3")->name, "Axis.code3");
  EXPECT_EQ(bench.controller->find("AGTEMP[ 2 ]")->name, "agTemp[2]");
  EXPECT_EQ(bench.controller->find("Axis.posit")->unit, "Um");
  EXPECT_EQ(bench.controller->find("2.AN01")->unit, "V");
  EXPECT_EQ(bench.controller->find("2.CNT01")->unit, "counts");
}

TEST(QmoveValues, AreReadOnlyWhereProgramsOnlyRead) {
  Bench bench({"END\n"});
  for (const std::string name :
       {"ifStart", "ofLamp", "Axis.reading", "Axis.st_still", "2.AN01", "2.CNT01", "2.OUT01", "QMOS.oserr"})
    EXPECT_FALSE(bench.controller->find(name)->write) << name;
}

TEST(QmoveValues, AreWrittenAsProgramsStore) {
  Bench bench({"END\n"});
  bench.set("sbKept", 132);
  EXPECT_EQ(bench["sbKept"], -124);
  bench.set("gfDone", 0.5);
  EXPECT_EQ(bench["gfDone"], 1);
  bench.set("slR", 12.9);
  EXPECT_EQ(bench["slR"], 12);
  bench.set("slR", 16777217);  // a long that no single holds
  EXPECT_EQ(bench["slR"], 16777217);
  bench.set("ssR", 0.25);
  EXPECT_EQ(bench["ssR"], 0.25);
  bench.set("slR", 1e300);
  bench.set("ssR", 1e300);
  EXPECT_TRUE(std::isfinite(bench["ssR"]));
  bench.set("ddbCode[2,3]", 7);
  EXPECT_EQ(bench["ddbCode[2,3]"], 7);
  EXPECT_EQ(bench["ddbCode[2,2]"], 0);
}

TEST(QmoveValues, DeviceWritesGoThroughTheMailbox) {
  Bench bench({"INIT Axis\nEND\n"});
  bench.run(6);  // initialised at 4 ms
  bench.set("Axis.gain", 5);
  EXPECT_EQ(bench["Axis.gain"], 0);
  bench.run(3);  // the sample at 8 ms
  EXPECT_EQ(bench["Axis.gain"], 5);
}

TEST(QmoveValues, AnalogueOutputsReadInVolts) {
  Bench bench({"END\n"});
  bench.controller->cards().analogue_outputs.at({Kind::analogue, 2, 1}).word = -32767;
  EXPECT_EQ(bench["2.AN01"], -10);
}

TEST(QmoveValues, NamesAreThoseThatAreFound) {
  Bench bench({"END\n"});
  const std::vector<std::string> names = bench.controller->names();
  for (const std::string& name : names) EXPECT_TRUE(bench.controller->find(name)) << name;
  for (const std::string name : {"slR", "agTemp[1]", "ddbCode[1,1]", "Axis.posit", "Axis.st_init", "2.AN01",
                                 "INT5", "ifStop", "QMOS.oserr"})
    EXPECT_THAT(names, Contains(name));
  EXPECT_THAT(names, Not(Contains("cTen")));
}

TEST(QmoveCards, HoldEveryTerminalOfTheConfiguration) {
  const Bench bench({"END\n"});
  const Cards& cards = bench.controller->cards();
  EXPECT_TRUE(cards.counters.contains({Kind::counter, 2, 1}));
  EXPECT_TRUE(cards.inputs.contains({Kind::input, 2, 1}));
  EXPECT_TRUE(cards.inputs.contains({Kind::input, 2, 8}));
  EXPECT_TRUE(cards.outputs.contains({Kind::output, 2, 2}));
  EXPECT_TRUE(cards.outputs.contains({Kind::output, 2, 8}));
  EXPECT_TRUE(cards.analogue_outputs.contains({Kind::analogue, 2, 1}));
  EXPECT_TRUE(cards.interrupt_lines.contains(5));
}

// An edge on a line that no device listens to does nothing.
TEST(QmoveCards, AnInterruptLineThatNoDeviceUsesIsNoTerminal) {
  const Bench bench({"END\n"});
  EXPECT_EQ(std::get<Address>(bench.controller->terminal("INT5")), (Address{Kind::interrupt, 0, 5}));
  EXPECT_EQ(std::get<TerminalFault>(bench.controller->terminal("INT2")).what,
            "the configuration uses no INT2");
}

}  // namespace
}  // namespace drycut::devices::qmove
