// controller.plcopen.program: a file, a folder, a list of both.
#include <gmock/gmock.h>

#include <filesystem>

#include "sim/cli/check_command.hpp"
#include "sim/controllers/kinds.hpp"
#include "sim/file.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/loop/scenario/folder.hpp"

namespace drycut::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

struct PlcopenFiles : scenario::ScenarioFolder {
  PlcopenFiles() {
    std::filesystem::create_directories(folder / "lib/below");
    write("main.st", "PROGRAM main VAR x : LREAL; END_VAR x := Two() + Three(); END_PROGRAM");
    write("lib/two.st", "FUNCTION Two : LREAL Two := 2.0; END_FUNCTION");
    write("lib/three.st", "FUNCTION Three : LREAL Three := 3.0; END_FUNCTION");
    write("lib/notes.txt", "no program");
    write("lib/below/more.st", "FUNCTION Two : LREAL Two := 7.0; END_FUNCTION");
  }
  scenario::Scenario with(const std::string& program) {
    return read("scene: {step: 500 us, duration: 1 s}\ncontroller: {plcopen: {program: " + program + "}}\n");
  }
  static std::vector<std::string> files_of(const scenario::Scenario& scenario) {
    std::vector<std::string> names;
    for (const auto& file : scenario.controller->files()) names.push_back(file.text);
    return names;
  }
};

TEST_F(PlcopenFiles, AreAFileAFolderOrAList) {
  EXPECT_THAT(files_of(with("main.st")), ElementsAre("main.st"));
  EXPECT_THAT(files_of(with("lib")), ElementsAre("lib/three.st", "lib/two.st"));
  const auto both = with("[main.st, lib]");
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_THAT(files_of(both), ElementsAre("main.st", "lib/three.st", "lib/two.st"));
  EXPECT_THAT(scenario::expand(both), HasSubstr("program: [main.st, lib]"));
  const auto controller = loop::load_controller(both, problems, nullptr);
  EXPECT_THAT(told(), IsEmpty());
  ASSERT_NE(controller, nullptr);
  controller->run_tasks(0);
  EXPECT_EQ(controller->find("x")->read(), 5.0);
}

// A study reads each file once: whether it is a folder is no other question to the set.
TEST_F(PlcopenFiles, AreReadThroughASetOfFiles) {
  FileSet set;
  const UseFiles use(set);
  const auto controller = loop::load_controller(with("[main.st, lib]"), problems, nullptr);
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_NE(controller, nullptr);
}

TEST_F(PlcopenFiles, ThatAreNotThereAreToldAtTheirNames) {
  std::filesystem::create_directories(folder / "empty");
  with("[main.st, empty]");
  EXPECT_THAT(told(), ElementsAre(HasSubstr("there is no *.st in empty; name a file")));
  problems.clear();
  with("[lib, lib/two.st]");
  EXPECT_THAT(told(), ElementsAre(HasSubstr("lib/two.st is named twice; once is enough")));
  problems.clear();
  loop::load_controller(with("[main.st, lib/twi.st]"), problems, nullptr);
  EXPECT_THAT(told(), ElementsAre(HasSubstr("lib/twi.st")));
}

TEST_F(PlcopenFiles, AreCheckedTogetherOrOneByOne) {
  const auto check = [&](const std::vector<const char*>& names) {
    cli::CheckOptions options;
    for (const auto* const name : names) options.files.push_back(folder / name);
    return cli::check_files(options);
  };
  EXPECT_EQ(check({"lib"}), 0);
  EXPECT_EQ(check({"main.st"}), 2);
  EXPECT_EQ(check({"main.st", "lib"}), 0);
  EXPECT_EQ(check({"lib/two.st", "lib/below/more.st"}), 0);  // each is one
  EXPECT_EQ(check({"main.st", "lib", "lib/below/more.st"}), 2);
}

}  // namespace
}  // namespace drycut::sim
