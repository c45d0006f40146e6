// A report's map in a browser: what its points tell under the pointer, by keys, and to copy.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "renders/report.hpp"
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
      .command = "drycut run line.yaml --set length='{x} mm' --set speed='{y} m/min'"};
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
    const auto [x, y] = point(map.x.values[i % 4] + 100, map.y.values[i / 4] - 10);  // nearest to this one
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

}  // namespace
}  // namespace drycut
