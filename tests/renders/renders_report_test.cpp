#include "renders/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "renders/html.hpp"
#include "renders/png_image.hpp"
#include "renders/report_data.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kNasty = "a < b && \"c\" 'd' </td><script>alert(1)</script>";

ReportFigure figure(const Scratch& scratch, const std::string& name) {
  Image image(20, 10);
  image.rgb[5] = 200;
  write_file(scratch / name, png_bytes(image));
  return {scratch / name, name + " caption"};
}

Report full_report(const Scratch& scratch) {
  Report report;
  report.title = "Rotary knife";
  report.scenario = "knife.yaml";
  report.verdict = "1 of 2 checks failed";
  report.facts = {{{"duration", "12 s"}}, {{"seed", "1"}}};
  report.checks = {{"cut length", "abs(length - 800) <= 0.1", true, "0.053 mm left at 7.204 s", "15 cuts"},
                   {"follows", "abs(AxisX.follerr) < 400", false, "12 counts over", ""}};
  report.frames = {figure(scratch, "f0.png"), figure(scratch, "f1.png")};
  report.plots = {figure(scratch, "motion.png")};
  ReportTable pieces;
  pieces.title = "Pieces";
  pieces.headings = {"no.", "length", "note"};
  pieces.rows = {{{"1", "800.012 mm", "first"}}, {{"2", "-1 mm", ""}}};
  ReportTable events = pieces;
  events.title = "Events";
  events.folded = true;
  report.tables = {events, pieces};
  report.scenario_expanded = "scene:\n  title: Rotary knife\n";
  return report;
}

std::string written(const Report& report, const Scratch& scratch) {
  write_report(report, scratch / "report.html");
  return read_file(scratch / "report.html");
}

/// The tags after the style sheet that are opened and not closed, or the first that is closed out of order;
/// empty if the page is well-formed.
std::string unbalanced(const std::string& page) {
  std::vector<std::string> open = {"html", "head"};
  for (std::size_t at = page.find('<', page.find("</style>") + 1); at != std::string::npos;
       at = page.find('<', at + 1)) {
    const bool closes = page[at + 1] == '/';
    const std::size_t begin = at + (closes ? 2 : 1);
    const std::string name = page.substr(begin, page.find_first_of(" >", begin) - begin);
    if (name == "img") continue;
    if (!closes) {
      open.push_back(name);
    } else if (!open.empty() && open.back() == name) {
      open.pop_back();
    } else {
      return "/" + name;
    }
  }
  std::string left;
  for (const std::string& name : open) left += name + " ";
  return left;
}

/// The page without its pictures, so that searches and regular expressions are quick.
std::string without_pictures(std::string page) {
  for (std::size_t at = page.find("base64,"); at != std::string::npos; at = page.find("base64,", at + 7)) {
    page.erase(at + 7, page.find('"', at) - at - 7);
  }
  return page;
}

TEST(RendersReport, VerdictComesFirstAndSaysPassOrFail) {
  const Scratch scratch;
  Report report = full_report(scratch);
  const std::string failed = written(report, scratch);
  EXPECT_THAT(failed,
              HasSubstr("<p class=\"verdict fail\"><strong>FAIL</strong> <span>1 of 2 checks failed</span>"));
  EXPECT_LT(failed.find("verdict fail\""), failed.find("<dl"));
  EXPECT_LT(failed.find("<dl"), failed.find("<h2>Checks"));
  EXPECT_LT(failed.find("<h2>Checks"), failed.find("<img"));
  report.passed = true;
  report.verdict = "all 2 checks passed";
  EXPECT_THAT(written(report, scratch), HasSubstr("<p class=\"verdict pass\"><strong>PASS</strong>"));
}

TEST(RendersReport, FailedChecksComeFirstAndTheOthersStayInTheirOrder) {
  const Scratch scratch;
  Report report;
  for (const auto& [name, passed] :
       {std::pair{"one", true}, {"two", false}, {"three", true}, {"four", false}})
    report.checks.push_back({name, "", passed, "", ""});
  const std::string page = written(report, scratch);
  std::size_t before = 0;
  for (const char* name : {"<td>two", "<td>four", "<td>one", "<td>three"}) {
    EXPECT_GT(page.find(name), before) << name;
    before = page.find(name);
  }
}

