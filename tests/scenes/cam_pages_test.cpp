// The report's cam pages of the shipped scenes: every axis that plays a cam is on it, by the laws of its
// table.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "sim/cams/overlay.hpp"
#include "sim/cams/study.hpp"
#include "sim/file.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/report/gallery.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::filesystem::path root = DRYCUT_SOURCE_DIR;

/// A scene to its end, with what its cams did.
struct Played {
  Problems problems;
  scenario::Scenario scenario;
  std::unique_ptr<loop::Simulation> simulation;
  record::Outcome outcome;
  /// `more` goes into its timeline.
  explicit Played(const std::string& name, const std::vector<scenario::Override>& overrides = {},
                  const std::string& more = "")
      : scenario(read(root / "scenes" / (name + ".yaml"), overrides, more, problems)) {
    scenario.pictures.frames = false;
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    simulation = std::make_unique<loop::Simulation>(scenario, problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    simulation->follow_cams();
    outcome = simulation->run();
  }
  static scenario::Scenario read(const std::filesystem::path& file,
                                 const std::vector<scenario::Override>& overrides, const std::string& more,
                                 Problems& problems) {
    auto text = read_file(file, problems).value_or("");
    const std::string timeline = "\ntimeline:\n";
    if (const auto place = text.find(timeline); place != std::string::npos)
      text.insert(place + timeline.size(), more);
    return scenario::read_scenario_text(text, file, overrides, problems);
  }
  [[nodiscard]] std::vector<cams::CamPage> pages() const { return report::cams_of(scenario, *simulation); }
  [[nodiscard]] std::vector<loop::PlayedCam> cams() const { return simulation->cams()->played(); }
};

cams::CamErrors errors_of(const loop::PlayedCam& cam) {
  cams::MasterRange range;
  for (const auto& sample : cam.samples)
    range = {std::min(range.first, sample.master), std::max(range.last, sample.master)};
  return cams::errors_of(cam, cams::ideal_cam(*cam.table, range));
}

/// A scene, how many cams it plays, and how far set and ideal may be apart in the device's unit.
struct Bound {
  std::string scene;
  std::size_t cams = 1;
  double set = 0;
  friend void PrintTo(const Bound& bound, std::ostream* out) { *out << bound.scene; }
};

const auto scene_name = [](const auto& info) { return info.param.scene; };
const auto report_name = [](const auto& info) { return info.param.first; };

class SceneCams : public testing::TestWithParam<Bound> {};

TEST_P(SceneCams, ArePlayedAsTheirTablesSay) {
  const Played run(GetParam().scene);
  const auto cams = run.cams();
  EXPECT_EQ(cams.size(), GetParam().cams);
  for (const auto& cam : cams) {
    const auto errors = errors_of(cam);
    const auto set = cams::figures_of(errors.set);
    EXPECT_GT(set.count, 100U) << cam.axis;
    EXPECT_EQ(set.count, cam.samples.size()) << cam.axis;
    EXPECT_LE(set.largest, GetParam().set) << cam.axis;
    EXPECT_EQ(cams::figures_of(errors.behind).count, cam.samples.size()) << cam.axis;
  }
  for (const auto& page : run.pages()) {
    EXPECT_EQ(page.plots.size(), 2U) << page.title;
    EXPECT_GE(page.tables.size(), 3U) << page.title;
  }
}

// CAMMING4 and MC_CamIn set the law itself. LX3VP gives whole pulses on the lines between rows of whole
// pulses: half a pulse each.
constexpr double exact = 1e-6;
constexpr double a_pulse = 1.05;
INSTANTIATE_TEST_SUITE_P(
    All, SceneCams,
    testing::Values(Bound{"rotary_knife", 1, exact}, Bound{"rotary_knife_long", 1, exact},
                    Bound{"flying_saw", 1, exact}, Bound{"wire_guide", 1, exact},
                    Bound{"rotary_knife_lx3vp", 1, a_pulse}, Bound{"flying_saw_return_square", 2, a_pulse},
                    Bound{"rotary_knife_mc_camin", 1, exact}, Bound{"mc_camin_eject", 1, exact},
                    Bound{"mc_camin_table_switch", 3, exact}),
    scene_name);

TEST(CamPagesOfScenes, ASectorChangedWhileTheCamRunsIsSeen) {
  const Played run("rotary_knife", {{"scene.duration", "8 s"}},
                   "  - {when: AxisX.rowex == 3, set: {AxisX.codeQs4: 5000}}\n");
  const auto cams = run.cams();
  ASSERT_EQ(cams.size(), 1U);
  auto changed = *cams[0].table;
  EXPECT_THAT(cams::cam_file(changed, "changed.csv"), HasSubstr("4,234,7400,5400"));
  EXPECT_GT(cams::figures_of(errors_of(cams[0]).set).largest, 400 * 40960.0 / 6000 - 1);
  EXPECT_LT(cams::figures_of(errors_of(cams[0]).behind).largest, 100);
}

TEST(CamPagesOfScenes, AMachineWithoutACamHasNone) {
  EXPECT_THAT(Played("press_learning", {{"scene.duration", "200 ms"}}).pages(), IsEmpty());
  EXPECT_THAT(Played("commissioning_counter", {{"scene.duration", "200 ms"}}).pages(), IsEmpty());
}

TEST(CamPagesOfScenes, AControllerThatNeverEngagesShowsItsTable) {
  const Played run("mc_camin_first", {{"scene.duration", "20 ms"}});
  EXPECT_THAT(run.cams(), IsEmpty());
  const auto pages = run.pages();
  ASSERT_EQ(pages.size(), 1U);
  EXPECT_EQ(pages[0].title, "Cam of cams/mc_rotary_knife.tab");
  EXPECT_THAT(pages[0].notes, Contains(HasSubstr("No slave was on this cam")));
  EXPECT_EQ(pages[0].plots.size(), 1U);
}

class Reports : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(Reports, HaveAPageForTheCamItsPlotsAndItsTable) {
  const auto& [scene, title] = GetParam();
  Played run(scene, {{"scene.duration", "5 s"}});
  const TestFolder folder;
  const std::filesystem::path out = folder / "out";
  Problems problems;
  OutputFolder results(out, "run", report::picture_files, problems);
  results.begin();
  report::write_pictures(run.scenario, *run.simulation, {}, run.outcome, results, 1,
                         [](const char*, double) {});
  const auto report = read_file(out / "report.html", problems).value_or("");
  EXPECT_THAT(report, HasSubstr("<h2>" + title + "</h2>"));
  EXPECT_THAT(report, HasSubstr("set minus ideal position"));
  const auto page = run.pages().at(0);
  EXPECT_TRUE(std::filesystem::exists(out / "plots" / ("cam_" + page.name + ".png")));
  EXPECT_TRUE(std::filesystem::exists(out / "plots" / ("cam_" + page.name + "_played.png")));
  // The table that was kept is a cam table like any other.
  const auto table = read_file(out / "cams" / (page.name + ".csv"), problems).value_or("");
  EXPECT_EQ(table, page.table);
  std::ignore = cams::read_cam("", table, page.name, problems);
  EXPECT_THAT(problems, IsEmpty());
  results.begin();
  EXPECT_FALSE(std::filesystem::exists(out / "cams"));
}

INSTANTIATE_TEST_SUITE_P(All, Reports,
                         testing::Values(std::pair{"rotary_knife", "Cam of AxisX"},
                                         std::pair{"rotary_knife_lx3vp", "Cam of Y0 (DECAM D1000)"},
                                         std::pair{"rotary_knife_mc_camin", "Cam of Knife"}),
                         report_name);

}  // namespace
}  // namespace drycut::sim
