// A file of the wrong kind is told what it is, and who takes it.
#include "sim/cli/file_kinds.hpp"

#include <CLI/CLI.hpp>

#include "base/text.hpp"
#include "sim/cli/commands.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct FileKinds : CommandTest {
  FileKinds() {
    for (const auto& [name, text] : std::vector<std::pair<const char*, const char*>>{
             {"line.yaml", "scene: {title: A}\n"},
             {"LINE.YML", "scene: {title: A}\n"},
             {"two.yaml", "scene: {title: A}\ncompare: {scenarios: []}\n"},
             {"scope.yaml", "file: scope.csv\n"},
             {"session.yaml", "- {scenario: line.yaml}\n"},
             {"x.cnf", "CONST\n"},
             {"x.mod", "END\n"},
             {"x.qcl", "END\n"},
             {"x.il", "LD M0\n"},
             {"x.st", "PROGRAM x\n"},
             {"x.tab", "Begintable\n"},
             {"cam.csv", "# measure: 100\nsector,codeG\n"},
             {"registers.csv", "register,value\nD100,5\n"},
             {"trace.csv", "time [s],web.speed [m/min]\n0,1\n"},
             {"events.csv", "time [s],source,event,values\n"},
             {"checks.json", "{}"},
             {"trace.h5", "\x89HDF"},
             {"x.mcap", "\x89MCAP"},
             {"report.html", "<!DOCTYPE html>"},
             {"junit.xml", "<testsuites/>"},
             {"x.glb", "glTF"},
             {"x.stl", "solid x"},
             {"x.png", "\x89PNG"},
             {"film.mp4", "ftyp"},
             {"notes.txt", "notes"},
             {"none", "no ending"}})
      folder.file(name, text);
    fs::create_directories(folder / "a_run");
    folder.file("a_run/checks.json", "{}");
    fs::create_directories(folder / "a_live");
    folder.file("a_live/session.yaml", "- {scenario: line.yaml}\n");
    fs::create_directories(folder / "empty");
  }
  int parse(const std::string& line) {
    CLI::App app{"drycut"};
    int status = all_passed;
    add_commands(app, status);
    return captured([&] {
      try {
        std::vector<std::string> words;
        for (const auto& word : split_words(line, {}, " ")) {
          const bool file = fs::exists(folder / std::string(word.text));
          words.insert(words.begin(),
                       file ? (folder / std::string(word.text)).string() : std::string(word.text));
        }
        app.parse(words);
      } catch (const CLI::RuntimeError& refused) {
        return refused.get_exit_code();
      }
      return status;
    });
  }
  TestFolder folder;
};

TEST_F(FileKinds, GoByEndingAndContent) {
  const std::vector<std::pair<std::string, FileKind>> all = {
      {"line.yaml", FileKind::scenario},
      {"LINE.YML", FileKind::scenario},
      {"two.yaml", FileKind::comparison},
      {"session.yaml", FileKind::session},
      {"x.cnf", FileKind::configuration},
      {"x.mod", FileKind::module},
      {"x.qcl", FileKind::module},
      {"x.il", FileKind::instruction_list},
      {"x.st", FileKind::structured_text},
      {"x.tab", FileKind::cam_table},
      {"cam.csv", FileKind::cam_table},
      {"registers.csv", FileKind::registers},
      {"trace.csv", FileKind::trace},
      {"events.csv", FileKind::events},
      {"checks.json", FileKind::checks},
      {"trace.h5", FileKind::hdf5},
      {"x.mcap", FileKind::mcap},
      {"report.html", FileKind::report},
      {"junit.xml", FileKind::junit},
      {"x.glb", FileKind::model},
      {"x.stl", FileKind::model},
      {"x.png", FileKind::picture},
      {"film.mp4", FileKind::film},
      {"notes.txt", FileKind::unknown},
      {"none", FileKind::unknown},
      {"a_run", FileKind::run_folder},
      {"a_live", FileKind::session_folder},
      {"empty", FileKind::folder},
      {"not_there.yaml", FileKind::scenario},
      {"not_there", FileKind::unknown},
  };
  for (const auto& [name, kind] : all) EXPECT_EQ(kind_of(folder / name), kind) << name;
}

