// Instruction lists as editors export them.
#include "devices/lx3vp/il_lines.hpp"

#include "tests/devices/lx3vp/il_bench.hpp"

namespace drycut::devices::lx3vp::il {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The instructions of a program, with their operands.
std::vector<std::string> instructions(const std::string& text) {
  Problems problems;
  const auto program = compile(text, "p.il", problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  std::vector<std::string> told;
  for (const auto& step : program.steps) {
    told.push_back(step.spelling == nullptr ? "label" : step.spelling->text);
    for (const auto& operand : step.operands) told.back() += " " + to_string(operand);
  }
  return told;
}

const auto same = ElementsAre("LD X0", "DMOV K50000 D2044", "OUT T0 K10", "label P3", "END");

TEST(IlLines, StepNumbersTabsAndBrackets) {
  EXPECT_THAT(instructions("0\tLD\tX000\n1\tDMOV\tK50000\tD2044\n10\tOUT\tT0\tK10\n13\tP3\n14\tEND\n"), same);
  EXPECT_THAT(instructions("000000 LD X0\n000001: [ DMOV K50000 D2044 ]\n10 [OUT T0 K10]\n P3\nEND"), same);
}

// The table of a vendor's editor: titles, a heading, operands in rows of their own, statements and notes
// between.
TEST(IlLines, TheTableOfAnExport) {
  const std::string table =
      "\"MAIN\"\n\"PC Information:\",\"FX\"\n"
      "\"Step No.\",\"Line Statement\",\"Instruction\",\"I/O (Device)\",\"Blank\",\"PI Statement\",\"Note\"\n"
      "\"0\",\"\",\"LD\",\"X000\",\"\",\"\",\"\"\n"
      "\"\",\"say \"\"hello\"\", LD X9\",\"\",\"\",\"\",\"\",\"\"\n"
      "\"1\",\"\",\"DMOV\",\"K50000\",\"\",\"\",\"the note\"\n\"\",\"\",\"\",\"D2044\",\"\",\"\",\"\"\n"
      "\"10\",\"\",\"OUT\",\"T0\",\"\",\"\",\"\"\n\"\",\"\",\"\",\"K10\",\"\",\"\",\"\"\n"
      "\"13\",\"\",\"P3\",\"\",\"\",\"\",\"\"\n\"14\",\"\",\"END\",\"\",\"\",\"\",\"\"\r\n";
  EXPECT_THAT(instructions(table), same);
  EXPECT_TRUE(is_table(table));
  EXPECT_FALSE(is_table("LD X0\nEND"));
  // The same by tabs.
  std::string tabs = table;
  std::replace(tabs.begin(), tabs.end(), ',', '\t');
  EXPECT_THAT(instructions(tabs), same);
}

// Further operands in columns beside the first, with a heading or without one.
TEST(IlLines, OperandsInColumnsOfTheirOwn) {
  const std::string rows = "0,LD,X0\n1,DMOV,K50000,D2044\n10,OUT,T0,K10\n13,P3\n14,END,,\n";
  EXPECT_THAT(instructions("Step,Instruction,I/O device\n" + rows), same);
  EXPECT_THAT(instructions("Step,Instruction,I/O device,\n" + rows), same);
  EXPECT_THAT(instructions("Step,Instruction,Operand 1,Operand 2\n" + rows), same);
  // What has another name is none.
  EXPECT_THAT(instructions("Instruction,Device,Device comment,Note\nLD,X0,the start,D9\nOUT,Y0\nEND"),
              ElementsAre("LD X0", "OUT Y0", "END"));
  EXPECT_THAT(faults("Step,Instruction,I/O device\n0,LD,X0\n1,MOV,K1,D9999\n5,END\n"),
              ElementsAre("3:10: 'D9999' does not exist; there are D0 to D8255 [il.out-of-range]"));
}

TEST(IlLines, FaultsOfATableStandInItsCells) {
  const std::string heading = "Step No.,Instruction,I/O(Device)\n";
  expect_faults({{heading + "0,LD,X0\n1,MOV,K1\n,,D9999\n5,OTU,Y0\n6,END,\n",
                  {"4:3: 'D9999' does not exist; there are D0 to D8255 [il.out-of-range]",
                   "5:3: there is no instruction 'OTU'; did you mean OUT? [il.unknown-instruction]"}},
                 {heading + ",,D5\n0,LD,X0\n1,OUT,Y0\n2,END,\n",
                  {"2:3: an operand stands before the first instruction; name the instruction in its column "
                   "[il.syntax]"}}});
}

TEST(IlLines, BracketsThatDoNotMatch) {
  EXPECT_THAT(
      faults("LD X0\n[MOV K5 D0\nMOV K5 D0]\n[ ]\nMOV [K5 D0\nOUT Y0\nEND"),
      ElementsAre("2:1: '[' is not closed; write [MOV K5 D0] [il.syntax]",
                  "3:1: ']' was not opened; write [MOV K5 D0] [il.syntax]",
                  "4:1: there is nothing between the brackets; write [MOV K5 D0] [il.syntax]",
                  "5:5: '[K5' is no operand; write a device (X0, D100), K10, H1F or E1.5 [il.operand]"));
}

// What follows from a line that was refused is not told too.
TEST(IlLines, OneRefusedLineIsOneMessage) {
  expect_faults({{"LDX X0\nMPS\nAND X1\nOUT Y0\nMPP\nOUT Y1\nLD X2\nOUT Y2\nEND",
                  {"1:1: there is no instruction 'LDX'; did you mean LD? [il.unknown-instruction]"}},
                 {"LD X0\nMOV KX D9999 K5\nEND",
                  {"2:5: 'KX' is no 32-bit number; write K-2147483648 to K2147483647 [il.width]"}},
                 {"FORR K5\nLD X0\nINC D0\nNEXT\nENDE",
                  {"1:1: there is no instruction 'FORR'; did you mean FOR? [il.unknown-instruction]",
                   "5:1: there is no instruction 'ENDE'; did you mean END? [il.unknown-instruction]"}},
                 {"LDX X0\nCJ P5\nEND",
                  {"1:1: there is no instruction 'LDX'; did you mean LD? [il.unknown-instruction]",
                   "2:4: there is no label P5; give it a line of its own [il.jump]"}},
                 {"LD X0\nOUTT Y0\nLD X1\nMPP\nOUT Y1\nLD X2\nMPP\nOUT Y0\nEND",
                  {"2:1: there is no instruction 'OUTT'; did you mean OUT? [il.unknown-instruction]",
                   "7:1: MPP has no branch to take up; keep the result with MPS before [il.rung]"}}});
}

// Whatever is put into it, it neither crashes nor reads beyond its end.
TEST(IlLines, BrokenTextsAreTold) {
  const std::string whole =
      "Step No.\tInstruction\tI/O(Device)\n0\tLD\tX000\n1\tMOV\tK5\n\t\tD0Z0\n6\t[\tD1\n7\tEND\n";
  for (const std::string mark : {"", "\xEF\xBB\xBF"})
    for (std::size_t length = 0; length <= whole.size(); ++length)
      for (const char odd : {'\0', '"', '\xFF', ']', '\t'}) {
        std::string text = mark + whole.substr(0, length);
        if (!text.empty()) text[text.size() / 2] = odd;
        Problems problems;
        compile(text, "p.il", problems);
        for (const auto& problem : problems) ASSERT_FALSE(problem.remedy.empty());
      }
}

}  // namespace
}  // namespace drycut::devices::lx3vp::il
