// Reports as their readers have them: written by the program, opened in a browser, on desk, phone and paper,
// by day and by night. Skipped where there is no Chromium.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "renders/png_image.hpp"
#include "renders/process.hpp"
#include "renders/report.hpp"
#include "tests/scenes/browser.hpp"
#include "tests/scenes/page_checks.hpp"
#include "tests/scenes/report_browser_scripts.hpp"
#include "tests/scenes/report_pages.hpp"
#include "tests/test_folder.hpp"

namespace drycut {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using report_pages::Call;
using report_pages::Page;

/// Columns of a trace.csv by their channels' names.
std::map<std::string, std::vector<double>> trace_of(const std::filesystem::path& file) {
  std::map<std::string, std::vector<double>> columns;
  std::vector<std::string> names;
  std::istringstream lines(content(file));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::size_t column = 0;
    const bool head = names.empty();
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (head)
        names.push_back(cell.substr(0, cell.rfind(" [")));
      else
        columns[names[column]].push_back(cell.empty() ? std::nan("") : std::stod(cell));
    }
  }
  return columns;
}

/// The picture is no blank sheet: its green has many tones.
void expect_not_blank(const std::filesystem::path& png, int width) {
  const auto image = renders::read_png(png);
  EXPECT_EQ(image.width, width);
  std::set<std::uint8_t> tones;
  for (std::size_t i = 1; i < image.rgb.size(); i += 3) tones.insert(image.rgb[i]);
  EXPECT_GT(tones.size(), 50U);
}

/// With the mouse at a share of the width of a plot's last panel, the cursor stands in all panels of all
/// plots over the same x and tells what the trace says there. Returns how many values were compared.
int expect_cursor_tells_the_trace(Browser& browser, std::size_t plot, double share,
                                  const std::map<std::string, std::vector<double>>& trace) {
  const auto place = browser.evaluate(fmt::format("({})({}, {})", kPlaceInPlot, plot, share));
  browser.mouse("mouseMoved", place["x"], place["y"]);
  int compared = 0;
  for (const auto& told : browser.evaluate(fmt::format("({})({})", kToldByCursor, plot))) {
    SCOPED_TRACE(told.dump());
    EXPECT_NEAR(told["at"].get<double>(), place["at"].get<double>(), 1e-9);
    EXPECT_TRUE(told["lines"].get<bool>()) << "in every panel, at the mouse";
    for (const auto& [label, text] : told["values"].items()) {
      EXPECT_NE(text, "");
      if (!trace.contains(label) || !told["time"].get<bool>()) continue;
      const auto& times = trace.at("time");
      const auto row =
          std::upper_bound(times.begin(), times.end(), told["at"].get<double>()) - times.begin() - 1;
      const double recorded = trace.at(label).at(static_cast<std::size_t>(row));
      // Five digits, of numbers below 0.001 four; kept as 32-bit floats.
      const double shown = std::abs(recorded) < 1e-3 ? 6e-4 : 1e-4;
      EXPECT_NEAR(std::stod(text.get<std::string>()), recorded, shown * std::abs(recorded)) << label;
      ++compared;
    }
  }
  return compared;
}

/// A drag over the middle of a plot shows just that stretch in all its panels, under other numbers; a double
/// click shows everything again.
void expect_drag_zooms(Browser& browser, std::size_t plot) {
  const auto ranges = [&] { return browser.evaluate(fmt::format("({})({})", kRangesOfPlot, plot)); };
  const auto place = [&](double share) {
    return browser.evaluate(fmt::format("({})({}, {})", kPlaceInPlot, plot, share));
  };
  const auto before = ranges();
  const auto from = place(0.3), until = place(0.6);
  browser.mouse("mousePressed", from["x"], from["y"], 1);
  browser.mouse("mouseMoved", place(0.5)["x"], from["y"], 1);
  browser.mouse("mouseMoved", until["x"], from["y"], 1);
  browser.mouse("mouseReleased", until["x"], from["y"], 1);
  const auto zoomed = ranges();
  for (const auto& range : zoomed["x"]) {
    EXPECT_NEAR(range[0].get<double>(), from["at"].get<double>(), place(0)["pixel"].get<double>());
    EXPECT_NEAR(range[1].get<double>(), until["at"].get<double>(), place(0)["pixel"].get<double>());
  }
  EXPECT_NE(zoomed["labels"], before["labels"]);
  for (const int clicks : {1, 2})
    for (const char* what : {"mousePressed", "mouseReleased"})
      browser.mouse(what, from["x"], from["y"], clicks);
  EXPECT_EQ(ranges(), before);
}