TEST_F(FileKinds, CommandsSayWhatTheyWereGiven) {
  const std::vector<std::pair<std::string, std::string>> all = {
      {"run x.qcl",
       "x.qcl:1:1: this is a QCL module, not a scenario; drycut check takes it behind its .cnf; a "
       "scenario names it in controller.qmove.tasks [file.other-kind]\n"},
      {"run x.cnf",
       "x.cnf:1:1: this is a QMOVE configuration, not a scenario; drycut check takes it; a scenario "
       "names it as controller.qmove.configuration [file.other-kind]\n"},
      {"run report.html",
       "report.html:1:1: this is a report, not a scenario; a browser shows it [file.other-kind]\n"},
      {"run trace.csv",
       "trace.csv:1:1: this is the trace of a run, not a scenario; drycut convert takes it, drycut "
       "compare its folder [file.other-kind]\n"},
      {"run a_run",
       "a_run:1:1: this is the folder of a run, not a scenario; drycut compare and drycut convert take it "
       "[file.other-kind]\n"},
      {"run empty", "empty:1:1: this is a folder, not a scenario; name a file [file.other-kind]\n"},
      {"cam line.yaml",
       "line.yaml:1:1: this is a scenario, not a cam table; drycut run takes it [file.other-kind]\n"},
      {"cam registers.csv", "registers.csv:1:1: this is a file of registers, not a cam table; "},
      {"replay line.yaml",
       "line.yaml:1:1: this is a scenario, not a recorded session; drycut run takes it [file.other-kind]\n"},
      {"live session.yaml",
       "session.yaml:1:1: this is a recorded session, not a scenario; drycut replay runs it"},
      {"check report.html", "report.html:1:1: this is a report, not a scenario; "},
      {"check session.yaml", "session.yaml:1:1: this is a recorded session, not a scenario; "},
      {"bode two.yaml",
       "two.yaml:1:1: this is a scene that compares runs, not a scenario; drycut run takes it "
       "[file.other-kind]\n"},
      {"size x.st", "x.st:1:1: this is Structured Text, not a scenario; "},
      {"tune x.il --vary a=1..2 --minimise b", "x.il:1:1: this is an instruction list, not a scenario; "},
      {"sweep x.png --over a=1..2:2",
       "x.png:1:1: this is a picture, not a scenario; any viewer shows it [file.other-kind]\n"},
      {"envelope x.tab --over a=1..2:2 --find-max b=1..2",
       "x.tab:1:1: this is a cam table, not a scenario; "},
      {"compare line.yaml a_run",
       "line.yaml:1:1: this is a scenario, not the folder of a run; drycut run takes it [file.other-kind]\n"},
      {"convert x.mcap --to csv", "x.mcap:1:1: this is a record in MCAP, not the folder of a run; "},
  };
  for (const auto& [line, told] : all) {
    EXPECT_EQ(parse(line), bad_input) << line;
    EXPECT_THAT(err, testing::StartsWith((folder.path / "").string() + told)) << line;
    EXPECT_EQ(out, "") << line;
  }
}

TEST_F(FileKinds, AllOfThemAreTold) {
  EXPECT_EQ(parse("run line.yaml x.st a_run/checks.json x.glb"), bad_input);
  EXPECT_EQ(split_lines(err).size(), 3U) << err;
  EXPECT_FALSE(fs::exists("out"));
}

TEST_F(FileKinds, AFolderWithScenariosNamesThem) {
  fs::create_directories(folder / "scenes");
  folder.file("scenes/b.yaml", "");
  folder.file("scenes/a.yaml", "");
  EXPECT_EQ(parse("run scenes"), bad_input);
  EXPECT_THAT(
      err, HasSubstr(fmt::format("name a file in it: {}, {} [file.other-kind]\n",
                                 (folder / "scenes/a.yaml").string(), (folder / "scenes/b.yaml").string())));
}

TEST_F(FileKinds, WhatCannotBeReadIsToldByTheReader) {
  EXPECT_EQ(parse("run not_there.yaml"), bad_input);
  EXPECT_THAT(err, HasSubstr("not_there.yaml:1:1: there is no file not_there.yaml; check the path"));
  EXPECT_EQ(parse("check notes.txt"), bad_input);
  EXPECT_THAT(err, HasSubstr("'.txt' is not a kind of file that is known"));
}

}  // namespace
}  // namespace drycut::sim::cli
