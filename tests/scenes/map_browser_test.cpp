// A report's map in a browser: what its points tell under the pointer, by keys, and to copy.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>

#include "renders/report.hpp"
#include "sim/cli/sweep_command.hpp"
#include "tests/scenes/browser.hpp"
#include "tests/test_folder.hpp"

namespace drycut {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

renders::ReportMap example(const std::filesystem::path& folder) {
  renders::ReportMap shown{
      .map = {.name = "map",
              .title = "Speed over length",
              .x = {"length [mm]", {500, 1000, 1500, 2000}},
              .y = {"speed [m/min]", {50, 100, 150}},
              .regions = {{"passed", renders::MapRegion::Kind::good}, {"</script> torque"}},
              .region = {}},
      .png = {},
      .caption = "Point at it.",
      .headings = {"length [mm]", "speed [m/min]", "verdict", "limit"},
      .cells = {},
      .command = "drycut run line.yaml --set length='{0} mm' --set speed='{1} m/min'"};
  for (const double y : shown.map.y.values)
    for (const double x : shown.map.x.values) {
      const bool good = y <= x / 10;
      shown.map.region.push_back(good ? 0 : 1);
      shown.cells.push_back({fmt::format("{}", x), fmt::format("{}", y), good ? "passed" : "failed",
                             good ? "" : "</script> torque"});
    }
  shown.png = renders::draw_map(shown.map, folder);
  return shown;
}

TEST(MapInAReport, TellsItsPoints) {
  if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
  const TestFolder folder;
  renders::Report report;
  report.title = "A map";
  report.maps = {example(folder.path)};
  write_report(report, folder.path / "report.html");
  Browser browser(folder.path);
  browser.window(1280, 900);
  browser.open(folder.path / "report.html");
  const auto told = [&] {
    return browser.evaluate("document.querySelector('.map-point').innerText").get<std::string>();
  };
  EXPECT_THAT(told(), HasSubstr("arrow keys"));

  // Under the pointer: at the places where the picture has the point.
  const auto area = map_area(report.maps[0].map);
  const auto& map = report.maps[0].map;
  const auto point = [&](double x, double y) {
    const auto box = browser.evaluate(
        "(() => { const b = document.querySelector('figure.map img').getBoundingClientRect(); return "
        "[b.left, b.top, "
        "b.width, b.height]; })()");
    return std::pair{box[0].get<double>() + area.x(x) / map.width * box[2].get<double>(),
                     box[1].get<double>() + area.y(y) / map.height * box[3].get<double>()};
  };
  for (std::size_t i = 0; i < report.maps[0].cells.size(); ++i) {
    const auto& cells = report.maps[0].cells[i];
    // Nearest to this one, and a little beside the last of an axis: its dot is met from both sides.
    const auto [x, y] =
        point(map.x.values[i % 4] + (i % 4 < 3 ? 100 : 10), map.y.values[i / 4] - (i > 3 ? 10 : 1));
    browser.mouse("mouseMoved", x, y);
    EXPECT_THAT(told(), HasSubstr(fmt::format("length='{} mm' --set speed='{} m/min'", cells[0], cells[1])));
    EXPECT_THAT(told(), HasSubstr(cells[2]));
    EXPECT_THAT(told(), HasSubstr(cells[3]));
  }

  // A click holds it, another lets it go.
  const auto [x, y] = point(500, 150);
  const auto [far_x, far_y] = point(2000, 50);
  const auto click = [&](double at_x, double at_y) {
    browser.mouse("mousePressed", at_x, at_y, 1);
    browser.mouse("mouseReleased", at_x, at_y, 1);
  };
  click(x, y);
  browser.mouse("mouseMoved", far_x, far_y);
  EXPECT_THAT(told(), HasSubstr("length='500 mm' --set speed='150 m/min'"));
  click(x, y);
  browser.mouse("mouseMoved", far_x, far_y);
  EXPECT_THAT(told(), HasSubstr("length='2000 mm' --set speed='50 m/min'"));

  // By keys: to the neighbours, and no further than the border.
  const auto press = [&](const std::string& key) {
    browser.evaluate(
        fmt::format("document.querySelector('figure.map .ground').dispatchEvent(new KeyboardEvent("
                    "'keydown', {{key: '{}', bubbles: true}})), 0",
                    key));
  };
  press("ArrowLeft");
  press("ArrowUp");
  EXPECT_THAT(told(), HasSubstr("length='1500 mm' --set speed='100 m/min'"));
  for (int i = 0; i < 5; ++i) press("ArrowDown");
  EXPECT_THAT(told(), HasSubstr("length='1500 mm' --set speed='50 m/min'"));
  EXPECT_EQ(browser.evaluate("document.querySelector('figure.map .ground').tabIndex"), 0);
  EXPECT_THAT(browser.complaints(), IsEmpty());
}

// A page as drycut sweep writes it: its points tell what sweep.csv has, to the pointer and to the keys.
TEST(MapInAReport, OfASweepTellsItsTable) {
  if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
  const TestFolder folder;
  sim::cli::SweepOptions sweep;
  sweep.scenario = folder.file("web.yaml", R"(variables: {limit: 100 m/min, speed: 60 m/min}
scene: {step: 1 ms, duration: 0.2 s}
plants: {web: {type: web, speed: "${speed}"}}
record: {every: 10 ms, channels: [web.speed]}
checks:
  - {name: slow enough, always: "web.speed <= ${limit}"}
  - {name: fast enough, always: "web.speed >= 10 m/min"}
)");
  sweep.over = {"variables.limit=80..120 m/min:5", "variables.speed=5..125 m/min:7"};
  sweep.out = folder / "out";
  testing::internal::CaptureStdout();
  const int status = sweep_scenario(sweep);
  testing::internal::GetCapturedStdout();
  ASSERT_EQ(status, sim::cli::all_passed);
  Browser browser(folder.path);
  browser.window(1280, 900);
  browser.open(sweep.out / "report.html");
  const auto told = [&] {
    return browser.evaluate("document.querySelector('.map-point').innerText").get<std::string>();
  };
  browser.evaluate("document.querySelector('figure.map').scrollIntoView({block: 'center'}); 0");
  // Where the page itself has the point, by its own account of its axes.
  const auto place = [&](int column, int row) {
    const auto at = browser.evaluate(fmt::format(
        "(() => {{ const map = JSON.parse(document.getElementById('map-data').textContent)[0];"
        "const b = document.querySelector('figure.map img').getBoundingClientRect();"
        "const share = (value, range) => (value - range[0]) / (range[1] - range[0]);"
        "return [b.left + b.width * (map.left + share(map.x[{}], map.xRange) * (map.right - map.left)),"
        "b.top + b.height * (map.bottom - share(map.y[{}], map.yRange) * (map.bottom - map.top))]; }})()",
        column, row));
    return std::pair{at[0].get<double>(), at[1].get<double>()};
  };
  const auto says = [&](int column, int row) {
    const int limit = 80 + 10 * column;
    const int speed = 5 + 20 * row;
    EXPECT_THAT(told(),
                HasSubstr(fmt::format("--set 'variables.limit={} m/min' --set 'variables.speed={} m/min'",
                                      limit, speed)));
    EXPECT_THAT(told(), HasSubstr(speed < 10 || speed > limit ? "failed" : "passed"));
    if (speed < 10 || speed > limit) {
      EXPECT_THAT(told(), HasSubstr(speed < 10 ? "fast enough" : "slow enough"));
    }
  };
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 5; ++column) {
      const auto [x, y] = place(column, row);
      browser.mouse("mouseMoved", x, y);
      says(column, row);
    }
  }
  const auto press = [&](const std::string& key) {
    browser.evaluate(
        fmt::format("document.querySelector('figure.map .ground').dispatchEvent(new KeyboardEvent("
                    "'keydown', {{key: '{}', bubbles: true}})), 0",
                    key));
  };
  for (int i = 0; i < 3; ++i) press("ArrowLeft");
  for (int i = 0; i < 2; ++i) press("ArrowDown");
  says(1, 4);
  for (int i = 0; i < 9; ++i) press("ArrowUp");
  for (int i = 0; i < 9; ++i) press("ArrowRight");
  says(4, 6);
  EXPECT_THAT(browser.complaints(), IsEmpty());
}

