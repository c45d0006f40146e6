// The plots that a browser zooms: their data, and what the script makes of it, seen by a real browser.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/output_file.hpp"
#include "renders/html.hpp"
#include "renders/palette.hpp"
#include "renders/plot_layout.hpp"
#include "renders/png_image.hpp"
#include "renders/process.hpp"
#include "renders/report.hpp"
#include "renders/report_data.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string as_base64(const void* numbers, std::size_t bytes) {
  return base64({static_cast<const char*>(numbers), bytes});
}

/// A sine of `count` samples over 10 s with one spike, a lane, marks and a band.
Plot sine(std::size_t count) {
  Plot plot{"motion", "Motion & more", "time [s]", {}, 1200, 260};
  Panel lanes{"outputs", "", {}, {}, {}};
  lanes.lanes.push_back({"2.OUT01", {0, 4, 10}, {0, 1, 1}});
  lanes.lanes.push_back({"phase", {0, 3, 10}, {2, 7, 7}});
  Panel curves{"position", "[mm]", {}, {}, {}};
  Curve curve{"knife </script>", {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    curve.x.push_back(10.0 * static_cast<double>(i) / static_cast<double>(count - 1));
    curve.y.push_back(std::sin(curve.x.back()));
  }
  curve.y[count / 3] = 25;
  Curve flat = curve;
  flat.label = "zero";
  std::fill(flat.y.begin(), flat.y.end(), 0.0);
  curves.curves = {curve, flat};
  curves.bands.push_back({"limit", -1.5, 1.5});
  plot.panels = {lanes, curves};
  plot.marks = {{5, "stuck = 1", true}, {7, "cut 3"}};
  return plot;
}

TEST(LiveData, EveryColumnIsThereOnce) {
  const Plot plot = sine(4);
  const auto json = plot_data({plot, plot});
  const auto& x = plot.panels[1].curves[0].x;
  const std::vector<float> y(plot.panels[1].curves[0].y.begin(), plot.panels[1].curves[0].y.end());
  for (const auto& column : {R"({"type":"f8","base64":")" + as_base64(x.data(), 8 * x.size()),
                             R"({"type":"f4","base64":")" + as_base64(y.data(), 4 * y.size())}) {
    const auto first = json.find(column);
    ASSERT_NE(first, std::string::npos) << column;
    EXPECT_EQ(json.find(column, first + 1), std::string::npos) << "the second plot has the same columns";
  }
}

TEST(LiveData, SaysWhatThePlotsShow) {
  const auto json = plot_data({sine(10)});
  EXPECT_THAT(json, HasSubstr(R"("title":"Motion \u0026 more","xLabel":"time [s]","range":[0.0,10.0])"));
  EXPECT_THAT(
      json,
      HasSubstr(R"({"x":5.0,"label":"stuck = 1","strong":true},{"x":7.0,"label":"cut 3","strong":false})"));
  const auto panels = nlohmann::json::parse(json)["plots"][0]["panels"];
  const auto& band = panels[1]["bands"][0];
  EXPECT_EQ(band["label"], "limit");
  EXPECT_EQ(band["low"], -1.5);
  EXPECT_EQ(band["high"], 1.5);
  EXPECT_EQ(panels[0]["lanes"][0]["states"].size(), 0) << "high or low";
  EXPECT_EQ(panels[0]["lanes"][1]["states"].size(), 2) << "2 and 7";
  EXPECT_THAT(json, Not(HasSubstr("<"))) << "nothing ends the script element";
}

