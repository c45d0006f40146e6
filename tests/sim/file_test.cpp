// Files that are read and written: marks, encodings, links, devices, FIFOs, what is read-only.
#include "sim/file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "sim/cli/cam_command.hpp"
#include "sim/cli/check_command.hpp"
#include "tests/sim/studies/tune/bench.hpp"

namespace drycut::sim {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string mark = "\xEF\xBB\xBF";

struct Files : CommandTest {
  void write(const fs::path& file, const std::string& text) {
    OutputFile written(file);
    written.write(text);
    written.finish();
  }
  std::string trouble(const fs::path& file) {
    try {
      write(file, "x");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  int check(const std::vector<fs::path>& files) {
    return captured([&] { return cli::check_files({files, false, {}}); });
  }
  TestFolder folder;
};

TEST_F(Files, ALinkStaysAndWhatItLeadsToIsWritten) {
  const auto file = folder.file("real.csv", "old");
  fs::create_symlink("real.csv", folder / "link.csv");
  write(folder / "link.csv", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
  EXPECT_EQ(content(file), "new");
  fs::create_symlink("to_come.csv", folder / "dangling.csv");
  write(folder / "dangling.csv", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "dangling.csv"));
  EXPECT_EQ(content(folder / "to_come.csv"), "new");
}

TEST_F(Files, ADeviceIsWrittenIntoAndStays) {
  fs::create_symlink("/dev/null", folder / "null");  // so that a fault hits the link, not the machine
  write(folder / "null", "lost");
  EXPECT_TRUE(fs::is_symlink(folder / "null"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  fs::create_symlink("/dev/full", folder / "full");
  EXPECT_THAT(trouble(folder / "full"), HasSubstr("/full: No space left on device"));
}

TEST_F(Files, AFifoIsWrittenIntoWhereSomebodyReads) {
  const auto fifo = folder / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(trouble(fifo), "cannot write " + fifo.string() + ": nobody reads from this FIFO");
  const int reader = open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  write(fifo, "row\n");
  char text[8] = {};
  EXPECT_EQ(read(reader, text, sizeof text), 4);
  EXPECT_STREQ(text, "row\n");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(fifo));
}

TEST_F(Files, WhatIsReadOnlyStaysForTheAdministratorToo) {
  const auto file = folder.file("kept.csv", "old");
  fs::permissions(file, fs::perms::owner_read);
  EXPECT_EQ(trouble(file), "cannot write " + file.string() + ": it is read-only");
  EXPECT_EQ(content(file), "old");
}

TEST_F(Files, TheNewFileIsAsOpenToOthersAsTheOldOne) {
  const auto file = folder.file("mine.csv", "old");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  write(file, "new");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Files, OptionsThatNameSuchFilesAreRefusedBeforeAnythingRuns) {
  const auto file = folder.file("kept.csv", "old");
  fs::permissions(file, fs::perms::owner_read);
  cli::CamOptions options;
  options.table = std::string(DRYCUT_SOURCE_DIR) + "/scenes/cams/fly_cut.csv";
  options.csv = file;
  EXPECT_EQ(captured([&] { return cli::validate_cam(options); }), cli::bad_input);
  EXPECT_EQ(err, "--csv:1:1: " + file.string() +
                     " cannot be written: it is read-only; name another file [file.not-writable]\n");
}

TEST_F(Files, AByteOrderMarkIsNoMatterInAnyKindOfFile) {
  const fs::path scenes = std::string(DRYCUT_SOURCE_DIR) + "/scenes";
  std::vector<fs::path> files;
  for (const auto* name : {"programs/rotary_knife.cnf", "programs/rotary_knife.mod",
                           "programs/rotary_knife.il", "programs/rotary_knife.st", "cams/rotary_knife.csv",
                           "cams/ecam_s_curve.csv", "cams/mc_stroke_80.csv", "cams/mc_rotary_knife.tab"}) {
    files.push_back(folder.file(fs::path(name).filename().string(), mark + content(scenes / name)));
  }
  folder.file("axis.cnf", mark + studies::tuning::configuration);
  folder.file("axis.mod", mark + studies::tuning::program);
  files.push_back(folder.file("axis.yaml", mark + studies::tuning::scenario));
  files.push_back(folder.file("registers.csv", mark + "D10,5\n"));
  EXPECT_EQ(check(files), cli::all_passed) << err;
}

TEST_F(Files, TextsOfSixteenBitsAreReadInBothOrders) {
  for (const bool low_first : {true, false}) {
    std::string wide = low_first ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : std::string("LD X0\nOUTT Y0\nEND\n"))
      wide += low_first ? std::string{c, '\0'} : std::string{'\0', c};
    EXPECT_EQ(check({folder.file("wide.il", wide)}), cli::bad_input);
    EXPECT_THAT(err, HasSubstr(":2:1: there is no instruction 'OUTT'"));
  }
}

TEST_F(Files, WhatIsNoTextIsRefusedInAnyKindOfFileWithItsPlace) {
  for (const auto* name : {"a.cnf", "a.il", "a.st", "a.csv", "a.tab", "a.yaml"}) {
    const auto file = folder.file(name, "x\n; m\xE8\n");
    EXPECT_EQ(check({file}), cli::bad_input) << name;
    EXPECT_THAT(err, HasSubstr(file.string() + ":2:4: byte 0xe8 is no text; ")) << name;
    folder.file(name, std::string("\xFF\xFEx\0\0\xD8", 6));  // ends in half a character
    EXPECT_EQ(check({file}), cli::bad_input) << name;
    EXPECT_THAT(err,
                HasSubstr(file.string() +
                          ":1:1: this is broken UTF-16; save it as plain text in UTF-8 [file.not-text]\n"));
  }
}

TEST_F(Files, EscapesOfAScenarioCanMakeACharacterButNoControlCharacter) {
  folder.file("axis.cnf", studies::tuning::configuration);
  folder.file("axis.mod", studies::tuning::program);
  const auto file = [&](const std::string& name) {
    return folder.file("axis.yaml", std::string(studies::tuning::scenario) + "checks: [{name: \"" + name +
                                        "\", eventually: axis.position > 1}]\n");
  };
  EXPECT_EQ(check({file("half\\_way")}), cli::all_passed) << err;
  EXPECT_EQ(check({file("half\\Nway")}), cli::bad_input);
  EXPECT_THAT(err,
              HasSubstr("axis.yaml:8:17: an escape makes what is no text: U+0085 is no text; leave it out"));
  EXPECT_EQ(check({file("\\e[31mred")}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("axis.yaml:8:17: an escape makes what is no text: byte 0x1b is no text"));
  EXPECT_EQ(check({file("\\uD800")}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("axis.yaml:8:"));
}

TEST_F(Files, ASetReadsEachOnceAndIsAllThatASealedOneHas) {
  const TestFolder folder;
  const auto there = folder / "there.txt";
  folder.file("there.txt", "first");
  fs::create_directory(folder / "sub");
  folder.file("sub/b.yaml", "");
  folder.file("sub/a.yaml", "");
  folder.file("sub/c.txt", "");
  const std::vector<fs::path> names = {there, folder / "missing.txt", folder / "sub"};
  Problems at_first;
  Problems later;
  FileSet seen;
  {
    const UseFiles use(seen);
    EXPECT_EQ(read_file(there, at_first), "first");
    for (const auto& name : names) read_file(name, at_first);
    EXPECT_THAT(files_in(folder / "sub", ".yaml"),
                testing::ElementsAre(folder / "sub/a.yaml", folder / "sub/b.yaml"));
    EXPECT_TRUE(folder_exists(there.parent_path())) << "known of a file that is missing";
  }
  folder.file("there.txt", "second");
  EXPECT_EQ(read_file(there, later), "second");
  FileSet elsewhere;
  elsewhere.files = seen.files;
  elsewhere.folders = seen.folders;
  elsewhere.seal();
  fs::remove_all(folder / "sub");
  const UseFiles use(elsewhere);
  EXPECT_EQ(read_file(there, later), "first");
  for (const auto& name : names) read_file(name, later);
  ASSERT_EQ(at_first.size(), 2U);
  ASSERT_EQ(later.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(to_string(at_first[i]), to_string(later[i]));
  EXPECT_EQ(files_in(folder / "sub", ".yaml").size(), 2U);
  EXPECT_TRUE(file_exists(there));
  EXPECT_FALSE(file_exists(folder / "missing.txt"));
  EXPECT_TRUE(folder_exists(there.parent_path()));
  EXPECT_THROW(read_file(folder / "unknown.txt", later), std::logic_error);
  EXPECT_THROW(files_in(folder / "unknown", ".yaml"), std::logic_error);
}

}  // namespace
}  // namespace drycut::sim
