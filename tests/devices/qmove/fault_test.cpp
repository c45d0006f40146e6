#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/devices/qmove/support.hpp"

// Every fault that a QCL module can have, by its message and place.
namespace drycut::devices::qmove {
namespace {

using testing::Bench;
using testing::text_of;

struct OnlyFault {
  std::string text;
  std::string said;  ///< of the only problem
};

TEST(QmoveFault, IsNamedAtItsPlace) {
  const std::vector<OnlyFault> cases = {
      // names
      {"slQ2 = 1\nEND\n", "1:1: unknown name 'slQ2'; declare it in test.cnf"},
      {"gfDome = 1\nEND\n", "1:1: unknown name 'gfDome'; did you mean 'gfDone'?"},
      {"slR = gfDome\nEND\n", "1:7: unknown name 'gfDome'; did you mean 'gfDone'?"},
      {"slR = gfDome[3]\nEND\n", "1:7: unknown name 'gfDome'; did you mean 'gfDone'?"},
      {"Axs:posit = 1\nEND\n", "1:1: unknown device 'Axs'; did you mean 'Axis'?"},
      {"slR = Carriage:posit\nEND\n", "1:7: unknown device 'Carriage'; devices are Axis"},
      {"slR = slA:posit\nEND\n", "1:7: 'slA' is a variable, not a device; devices are Axis"},
      {"Axis:posti = 1\nEND\n", "1:6: PUPPET has no parameter or state 'posti'; did you mean 'posit'?"},
      {"WAIT Axis:st_instl\nEND\n",
       "1:11: PUPPET has no parameter or state 'st_instl'; did you mean 'st_init'?"},
      {"WAIT Axis:speed\nEND\n",
       "1:11: PUPPET has no parameter or state 'speed'; see: drycut devices PUPPET"},
      {"slR = Axis:code5\nEND\n", "1:12: PUPPET has no parameter or state 'code5'; did you mean 'code1'?"},
      {"Axis:GO = 1\nEND\n", "1:6: 'GO' is a command of PUPPET, not a parameter; write GO Axis"},
      {"INTI Axis\nEND\n", "1:1: PUPPET has no command 'INTI'; did you mean 'INIT'?"},
      {"STARTCAM Axis\nEND\n", "1:1: PUPPET has no command 'STARTCAM'; see: drycut devices PUPPET"},
      {"INIT Axsi\nEND\n", "1:6: unknown device 'Axsi'; did you mean 'Axis'?"},
      {"INIT slR\nEND\n", "1:6: 'slR' is a variable, not a device"},
      {"slR = Axis\nEND\n", "1:7: 'Axis' is a device, not a value; write Axis:parameter"},
      {"slR = dgCam\nEND\n", "1:7: 'dgCam' is a datagroup, not a value; name one of its variables"},
      // what cannot be assigned
      {"cTen = 1\nEND\n", "1:1: 'cTen' is a constant and cannot be assigned; assign a variable"},
      {"ifStart = 1\nEND\n", "1:1: 'ifStart' is an input and cannot be assigned"},
      {"dgCam = 1\nEND\n", "1:1: 'dgCam' is a datagroup and cannot be assigned; assign one of its variables"},
      {"Axis = 1\nEND\n", "1:1: 'Axis' is a device and cannot be assigned; write Axis:parameter = value"},
      {"Axis:reading = 1\nEND\n",
       "1:6: 'reading' of PUPPET is read-only; assign a parameter that programs may write"},
      {"Axis:st_still = 1\nEND\n",
       "1:6: 'st_still' is a state of PUPPET, only the device changes it; give the command"},
      {"SETOUT slR\nEND\n",
       "1:8: 'slR' is a variable, not an output; name an output that is declared under OUTPUT"},
      {"RESOUT ofLmap\nEND\n", "1:8: unknown name 'ofLmap'; did you mean 'ofLamp'?"},
      {"SETOUT\nEND\n", "1:7: expected a name, found the end of the line; write: SETOUT <output>"},
      // indexes
      {"slR = agTemp\nEND\n", "1:7: 'agTemp' is an array and needs an index; write agTemp[index]"},
      {"agTemp = 1\nEND\n", "1:1: 'agTemp' is an array and needs an index; write agTemp[index]"},
      {"slR = agTemp[1, 2]\nEND\n", "1:13: 'agTemp' takes 1 index, found 2; write agTemp[index]"},
      {"slR = ddbCode[1]\nEND\n", "1:14: 'ddbCode' takes 2 indexes, found 1; write ddbCode[recipe, step]"},
      {"ddbCode[1, 2, 3] = 4\nEND\n", "1:8: 'ddbCode' takes 2 indexes, found 3; write ddbCode[recipe, step]"},
      {"ddlHead[1, 2] = 4\nEND\n", "1:8: 'ddlHead' takes 1 index, found 2; write ddlHead[recipe]"},
      {"slR[1] = 4\nEND\n", "1:4: 'slR' is a variable and takes no index; write: name = value"},
      {"slR = slA[1]\nEND\n", "1:10: unexpected '['; one statement a line"},
      {"slR = agTemp[1\nEND\n", "1:15: expected ']', found the end of the line; close the index"},
      {"slR = agTemp[]\nEND\n", "1:14: missing operand before ']'; write a number"},
      // expressions
      {"slR =\nEND\n", "1:6: missing operand at the end of the line; write a number, a name"},
      {"slR = 1 +\nEND\n", "1:10: missing operand at the end of the line"},
      {"slR = 1 + * 2\nEND\n", "1:11: missing operand before '*'"},
      {"slR = AND 1\nEND\n", "1:7: missing operand before 'AND'"},
      {"slR = (1 + 2\nEND\n", "1:13: expected ')', found the end of the line; close the parenthesis"},
      {"slR = 1 + 2)\nEND\n", "1:12: unexpected ')'; one statement a line, comments after ';'"},
      {"slR = 1 2\nEND\n", "1:9: unexpected '2'; one statement a line"},
      {"IF slR = 1\nENDIF\nEND\n", "1:8: unexpected '='; EQ compares"},
      {"IF slR > 1\nENDIF\nEND\n", "1:8: there is no '>'; GT compares"},
      {"slR = 5 # five\nEND\n", "1:9: unexpected character '#'; a comment begins with ';'"},
      {"slR = 5 \xC3\xA4\nEND\n", "1:9: unexpected character '\\xC3\\xA4'"},
      {"slR = 2147483648\nEND\n",
       "1:7: '2147483648' is out of range; a long goes from -2147483648 to 2147483647"},
      {"slR = 99999999999999999999\nEND\n", "1:7: '99999999999999999999' is out of range"},
      {"slR = 1" + std::string(60, '0') + ".0\nEND\n",
       "1:7: '1000000000000000000000000000000000000000...' is out of range; a single"},
      {"slR = 12ab\nEND\n", "1:7: '12ab' is neither a number nor a name; names begin with a letter"},
      {"slR = ssA % 2\nEND\n",
       "1:11: % works on whole numbers, one side is a single; assign the single to a long"},
      {"slR = 1 ANDB ssA\nEND\n", "1:9: ANDB works on whole numbers, one side is a single"},
      {"slR = NOTB ssA\nEND\n", "1:7: NOTB works on whole numbers, not on a single"},
      {"slR = Axis:\nEND\n",
       "1:12: expected a parameter after Axis:, found the end of the line; write Device:parameter"},
      {"Axis:5 = 3\nEND\n",
       "1:6: expected a parameter after Axis:, found '5'; write Device:parameter = value"},
      {"Axis:posit\nEND\n", "1:11: expected '=', found the end of the line; write: Device:parameter = value"},
      // statements
      {"slR\nEND\n", "1:4: expected '=' after 'slR', found the end of the line; write: name = value"},
      {"slR 5\nEND\n", "1:5: expected '=' after 'slR', found '5'; write: name = value"},
      {"5 = slR\nEND\n", "1:1: '5' does not begin a statement; write a statement, or ';' before a comment"},
      {": END\nEND\n", "1:1: ':' does not begin a statement"},
      {"WIAT 1\nEND\n", "1:1: unknown statement 'WIAT'; did you mean 'WAIT'?"},
      {"EQ 1\nEND\n", "1:1: 'EQ' does not begin a statement; write an assignment, a command"},
      {"Frobnicate(1, 2)\nEND\n", "1:1: unknown statement 'Frobnicate'; write an assignment, a command"},
      {"INIT Axis WAIT 1\nEND\n", "1:11: unexpected 'WAIT'; one statement a line, comments after ';'"},
      {"WAIT\nEND\n", "1:5: missing operand at the end of the line"},
      {"WAIT Axis:st init\nEND\n", "1:11: PUPPET has no parameter or state 'st'; did you mean 'st_init'?"},
      {"JUMP\nEND\n", "1:5: expected a name, found the end of the line; write: JUMP <label>"},
      {"JUMP IF\nEND\n", "1:6: expected a name, found 'IF'; write: JUMP <label>"},
      {"CALL 5\nEND\n", "1:6: expected a name, found '5'; write: CALL <subroutine>"},
      {"Axis posit = 1\nEND\n",
       "1:6: expected '=' after 'Axis', found 'posit'; write Axis:parameter = value"},
      // labels and subroutines
      {"MAIN:\nWAIT 1\nJUMP MIAN\nEND\n", "3:6: unknown label 'MIAN'; did you mean 'MAIN'?"},
      {"JUMP OUT\nEND\n", "1:6: unknown label 'OUT'; write OUT: where it leads"},
      {"MAIN:\nMain:\nEND\n", "2:1: the label 'Main' stands twice; the first is in line 1; rename one"},
      {"Axis:\nEND\n", "1:1: 'Axis' cannot be a label; it is a device; write Axis:parameter"},
      {"IF:\nEND\n", "1:1: 'IF' cannot be a label; it is a word of the language"},
      {"CALL home\nEND\nSUB hom\nENDSUB\n", "1:6: unknown subroutine 'home'; did you mean 'hom'?"},
      {"CALL home\nEND\n", "1:6: unknown subroutine 'home'; write SUB home .. ENDSUB"},
      {"END\nSUB a\nENDSUB\nSUB A\nENDSUB\n", "4:5: the subroutine 'A' stands twice; the first is in line 2"},
      {"END\nSUB\nENDSUB\n", "2:4: expected a name, found the end of the line; write: SUB <name>"},
      {"END\nSUB a\nSUB b\nENDSUB\nENDSUB\n", "3:1: SUB inside a SUB; close the first with ENDSUB"},
      // blocks
      {"slR = 1\n  IF slR\nslA = 1\nEND\n", "2:3: IF without ENDIF; write ENDIF at the end of its block"},
      {"IF slR\nslA = 1\nELSE\nEND\n", "1:1: IF without ENDIF"},
      {"IF slR\nWHILE slA\nENDIF\nEND\n", "2:1: WHILE without ENDWHILE"},
      {"WHILE slR\nEND\n", "1:1: WHILE without ENDWHILE; write ENDWHILE at the end of its block"},
      {"FOR (glI = 1, glI LT 3, 1)\nEND\n", "1:1: FOR without NEXT"},
      {"SUB a\nEND\n", "1:1: SUB without ENDSUB"},
      {"ENDIF\nEND\n", "1:1: ENDIF without IF; no IF is open here; remove it or write the missing IF"},
      {"  ELSE\nEND\n", "1:3: ELSE without IF"},
      {"ENDWHILE\nEND\n", "1:1: ENDWHILE without WHILE"},
      {"NEXT\nEND\n", "1:1: NEXT without FOR"},
      {"ENDSUB\nEND\n", "1:1: ENDSUB without SUB"},
      {"IF 1\nELSE\nELSE\nENDIF\nEND\n",
       "3:1: a second ELSE in one IF; the IF of line 1 has its ELSE in line 2"},
      {"IF\nENDIF\nEND\n", "1:3: missing operand at the end of the line"},
      {"IF 1 THEN\nENDIF\nEND\n", "1:6: QCL has no THEN; an IF ends with its line"},
      {"FOR glI = 1\nNEXT\nEND\n", "1:5: expected '(', found 'glI'; write: FOR (i = 1, i LE 10, 1)"},
      {"FOR (1, 2, 3)\nNEXT\nEND\n", "1:6: FOR begins with an assignment, found '1'; write: FOR (i = 1"},
      {"FOR (glI = 1, glI LT 3)\nNEXT\nEND\n", "1:23: expected ',', found ')'"},
      {"FOR (glI = 1, glI LT 3, 1\nNEXT\nEND\n", "1:26: expected ')', found the end of the line"},
      {"FOR (agTemp[1] = 1, 1, 1)\nNEXT\nEND\n",
       "1:24: a step without assignment needs a plain variable to count"},
      // What other languages write.
      {"slR := 1\nEND\n", "1:5: there is no ':='; '=' assigns"},
      {"slR = \"abc\"\nEND\n", "1:7: QCL has no texts"},
      {"IF slR == 1\nENDIF\nEND\n", "1:8: there is no '=='; EQ compares"},
      {"IF slR != 1\nENDIF\nEND\n", "1:8: there is no '!='; NEQ compares"},
      {"IF slR <> 1\nENDIF\nEND\n", "1:8: there is no '<>'; NEQ compares"},
      {"IF slR <= 1\nENDIF\nEND\n", "1:8: there is no '<='; LE compares"},
      {"IF slR >= 1\nENDIF\nEND\n", "1:8: there is no '>='; GE compares"},
      {"IF slR < 1\nENDIF\nEND\n", "1:8: there is no '<'; LT compares"},
      {"IF slR && 1\nENDIF\nEND\n", "1:8: there is no '&&'; AND combines"},
      {"IF slR || 1\nENDIF\nEND\n", "1:8: there is no '||'; OR combines"},
      {"IF !slR\nENDIF\nEND\n", "1:4: there is no '!'; NOT inverts"},
      // end
      {"WAIT 1\nslR = 1\n", "2:8: the module has no END; write END after its last statement"},
      {"", "1:1: the module has no END"},
  };
  for (const OnlyFault& c : cases) {
    const Bench bench({c.text});
    EXPECT_EQ(bench.problems.size(), 1U) << c.text << text_of(bench.problems);
    EXPECT_NE(text_of(bench.problems).find("task0.mod:" + c.said), std::string::npos)
        << c.text << "said:\n"
        << text_of(bench.problems) << "wanted:\n"
        << c.said;
  }
}

TEST(QmoveFault, AllOfAFileAreListedInOrder) {
  const Bench bench({"slQ = glX + glY2\nIF slR\n  slR = (1\n  INTI Axis\nJUMP away\nWAIT 1\n"});
  std::vector<std::string> places;
  for (const Problem& problem : bench.problems)
    places.push_back(std::to_string(problem.line) + ":" + std::to_string(problem.column));
  EXPECT_EQ(places, (std::vector<std::string>{"1:1", "1:7", "1:13", "2:1", "3:11", "4:3", "5:6", "6:7"}))
      << text_of(bench.problems);
}

TEST(QmoveFault, LeavesNoCode) {
  Problems problems;
  const Configuration configuration =
      parse_configuration(testing::usual_cnf, "c", testing::puppets(), problems);
  const QclProgram program =
      compile_module("slR = 1\nslQ9 = 2\nEND\n", "dir/a.b.mod", configuration, testing::puppets(), problems);
  EXPECT_TRUE(program.code.empty());
  EXPECT_EQ(program.name, "a.b");
}

}  // namespace
}  // namespace drycut::devices::qmove
