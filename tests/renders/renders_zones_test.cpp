// Stretches of x as bands, pale curves and a second scale: in the picture and as data for a browser.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "renders/plot_layout.hpp"
#include "renders/plots.hpp"
#include "renders/png_image.hpp"
#include "renders/report.hpp"
#include "renders/report_data.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A line from (0, 0) to (100, 1).
Plot cam() {
  Plot plot;
  plot.name = "cam";
  plot.title = "Cam";
  plot.x_label = "master [Um]";
  plot.width = 800;
  plot.panels.push_back({"position", "[Um]", {{"", {0, 100}, {0, 1}}}, {}, {}});
  return plot;
}

/// What is drawn in the middle of the first panel's height, at an x.
std::string colour_at(const Image& image, const Plot& plot, double x) {
  const auto layout = laid_out(plot);
  const auto [low, high] = layout.x_range;
  const double left = layout.left + (x - low) / (high - low) * (layout.right - layout.left);
  const double down = layout.panels[0].top + 8;
  const auto at = 3 * (static_cast<std::size_t>(down) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(left));
  return fmt::format("{:02x}{:02x}{:02x}", image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]);
}

TEST(RendersZones, EverySecondIsShadedAndAStrongOneHasItsOwnColour) {
  auto plot = cam();
  plot.zones = {{0, 20}, {20, 40, true}, {40, 50}, {50, 60}};
  const auto image = drawn(plot);
  EXPECT_EQ(colour_at(image, plot, 12), "f0f3f6");
  EXPECT_EQ(colour_at(image, plot, 31), "d3efe2");
  EXPECT_EQ(colour_at(image, plot, 46), "f0f3f6");
  EXPECT_EQ(colour_at(image, plot, 54), "ffffff");
  EXPECT_EQ(colour_at(image, plot, 72), "ffffff");
}

TEST(RendersZones, OnesOutsideOfTheAxesAreCutOff) {
  auto plot = cam();
  plot.zones = {{-500, 10, true}, {60, 1e9, true}, {2e9, 3e9, true}};
  const auto image = drawn(plot);
  EXPECT_EQ(colour_at(image, plot, 5), "d3efe2");
  EXPECT_EQ(colour_at(image, plot, 33), "ffffff");
  EXPECT_EQ(colour_at(image, plot, 74), "d3efe2");
}

TEST(RendersZones, APaleCurveIsPale) {
  auto plot = cam();
  plot.panels[0].curves[0].y = {0.5, 0.5};
  EXPECT_GT(pixels_like(drawn(plot), 0x00, 0x72, 0xb2), 300);
  plot.panels[0].curves[0].faint = true;
  EXPECT_EQ(pixels_like(drawn(plot), 0x00, 0x72, 0xb2), 0);
  EXPECT_GT(pixels_like(drawn(plot), 0xb9, 0xc2, 0xcc), 300);
}

TEST(RendersZones, ASecondScaleHasRoomAndRoundNumbersOfItsOwn) {
  auto plot = cam();
  const int height = laid_out(plot).height;
  EXPECT_TRUE(laid_out(plot).second_ticks.empty());
  plot.second_x = SecondScale{"time [s]", 0.007};
  const auto layout = laid_out(plot);
  EXPECT_EQ(layout.height, height + 46);
  ASSERT_GE(layout.second_ticks.size(), 3U);
  EXPECT_EQ(layout.second_ticks[0].label, "0.0");
  EXPECT_NEAR(layout.second_ticks[1].value * 0.007, std::atof(layout.second_ticks[1].label.c_str()), 1e-12);
  EXPECT_EQ(drawn(plot).height, height + 46);
}

TEST(RendersZones, ABrowserGetsThemToo) {
  auto plot = cam();
  plot.zones = {{0, 20}, {20, 40, true}};
  plot.second_x = SecondScale{"time [s]", 0.5};
  plot.panels[0].curves[0].faint = true;
  plot.panels[0].y_range = {{-1, 1}};
  const auto json = nlohmann::json::parse(plot_data({plot}))["plots"][0];
  const auto& zones = json["zones"];
  ASSERT_EQ(zones.size(), 2);
  EXPECT_EQ(zones[0]["from"], 0);
  EXPECT_EQ(zones[1]["to"], 40);
  EXPECT_NE(zones[0]["look"]["tone"], zones[1]["look"]["tone"]) << "the strong one has a colour of its own";
  EXPECT_EQ(json["second"], nlohmann::json::parse(R"({"label":"time [s]","factor":0.5})"));
  EXPECT_EQ(json["panels"][0]["curves"][0]["faint"], true);
  EXPECT_EQ(json["panels"][0]["least"], nlohmann::json::parse("[-1,1]"));
  EXPECT_THAT(plot_data({cam()}), AllOf(HasSubstr(R"("second":null)"), HasSubstr(R"("zones":[])"),
                                        HasSubstr(R"("faint":false)"), HasSubstr(R"("least":[])")));
}

TEST(ReportSections, StandBehindThePlotsWithTheirOwnTablesAndData) {
  const Scratch scratch;
  const auto png = draw_plots({cam()}, scratch.path).at(0);
  Report report;
  report.title = "Line";
  report.plots = {{png, "motion"}};
  report.sections = {{"Cam of <AxisX>",
                      {"eight sectors"},
                      {{png, "the cam"}, {png, "as played"}},
                      {{"Feasibility", {"what"}, {{{"velocity"}}}}}}};
  report.live = {cam(), cam(), cam()};
  write_report(report, scratch.path / "r.html");
  const auto page = read_file(scratch.path / "r.html");
  const auto place = [&](const std::string& text) {
    const auto found = page.find(text);
    EXPECT_NE(found, std::string::npos) << text;
    return found;
  };
  EXPECT_LT(place("data-plot=\"0\""), place("<h2>Cam of &lt;AxisX&gt;</h2>"));
  EXPECT_LT(place("<h2>Cam of &lt;AxisX&gt;</h2>"), place("<p class=\"remark\">eight sectors</p>"));
  EXPECT_LT(place("<p class=\"remark\">eight sectors</p>"), place("data-plot=\"1\""));
  EXPECT_LT(place("data-plot=\"1\""), place("data-plot=\"2\""));
  EXPECT_LT(place("data-plot=\"2\""), place("<h2>Feasibility"));
}

}  // namespace
}  // namespace drycut::renders
