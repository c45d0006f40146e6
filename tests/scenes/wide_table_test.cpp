// A page that judges nothing, with a table of many columns, as compare writes it of a recording.
#include <gmock/gmock.h>

#include <optional>

#include "renders/report.hpp"
#include "tests/scenes/browser.hpp"
#include "tests/test_folder.hpp"

namespace drycut {
namespace {

struct PageOfAWideTable : testing::Test {
  void SetUp() override {
    if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
    renders::Report report;
    report.title = "move.yaml against out/replay";
    report.word = "MEASURED";
    renders::ReportTable table{"What the run leaves of what was measured", {}, {}};
    for (const auto* heading :
         {"channel", "unit", "samples", "residual, of measured (rms) [%]", "residual rms", "mean", "worst",
          "at [s]", "mean forwards", "mean backwards", "allowed"})
      table.headings.emplace_back(heading);
    table.rows.push_back({{"axis.encoder.count", "-", "4751", "100.079", "80467.2", "-53096.3", "213437",
                           "3.801", "-61954.9", "-62636.3", "0.161296"}});
    report.summary.push_back(table);
    renders::write_report(report, folder / "report.html");
    opened.emplace(folder.path);
    opened->window(1200, 900);
    opened->open(folder / "report.html");
  }
  TestFolder folder;
  std::optional<Browser> opened;
};

TEST_F(PageOfAWideTable, HasAllColumnsInSightAtADesk) {
  EXPECT_EQ(
      opened->evaluate("[...document.querySelectorAll('.scroll')].map(t => t.scrollWidth > t.clientWidth)"),
      nlohmann::json::array({false}));
}

TEST_F(PageOfAWideTable, IsHeadedInTheColourOfItsText) {
  EXPECT_EQ(opened->evaluate("getComputedStyle(document.querySelector('.verdict strong')).color === "
                             "getComputedStyle(document.body).color"),
            true);
}

}  // namespace
}  // namespace drycut