TEST(LiveData, PictureReportAndLiveLineHaveOnePalette) {
  Plot plot{"eight", "", "x", {{"", "", {}, {}, {}}}, 600, 200};
  for (double y = 0; y < 8; ++y) plot.panels[0].curves.push_back({"", {0, 1}, {y, y}});
  const Image image = drawn(plot);
  const auto curves = nlohmann::json::parse(plot_data({plot}))["plots"][0]["panels"][0]["curves"];
  for (std::size_t i = 0; i < 7; ++i) {
    const std::string day = curves[i]["look"]["tone"][0];
    const std::string night = curves[i]["look"]["tone"][1];
    const auto rgb = std::stoi(day.substr(1), nullptr, 16);
    EXPECT_GT(pixels_like(image, rgb >> 16, rgb >> 8 & 255, rgb & 255), 300) << day;
    EXPECT_THAT(palette_css(),
                HasSubstr("--curve-" + std::to_string(i + 1) + ": light-dark(" + day + ", " + night + ");"));
  }
  EXPECT_EQ(curves[7]["look"]["tone"], curves[0]["look"]["tone"]);
  EXPECT_NE(curves[7]["look"]["dash"], curves[0]["look"]["dash"]) << "told apart by its dashes";
}

TEST(LiveData, PathsAndDecadesStayPictures) {
  Plot path = sine(10);
  path.panels = {path.panels[1]};
  path.panels[0].equal_scale = true;
  Plot decades = sine(10);
  decades.log_x = true;
  EXPECT_FALSE(can_be_live(path));
  EXPECT_FALSE(can_be_live(decades));
  EXPECT_THAT(plot_data({path, sine(10)}), HasSubstr(R"({"plots":[null,{"title")"));
  EXPECT_EQ(live_plots({path, decades}), "");
}

TEST(LiveData, WithoutTheLibraryThePicturesStay) {
  const Scratch scratch;
  EXPECT_EQ(live_plots({sine(10)}, scratch.path.string()),
            "<p class=\"remark\">The plots cannot be zoomed: they need libjs-dygraphs, which was not "
            "installed.</p>\n");
  write_file(scratch / "dygraph.min.js", "/* the library */");
  write_file(scratch / "dygraph.min.css", "/* its style */");
  EXPECT_THAT(live_plots({sine(10)}, scratch.path.string()),
              AllOf(HasSubstr("<script>/* the library */</script>"),
                    HasSubstr("<style>/* its style */</style>"), HasSubstr("id=\"plot-data\">{\"plots\"")));
}

// ---- in a browser ----