// The curves of a sweep over one axis: a name's swatch has the colour of its dots, the line that only joins
// them has no name, and light and dark page agree.
TEST(CurvesInAReport, OfASweepAreNamedByTheColourOfTheirDots) {
  if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
  const TestFolder folder;
  sim::cli::SweepOptions sweep;
  sweep.scenario = folder.file("web.yaml", R"(variables: {speed: 60 m/min}
scene: {step: 1 ms, duration: 0.2 s}
plants: {web: {type: web, speed: "${speed}"}}
record: {every: 10 ms, channels: [web.speed]}
checks:
  - {name: slow enough, always: "web.speed <= 100 m/min"}
)");
  sweep.over = {"variables.speed=5..125 m/min:7"};
  sweep.figures = {"peak=max(web.speed)"};
  sweep.out = folder / "out";
  testing::internal::CaptureStdout();
  const int status = sweep_scenario(sweep);
  testing::internal::GetCapturedStdout();
  ASSERT_EQ(status, sim::cli::all_passed);
  Browser browser(folder.path);
  browser.window(1280, 900);
  for (const auto& [scheme, fails, passes] : {std::array{"light", "rgb(213, 94, 0)", "rgb(0, 158, 115)"},
                                              std::array{"dark", "rgb(255, 143, 74)", "rgb(46, 199, 155)"}}) {
    browser.media(scheme);
    browser.open(sweep.out / "report.html");
    ASSERT_TRUE(browser.becomes("document.querySelector('.live-legend i') !== null"));
    const auto legend = browser.evaluate(
        "[...document.querySelectorAll('.live-legend')].pop().querySelectorAll('.live-entry:not([hidden])')."
        "length");
    EXPECT_EQ(legend, 2);
    const auto colour = [&](int entry) {
      return browser
          .evaluate(fmt::format("(() => {{ const named = [...document.querySelectorAll('.live-legend')].pop()"
                                ".querySelectorAll('.live-entry i')[{}];"
                                "return named.nextSibling.textContent.trim() + ' ' + "
                                "getComputedStyle(named).backgroundColor; }})()",
                                entry))
          .get<std::string>();
    };
    EXPECT_EQ(colour(0), std::string("fails ") + fails) << scheme;
    EXPECT_EQ(colour(1), std::string("passes ") + passes) << scheme;
  }
  EXPECT_THAT(browser.complaints(), IsEmpty());
}

}  // namespace
}  // namespace drycut
