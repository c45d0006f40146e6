// Folders that can only be read, and disks that are full: what the exit status and the messages say, and what
// is still there afterwards.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/sim/command_bench.hpp"
#include "tests/sim/mounts.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr auto* scenario = R"(scene: {step: 1 ms, duration: 0.2 s}
plants: {web: {type: web, speed: 60 m/min}}
record: {every: 1 ms, channels: [web.speed, web.position]}
checks:
  - {name: slow enough, always: "web.speed <= 100"}
)";

struct Disks : testing::Test {
  Disks() {
    folder.file("web.yaml", scenario);
    fs::create_directories(disk);
  }
  void SetUp() override {
    if (!fs::exists(DRYCUT_PROGRAM)) GTEST_SKIP() << "needs the program, which is not built here";
  }
  /// The status of the program, called in `folder`; what it prints goes to NAME.out and NAME.err there.
  int drycut(const std::string& words, const std::string& name = "told") const {
    const auto line = "cd '" + folder.path.string() + "' && '" DRYCUT_PROGRAM "' " + words + " >" + name +
                      ".out 2>" + name + ".err </dev/null";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 99;
  }
  std::string told(const std::string& name) const { return content(folder / name); }

  TestFolder folder;
  fs::path disk = folder / "disk";
};

TEST_F(Disks, AFolderThatCanOnlyBeReadIsWrongInputForEveryCommand) {
  ASSERT_EQ(drycut("run web.yaml --no-pictures --out disk/run"), 0) << told("told.err");
  ASSERT_EQ(drycut("run web.yaml --no-pictures --out other"), 0) << told("told.err");
  folder.file("session.yaml", "- {scenario: web.yaml, set: [], fingerprint: 0}\n- {reached: 0.1 s}\n");
  const auto cams = shipped_cams.string();
  const auto knife = "'" DRYCUT_SOURCE_DIR "/scenes/rotary_knife.yaml'";
  const std::string job =
      "design rotary_knife --length '800 mm' --circumference '600 mm' --sync '120 mm' --device camming4 ";
  const std::string commands[] = {
      "run web.yaml --no-pictures --out disk",
      "run web.yaml --no-pictures --out disk/new",
      "run web.yaml --no-pictures --out disk/run",
      "run web.yaml --no-pictures --out x --cache disk/cache",
      "run web.yaml --no-pictures --out x --summary disk/s.md",
      "sweep web.yaml --over 'plants.web.speed=10,20 m/min' --out disk",
      "envelope web.yaml --find-max 'plants.web.speed=10..20 m/min' --out disk",
      std::string("size ") + knife + " --motors HG-SR202 --out disk",
      std::string("bode ") + knife + " --out disk",
      std::string("bode ") + knife + " --csv disk/x.csv",
      std::string("bode ") + knife + " --png disk/x.png",
      std::string("tune ") + knife +
          " --vary controller.qmove.set.AxisX.pgain=1..40 --minimise 'rms(AxisX.follerr)' --out disk",
      "cam '" + cams + "/rotary_knife.csv' --csv disk/x.csv",
      "cam '" + cams + "/rotary_knife.csv' --png disk/x.png",
      "cam '" + cams + "/ecam_s_curve.csv' --table disk/x.csv",
      job + "--table disk/x.csv",
      job + "--out disk",
      "convert other/web --to csv --out disk/x.csv",
      "convert other/web --to hdf5 --out disk/x.h5",
      "convert other/web --to mcap --out disk/x.mcap",
      "convert disk/run/web --to mcap",
      "index disk/run",
      "compare other/web disk/run/web --out disk",
      "replay session.yaml --no-pictures --out disk",
      "replay session.yaml --to-scenario disk/x.yaml",
      "new disk/line --from rotary_knife --controller plcopen",
  };
  const auto status = Mounts::in_child([&](const auto& ready) {
    ready(Mounts::read_only(disk));
    int number = 0;
    for (const auto& command : commands) {
      const auto name = std::to_string(number++);
      folder.file(name + ".status", std::to_string(drycut(command, name)));
    }
    return 0;
  });
  if (!status) GTEST_SKIP() << "nothing can be mounted here";
  for (std::size_t i = 0; i < std::size(commands); ++i) {
    const auto name = std::to_string(i);
    EXPECT_EQ(told(name + ".status"), "2") << commands[i] << ": " << told(name + ".err");
    EXPECT_THAT(told(name + ".err"),
                AllOf(HasSubstr("Read-only file system; "), Not(HasSubstr("filesystem error"))))
        << commands[i];
  }
}

TEST_F(Disks, ARunThatFillsTheDiskNamesTheFileThatDid) {
  const auto status = Mounts::in_child([&](const auto& ready) {
    ready(Mounts::disk(disk, "400k"));
    return drycut("run web.yaml --no-pictures --out disk --set 'scene.duration=100 s'");
  });
  if (!status) GTEST_SKIP() << "nothing can be mounted here";
  EXPECT_EQ(*status, 3);
  const auto said = told("told.out");
  EXPECT_THAT(said.substr(0, said.find('\n')),
              HasSubstr("STOPPED, cannot write disk/web/trace.csv: No space"));
  EXPECT_THAT(said, AllOf(HasSubstr("  held so far slow enough"), Not(HasSubstr("  ok   "))))
      << "a check of a run that stopped has not passed";
}

// The run alone fits, its moments do not.
TEST_F(Disks, WhereMomentsFillTheDiskTheyMakeRoomForTheRun) {
  const auto status = Mounts::in_child([&](const auto& ready) {
    ready(Mounts::disk(disk, "600k"));
    return drycut(
        "run web.yaml --no-pictures --out disk --states '10 ms' --keep 1000 --set 'scene.duration=3 s'");
  });
  if (!status) GTEST_SKIP() << "nothing can be mounted here";
  EXPECT_EQ(*status, 0) << told("told.out");
  EXPECT_THAT(told("told.out"), AllOf(HasSubstr("passed"), HasSubstr("[state.lost]")));
}

TEST_F(Disks, ASweepThatFillsTheDiskLeavesTheEarlierResults) {
  const auto sweep = [&](const char* speeds) {
    return drycut("sweep web.yaml --out disk/sweep --over 'plants.web.speed=" + std::string(speeds) +
                  " m/min'");
  };
  const auto files = [&] {
    std::string all;
    for (const auto* name : {"sweep.csv", "report.html"}) all += content(disk / "sweep" / name);
    return all;
  };
  const auto status = Mounts::in_child([&](const auto& ready) {
    ready(Mounts::disk(disk, "8m"));
    if (sweep("10,20,30") != 0) return 10;
    const auto before = files();
    {
      std::ofstream filler(disk / "filler", std::ios::binary);
      const std::string block(4096, 'x');
      while (filler.write(block.data(), static_cast<std::streamsize>(block.size())).flush()) {
      }
    }
    fs::resize_file(disk / "filler",
                    fs::file_size(disk / "filler") - 3 * 4096);  // room for a table, not for a page
    if (sweep("10,20,30,40") != 3) return 11;
    if (files() != before) return 12;
    fs::remove(disk / "filler");
    if (sweep("10,20,30,40") != 0) return 13;
    if (files() == before) return 14;
    // points.cache, sweep.csv, report.html, verdict.json, the manifest
    return std::distance(fs::directory_iterator(disk / "sweep"), {}) == 5 ? 0 : 15;
  });
  if (!status) GTEST_SKIP() << "nothing can be mounted here";
  EXPECT_EQ(*status, 0) << told("told.err");
}

}  // namespace
}  // namespace drycut::sim::cli
