// A program of several files: one scope, in any order; places tell the file.
#include <gmock/gmock.h>

#include <algorithm>

#include "devices/plcopen/controller/controller.hpp"
#include "devices/plcopen/st/runtime.hpp"
#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const SourceFile types{"types.st",
                       R"(TYPE Recipe : STRUCT lengths : ARRAY [1..most] OF LREAL; END_STRUCT END_TYPE
TYPE State : (Idle, Run) END_TYPE)"};
const SourceFile globals{"globals.st",
                         "VAR_GLOBAL CONSTANT most : INT := few + 2; END_VAR\n"
                         "VAR_GLOBAL recipe : Recipe; END_VAR"};
const SourceFile numbers{"numbers.st", "VAR_GLOBAL CONSTANT few : INT := 1; END_VAR"};
const SourceFile helper{"helper.st", R"(FUNCTION Double : LREAL
VAR_INPUT x : LREAL; END_VAR
Double := 2.0 * x;
END_FUNCTION)"};
const SourceFile main_file{"main.st", R"(PROGRAM main
VAR state : State; sum : LREAL; i : INT; END_VAR
FOR i := 1 TO most DO recipe.lengths[i] := Double(INT_TO_LREAL(i)); sum := sum + recipe.lengths[i]; END_FOR
state := Run;
END_PROGRAM)"};

std::vector<std::string> told(const std::vector<SourceFile>& files, const CompileOptions& options = {}) {
  Problems problems;
  compile(files, options, problems);
  std::vector<std::string> lines;
  for (const Problem& problem : problems) lines.push_back(to_string(problem));
  return lines;
}

double sum_of(const std::vector<SourceFile>& files) {
  Problems problems;
  MotionKernel kernel;
  Runtime runtime(compile(files, {}, problems), kernel);
  for (const Problem& problem : problems) ADD_FAILURE() << to_string(problem);
  runtime.scan(0);
  for (std::size_t i = 0; i < runtime.symbols().size(); ++i)
    if (runtime.symbols()[i].name == "sum") return runtime.read(i);
  return -1;
}

TEST(StFiles, MeanTheSameInAnyOrder) {
  std::vector<SourceFile> files{globals, helper, main_file, numbers, types};
  do EXPECT_EQ(sum_of(files), 12.0);
  while (std::next_permutation(files.begin(), files.end(),
                               [](const auto& a, const auto& b) { return a.name < b.name; }));
}

TEST(StFiles, TellTheirOwnLines) {
  EXPECT_THAT(told({helper,
                    {"main.st", "PROGRAM main\nVAR x : LREAL; END_VAR\nx := Duoble(1.0);\nEND_PROGRAM\n"},
                    {"more.st", "\nFUNCTION f : INT\nf := TRUE;\nEND_FUNCTION"}}),
              ElementsAre(StartsWith("main.st:3:6: there is no function 'Duoble'; did you mean"),
                          StartsWith("more.st:3:6: a value of type BOOL does not go into INT")));
}

TEST(StFiles, TellOneNameOfTwoAtBoth) {
  const SourceFile again{"again.st",
                         "\nFUNCTION double : INT\nEND_FUNCTION\nVAR_GLOBAL Recipe : INT; END_VAR"};
  EXPECT_THAT(told({globals, again, helper, main_file, numbers, {"more.st", "TYPE Recipe : INT; END_TYPE"}}),
              testing::Contains("helper.st:1:10: 'Double' is declared twice; the first one is in line 2 of "
                                "again.st [st.declared-twice]"));
  EXPECT_THAT(
      told({helper, again, types, globals, numbers}),
      ElementsAre("helper.st:1:10: 'Double' is declared twice; the other one is in line 2 of again.st "
                  "[st.declared-twice]",
                  "again.st:2:10: 'double' is declared twice; the first one is in line 1 of helper.st "
                  "[st.declared-twice]",
                  "again.st:4:12: 'Recipe' is declared twice; the other one is in line 2 of globals.st "
                  "[st.declared-twice]",
                  "globals.st:2:12: 'recipe' is declared twice; the first one is in line 4 of again.st "
                  "[st.declared-twice]"));
}

// What is not closed in one file does not reach into the next.
TEST(StFiles, DoNotRunIntoEachOther) {
  EXPECT_THAT(told({{"a.st", "FUNCTION f : INT\nf := 1;\n(* open"}, {"b.st", "PROGRAM main END_PROGRAM"}}),
              ElementsAre(StartsWith("a.st:1:1: FUNCTION has no END_FUNCTION; write END_FUNCTION before the "
                                     "PROGRAM of line 1 of b.st"),
                          StartsWith("a.st:3:1: '(*' is never closed")));
}

TEST(StFiles, OfALibraryNeedNoProgram) {
  EXPECT_THAT(told({helper}), ElementsAre(StartsWith("helper.st:1:1: the file has no PROGRAM")));
  EXPECT_THAT(told({helper}, {.library = true}), IsEmpty());
}

TEST(StFiles, OfAControllerAreSeenOneByOne) {
  const std::vector<SourceFile> files{helper,
                                      {"main.st",
                                       "PROGRAM main\nVAR a : ARRAY [0..1] OF LREAL; i : INT; END_VAR\n"
                                       "a[0] := Double(a[1]);\ni := i + 1;\na[i] := 1.0;\nEND_PROGRAM"}};
  Problems problems;
  PlcopenController controller(compile(files, {}, problems),
                               std::vector<std::string>{"lib/helper.st", "main.st"}, {});
  ASSERT_THAT(problems, IsEmpty());
  ASSERT_EQ(controller.programs().size(), 2U);
  EXPECT_EQ(controller.programs()[0].file, "lib/helper.st");
  EXPECT_THAT(controller.programs()[1].values[4], ElementsAre("i"));
  controller.watch_programs(true);
  controller.run_tasks(0);
  EXPECT_THAT(controller.positions(0).scanned, ElementsAre("  + ", "  +++ "));
  controller.run_tasks(2'000'000);
  EXPECT_EQ(controller.positions(0).tasks[0].program, 1U);
  EXPECT_EQ(controller.positions(0).tasks[0].line, 5);
  EXPECT_THAT(controller.take_events().back().text, StartsWith("main.st:5:3: the index 2 is out of bounds"));
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