TEST(RendersReport, ABarShowsHowMuchOfALimitIsUsed) {
  const Scratch scratch;
  const struct {
    std::optional<double> used;
    const char* kind;
    const char* text;
    const char* width;
  } cases[] = {{0.24, "share", "24 %", "24%"},       {0.0, "share", "0 %", "0%"},
               {0.95, "share close", "95 %", "95%"}, {1.0, "share close", "100 %", "100%"},
               {1.5, "share fail", "150 %", "100%"}, {26.5, "share fail", "over 1000 %", "100%"}};
  for (const auto& [used, kind, text, width] : cases) {
    Report report;
    report.checks = {{"follows", "x < 100", true, "76 left", "", used}};
    EXPECT_THAT(written(report, scratch),
                HasSubstr("<td><span class=\"" + std::string(kind) + "\" role=\"img\" aria-label=\"" + text +
                          " of the limit used\"><span class=\"bar\"><i style=\"width:" + width +
                          "\"></i></span><b>" + text + "</b></span>76 left</td>"));
  }
  Report report;
  report.checks = {{"drive", "", false, "", "", 0.5}};
  EXPECT_THAT(written(report, scratch), HasSubstr("class=\"share fail\"")) << "it tripped";
  report.checks = {{"no error", "x == 0", true, "", "", {}}};
  EXPECT_THAT(written(report, scratch), Not(HasSubstr("class=\"share"))) << "no number, no bar";
}

TEST(RendersReport, KeyFiguresComeBeforeAllElse) {
  const Scratch scratch;
  Report report = full_report(scratch);
  report.keys = {{"pieces", "12", {"75 a minute"}}, {"length of cut", "800 ± 0.1 mm", {}, 0.5}};
  report.notes = {"a remark"};
  const std::string page = written(report, scratch);
  EXPECT_THAT(page, HasSubstr("<dl class=\"keys\">\n<div><dt>pieces</dt><dd><strong>12</strong><small>75 a "
                              "minute</small></dd></div>"));
  EXPECT_THAT(page, HasSubstr("<strong>800 ± 0.1 mm</strong><span class=\"share\""));
  EXPECT_LT(page.find("class=\"verdict"), page.find("class=\"keys\""));
  EXPECT_LT(page.find("class=\"keys\""), page.find("class=\"facts\""));
  EXPECT_LT(page.find("<h2>Checks"), page.find("<li>a remark</li>"));
  EXPECT_LT(page.find("<li>a remark</li>"), page.find("<h2>The run in pictures"));
}

TEST(RendersReport, ContentsLeadToEveryHeading) {
  const Scratch scratch;
  Report report = full_report(scratch);
  report.tables.push_back(report.tables[1]);
  const std::string page = written(report, scratch);
  const std::size_t begin = page.find("<nav class=\"contents\"");
  EXPECT_LT(begin, page.find("<h2>"));
  const std::string contents = page.substr(begin, page.find("</nav>") - begin);
  for (const char* link :
       {"<a href=\"#checks\">Checks</a>", "<a href=\"#the-run-in-pictures\">The run in pictures</a>",
        "<a href=\"#pieces\">Pieces</a>", "<a href=\"#pieces-2\">Pieces</a>",
        "<a href=\"#details\">Details</a>"})
    EXPECT_THAT(contents, HasSubstr(link));
  for (const char* id : {"checks", "the-run-in-pictures", "pieces", "pieces-2", "details"})
    EXPECT_THAT(page, HasSubstr("id=\"" + std::string(id) + "\""));
  EXPECT_THAT(written(Report{}, scratch), Not(HasSubstr("<nav"))) << "nothing to look for";
}

