// The page of a live line as its operators have it: served by the program, worked in a browser. Skipped where
// there is no Chromium or no three.js.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sim/live/line.hpp"
#include "sim/live/server.hpp"
#include "tests/scenes/browser.hpp"
#include "tests/scenes/report_browser_scripts.hpp"
#include "tests/test_folder.hpp"

namespace drycut {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace live = sim::live;

const auto* const three = "/usr/share/javascript/three/three.min.js";

/// A line with all that an operator's panel has, and nobody but the browser to work it.
constexpr auto* scenario = R"(extends: {}/scenes/rotary_knife_mc_emergency.yaml
timeline: []
checks:
  - {{name: never too fast, always: web.speed < 70}}
  - {{name: stands for ever, always: web.speed < 1}}
)";

/// A line that stands at time zero, as fast as it goes when it is run, its server and a browser on its page.
class Stand {
 public:
  Stand() {
    Problems problems;
    line_.emplace(
        live::Line::Options{
            folder_.file("line.yaml", fmt::format(scenario, source_root.string())), {}, 0, false, {}},
        problems);
    EXPECT_EQ(lines_of(problems), "");
    serve(0);
    work_ = std::thread([this] {
      line_->run([this](auto news) { tell(std::move(news)); },
                 [this](auto description) { describe(std::move(description)); });
    });
    browser.emplace(folder_.path);
    browser->window(1280, 720);
  }
  ~Stand() {
    line_->stop();
    work_.join();
  }
  Stand(const Stand&) = delete;
  Stand& operator=(const Stand&) = delete;

  void serve(std::uint16_t port) {
    auto server = std::make_unique<live::Server>(live::Server::Options{"127.0.0.1", port, ""}, *line_);
    const std::lock_guard lock(mutex_);
    server_ = std::move(server);
    if (described_) server_->describe(described_);
  }
  std::uint16_t leave() {
    const std::lock_guard lock(mutex_);
    const auto port = server_->port();
    server_.reset();
    return port;
  }

  void open() {
    browser->visit(server_->url());
    EXPECT_TRUE(becomes("window.drycut?.news && drycut.machine.frames > 0"));
  }
  json look(const std::string& script) { return browser->evaluate(script); }
  /// Waits until that is true; false if it does not come.
  bool becomes(const std::string& condition) {
    return look("new Promise((done) => { let left = 4000; const look = () => (" + condition +
                ") ? done(true) : --left ? setTimeout(look, 20) : done(false); look(); })") == true;
  }
  void click(const std::string& selector) { look("document.querySelector('" + selector + "').click()"); }
  /// As typed, and Enter.
  void type(const std::string& selector, const std::string& text) {
    look("(() => { const field = document.querySelector('" + selector + "'); field.focus(); field.value = '" +
         text +
         "'; field.dispatchEvent(new Event('input', {bubbles: true})); "
         "field.dispatchEvent(new Event('change', {bubbles: true})); "
         "field.dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter', bubbles: true})); })()");
  }
  void key(const std::string& key) {
    look(
        "(() => { document.activeElement?.blur(); document.body.dispatchEvent(new KeyboardEvent('keydown', "
        "{key: '" +
        key + "', bubbles: true})); })()");
  }
  std::string text(const std::string& selector) {
    return look("document.querySelector('" + selector + "').innerText");
  }

  TestFolder folder_;
  std::optional<Browser> browser;

 private:
  void tell(std::shared_ptr<const live::News> news) {
    const std::lock_guard lock(mutex_);
    if (server_) server_->tell(std::move(news));
  }
  void describe(std::shared_ptr<const live::LineDescription> description) {
    const std::lock_guard lock(mutex_);
    described_ = description;
    if (server_) server_->describe(std::move(description));
  }

  std::optional<live::Line> line_;
  std::mutex mutex_;
  std::shared_ptr<const live::LineDescription> described_;
  std::unique_ptr<live::Server> server_;
  std::thread work_;
};

class LivePage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!Browser::is_installed()) GTEST_SKIP() << "chromium is not installed";
    if (!std::filesystem::exists(three)) GTEST_SKIP() << "libjs-three is not installed";
  }
};

