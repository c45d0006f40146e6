// Mutated programs never crash: they compile, or give problems with places inside the text.
#include <algorithm>
#include <iterator>
#include <random>
#include <sstream>

#include "st_bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

const char* const seed_text =
    R"(TYPE State : (Idle, Run := 3); P : STRUCT u : INT; f : ARRAY [0..2] OF LREAL; END_STRUCT; END_TYPE
VAR_GLOBAL CONSTANT n : INT := 4; END_VAR
FUNCTION F : LREAL VAR_INPUT a : LREAL; b : INT; END_VAR VAR_IN_OUT p : P; END_VAR F := a * b + p.f[1]; END_FUNCTION
FUNCTION_BLOCK B VAR_IN_OUT s : P; END_VAR VAR t : TON; END_VAR t(IN := s.u > 3, PT := T#20ms); s.u := s.u + 1; END_FUNCTION_BLOCK
PROGRAM main
VAR_EXTERNAL Web, Knife : AXIS_REF; END_VAR
VAR s : State; p : ARRAY [1..n] OF P; i : INT; x : LREAL; text : STRING := 'knife.tab'; b : B; pow : MC_Power; cam : MC_CamIn;
  sel : MC_CamTableSelect; ref : MC_CAM_REF := (File := 'a.tab'); go AT %IX0.1 : BOOL; END_VAR
pow(Axis := Knife, Enable := go); sel(Master := Web, Slave := Knife, CamTable := ref);
cam(Master := Web, Slave := Knife, Execute := pow.Status AND NOT go, StartMode := HLI_CI_F_PERIODIC);
CASE s OF Idle: IF go OR_ELSE i = 2 THEN s := Run; END_IF Run: x := F(1.5, i, p[1]); ELSE s := Idle; END_CASE
FOR i := 1 TO n DO b(s := p[i]); p[i].f[i MOD 3] := -x ** 2 + SQRT(ABS(x)) / 3; END_FOR
WHILE i > 0 DO i := i - 1; IF i = 2 THEN EXIT; END_IF END_WHILE
REPEAT i := i + LREAL_TO_INT(x); UNTIL i > 5 OR text = 'b' END_REPEAT
END_PROGRAM
)";

void check(const std::string& text) {
  Problems problems;
  const Program program = compile(text, "f", problems);
  const int lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
  for (const Problem& problem : problems) {
    ASSERT_GE(problem.line, 1) << to_string(problem) << "\n" << text;
    ASSERT_LE(problem.line, lines) << to_string(problem) << "\n" << text;
    ASSERT_GE(problem.column, 1) << to_string(problem) << "\n" << text;
    ASSERT_FALSE(problem.what.empty() || problem.remedy.empty());
  }
  if (!problems.empty()) return;
  MotionKernel kernel;
  kernel.add_axis("Web", AxisParameters{});
  kernel.add_axis("Knife", AxisParameters{});
  Runtime runtime(program, kernel);
  for (int i = 0; i < 3; ++i) runtime.scan(i * 2'000'000);
}

TEST(StFuzz, TheTextItselfIsSound) {
  EXPECT_TRUE(problems_of(seed_text).empty()) << problems_of(seed_text).front();
}

TEST(StFuzz, MutatedBytesAreToldOrRun) {
  std::mt19937 random(1);
  const std::string alphabet = "();:=.,[]'#%<>*/+-&0159aAeEiIxX_ \n\"$@\xC3";
  for (int round = 0; round < 400; ++round) {
    std::string text = seed_text;
    for (int i = 1 + static_cast<int>(random() % 3); i > 0; --i) {
      const std::size_t at = random() % text.size();
      const char c = alphabet[random() % alphabet.size()];
      if (random() % 3 == 0)
        text.erase(at, 1 + random() % 6);
      else if (random() % 2 == 0)
        text[at] = c;
      else
        text.insert(at, 1, c);
    }
    ASSERT_NO_FATAL_FAILURE(check(text));
  }
}

TEST(StFuzz, WordsMovedAboutAreToldOrRun) {
  std::mt19937 random(2);
  std::istringstream stream(seed_text);
  const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  for (int round = 0; round < 400; ++round) {
    std::vector<std::string> mixed = words;
    for (int i = 1 + static_cast<int>(random() % 3); i > 0; --i) {
      const std::size_t a = random() % mixed.size();
      if (random() % 3 == 0)
        mixed.erase(mixed.begin() + static_cast<std::ptrdiff_t>(a));
      else if (random() % 2 == 0)
        std::swap(mixed[a], mixed[random() % mixed.size()]);
      else
        mixed.insert(mixed.begin() + static_cast<std::ptrdiff_t>(a), mixed[random() % mixed.size()]);
    }
    std::string text;
    for (const std::string& word : mixed) text += word + (random() % 8 == 0 ? "\n" : " ");
    ASSERT_NO_FATAL_FAILURE(check(text));
  }
}

TEST(StFuzz, EveryBeginningIsToldOrRun) {
  const std::string text = seed_text;
  for (std::size_t size = 0; size < text.size(); size += 11)
    ASSERT_NO_FATAL_FAILURE(check(text.substr(0, size)));
}

TEST(StFuzz, DeepAndLongTextsAreRefused) {
  const auto repeated = [](const char* part) {
    std::string s;
    for (int i = 0; i < 20000; ++i) s += part;
    return s;
  };
  for (const char* part :
       {"(", "-", "NOT ", "1 + ", "IF TRUE THEN ", "x[", "CASE x OF 1: ", "F(", "x.", "(*"})
    check("PROGRAM p VAR x : INT; END_VAR\nx := " + repeated(part) + "\n" + repeated(part) + "; END_PROGRAM");
  check("PROGRAM p VAR x : " + repeated("ARRAY [0..1] OF ") + "INT; END_VAR END_PROGRAM");
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