TEST(RendersReport, APictureSaysInWordsWhatItShows) {
  const Scratch scratch;
  Report report = full_report(scratch);
  Plot plot;
  plot.title = "Motion";
  plot.x_label = "time [s]";
  plot.panels = {{"", "speed [m/min]", {{"web", {0, 1}, {1, 2}}, {"knife", {0, 1}, {1, 2}}}, {}, {}}, {}};
  plot.panels[1].lanes = {{"busy", {0, 1}, {0, 1}}};
  report.plots[0].words = plot_words(plot);
  const std::string page = written(report, scratch);
  EXPECT_THAT(page, HasSubstr("alt=\"Motion: speed [m/min] of web, knife; busy over time [s]\""));
  EXPECT_THAT(page, HasSubstr("alt=\"The machine, f0.png caption\""));
}

TEST(RendersReport, HoldsEverythingOfTheStruct) {
  const Scratch scratch;
  const std::string page = written(full_report(scratch), scratch);
  for (const char* text :
       {"<h1>Rotary knife</h1>", "knife.yaml", "<dt>duration</dt><dd>12 s</dd>",
        "abs(length - 800) &lt;= 0.1", "0.053 mm left at 7.204 s", "<small>15 cuts</small>",
        "<span class=\"badge pass\">PASS</span>", "<span class=\"badge fail\">FAIL</span>", "f0.png caption",
        "motion.png caption", "<th class=\"number\">length</th>", "<th>note</th>",
        "<td class=\"number\">800.012 mm</td>", "<summary>Events<small>2 rows</small></summary>",
        "title: Rotary knife"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
  EXPECT_LT(page.find("<h2>Pieces"), page.find("<summary>Events")) << "what is folded comes last";
}

TEST(RendersReport, VerdictsNameTheirColumnsForAPhone) {
  const Scratch scratch;
  Report report;
  report.summary = {{"Verdicts", {"check", "old <1>", "new"}, {{{"length", "PASS 1 mm left\n9 cuts", ""}}}}};
  report.summary[0].verdicts = true;
  EXPECT_THAT(
      written(report, scratch),
      HasSubstr("<td>length</td><td data-of=\"old &lt;1&gt;\"><span class=\"badge pass\">PASS</span> 1 mm "
                "left<small>9 cuts</small></td><td data-of=\"new\"></td>"));
}

TEST(RendersReport, ATableWithoutNamesHasNoHead) {
  const Scratch scratch;
  Report report;
  report.tables = {{"Margins", {"", ""}, {{{"phase margin", "good"}}}}};
  EXPECT_THAT(written(report, scratch), Not(HasSubstr("<thead>")));
  report.tables[0].headings[1] = "value";
  EXPECT_THAT(written(report, scratch), HasSubstr("<thead><tr><th></th><th>value</th></tr></thead>"));
}

TEST(RendersReport, LongFactsGetRoom) {
  const Scratch scratch;
  Report report;
  report.facts = {{{"seed", "1"}}, {{"note", "AxisX at 5.002 s: warning"}}};
  EXPECT_THAT(
      written(report, scratch),
      HasSubstr("<div><dt>seed</dt><dd>1</dd></div>\n<div style=\"flex-basis:min(100%,29ch)\"><dt>note"));
}

TEST(RendersReport, EmbedsThePicturesWhole) {
  const Scratch scratch;
  const Report report = full_report(scratch);
  const std::string page = written(report, scratch);
  for (const ReportFigure& f : {report.frames[0], report.frames[1], report.plots[0]}) {
    EXPECT_THAT(page, HasSubstr("src=\"data:image/png;base64," + base64(read_file(f.png)) + "\""));
  }
}

TEST(RendersReport, AsksForNothingOutside) {
  const Scratch scratch;
  const std::string page = without_pictures(written(full_report(scratch), scratch));
  for (const char* outside : {"http", "<script", "<link", "@import", "url(", "<iframe", "src=\"/", "//"}) {
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  }
  std::size_t sources = 0;
  for (std::size_t at = page.find("src="); at != std::string::npos; at = page.find("src=", at + 1)) {
    EXPECT_EQ(page.substr(at, 10), "src=\"data:");
    ++sources;
  }
  EXPECT_EQ(sources, 3U);
}

TEST(RendersReport, IsWellFormed) {
  const Scratch scratch;
  EXPECT_EQ(unbalanced(without_pictures(written(full_report(scratch), scratch))), "");
  EXPECT_EQ(unbalanced(written(Report{}, scratch)), "") << "also with nothing in it";
}

TEST(RendersReport, EscapesEveryText) {
  const Scratch scratch;
  Report report = full_report(scratch);
  report.title = report.scenario = report.verdict = report.scenario_expanded = kNasty;
  report.facts = {{{kNasty, kNasty}}};
  report.keys = {{kNasty, kNasty, {kNasty}}};
  report.notes = {kNasty};
  report.checks = {{kNasty, kNasty, true, kNasty, kNasty}};
  report.frames[0].caption = report.plots[0].caption = kNasty;
  for (ReportTable& table : report.tables) {
    table.title = kNasty;
    table.headings = {kNasty};
    table.rows = {{{kNasty}}};
  }
  const std::string page = without_pictures(written(report, scratch));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("alert(1)</script")));
  EXPECT_EQ(unbalanced(page), "");
  const std::string escaped = html_text(kNasty);
  std::size_t times = 0;
  for (std::size_t at = page.find(escaped); at != std::string::npos; at = page.find(escaped, at + 1)) ++times;
  EXPECT_EQ(times, 28U);
}

