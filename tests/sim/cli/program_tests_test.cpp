// drycut run --coverage and drycut test: files, reports, exit statuses.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/program.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/studies/tune/bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct ProgramTests : CommandTest {
  ProgramTests() {
    fs::create_directory(folder / "a");
    folder.file("axis.cnf", studies::tuning::configuration);
    folder.file("axis.mod", studies::tuning::program);
    folder.file("one.yaml", studies::tuning::scenario);
    folder.file("two.yaml", studies::tuning::scenario);
    folder.file("sign.st",
                "FUNCTION Sign : INT\n"
                "VAR_INPUT x : INT; END_VAR\n"
                "IF x < 0 THEN\n"
                "  Sign := -1;\n"
                "ELSE\n"
                "  Sign := 1;\n"
                "END_IF\n"
                "END_FUNCTION\n");
    folder.file("sign_test.st",
                "FUNCTION_BLOCK TEST_Sign\n"
                "AssertEquals(1, Sign(5), 'above');\n"
                "END_FUNCTION_BLOCK\n");
    folder.file("wrong_test.st",
                "FUNCTION_BLOCK TEST_Zero\n"
                "AssertEquals(0, Sign(0), 'at zero');\n"
                "END_FUNCTION_BLOCK\n");
  }
  int drycut(const std::vector<std::string>& words) {
    return captured([&] { return run_program(words); });
  }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder / name).string(); }

  TestFolder folder;
};

/// Of the lines DA:number,count of a table their counts.
std::vector<int> counts_of(const std::string& lcov) {
  std::vector<int> counts;
  for (auto at = lcov.find("\nDA:"); at != std::string::npos; at = lcov.find("\nDA:", at + 1))
    counts.push_back(std::atoi(lcov.c_str() + lcov.find(',', at) + 1));
  return counts;
}

TEST_F(ProgramTests, CoverageOfARunAddsUpAndIsTheSameAtAnyJobs) {
  EXPECT_EQ(drycut({"run", at("one.yaml"), at("two.yaml"), "--out", at("out"), "--coverage"}), all_passed)
      << err;
  const auto one = content(folder / "out/one/coverage.info");
  EXPECT_THAT(one, AllOf(testing::StartsWith("TN:drycut\nSF:"), HasSubstr("axis.mod\n"), HasSubstr("BRDA:")));
  EXPECT_EQ(one, content(folder / "out/two/coverage.info"));
  const auto all = content(folder / "out/coverage.info");
  auto twice = counts_of(one);
  ASSERT_GT(twice.size(), 10U);
  for (int& count : twice) count *= 2;
  EXPECT_EQ(counts_of(all), twice);
  EXPECT_THAT(out, HasSubstr("coverage: "));
  EXPECT_THAT(content(folder / "out/one/report.html"),
              AllOf(HasSubstr("Coverage of the programs"), HasSubstr("axis.mod")));
  EXPECT_EQ(drycut({"run", at("one.yaml"), at("two.yaml"), "--out", at("b"), "--coverage", "--jobs", "2",
                    "--no-pictures"}),
            all_passed);
  EXPECT_EQ(content(folder / "b/coverage.info"), all);
  // The next one without it leaves none, and its trace is the same.
  const auto trace = content(folder / "out/one/trace.csv");
  EXPECT_EQ(drycut({"run", at("one.yaml"), at("two.yaml"), "--out", at("out")}), all_passed);
  EXPECT_FALSE(fs::exists(folder / "out/coverage.info"));
  EXPECT_FALSE(fs::exists(folder / "out/one/coverage.info"));
  EXPECT_THAT(content(folder / "out/one/report.html"), Not(HasSubstr("Coverage of the programs")));
  EXPECT_EQ(content(folder / "out/one/trace.csv"), trace);
}

