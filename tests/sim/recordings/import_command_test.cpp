// drycut import, and drycut check of what it wrote.
#include "sim/cli/import_command.hpp"

#include "sim/cli/check_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

using testing::HasSubstr;

struct ImportCommand : CommandTest {
  TestFolder folder;
};

TEST_F(ImportCommand, ShowsTheGuessAndWritesItOnlyWhenAsked) {
  const auto file = folder.file("x.csv", "Time [ms];Torque (N m)\n0,5;1,5\n1,5;2,5\n2,5;2\n7,5;2\n");
  EXPECT_EQ(captured([&] { return import_file({file, {}}); }), 0);
  EXPECT_THAT(out, HasSubstr("file: x.csv"));
  EXPECT_THAT(err, HasSubstr("x.csv:5: samples are missing"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1);
  std::filesystem::create_directory(folder / "sub");
  const auto yaml = folder / "sub" / "x.yaml";
  EXPECT_EQ(captured([&] { return import_file({file, yaml}); }), 0);
  EXPECT_THAT(out, HasSubstr("file: \"../x.csv\""));
  EXPECT_EQ(captured([&] { return check_files({.files = {yaml}}); }), 0) << err;
  EXPECT_THAT(out, HasSubstr("warning "));
  EXPECT_THAT(out, HasSubstr("x.csv:5: samples are missing"));
  EXPECT_EQ(captured([&] { return check_files({.files = {yaml}, .strict = true}); }), 1);
}

TEST_F(ImportCommand, LeavesAFileThatWasCorrected) {
  const auto file = folder.file("x.csv", "Time [ms];Torque (N m)\n0,5;1,5\n1,5;2,5\n");
  const auto yaml = folder / "x.yaml";
  EXPECT_EQ(captured([&] { return import_file({file, yaml}); }), 0) << err;
  EXPECT_EQ(captured([&] { return import_file({file, yaml}); }), 0) << "the same bytes";
  const auto corrected = content(yaml) + "  knife.motor.torque: {column: 2, unit: N m, sign: -1}\n";
  folder.file("x.yaml", corrected);
  EXPECT_EQ(captured([&] { return import_file({file, yaml}); }), 2);
  EXPECT_THAT(err, HasSubstr("[file.not-ours]"));
  EXPECT_THAT(err, HasSubstr("--force"));
  EXPECT_EQ(content(yaml), corrected);
  EXPECT_EQ(captured([&] { return import_file({file, yaml, true}); }), 0);
  EXPECT_NE(content(yaml), corrected);
}

TEST_F(ImportCommand, WritesNothingWhereTheDataAreRefused) {
  const auto yaml = folder / "x.yaml";
  const auto text = folder.file("text.csv", "Time [ms];Torque [N m]\n0;1\n1;2\n2;NaN\n3;abc\n");
  EXPECT_EQ(captured([&] { return import_file({text, yaml}); }), 2);
  EXPECT_THAT(err, HasSubstr("text.csv:5:3: 'abc' is not a number"));
  EXPECT_THAT(err, HasSubstr("1 sample without a number")) << "a text is told as one, and not counted again";
  EXPECT_FALSE(std::filesystem::exists(yaml));
  const auto back = folder.file("back.csv", "Time [ms];Torque [N m]\n0;1\n1;2\n0.5;3\n");
  EXPECT_EQ(captured([&] { return import_file({back, yaml}); }), 2);
  EXPECT_FALSE(std::filesystem::exists(yaml));
}

TEST_F(ImportCommand, RefusesWhatItCannotReadAndWhatIsNotItsOwn) {
  const auto file = folder.file("x.csv", "t,v\n0,0,1,5\n0,1,1,6\n");
  EXPECT_EQ(captured([&] { return import_file({file, {}}); }), 2);
  EXPECT_THAT(err, HasSubstr("x.csv:2:1: a comma stands both between cells and in numbers"));
  EXPECT_EQ(captured([&] { return import_file({folder / "y.csv", {}}); }), 2);
  EXPECT_THAT(err, HasSubstr("[file.missing]"));
  const auto good = folder.file("good.csv", "t,v\n0,1\n1,2\n");
  const auto mine = folder.file("mine.yaml", "# my own\n");
  EXPECT_EQ(captured([&] { return import_file({good, mine}); }), 2);
  EXPECT_EQ(content(mine), "# my own\n");
  EXPECT_EQ(captured([&] { return import_file({good, good}); }), 2);
}

}  // namespace
}  // namespace drycut::sim::cli