TEST(RendersReport, ReplacesTheOldReportAndLeavesNothingBeside) {
  const Scratch scratch;
  write_file(scratch / "report.html", "old");
  written(Report{}, scratch);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path)) {
    EXPECT_EQ(entry.path().filename(), "report.html");
    ++files;
  }
  EXPECT_EQ(files, 1U);
}

TEST(RendersReport, PictureThatIsMissingOrNoneIsAnErrorAndKeepsTheOldReport) {
  const Scratch scratch;
  write_file(scratch / "report.html", "old");
  Report report = full_report(scratch);
  report.plots[0].png = scratch / "gone.png";
  EXPECT_THAT(message_of<std::runtime_error>([&] { write_report(report, scratch / "report.html"); }),
              HasSubstr("gone.png: cannot be read"));
  write_file(scratch / "gone.png", "GIF89a");
  EXPECT_THAT(message_of<std::runtime_error>([&] { write_report(report, scratch / "report.html"); }),
              HasSubstr("gone.png: not a PNG picture"));
  EXPECT_EQ(read_file(scratch / "report.html"), "old");
}

TEST(RendersReport, SaysThatItCannotBeWritten) {
  const Scratch scratch;
  EXPECT_THAT(
      message_of<std::runtime_error>([&] { write_report(Report{}, scratch / "no/such/report.html"); }),
      HasSubstr("cannot write "));
}

TEST(RendersReport, SameReportSameBytes) {
  const Scratch scratch;
  const Report report = full_report(scratch);
  EXPECT_EQ(written(report, scratch), written(report, scratch));
}

TEST(RendersHtml, Base64OfTheRfc) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(RendersHtml, EscapesAndKeepsLines) {
  EXPECT_EQ(html_text("<a href=\"x\">'&'</a>\n\tµ\x01\xff"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;\n\tµ ?");
}

TEST(RendersPng, WritesWhatItReads) {
  const Scratch scratch;
  Image image(7, 5);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<std::uint8_t>(i * 37);
  write_file(scratch / "a.png", png_bytes(image));
  const Image back = read_png(scratch / "a.png");
  EXPECT_EQ(back.width, 7);
  EXPECT_EQ(back.rgb, image.rgb);
  write_file(scratch / "b.png", "no picture");
  EXPECT_THAT(message_of<std::runtime_error>([&] { read_png(scratch / "b.png"); }),
              HasSubstr("not a PNG picture"));
}

}  // namespace
}  // namespace drycut::renders