bool has_browser() {
  try {
    return run_process({"chromium", "chromium", {"--version"}}).good && !live_plots({sine(10)}).empty();
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Opens a report with these plots, runs `script` in it and returns what it writes with tell(...), a line
/// each; errors of the page come as lines too.
std::string browsed(const std::vector<Plot>& plots, const std::string& script) {
  const Scratch scratch;
  Report report;
  report.title = "live";
  write_file(scratch / "plot.png", png_bytes(Image(20, 10)));
  for (const Plot& plot : plots) report.plots.push_back({scratch / "plot.png", plot.name});
  report.live = plots;
  write_report(report, scratch / "report.html");
  auto page = read_file(scratch / "report.html");
  const auto early =
      "<script>const told = []; const tell = x => told.push(String(x));"
      "window.onerror = message => tell('error: ' + message);</script>";
  page.insert(page.find("<style>"), early);
  page += "<script>window.addEventListener('load', () => {" + script +
          "\nconst out = document.createElement('pre'); out.id = 'told';"
          "out.textContent = 'BEGIN' + told.join('|') + 'END'; document.body.appendChild(out); });</script>";
  write_file(scratch / "page.html", page);
  const auto dom =
      run_process({"chromium",
                   "chromium",
                   {"--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1280,900",
                    "--user-data-dir=" + (scratch / "profile").string(), "--virtual-time-budget=5000",
                    "--dump-dom", "file://" + (scratch / "page.html").string()}})
          .output;
  const auto begin = dom.rfind("BEGIN");
  const auto end = dom.find("END", begin);
  if (begin == std::string::npos || end == std::string::npos) return "the page says nothing";
  return dom.substr(begin + 5, end - begin - 5);
}

TEST(LiveBrowser, DrawsThePanelsInPlaceOfThePicture) {
  if (!has_browser()) GTEST_SKIP() << "needs chromium and libjs-dygraphs";
  EXPECT_EQ(
      browsed({sine(1000), sine(10)},
              "tell(drycutPlots.length); const box = document.querySelector('figure.plot');"
              "tell(box.querySelectorAll('canvas').length > 0);"
              "tell(getComputedStyle(box.querySelector('.ground')).display);"
              "tell(box.querySelector('.live-head strong').textContent);"
              "tell([...box.querySelectorAll('.live-entry span')].map(e => e.textContent.trim()).join());"),
      "2|true|none|Motion &amp; more|knife &lt;/script&gt;,zero");
}

TEST(LiveBrowser, DraggingZoomsAllPanelsAndADoubleClickShowsAll) {
  if (!has_browser()) GTEST_SKIP() << "needs chromium and libjs-dygraphs";
  const std::string drag = R"(
    const plot = drycutPlots[0], graph = plot.graphs[1].graph, area = graph.getArea();
    const canvas = plot.graphs[1].canvas.querySelectorAll('canvas')[1];
    canvas.scrollIntoView();
    const at = (kind, share, target) => {
      const box = plot.graphs[1].canvas.getBoundingClientRect();
      target.dispatchEvent(new MouseEvent(kind, {bubbles: true, cancelable: true, view: window, button: 0, detail: 1,
        clientX: box.left + area.x + share * area.w, clientY: box.top + area.y + 50}));
    };
    at('mousedown', 0.3, canvas); at('mousemove', 0.5, document); at('mouseup', 0.5, document);
    for (const view of plot.graphs) tell(view.graph.xAxisRange().map(x => x.toFixed(1)).join(' to '));
    at('dblclick', 0.5, canvas);
    for (const view of plot.graphs) tell(view.graph.xAxisRange().map(x => x.toFixed(1)).join(' to '));)";
  EXPECT_EQ(browsed({sine(1000)}, drag), "3.0 to 5.0|3.0 to 5.0|0.0 to 10.0|0.0 to 10.0");
}

TEST(LiveBrowser, TheCursorTellsTheRecordedValues) {
  if (!has_browser()) GTEST_SKIP() << "needs chromium and libjs-dygraphs";
  EXPECT_EQ(browsed({sine(10001)},
                    "drycutPlots[0].point(2); tell([...document.querySelectorAll('output')].map(e => "
                    "e.textContent).join()); tell(document.querySelector('.live-x').textContent);"
                    "tell(drycutPlots[0].graphs.map(v => v.cursor.style.display).join());"),
            "0,2,0.9093,0|time 2.0000 s|block,block");
}

TEST(LiveBrowser, AMillionSamplesAreThinnedAndNoSpikeIsLost) {
  if (!has_browser()) GTEST_SKIP() << "needs chromium and libjs-dygraphs";
  const auto told = browsed({sine(1'000'000)}, R"(
    const view = drycutPlots[0].graphs[1], rows = () => view.graph.numRows();
    const peak = () => {
      let high = -Infinity;
      for (let i = 0; i < rows(); ++i) high = Math.max(high, view.graph.getValue(i, 1));
      return high;
    };
    tell(rows() <= 2 * view.pixels && rows() > view.pixels); tell(peak());
    drycutPlots[0].show([3.3333, 3.3334]);
    tell(rows() < 30); tell(peak());
    drycutPlots[0].show([6, 8]); tell(peak() < 1.01);
    drycutPlots[0].show([20, 30]); tell(rows());)");
  EXPECT_EQ(told, "true|25|true|25|true|1");
}

TEST(LiveBrowser, GapsAndEmptyCurvesAreNoError) {
  if (!has_browser()) GTEST_SKIP() << "needs chromium and libjs-dygraphs";
  Plot plot = sine(100);
  auto& curves = plot.panels[1].curves;
  for (std::size_t i = 20; i < 40; ++i) curves[0].y[i] = std::nan("");
  curves[1] = {"none", {}, {}};
  curves.push_back({"points", {1, 2.5}, {3, 4}, Curve::Style::points});
  plot.panels[0].lanes[1] = {"no state", {}, {}};
  EXPECT_EQ(browsed({plot},
                    "drycutPlots[0].point(2.4); tell([...document.querySelectorAll('output')].map(e => "
                    "e.textContent).join());"),
            "0,-,-,-,4");
}

}  // namespace
}  // namespace drycut::renders
