#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/devices/qmove/support.hpp"

// Damaged texts: whatever a file holds, it is read without a crash, and what compiles also runs.
namespace drycut::devices::qmove {
namespace {

using testing::puppets;
using testing::usual_cnf;

const std::string sample_module =
    "; all of the language\n"
    "INIT Axis\nWAIT Axis:st_init\nAxis:posit = - 100 + cTen * (slA % 3)\n"
    "MAIN:\nIF (ddbCode [2 , 1] EQ 0) AND NOT ifStart\n  ddbCode[2, slB + 1] = 132\nELSE\n  ddlHead[1] = "
    "agTemp[5]\nENDIF\n"
    "FOR (glI = 1, glI LE 3, 1)\n  asReal[2] = ssA / 2.5 + cHalf\n  CALL twice\nNEXT\n"
    "WHILE glJ LT 4\n  glJ = glJ + 1\nENDWHILE\n"
    "SETOUT ofLamp\nofHorn = Axis:st_still\ntmWait = 20\nRESOUT ofLamp\n"
    "slR = 12 ANDB 10 ORB 3 XORB NOTB slR\nWAIT tmWait OR 1\nJUMP MAIN\nEND\n"
    "SUB twice\n  slA = slA * 2\nENDSUB\n";

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}
  std::string operator()(std::string text) {
    for (std::size_t n = 1 + below(3); n > 0 && !text.empty(); --n) once(text);
    return text;
  }

 private:
  // The distributions of the library differ between libraries; this does not.
  std::size_t below(std::size_t limit) { return random_() % limit; }

  void once(std::string& text) {
    static const std::string odd = "()[],:.=+-*/%;\n\t 09azAZ_#<>\"\x80\xff";
    const std::size_t at = below(text.size());
    switch (below(7)) {
      case 0:
        text.erase(at, 1);
        break;
      case 1:
        text.erase(at, below(40));
        break;
      case 2:
        std::swap(text[at], text[below(text.size())]);
        break;
      case 3:
        text.resize(at);
        break;
      case 4:
        text.insert(at, 1, odd[below(odd.size())]);
        break;
      case 5:
        text.insert(at, text.substr(below(text.size()), below(60)));
        break;
      default:
        text[at] = static_cast<char>(below(256));
        break;
    }
  }

  std::mt19937 random_;
};

void expect_places(const Problems& problems, const std::string& text) {
  const auto lines = static_cast<int>(split_lines(text).size());
  for (const Problem& problem : problems) {
    EXPECT_GE(problem.line, 1) << to_string(problem);
    EXPECT_LE(problem.line, std::max(lines, 1)) << to_string(problem);
    EXPECT_GE(problem.column, 1) << to_string(problem);
    EXPECT_FALSE(problem.what.empty());
    EXPECT_FALSE(problem.remedy.empty()) << to_string(problem);
  }
}

TEST(QmoveFuzz, SampleModuleIsSound) {
  testing::Bench bench({sample_module});
  ASSERT_TRUE(bench.controller) << testing::text_of(bench.problems);
  bench.run(50);
  EXPECT_EQ(bench["QMOS.oserr"], 0);
}

TEST(QmoveFuzz, DamagedModulesGiveProblemsOrAProgramThatRuns) {
  Problems none;
  const Configuration configuration = parse_configuration(usual_cnf, "c.cnf", puppets(), none);
  int compiled = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    const std::string text = Mutator(seed)(sample_module);
    Problems problems;
    const QclProgram program = compile_module(text, "m.mod", configuration, puppets(), problems);
    expect_places(problems, text);
    EXPECT_EQ(program.code.empty(), !problems.empty()) << text;
    if (!problems.empty()) continue;
    ++compiled;
    QmoveController controller(configuration, {program}, puppets(), 1'000'000);
    for (std::int64_t time = 0; time < 20'000'000; time += 1'000'000) {
      controller.run_devices(time);
      controller.run_tasks(time);
    }
  }
  EXPECT_GT(compiled, 100);  // else the mutations are too wild to test the machine
  EXPECT_LT(compiled, 3900);
}

TEST(QmoveFuzz, DamagedConfigurationsGiveProblemsOrAController) {
  int sound = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    const std::string text = Mutator(seed)(std::string(usual_cnf));
    Problems problems;
    const Configuration configuration = parse_configuration(text, "c.cnf", puppets(), problems);
    expect_places(problems, text);
    // Modules can be checked against a configuration with faults.
    Problems module_problems;
    const QclProgram program =
        compile_module(sample_module, "m.mod", configuration, puppets(), module_problems);
    expect_places(module_problems, sample_module);
    if (!problems.empty()) continue;
    ++sound;
    QmoveController controller(configuration, {program}, puppets(), 1'000'000);
    controller.run_devices(0);
    controller.run_tasks(0);
  }
  EXPECT_GT(sound, 100);
  EXPECT_LT(sound, 3900);
}

}  // namespace
}  // namespace drycut::devices::qmove
