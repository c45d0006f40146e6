// The machine in 3-D in a report, as its reader has it: it stands where the run was at the time of the plots'
// cursor, and played it takes the cursor along. Skipped where there is no Chromium or no three.js.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "renders/process.hpp"
#include "tests/scenes/browser.hpp"
#include "tests/scenes/page_checks.hpp"
#include "tests/scenes/report_browser_scripts.hpp"
#include "tests/test_folder.hpp"

namespace drycut {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const auto* const library = "/usr/share/javascript/three/three.min.js";

/// Runs the short pieces, with small frames, into `out`.
std::filesystem::path report_in(const std::filesystem::path& out, const std::vector<std::string>& more = {}) {
  renders::ProcessCommand command = {
      DRYCUT_PROGRAM,
      "drycut",
      {"run", std::string(DRYCUT_SOURCE_DIR) + "/scenes/rotary_knife_short.yaml", "--out", out.string()}};
  auto assignments = more;
  for (const auto* assignment :
       {"scene.duration=5 s", "pictures.frames.every=250 ms", "pictures.frames.size=320x180"})
    assignments.emplace_back(assignment);
  for (const auto& assignment : assignments)
    command.arguments.insert(command.arguments.end(), {"--set", assignment});
  const auto finished = renders::run_process(command);
  EXPECT_EQ(finished.words, "") << finished.output;
  return out / "rotary_knife_short" / "report.html";
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

/// knife.angle [deg] by time, from trace.csv.
std::vector<std::pair<double, double>> angles_of(const std::filesystem::path& trace) {
  std::istringstream lines(bytes_of(trace));
  std::vector<std::pair<double, double>> angles;
  std::ptrdiff_t column = -1;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (column < 0)
      column = std::find_if(cells.begin(), cells.end(),
                            [](const auto& cell) { return cell.starts_with("knife.angle"); }) -
               cells.begin();
    else
      angles.emplace_back(std::stod(cells.at(0)), std::stod(cells.at(static_cast<std::size_t>(column))));
  }
  return angles;
}

/// How far the drum that is drawn stands from `angle` [deg].
constexpr auto* drum_off = R"js((angle) => {
  const {view} = drycutView, {elements: m} = view.parts[view.names.indexOf("knife.drum")].matrix;
  const off = (Math.atan2(m[1], m[0]) * 180 / Math.PI - angle) % 360;
  return Math.min(Math.abs(off), 360 - Math.abs(off));
})js";

/// A report and a browser to read it.
struct ViewInABrowser : testing::Test {
  void SetUp() override {
    if (!Browser::is_installed()) GTEST_SKIP() << "chromium is not installed";
    if (!std::filesystem::exists(library)) GTEST_SKIP() << "libjs-three is not installed";
    report = report_in(folder.path / "a");
    opened.emplace(folder.path);
    opened->window(1280, 900);
    opened->open(report);
  }
  const TestFolder folder;
  std::filesystem::path report;
  std::optional<Browser> opened;
};

