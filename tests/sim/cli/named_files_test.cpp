// Files that the user names: drycut replaces what it wrote itself, and all else only when it is told to.
#include <gmock/gmock.h>

#include "renders/png_image.hpp"
#include "sim/cli/bode_command.hpp"
#include "sim/cli/cam_command.hpp"
#include "sim/cli/convert_command.hpp"
#include "sim/cli/design_command.hpp"
#include "sim/cli/live_command.hpp"
#include "sim/cli/run_command.hpp"
#include "sim/record/own_file.hpp"
#include "tests/sim/studies/tune/bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct NamedFiles : CommandTest {
  NamedFiles() {
    folder.file("axis.cnf", studies::tuning::configuration);
    folder.file("axis.mod", studies::tuning::program);
    folder.file("axis.yaml", studies::tuning::scenario);
  }
  /// `work(force)` writes `name`: not over a hand-made file unless forced, and again over its own.
  template <typename Work>
  void guards(const std::string& name, const Work& work,
              const std::string& hand_made = "# mine\na,b\n1,2\n") {
    const auto file = folder.file(name, hand_made);
    EXPECT_EQ(captured([&] { return work(false); }), bad_input) << name;
    EXPECT_THAT(err, HasSubstr(name + " is there already, and drycut did not write it; name another file, or "
                                      "replace it with --force"));
    EXPECT_EQ(content(file), hand_made) << name;
    EXPECT_EQ(captured([&] { return work(true); }), all_passed) << name << err;
    const auto first = content(file);
    EXPECT_NE(first, hand_made) << name;
    EXPECT_TRUE(captured([&] { return work(false); }) == all_passed) << name << " is its own: " << err;
    EXPECT_EQ(content(file), first) << name;
    std::ofstream(file, std::ios::binary).close();
    EXPECT_EQ(captured([&] { return work(false); }), all_passed)
        << "nothing is lost with an empty one: " << err;
    fs::remove(file);
    EXPECT_EQ(captured([&] { return work(false); }), all_passed) << err;
  }
  TestFolder folder;
};

TEST_F(NamedFiles, OfACam) {
  CamOptions cam;
  cam.table = shipped_cams / "fly_cut.csv";
  guards("samples.csv", [&](bool force) {
    auto options = cam;
    options.csv = folder / "samples.csv";
    options.force = force;
    return validate_cam(options);
  });
  guards("cam.png", [&](bool force) {
    auto options = cam;
    options.png = folder / "cam.png";
    options.force = force;
    return validate_cam(options);
  });
  guards(
      "rows.csv",
      [&](bool force) {
        CamOptions options;
        options.table = shipped_cams / "ecam_s_curve.csv";
        options.rows = folder / "rows.csv";
        options.force = force;
        return validate_cam(options);
      },
      "master,slave\n0,0\n100,100\n");
  CamOptions again;
  again.table = folder / "rows.csv";
  EXPECT_EQ(captured([&] { return validate_cam(again); }), all_passed) << "its mark is a comment: " << err;
}

TEST_F(NamedFiles, OfADesign) {
  const auto design = [&](bool force) {
    DesignOptions options;
    options.kind = "rotary_knife";
    options.length = "800 mm";
    options.circumference = "600 mm";
    options.sync = "120 mm";
    options.speed = "60 m/min";
    options.device = "camming4";
    options.table = folder / "best.csv";
    options.scene = source_root / "scenes/rotary_knife.yaml";
    options.force = force;
    return design_cam(options);
  };
  guards("best.csv", design, content(shipped_cams / "rotary_knife.csv"));
  guards("best.yaml", design, "scene: {duration: 1 s}\n");
}

TEST_F(NamedFiles, OfABode) {
  const auto bode = [&](bool force) {
    BodeOptions options;
    options.scenario = folder / "axis.yaml";
    options.set = {"controller.qmove.set.AxisX.pgain=50"};
    options.loop.points = 3;
    options.csv = folder / "bode.csv";
    options.png = folder / "bode.png";
    options.force = force;
    const int status = measure_bode(options);
    return status == check_failed ? all_passed : status;  // what it found is not asked here
  };
  guards("bode.csv", bode);
  guards("bode.png", bode);
}

TEST_F(NamedFiles, OfAConversion) {
  RunOptions run;
  run.scenarios = {folder / "axis.yaml"};
  run.out = folder / "out";
  run.pictures = false;
  ASSERT_EQ(captured([&] { return run_scenarios(run); }), all_passed) << err;
  for (const auto& [to, name] : {std::pair{"csv", "x.csv"}, {"hdf5", "x.h5"}, {"mcap", "x.mcap"}}) {
    const auto convert = [&, to = to, name = name](bool force) {
      ConvertOptions options{folder / "out/axis", to, folder / name};
      options.force = force;
      return convert_run(options);
    };
    guards(name, convert);
    // A trace of somebody else begins with its time, too.
    fs::remove(folder / "x.events.csv");
    guards(name, convert, "time [s],speed [m/min]\n0,1\n");
  }
  folder.file("x.csv", content(folder / "out/axis/trace.csv"));
  folder.file("x.events.csv", "my notes\n");
  ConvertOptions options{folder / "out/axis", "csv", folder / "x.csv"};
  EXPECT_EQ(captured([&] { return convert_run(options); }), bad_input);
  EXPECT_THAT(err, HasSubstr("x.events.csv is there already, and drycut did not write it"));
  EXPECT_EQ(content(folder / "x.events.csv"), "my notes\n");
}

TEST_F(NamedFiles, OfASessionAndASummary) {
  folder.file("web.yaml", "scene: {step: 1 ms, duration: 0.1 s}\nplants: {web: {type: web}}\n");
  folder.file("session.yaml", "- {scenario: web.yaml, set: [], fingerprint: 0}\n- {reached: 0.1 s}\n");
  guards(
      "own.yaml",
      [&](bool force) {
        ReplayOptions options;
        options.session = folder / "session.yaml";
        options.to_scenario = folder / "own.yaml";
        options.force = force;
        return replay_session(options);
      },
      "# yaml-language-server: $schema=drycut.schema.json\nscene: {}\n");
  guards(
      "summary.md",
      [&](bool force) {
        RunOptions options;
        options.scenarios = {folder / "web.yaml"};
        options.out = folder / "out";
        options.pictures = false;
        options.summary = folder / "summary.md";
        options.force = force;
        return run_scenarios(options);
      },
      "# My notes on drycut\n");
}

TEST_F(NamedFiles, KnowThemselves) {
  const auto own = [&](const std::string& text) { return record::is_own_file(folder.file("x", text)); };
  EXPECT_TRUE(own("# Written by drycut design: a cam\n"));
  EXPECT_TRUE(own("## Written by drycut cam.\nmaster,slave\n"));
  EXPECT_FALSE(own("Written by drycut, or so they say\n")) << "no comment";
  EXPECT_FALSE(own("# mine\n# Written by drycut design\n")) << "the first line";
  EXPECT_FALSE(own("# for drycut\n"));
  EXPECT_FALSE(own("\x89PNG\r\n\x1a\n and no more"));
  EXPECT_FALSE(own("\x89HDF\r\n\x1a\n and no more"));
  EXPECT_TRUE(own(renders::png_bytes(renders::Image(4, 4))));
  EXPECT_FALSE(record::is_own_file(folder / "nothing"));
}

}  // namespace
}  // namespace drycut::sim::cli
