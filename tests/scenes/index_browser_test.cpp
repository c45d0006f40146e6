// The page over many runs in a browser: sorted by pointer and keys, on a desk and on a phone.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "sim/report/index.hpp"
#include "tests/scenes/browser.hpp"
#include "tests/test_folder.hpp"

namespace drycut {
namespace {

using ::testing::IsEmpty;

std::vector<sim::report::IndexEntry> example() {
  using Came = sim::record::Verdict::Came;
  const auto entry = [](const char* name, Came came, const char* word, double simulated) {
    return sim::report::IndexEntry{.name = name,
                                   .kind = "run",
                                   .title = "A line",
                                   .came = came,
                                   .word = word,
                                   .verdict = "told",
                                   .simulated = simulated,
                                   .version = "0.1.0",
                                   .page = std::string(name) + "/report.html",
                                   .picture = "",
                                   .picture_words = ""};
  };
  return {entry("line 2", Came::passed, "PASS", 9), entry("line 10", Came::failed, "FAIL", 100),
          entry("line 1", Came::none, "MEASURED", 12)};
}

TEST(IndexInABrowser, IsSortedByPointerAndKeys) {
  if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
  const TestFolder folder;
  const auto page = folder.file("index.html", sim::report::index_page(example()));
  Browser browser(folder.path);
  for (const bool phone : {false, true}) {
    browser.window(phone ? 390 : 1280, 800, phone);
    browser.open(page);
    const auto order = [&] {
      return browser.evaluate("[...document.querySelectorAll('tbody th a')].map(a => a.textContent).join()")
          .get<std::string>();
    };
    const auto sorted = [&](int column) {
      return browser
          .evaluate(
              fmt::format("document.querySelectorAll('thead th')[{}].getAttribute('aria-sort')", column))
          .get<std::string>();
    };
    const auto click = [&](int column) {
      browser.evaluate(fmt::format("document.querySelectorAll('thead button')[{}].click(), 0", column));
    };
    EXPECT_EQ(order(), "line 2,line 10,line 1") << "as written";
    click(0);
    EXPECT_EQ(order(), "line 1,line 2,line 10") << "numbers in names count as numbers";
    EXPECT_EQ(sorted(0), "ascending");
    click(1);
    EXPECT_EQ(order(), "line 10,line 1,line 2") << "what failed comes first";
    EXPECT_EQ(sorted(0), "none");
    click(3);
    EXPECT_EQ(order(), "line 2,line 1,line 10") << "9, 12, 100 s";
    click(3);
    EXPECT_EQ(order(), "line 10,line 1,line 2");
    EXPECT_EQ(sorted(3), "descending");
    // A button takes the focus and the keys of one.
    EXPECT_EQ(browser.evaluate("document.querySelector('thead button').tabIndex"), 0);
    EXPECT_EQ(browser.evaluate("document.querySelector('thead button').tagName + "
                               "document.querySelector('thead button').type"),
              "BUTTONbutton");
    EXPECT_EQ(browser.evaluate("document.documentElement.scrollWidth <= window.innerWidth"), true);
    EXPECT_THAT(browser.complaints(), IsEmpty());
  }
}

}  // namespace
}  // namespace drycut