TEST_F(ViewInABrowser, MovesWithTheCursorAndTheCursorWithIt) {
  auto& browser = *opened;
  // Until it is seen nothing is unpacked.
  EXPECT_EQ(browser.evaluate("typeof THREE"), "undefined");
  EXPECT_EQ(browser.evaluate("document.querySelector('.view-poster').naturalWidth"), 320);
  browser.evaluate("document.querySelector('#machine').scrollIntoView()");
  ASSERT_TRUE(browser.becomes("window.drycutView?.view.frames > 0"));
  EXPECT_THAT(browser.complaints(), IsEmpty());

  // The mouse over a plot: the drum stands as it was recorded then.
  const auto angles = angles_of(report.parent_path() / "trace.csv");
  ASSERT_GT(angles.size(), 1000U);
  for (const double share : {0.3, 0.52, 0.611, 0.83, 0.97}) {
    const auto place = browser.evaluate(fmt::format("({})(0, {})", kPlaceInPlot, share));
    browser.mouse("mouseMoved", place["x"], place["y"]);
    const double at = browser.evaluate("drycutView.now");
    EXPECT_NEAR(at, place["at"].get<double>(), 1e-9);
    const auto row = std::lower_bound(angles.begin(), angles.end(), std::pair(at, -1e9));
    ASSERT_TRUE(row != angles.begin() && row != angles.end());
    const auto [before_s, before] = *(row - 1);
    const double turned = std::remainder(row->second - before, 360);
    const double angle = before + turned * (at - before_s) / (row->first - before_s);
    // Keys are up to 30 degrees or 250 ms apart in the film: what speeds up in between is a little off.
    EXPECT_LT(browser.evaluate(fmt::format("({})({})", drum_off, angle)).get<double>(), 1.5) << at;
    EXPECT_TRUE(browser.becomes("!drycutView.view.stale")) << "it is drawn";
  }

  // Played, it takes the cursors along; a press on a plot stops it there; at the end it stops by itself.
  browser.evaluate("document.querySelector('.view-play').click()");
  const double begun = browser.evaluate("drycutView.now");
  EXPECT_TRUE(
      browser.becomes(fmt::format("drycutView.now > {} && drycutPlots[0].at === drycutView.now", begun)));
  const auto place = browser.evaluate(fmt::format("({})(0, 0.5)", kPlaceInPlot));
  browser.mouse("mousePressed", place["x"], place["y"], 1);
  browser.mouse("mouseReleased", place["x"], place["y"], 1);
  EXPECT_EQ(browser.evaluate("drycutView.playing"), false);
  EXPECT_NEAR(browser.evaluate("drycutView.now").get<double>(), place["at"].get<double>(), 1e-9);
  browser.evaluate("document.querySelector('.view-controls select').value = 16; drycutView.play(true)");
  EXPECT_TRUE(browser.becomes("!drycutView.playing && drycutView.now === drycutView.motion.until"));
  EXPECT_NEAR(browser.evaluate("drycutPlots[0].at").get<double>(), 5, 1e-9);

  // Time by its slider, views by their buttons, turns by the keys.
  browser.evaluate(
      "(() => { const slider = document.querySelector('.view-controls input'); slider.value = 2; "
      "slider.dispatchEvent(new Event('input')); })()");
  EXPECT_EQ(browser.evaluate("drycutPlots[0].at"), 2);
  EXPECT_EQ(browser.evaluate("document.querySelector('.view-controls output').textContent"), "2.000 s");
  const auto eye = browser.evaluate("drycutView.view.camera.position.toArray()");
  browser.evaluate(
      "[...document.querySelectorAll('.view-bar button')].find(one => one.innerText === 'top').click()");
  const auto from_above = browser.evaluate("drycutView.view.camera.position.toArray()");
  EXPECT_NE(from_above, eye);
  browser.evaluate(
      "document.querySelector('.view-holder canvas').dispatchEvent(new KeyboardEvent('keydown', {key: "
      "'ArrowLeft'}))");
  EXPECT_NE(browser.evaluate("drycutView.view.camera.position.toArray()"), from_above);
  EXPECT_THAT(browser.complaints(), IsEmpty());

  // It is seen together with a plot, whatever the screen; nothing sticks out, all can be read, by day and
  // night.
  struct Screen {
    int width, height;
    bool phone;
  };
  for (const auto& screen : {Screen{1280, 900, false}, Screen{768, 1024, false}, Screen{390, 844, true}}) {
    SCOPED_TRACE(screen.width);
    browser.window(screen.width, screen.height, screen.phone);
    // The plots are laid out anew by the window's event, which may come after the answer to this call.
    EXPECT_TRUE(browser.becomes(fmt::format("({}).length === 0", kOverflow)));
    browser.evaluate("drycutPlots[0].box.scrollIntoView({block: 'end'})");
    const auto box = browser.evaluate(
        "(() => { const {top, bottom} = document.querySelector('.view-stage').getBoundingClientRect(); "
        "return [top, "
        "bottom]; })()");
    EXPECT_GE(box[0].get<double>(), -1);
    EXPECT_LE(box[1].get<double>(), 0.6 * screen.height);
    for (const auto* scheme : {"light", "dark"}) {
      browser.media(scheme);
      EXPECT_EQ(browser.evaluate(kOverflow), nlohmann::json::array());
      EXPECT_EQ(browser.evaluate(kFaintText), nlohmann::json::array());
    }
  }
  EXPECT_THAT(browser.complaints(), IsEmpty());
}

TEST_F(ViewInABrowser, LeavesAPictureWhereThereIsNoWebGL) {
  auto& browser = *opened;
  browser.evaluate("HTMLCanvasElement.prototype.getContext = () => null");
  browser.evaluate("document.querySelector('#machine').scrollIntoView()");
  EXPECT_TRUE(browser.becomes("document.querySelector('.view-notice').innerText.includes('no WebGL')"));
  EXPECT_GT(browser.evaluate("document.querySelector('.view-poster').getClientRects().length"), 0);
  EXPECT_EQ(browser.evaluate("document.querySelector('.view-controls').getClientRects().length"), 0);
  EXPECT_THAT(browser.complaints(), IsEmpty());
}

TEST(ViewInReport, IsTheSameBytesLightAndLeftOutOnRequest) {
  if (!std::filesystem::exists(library)) GTEST_SKIP() << "libjs-three is not installed";
  const TestFolder folder;
  const auto with = bytes_of(report_in(folder.path / "a"));
  EXPECT_EQ(with, bytes_of(report_in(folder.path / "b")));
  const auto without = bytes_of(report_in(folder.path / "c", {"pictures.view=off"}));
  EXPECT_THAT(with, HasSubstr("id=\"view-machine\""));
  EXPECT_THAT(without, Not(HasSubstr("id=\"view-")));
  EXPECT_THAT(without, Not(HasSubstr("id=\"machine\"")));
  EXPECT_LT(with.size() - without.size(), 800U << 10U);
}

}  // namespace
}  // namespace drycut
