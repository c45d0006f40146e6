// What others make of the files: h5py and pandas, Octave, the reader of MCAP's own authors. Each is skipped
// where it is not installed.
#include "renders/process.hpp"
#include "sim/cli/convert_command.hpp"
#include "sim/cli/run_command.hpp"
#include "sim/record/hdf5_file.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::record {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The knife, recorded in both formats.
struct RecordsWitness : CommandTest {
  void record() {
    for (const auto* format : {"csv", "hdf5"}) {
      cli::RunOptions options;
      options.scenarios = {source_root / "scenes/rotary_knife.yaml"};
      options.out = folder / format;
      options.set = {std::string("record.format=") + format, "scene.seed=3", "pictures={}"};
      options.pictures = false;
      ASSERT_EQ(captured([&] { return cli::run_scenarios(options); }), cli::all_passed) << err;
    }
  }
  /// Runs a program over the recorded files; what it finds wrong it says, and ends with another status than
  /// 0.
  void expect_good(const std::string& program, std::vector<std::string> arguments,
                   const fs::path& directory = {}) {
    for (const auto* file : {"csv/rotary_knife/trace.csv", "csv/rotary_knife/events.csv"})
      arguments.push_back((folder / file).string());
    const auto said = renders::run_process({program, program, arguments, directory});
    EXPECT_TRUE(said.good) << said.output << said.words;
    EXPECT_THAT(said.output, HasSubstr("equal"));
  }
  static bool works(const std::string& program, const std::vector<std::string>& arguments) {
    try {
      return renders::run_process({program, program, arguments}).good;
    } catch (const renders::HelperFailed&) {
      return false;
    }
  }
  static std::string script(const std::string& name) {
    return (source_root / "tests/sim/record" / name).string();
  }

  TestFolder folder;
};

TEST_F(RecordsWitness, H5pyAndPandas) {
  if (!works("/usr/bin/python3", {"-c", "import h5py, pandas"}))
    GTEST_SKIP() << "needs python3-h5py, python3-pandas";
  record();
  expect_good("/usr/bin/python3", {script("read_hdf5.py"), (folder / "hdf5/rotary_knife/trace.h5").string()});
}

TEST_F(RecordsWitness, H5pyWhileItIsWritten) {
  if (!works("/usr/bin/python3", {"-c", "import h5py"})) GTEST_SKIP() << "needs python3-h5py";
  double speed = 0;
  Recording recording;
  recording.add("web.speed", "m/min").slot = &speed;
  const auto writer = hdf5_writer(recording, folder / "trace.h5", {{"drycut", "0"}});
  auto& file = *writer;
  for (int row = 0; row < 10'000; ++row) {
    speed = row;
    file.sample(Time{row} * millisecond);
  }
  // What kill -9 leaves is what lies there now.
  fs::copy_file(folder / "trace.h5", folder / "killed.h5");
  for (const auto* name : {"trace.h5", "killed.h5"}) {
    const auto said = renders::run_process(
        {"/usr/bin/python3",
         "python3",
         {"-c",
          "import sys, h5py, numpy\n"
          "file = h5py.File(sys.argv[1], 'r', swmr=True)\n"
          "time, speed = file['time'][:], file['channels/web.speed'][:]\n"
          "assert len(time) == 8192 == len(speed), len(time)\n"
          "assert (speed == numpy.arange(8192)).all() and (time == speed / 1000).all()\n",
          (folder / name).string()}});
    EXPECT_TRUE(said.good) << name << ": " << said.output << said.words;
  }
}

TEST_F(RecordsWitness, Octave) {
  if (!works("octave-cli", {"--version"})) GTEST_SKIP() << "needs octave";
  record();
  expect_good("octave-cli", {"-q", script("read_hdf5.m"), (folder / "hdf5/rotary_knife/trace.h5").string()});
}

TEST_F(RecordsWitness, McapCore) {
  const auto modules = fs::path(DRYCUT_PROGRAM).parent_path() / "npm";
  if (!fs::exists(modules / "node_modules/@mcap/core") &&
      !works("npm", {"install", "--no-audit", "--no-fund", "--fetch-retries=0", "--prefix", modules.string(),
                     "@mcap/core@2.2.2", "fzstd@0.1.1"}))
    GTEST_SKIP() << "needs npm and its registry";
  fs::copy_file(script("read_mcap.mjs"), modules / "read_mcap.mjs", fs::copy_options::overwrite_existing);
  record();
  ASSERT_EQ(captured([&] {
              return cli::convert_run({folder / "hdf5/rotary_knife", "mcap", folder / "knife.mcap"});
            }),
            cli::all_passed)
      << err;
  expect_good("node", {(modules / "read_mcap.mjs").string(), (folder / "knife.mcap").string()});
}

}  // namespace
}  // namespace drycut::sim::record