TEST_F(ProgramTests, TestsThatPass) {
  EXPECT_EQ(
      drycut({"test", at("sign_test.st"), at("sign.st"), "--junit", at("j.xml"), "--coverage", at("c.info")}),
      all_passed)
      << err;
  EXPECT_THAT(
      out, AllOf(HasSubstr(
               "TEST_Sign (0.0 s)\n1 test, 0 failed\ncoverage: 2 of 3 lines ran (66 %), 1 of 2 branches")));
  EXPECT_EQ(content(folder / "c.info"),
            "TN:drycut\nSF:" + at("sign.st") +
                "\nFN:1,Sign\nFNDA:1,Sign\nFNF:1\nFNH:1\nBRDA:3,0,0,0\nBRDA:3,0,1,1\n"
                "BRF:2\nBRH:1\nDA:3,1\nDA:4,0\nDA:6,1\nLF:3\nLH:2\nend_of_record\n");
  EXPECT_THAT(content(folder / "j.xml"),
              AllOf(HasSubstr("<testsuite name=\"sign_test\" tests=\"1\" failures=\"0\""),
                    HasSubstr("name=\"TEST_Sign\"")));
  // What it wrote it replaces, and nothing else.
  EXPECT_EQ(
      drycut({"test", at("sign_test.st"), at("sign.st"), "--junit", at("j.xml"), "--coverage", at("c.info")}),
      all_passed);
  folder.file("j.xml", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<mine/>\n");
  EXPECT_EQ(drycut({"test", at("sign_test.st"), at("sign.st"), "--junit", at("j.xml")}), bad_input);
  EXPECT_THAT(content(folder / "j.xml"), HasSubstr("<mine/>"));
}

TEST_F(ProgramTests, OneThatFailsIsToldEverywhere) {
  EXPECT_EQ(drycut({"test", folder.path.string(), "--junit", at("j.xml"), "--annotate", "github"}),
            check_failed)
      << err;
  EXPECT_THAT(
      out, AllOf(HasSubstr("ok   TEST_Sign"), HasSubstr("FAIL TEST_Zero"),
                 HasSubstr("wrong_test.st:2: expected 0, was 1: at zero\n"), HasSubstr("2 tests, 1 failed"),
                 HasSubstr("::error file="), HasSubstr("wrong_test.st,line=2")));
  EXPECT_THAT(content(folder / "j.xml"), AllOf(HasSubstr("<failure message=\"expected 0, was 1: at zero\">"),
                                               HasSubstr("wrong_test.st\" line=\"2\"")));
}

TEST_F(ProgramTests, EachHasItsTimeAndOneThatAssertsNothingIsSkipped) {
  folder.file("t_test.st",
              "FUNCTION_BLOCK TEST_Long VAR t : TON; END_VAR\n"
              "t(IN := TRUE, PT := T#500ms);\n"
              "IF t.Q THEN AssertTrue(TRUE); TEST_FINISHED(); END_IF\n"
              "END_FUNCTION_BLOCK\n"
              "FUNCTION_BLOCK TEST_Short AssertTrue(TRUE); END_FUNCTION_BLOCK\n"
              "FUNCTION_BLOCK TEST_Idle VAR n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK\n");
  EXPECT_EQ(drycut({"test", at("t_test.st"), "--junit", at("j.xml"), "--annotate", "github"}), all_passed);
  EXPECT_THAT(out, AllOf(HasSubstr("TEST_Idle (0.0 s, asserts nothing)\n"),
                         HasSubstr("t_test.st,line=6,col=1,title=t_test%3A TEST_Idle::it asserts nothing")));
  EXPECT_THAT(content(folder / "j.xml"),
              AllOf(HasSubstr("tests=\"3\" failures=\"0\" errors=\"0\" time=\"0.500000\" skipped=\"1\""),
                    HasSubstr("name=\"TEST_Long\" time=\"0.500000\""),
                    HasSubstr("name=\"TEST_Short\" time=\"0.000000\""),
                    HasSubstr("line=\"6\">\n      <skipped message=\"it asserts nothing\"/>\n")));
}

TEST_F(ProgramTests, WhatIsNoTestIsBadInput) {
  fs::create_directory(folder / "empty");
  EXPECT_EQ(drycut({"test", at("empty")}), bad_input);
  EXPECT_THAT(err, AllOf(HasSubstr("empty:1:1: this is a folder without .st files, not Structured Text"),
                         Not(HasSubstr("there is no test"))));
  folder.file("f.st", "FUNCTION TEST_f : BOOL AssertTrue(TRUE); END_FUNCTION\n");
  EXPECT_EQ(drycut({"test", at("f.st")}), bad_input);
  EXPECT_THAT(out, HasSubstr("f.st:1:10: FUNCTION TEST_f is no test"));

  EXPECT_EQ(drycut({"test", at("sign.st")}), bad_input);
  EXPECT_THAT(err, HasSubstr("there is no test in it"));
  EXPECT_EQ(drycut({"test", at("axis.mod")}), bad_input);
  EXPECT_THAT(err, HasSubstr("[qcl.no-configuration]"));
  EXPECT_EQ(drycut({"test", at("sign.st"), "--timeout", "0 s"}), bad_input);
  folder.file("p.il", "LD X0\nOUT Y0\nEND\n");
  EXPECT_EQ(drycut({"test", at("p.il")}), bad_input);
  folder.file("b_test.st", "FUNCTION_BLOCK TEST_b AssertEquals(1); END_FUNCTION_BLOCK\n");
  EXPECT_EQ(drycut({"test", at("b_test.st")}), bad_input);
  EXPECT_THAT(err, HasSubstr("b_test.st:1:23: AssertEquals lacks its Actual"));
}

TEST_F(ProgramTests, CheckTellsTheNotesOfABareFile) {
  folder.file("n.st",
              "FUNCTION_BLOCK Late\n"
              "VAR t, since : TIME; n : SINT; END_VAR\n"
              "t := T#1s - since - T#2s;\n"
              "n := INT_TO_SINT(300);\n"
              "END_FUNCTION_BLOCK\n");
  EXPECT_EQ(drycut({"check", at("n.st")}), all_passed) << err;
  EXPECT_THAT(out, AllOf(HasSubstr("n.st:3:"), HasSubstr("[program.dialect]\n"),
                         HasSubstr("n.st:4:6: 300 does not fit in SINT, which makes 44 of it")));
  EXPECT_EQ(drycut({"check", at("n.st"), "--strict"}), check_failed);
  // Files that are no one program have theirs, too.
  folder.file("main1.st", "PROGRAM Main VAR n : SINT; END_VAR n := INT_TO_SINT(400); END_PROGRAM\n");
  folder.file("main2.st", "PROGRAM Main VAR n : SINT; END_VAR n := INT_TO_SINT(500); END_PROGRAM\n");
  EXPECT_EQ(drycut({"check", at("main1.st"), at("main2.st")}), all_passed) << err;
  EXPECT_THAT(out, AllOf(HasSubstr("main1.st:1:41: 400 does not fit"), HasSubstr("main2.st:1:41: 500 does")));
}

TEST_F(ProgramTests, QclWithItsConfiguration) {
  folder.file("t.mod", "END\nSUB TEST_Phase\ngbPhase = 3\n; ASSERT gbPhase EQ 3\nENDSUB\n");
  EXPECT_EQ(drycut({"test", at("t.mod"), at("axis.cnf")}), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("TEST_Phase (0.0 s)\n"));
}

TEST_F(ProgramTests, GenhtmlReadsIt) {
  if (std::system("genhtml --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "genhtml is not installed";
  EXPECT_EQ(drycut({"test", at("sign_test.st"), at("sign.st"), "--coverage", at("c.info")}), all_passed);
  const auto command = "genhtml --quiet --branch-coverage --output-directory " + at("html") + " " +
                       at("c.info") + " > " + at("said") + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << content(folder / "said");
  EXPECT_TRUE(fs::exists(folder / "html/index.html"));
}

}  // namespace
}  // namespace drycut::sim::cli