class ReportInABrowser : public ::testing::TestWithParam<Page> {
 protected:
  void SetUp() override {
    if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
    for (const Call& call : GetParam().calls) {
      renders::ProcessCommand command = {DRYCUT_PROGRAM, "drycut", {}};
      for (std::string word : call) {
        if (word.starts_with("SCENES")) word.replace(0, 6, std::string(DRYCUT_SOURCE_DIR) + "/scenes");
        if (word.starts_with("OUT")) word.replace(0, 3, folder.path.string());
        command.arguments.push_back(word);
      }
      // Checks may fail in a run cut short; the page is what counts.
      const auto finished = renders::run_process(command);
      EXPECT_EQ(finished.words, "") << finished.output;
    }
    ASSERT_TRUE(std::filesystem::exists(folder / GetParam().report));
    browser.emplace(folder.path);
  }

  /// The page on this screen; it shows all its pictures and has nothing to complain of.
  void open(int width, int height, bool phone) {
    browser->window(width, height, phone);
    browser->media("light");
    browser->open(folder / GetParam().report);
    EXPECT_EQ(browser->evaluate(kPicturesLoaded), "all");
    // The machine in 3-D begins once it is seen; the page is looked at when it stands, with its buttons.
    EXPECT_TRUE(browser->becomes(kMachineStands));
    EXPECT_THAT(browser->complaints(), IsEmpty());
  }

  void expect_reads_well(int width) {
    for (const std::string scheme : {"light", "dark"}) {
      SCOPED_TRACE(scheme + ", " + std::to_string(width));
      browser->media(scheme);
      EXPECT_EQ(browser->evaluate(kIsDark), scheme == "dark");
      browser->evaluate(kUnfold);
      EXPECT_EQ(browser->evaluate(kOverflow), json::array());
      EXPECT_EQ(browser->evaluate(kFaintText), json::array());
      EXPECT_EQ(browser->evaluate(kNameless), json::array());
      EXPECT_EQ(browser->evaluate(kDeadAnchors), json::array());
      EXPECT_EQ(browser->evaluate(kAxesWithoutScale), json::array());
      if (scheme == "light") {
        EXPECT_THAT(out_of_keyboards_reach(*browser), IsEmpty());
      }
      browser->evaluate("scrollTo(0, 0)");
      browser->screenshot(folder / (scheme + ".png"));
      expect_not_blank(folder / (scheme + ".png"), width);
    }
  }

  /// False where libjs-dygraphs is not installed: then the page says so, and there are pictures only.
  bool has_library() {
    return content(folder / GetParam().report).find("need libjs-dygraphs") == std::string::npos;
  }

  void expect_plots_answer() {
    const auto& page = GetParam();
    ASSERT_EQ(browser->evaluate("typeof drycutPlots !== 'undefined'"), page.live);
    if (!page.live) return;
    const auto trace =
        page.trace.empty() ? std::map<std::string, std::vector<double>>() : trace_of(folder / page.trace);
    const auto plots = browser->evaluate("drycutPlots.length").get<std::size_t>();
    ASSERT_GT(plots, 0U);
    int compared = 0;
    for (std::size_t plot = 0; plot < plots; ++plot) {
      SCOPED_TRACE(plot);
      for (const double share : {0.137, 0.911})
        compared += expect_cursor_tells_the_trace(*browser, plot, share, trace);
      expect_drag_zooms(*browser, plot);
    }
    EXPECT_EQ(compared > 0, !trace.empty());
  }

  TestFolder folder;
  std::optional<Browser> browser;
};
INSTANTIATE_TEST_SUITE_P(Of, ReportInABrowser, ::testing::ValuesIn(report_pages::pages()),
                         [](const auto& page) { return page.param.name; });

TEST_P(ReportInABrowser, ReadsWellOnDeskPhoneAndPaperByDayAndByNightAndItsPlotsAnswer) {
  open(1280, 900, false);
  expect_reads_well(1280);
  if (has_library()) expect_plots_answer();
  EXPECT_THAT(browser->complaints(), IsEmpty());

  open(390, 844, true);
  expect_reads_well(390);

  // A4 between margins of a centimetre. What the reader left folded is printed all the same.
  browser->evaluate(kFold);
  browser->window(718, 1042, true);
  for (const char* scheme : {"light", "dark"}) {
    SCOPED_TRACE(scheme);
    browser->media(scheme, "print");
    EXPECT_EQ(browser->evaluate(kClippedOnPaper), json::array());
    EXPECT_EQ(browser->evaluate(kFaintText), json::array());
    EXPECT_EQ(browser->evaluate(kFaintOnPaper), json::array()) << "printers leave grounds out";
    EXPECT_EQ(browser->evaluate(kIsDark), false);
  }
  EXPECT_THAT(browser->pdf(), ::testing::StartsWith("JVBERi0")) << "%PDF-";
  EXPECT_THAT(browser->complaints(), IsEmpty());
}

