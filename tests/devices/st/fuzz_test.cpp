// Mutated programs never crash: they compile, or give problems with places inside the text.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

#include "devices/plcopen/tab_file.hpp"
#include "tests/devices/st/bench.hpp"

namespace drycut::devices::plcopen::st {
namespace {

constexpr const char* seed_text =
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

constexpr const char* second_seed =
    R"({define FAST 'yes'} {IF hasvalue(FAST, 'yes') AND NOT defined(SLOW)}
TYPE R : INT (lo..9); S : STRUCT t : TON; c : CTU; w : WORD; END_STRUCT; END_TYPE
VAR_GLOBAL CONSTANT lo : INT := -1; END_VAR {ELSE} nothing {END_IF}
FUNCTION Named : STRING[20] VAR_INPUT n : INT; END_VAR n := n + 1; Named := CONCAT('p ', INT_TO_STRING(n)); END_FUNCTION
PROGRAM a VAR_INPUT n : INT; END_VAR VAR_OUTPUT q : BOOL; END_VAR
VAR s : ARRAY [0..1] OF S; r : R; text : STRING; u : ULINT := 16#FFFF_FFFF_FFFF_FFFF; d : DT := DT#2024-02-29-12:00:00.5;
  t : TOD := TOD#23:59:59; day : DATE; f : REAL; l : LWORD; END_VAR
s[0].t(EN := n > 2, IN := s[1].w.3, PT := T#4ms, Q => s[0].w.%X4, ENO => q); s[1].c(CU := q, R := AND(q, NOT(IN := q)), PV := 3);
text := REPLACE(IN1 := Named(n), IN2 := MID(text, 2, FIND(text, 'p')), L := LEN(text), P := 1); r := LIMIT(lo, n, 9);
u := MAX(u / 3, ADD(EN := q, u, 5, ENO => q)); d := d + T#1d; t := DT_TO_TOD(d) + T#2h; day := DT_TO_DATE(d); f := n * 1.5 + r;
l := SHL(NOT 16#F0, 2) XOR ROR(l, n); text := INSERT(DELETE(text, 1, 1), SEL(q, RIGHT('ab', 1), TO_STRING(f)), MUX(n, 1, 2, 3) MOD 3);
END_PROGRAM
CONFIGURATION c VAR_GLOBAL go : BOOL; out : BOOL; END_VAR RESOURCE cpu ON plc TASK x(INTERVAL := T#4ms, PRIORITY := 2); TASK y(SINGLE := go);
PROGRAM one WITH x : a(n := 5, q => out); PROGRAM two WITH y : a; END_RESOURCE END_CONFIGURATION
)";
constexpr std::array seeds{seed_text, second_seed};

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
  for (const char* seed : seeds) EXPECT_TRUE(problems_of(seed).empty()) << problems_of(seed).front();
}

TEST(StFuzz, MutatedBytesAreToldOrRun) {
  std::mt19937 random(1);
  const std::string alphabet = "();:=.,[]'#%<>*/+-&0159aAeEiIxX_ \n\"$@\xC3";
  for (int round = 0; round < 400; ++round) {
    std::string text = seeds.at(random() % seeds.size());
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
  for (int round = 0; round < 400; ++round) {
    std::istringstream stream(seeds.at(random() % seeds.size()));
    const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
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
  for (const std::string text : seeds)
    for (std::size_t size = 0; size < text.size(); size += 11)
      ASSERT_NO_FATAL_FAILURE(check(text.substr(0, size)));
}

TEST(StFuzz, EveryBeginningOfTheShippedFilesIsToldOrRun) {
  int programs = 0;
  int tables = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes")) {
    const bool program = entry.path().extension() == ".st";
    if (!program && entry.path().extension() != ".tab") continue;
    ++(program ? programs : tables);
    std::ifstream stream(entry.path());
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    for (std::size_t size = 0; size <= text.size(); size += 37) {
      const std::string cut = text.substr(0, size);
      if (program) {
        ASSERT_NO_FATAL_FAILURE(check(cut)) << entry.path();
      } else {
        Problems problems;
        EXPECT_TRUE(parse_tab(cut, "f", problems) || !problems.empty()) << entry.path() << " at " << size;
      }
    }
  }
  EXPECT_GE(programs, 6);
  EXPECT_GE(tables, 1);
}

TEST(StFuzz, DeepAndLongTextsAreRefused) {
  const auto repeated = [](const char* part) {
    std::string s;
    for (int i = 0; i < 20000; ++i) s += part;
    return s;
  };
  for (const char* part : {"(", "-", "NOT ", "1 + ", "IF TRUE THEN ", "x[", "CASE x OF 1: ", "F(", "x.", "(*",
                           "{IF NOT (", "{IF defined(a)} ", "FOR x := 1 TO 2 DO ", "ADD(1, ",
                           "x := ", "1 ** ", "AND(", "TYPE a : STRUCT b : "})
    check("PROGRAM p VAR x : INT; END_VAR\nx := " + repeated(part) + "\n" + repeated(part) + "; END_PROGRAM");
  check("PROGRAM p VAR x : " + repeated("ARRAY [0..1] OF ") + "INT; END_VAR END_PROGRAM");
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