TEST_F(LivePage, IsWorkedAsAnOperatorWould) {
  Stand stand;
  stand.open();
  EXPECT_EQ(stand.text("#state"), "paused");
  EXPECT_EQ(stand.text("#time"), "0.0000");

  // A millisecond, and not more.
  stand.click("#step");
  EXPECT_TRUE(stand.becomes("document.querySelector('#time').innerText === '0.0010'"));
  stand.key(".");
  EXPECT_TRUE(stand.becomes("document.querySelector('#time').innerText === '0.0020'"));

  // Start: the switch stays, the lamp comes on. While the line stands still it says when it will act.
  stand.click("[data-name=\"panel.start\"] button");
  EXPECT_TRUE(
      stand.becomes("document.querySelector('[data-name=\"panel.start\"] [aria-pressed=true]') !== null"));
  stand.key(" ");
  EXPECT_TRUE(stand.becomes("document.body.dataset.state === 'running'"));
  EXPECT_TRUE(stand.becomes("document.querySelector('.lamp.on')?.innerText.startsWith('in sync')"));

  // The line's speed: by number, then by slider; a ramp; what cannot be is told where it was typed.
  const std::string speed = "[data-name=\"web.speed\"] ";
  stand.type(speed + "input.value", "5000");
  EXPECT_TRUE(stand.becomes("document.querySelector('[data-name=\"web.speed\"] .problem').innerText !== ''"));
  stand.type(speed + "input.value", "30");
  EXPECT_TRUE(
      stand.becomes("Math.abs(drycut.news.values[drycut.line.targets.findIndex((one) => "
                    "one.name === 'web.speed')] - 30) < 1e-9"));
  EXPECT_EQ(stand.look("document.querySelector('[data-name=\"web.speed\"] .problem').hidden"), true);
  stand.type("#ramp", "0.5");
  stand.type(speed + "input[type=range]", "60");
  EXPECT_TRUE(
      stand.becomes("Math.abs(drycut.news.values[drycut.line.targets.findIndex((one) => "
                    "one.name === 'web.speed')] - 60) < 1e-9"));

  // To the next cut, and there it stands.
  stand.type("#event", "cut");
  EXPECT_TRUE(stand.becomes("document.body.dataset.state === 'paused'"));
  EXPECT_TRUE(stand.becomes("document.querySelector('#events b')?.innerText === 'cut'"));

  // The check that a running line breaks is told as broken, the other one not.
  EXPECT_TRUE(stand.becomes("document.querySelector('#checks-mark').innerText === '1'"));
  EXPECT_EQ(
      stand.look(
          "[...document.querySelectorAll('#checks .badge')].slice(0, 2).map((badge) => badge.textContent)"),
      json::parse(R"(["PASS", "FAIL"])"));
  EXPECT_GE(stand.look("document.querySelectorAll('#drives .load').length"), 5);

  // The emergency stop, and up again.
  stand.key("e");
  EXPECT_TRUE(stand.becomes("document.querySelector('.stop[aria-pressed=true]') !== null"));
  stand.click("#run");
  EXPECT_TRUE(stand.becomes("document.querySelector('.lamp.bad.on')?.innerText.startsWith('fault')"));
  stand.click(".stop");
  EXPECT_TRUE(stand.becomes("document.querySelector('.stop[aria-pressed=false]') !== null"));

  // From zero: another run, with its panel as it was in the beginning.
  stand.click("#run");
  EXPECT_TRUE(stand.becomes("document.body.dataset.state === 'paused'"));
  stand.click("#restart");
  EXPECT_TRUE(stand.becomes("drycut.line.run === 2 && drycut.news.run === 2"));
  EXPECT_TRUE(stand.becomes("document.querySelector('#time').innerText === '0.0000'"));
  EXPECT_TRUE(
      stand.becomes("document.querySelector('[data-name=\"panel.start\"] [aria-pressed=false]') !== null"));
  EXPECT_EQ(stand.look("document.querySelector('#events').children.length"), 0);
  EXPECT_THAT(stand.browser->complaints(), IsEmpty());
}

TEST_F(LivePage, ShowsAndWritesValuesAndFaults) {
  Stand stand;
  stand.open();
  // A push button is on while it is pressed.
  const std::string button = "document.querySelector('[data-name=\"panel.acknowledge\"] button')";
  stand.look(button + ".dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter', bubbles: true}))");
  EXPECT_TRUE(stand.becomes(button + ".getAttribute('aria-pressed') === 'true'"));
  stand.look(button + ".dispatchEvent(new KeyboardEvent('keyup', {key: 'Enter', bubbles: true}))");
  EXPECT_TRUE(stand.becomes(button + ".getAttribute('aria-pressed') === 'false'"));

  // Values: found by name, told as they are, written; what is refused is told below.
  stand.key("/");
  stand.type("#value-search", "failure");
  const std::string row = "document.querySelector('#values [data-name=failure]')";
  EXPECT_TRUE(stand.becomes(row + ".querySelector('.value').textContent === '0'"));
  EXPECT_EQ(
      stand.look("[...document.querySelectorAll('#values li')].filter((one) => !one.hidden).every((one) => "
                 "one.dataset.name.includes('failure'))"),
      true);
  stand.click("#values [data-name=failure] .value");
  stand.type("#values [data-name=failure] input", "much");
  EXPECT_TRUE(stand.becomes(row + ".querySelector('.problem').innerText.includes('much')"));
  stand.type("#values [data-name=failure] input", "7");
  EXPECT_TRUE(stand.becomes(row + ".querySelector('button.value')?.textContent === '7'"));

  // Faults: injected with their unit; a value out of range is refused.
  stand.click("#tab-faults");
  stand.look(
      "(() => { const choice = document.querySelector('#fault-component'); choice.value = 'web.wheel'; "
      "choice.dispatchEvent(new Event('change')); })()");
  stand.type("[data-name=\"web.wheel.slip\"] input", "500");
  EXPECT_TRUE(
      stand.becomes("document.querySelector('[data-name=\"web.wheel.slip\"] .problem').innerText !== ''"));
  stand.type("[data-name=\"web.wheel.slip\"] input", "5");
  EXPECT_TRUE(stand.becomes("document.querySelector('#fault-log li') !== null"));
  EXPECT_THAT(stand.text("#fault-log"), HasSubstr("web.wheel.slip = 5 %"));
  EXPECT_THAT(stand.browser->complaints(), IsEmpty());
}