/// A report of one plot: a state that changes at 1 s and 9 s, a lamp, and a ramp beside them.
renders::Report report_with_lanes(const TestFolder& folder) {
  renders::Plot plot;
  plot.name = "states";
  plot.title = "States";
  plot.x_label = "time [s]";
  plot.panels.resize(2);
  plot.panels[0].lanes = {{"phase", {0, 1, 9, 10}, {0, 7, 3, 3}}, {"lamp", {0, 5, 10}, {0, 1, 1}}};
  plot.panels[1].y_label = "way [mm]";
  plot.panels[1].curves = {{"slide", {0, 10}, {0, 100}}};
  renders::Report report;
  report.title = "lanes";
  for (const auto& png : renders::draw_plots({plot}, folder.path))
    report.plots.push_back({png, "states.png"});
  report.live = {plot};
  return report;
}

struct ReportOfLanes : testing::Test {
  void SetUp() override {
    if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
    renders::write_report(report_with_lanes(folder), folder / "report.html");
    opened.emplace(folder.path);
    opened->window(1280, 900);
    opened->open(folder / "report.html");
    if (opened->evaluate("typeof drycutPlots === 'undefined'") == true)
      GTEST_SKIP() << "needs libjs-dygraphs";
  }
  TestFolder folder;
  std::optional<Browser> opened;
};

TEST_F(ReportOfLanes, KeepsTheTextsOfStatesWhenZoomedAndTellsTheStateAtTheCursor) {
  auto& browser = *opened;
  // Nothing but the state 7 is in sight, whose ends are far outside; its text stands within the plot.
  const auto texts = browser.evaluate(R"js((() => {
    const told = [], fill = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (text, x, ...more) { told.push([text, x]); return fill.call(this, text, x, ...more); };
    drycutPlots[0].show([6, 6.5]);
    const area = drycutPlots[0].graphs[0].graph.getArea();
    return told.filter(one => one[1] > area.x && one[1] < area.x + area.w).map(one => one[0]);
  })())js");
  EXPECT_EQ(texts, json::array({"7"}));
  const auto at = [&](double time) {
    return browser.evaluate(fmt::format(
        "(() => {{ const plot = drycutPlots[0]; plot.show(plot.whole); plot.tell({}); return "
        "plot.graphs[0].states.map(one => [one.textContent, getComputedStyle(one).display]); }})()",
        time));
  };
  EXPECT_EQ(at(0.5), json::parse(R"([["0", "block"], ["0", "block"]])"));
  EXPECT_EQ(at(6), json::parse(R"([["7", "block"], ["1", "block"]])"));
  EXPECT_EQ(at(9.5), json::parse(R"([["3", "block"], ["1", "block"]])"));
  EXPECT_EQ(at(11)[0][1], "none") << "the cursor is elsewhere";
  EXPECT_EQ(browser.evaluate(kOverflow), json::array());
}

TEST_F(ReportOfLanes, IsWorkedByKeys) {
  auto& browser = *opened;
  const auto now = [&] { return browser.evaluate("[drycutPlots[0].at, ...drycutPlots[0].range]"); };
  const auto expect_now = [&](double cursor, double from, double until) {
    const auto found = now();
    EXPECT_NEAR(found[0].get<double>(), cursor, 1e-6);
    EXPECT_NEAR(found[1].get<double>(), from, 1e-6);
    EXPECT_NEAR(found[2].get<double>(), until, 1e-6);
  };
  browser.evaluate("drycutPlots[0].box.focus()");
  browser.key("ArrowRight");  // from the middle, a hundredth of what is in sight
  expect_now(5.1, 0, 10);
  browser.key("ArrowLeft", true);
  expect_now(4.1, 0, 10);
  browser.key("+");
  expect_now(4.1, 2.05, 7.05);
  for (int i = 0; i < 6; ++i) browser.key("ArrowRight", true);  // the last step takes the sight along
  expect_now(7.1, 2.1, 7.1);
  browser.key("-");
  expect_now(7.1, 0, 7.1);
  browser.key("Home");
  expect_now(7.1, 0, 10);
  browser.evaluate("document.querySelector('.live-head button').focus()");
  browser.key("+");
  expect_now(7.1, 0, 10);
}

// What the test above must notice.
TEST(BrowserOfTheTests, NoticesWhatIsWrongWithAPage) {
  if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
  const TestFolder folder;
  Browser browser(folder.path);
  const auto body = [&](const std::string& html) {
    browser.open(folder.file("page.html",
                             "<meta name=viewport content='width=device-width'><style>:root{"
                             "--ground:#fff}body{background:#fff;color:#000}</style><body><main>" +
                                 html));
    return browser.complaints();
  };
  browser.window(390, 844, true);
  EXPECT_THAT(body("<p>good</p>"), IsEmpty());
  EXPECT_EQ(browser.evaluate(kOverflow), json::array());
  EXPECT_EQ(browser.evaluate(kFaintText), json::array());
  EXPECT_EQ(browser.evaluate(kClippedOnPaper), json::array());
  EXPECT_EQ(browser.evaluate(kPicturesLoaded), "all");

  EXPECT_THAT(body("<script>console.warn('hm')</script>"), ::testing::SizeIs(1));
  EXPECT_THAT(body("<script>nothing.at.all</script>"), ::testing::SizeIs(1));
  EXPECT_THAT(body("<img src='other.png'>"), ::testing::Contains(::testing::HasSubstr("asks for")));
  body("<img src='data:image/png;base64,AAAA'>");
  EXPECT_NE(browser.evaluate(kPicturesLoaded), "all");
  body("<p style='width:500px'>wide</p>");
  EXPECT_NE(browser.evaluate(kOverflow), json::array());
  body("<div style='overflow:hidden;width:100px'><p style='width:500px'>cut</p></div>");
  EXPECT_NE(browser.evaluate(kOverflow), json::array());
  body("<div style='overflow:auto;width:100px'><p style='width:500px'>scrolls</p></div>");
  EXPECT_EQ(browser.evaluate(kOverflow), json::array());
  EXPECT_NE(browser.evaluate(kClippedOnPaper), json::array()) << "nobody scrolls paper";
  body("<p style='color:#aaa'>faint</p>");
  EXPECT_NE(browser.evaluate(kFaintText), json::array());
  body("<p style='background:#444;color:#fff'>bright</p>");
  EXPECT_EQ(browser.evaluate(kFaintText), json::array());
  EXPECT_NE(browser.evaluate(kFaintOnPaper), json::array());
  body("<details><summary>more</summary><p>folded</p></details>");
  EXPECT_NE(browser.evaluate(kClippedOnPaper), json::array()) << "nobody unfolds paper";
  EXPECT_THROW(browser.evaluate("nothing.at.all"), std::runtime_error);
}

// Each of what page_checks.hpp looks for, once wrong and once right.
TEST(BrowserOfTheTests, NoticesWhatAReaderWithoutMouseOrEyesMisses) {
  if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
  const TestFolder folder;
  Browser browser(folder.path);
  browser.window(800, 600);
  const auto faults = [&](const std::string& body, const std::string& head = "<title>t</title>") {
    browser.open(folder.file("page.html", "<!DOCTYPE html><html lang=en><meta charset=utf-8>" + head +
                                              "<style>body{background:#fff;color:#000}</style><body><main>" +
                                              body));
    return hard_to_reach(browser);
  };
  const std::string pixel = "data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==";
  const std::string tall = "<div style='height:40px;overflow:auto' id=tall ";
  const std::vector<std::pair<std::string, std::string>> wrong_and_right = {
      {"<p style='color:#999'>faint</p>", "<p style='color:#555'>clear</p>"},
      {"<img width=9 height=9 src='" + pixel + "'>",
       "<img width=9 height=9 alt='a knife' src='" + pixel + "'>"},
      {"<canvas></canvas>", "<div role=img aria-label='speed over time'><canvas></canvas></div>"},
      {"<svg width=9 height=9></svg>", "<svg width=9 height=9 aria-hidden=true></svg>"},
      {"<video controls></video>", "<video controls aria-label='film'></video>"},
      {"<button></button>", "<button aria-label='whole range'></button>"},
      {"<input>", "<label>speed <input></label>"},
      {"<h1>one</h1><h3>three</h3>", "<h1>one</h1><h2>two</h2><h3>three</h3>"},
      {"<a href='#gone'>to</a><p id=there>x</p>", "<a href='#there'>to</a><p id=there>x</p>"},
      {"<p id=same>x</p><p id=same>y</p>", "<p id=same>x</p><p id=other>y</p>"},
      {"<button onclick='0' style='outline:none'>go</button>", "<button onclick='0'>go</button>"},
      {"<div onclick='0'>go</div>", "<div onclick='0' tabindex=0 role=button>go</div>"},
      {"<div role=region tabindex=0>x</div>",
       tall + "role=region aria-label=rows tabindex=0><p>a<p>b<p>c</div>"},
  };
  for (const auto& [wrong, right] : wrong_and_right) {
    EXPECT_THAT(faults(wrong), ::testing::SizeIs(1)) << wrong;
    EXPECT_THAT(faults(right), IsEmpty()) << right;
  }
  EXPECT_THAT(faults("x", ""), ElementsAre("no title"));
}

}  // namespace
}  // namespace drycut