TEST_F(LivePage, TriggersOnAnEdge) {
  Stand stand;
  stand.open();
  stand.look("(() => { for (const name of drycut.scope.wanted) drycut.scope.remove(name); })()");
  stand.type("#pick", "web.position");
  EXPECT_EQ(stand.look("drycut.scope.wanted"), json::parse(R"(["web.position"])"));
  EXPECT_TRUE(stand.becomes("drycut.scope.traces.count > 0"));  // it is sampled from now on
  // Set, the level is crossed once: at half a metre.
  const auto choose = [&](const char* id, const char* value) {
    stand.look(
        fmt::format("(() => {{ const one = document.querySelector('#{}'); one.value = '{}'; "
                    "one.dispatchEvent(new Event('change')); }})()",
                    id, value));
  };
  choose("trigger-mode", "single");
  choose("trigger-level", "500");
  choose("scope-width", "0.5");
  stand.click("[data-name=\"panel.start\"] button");
  stand.type("[data-name=\"web.speed\"] input.value", "60");
  stand.look("drycut.link.ask({advance: '3 s'})");
  EXPECT_TRUE(stand.becomes("document.querySelector('#trigger-state').innerText.startsWith('triggered at')"));
  EXPECT_TRUE(stand.becomes("document.body.dataset.state === 'paused'"));
  const double found = stand.look("drycut.scope.trigger.found");
  EXPECT_GE(stand.look(fmt::format("drycut.scope.traces.at('web.position', {})", found)).get<double>(), 500);
  EXPECT_LT(
      stand.look(fmt::format("drycut.scope.traces.at('web.position', {} - 0.011)", found)).get<double>(),
      500);
  // A quarter of the picture is before the edge.
  const auto shown = stand.look("drycut.scope.stretch()");
  EXPECT_NEAR(shown[0].get<double>(), found - 0.125, 1e-9);
  EXPECT_NEAR(shown[1].get<double>(), found + 0.375, 1e-9);
  // Cursors tell values, their difference and the time between.
  stand.key("c");
  EXPECT_TRUE(stand.becomes("document.querySelector('#cursor-times').innerText.includes('150 ms')"));
  const std::string cells =
      "[...document.querySelectorAll('#legend-rows td.number')].slice(1).map((cell) => "
      "Number(cell.innerText))";
  const auto values = stand.look(cells);
  EXPECT_NEAR(values[2].get<double>(), values[1].get<double>() - values[0].get<double>(), 0.02);
  EXPECT_GT(values[2].get<double>(), 50);
  EXPECT_THAT(stand.browser->complaints(), IsEmpty());
}

TEST_F(LivePage, CanBeReadOnDeskTabletAndPhoneByDayAndNight) {
  struct Window {
    int width, height;
    bool phone;
  };
  Stand stand;
  for (const auto& window : {Window{1280, 720, false}, Window{768, 1024, false}, Window{390, 844, true}}) {
    stand.browser->window(window.width, window.height, window.phone);
    stand.open();
    for (const auto* scheme : {"light", "dark"}) {
      stand.browser->media(scheme);
      for (const auto* tab : {"panel", "values", "events", "checks", "faults"}) {
        SCOPED_TRACE(fmt::format("{} wide, {}, {}", window.width, scheme, tab));
        stand.click(std::string("#tab-") + tab);
        EXPECT_THAT(stand.look(kFaintText), IsEmpty());
        EXPECT_LE(stand.look("document.documentElement.scrollWidth"), window.width);
        EXPECT_THAT(
            stand.look(
                "[...document.querySelectorAll('button, input, select')].filter((one) => "
                "one.checkVisibility({visibilityProperty: true}) && !one.innerText && !one.labels?.length && "
                "!one.getAttribute('aria-label')).map((one) => one.outerHTML.slice(0, 90))"),
            IsEmpty());
      }
    }
  }
  // The switch outdoes the system, and the browser keeps it.
  const auto is_dark = stand.look(kIsDark);
  stand.click("#theme");
  EXPECT_NE(stand.look(kIsDark), is_dark);
  stand.open();
  EXPECT_NE(stand.look(kIsDark), is_dark);
}

TEST_F(LivePage, ComesBackByItself) {
  Stand stand;
  stand.open();
  EXPECT_EQ(stand.look("document.querySelector('#lost').hidden"), true);
  const auto port = stand.leave();
  EXPECT_TRUE(
      stand.becomes("!document.querySelector('#lost').hidden && document.querySelector('#work').inert"));
  stand.serve(port);
  EXPECT_TRUE(stand.becomes("document.querySelector('#lost').hidden"));
  stand.click("#step");
  EXPECT_TRUE(stand.becomes("document.querySelector('#time').innerText === '0.0010'"));
}

}  // namespace
}  // namespace drycut
