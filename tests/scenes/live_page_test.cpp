// The page of a live line: operated, read, written and lost. Skipped where there is no Chromium or no
// three.js.
#include "tests/scenes/live_stand.hpp"
#include "tests/scenes/page_checks.hpp"
#include "tests/scenes/report_browser_scripts.hpp"

namespace drycut::live_page {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

TEST_F(LivePage, GoesBackAndOnFromThere) {
  Stand stand;
  stand.open();
  const auto advance = [&](const char* by, const char* until) {
    stand.look(fmt::format("drycut.link.ask({{advance: '{}'}})", by));
    EXPECT_TRUE(stand.becomes(fmt::format(
        "document.body.dataset.state === 'paused' && document.querySelector('#time').innerText === '{}'",
        until)));
  };
  const std::string poses = "JSON.stringify(drycut.machine.latest && [...drycut.machine.latest.poses])";
  stand.type("[data-name=\"web.speed\"] input.value", "60");
  stand.click("[data-name=\"panel.start\"] button");
  advance("1.5 s", "1.5000");
  const auto then = stand.look(poses);
  stand.type("[data-name=\"web.speed\"] input.value", "20");
  stand.key("e");
  advance("2 s", "3.5000");
  EXPECT_NE(stand.look(poses), then);

  // As it was, and marked: the emergency stop is not pressed, the web has its speed, nothing can be set.
  stand.type("#past-time", "1.5");
  EXPECT_TRUE(stand.becomes("document.body.dataset.past === 'on'"));
  EXPECT_TRUE(stand.becomes("document.querySelector('#time').innerText === '1.5000'"));
  EXPECT_EQ(stand.text("#state"), "past");
  EXPECT_EQ(stand.text("#past-ago"), "2.00 s ago");
  EXPECT_EQ(stand.look(poses), then);
  EXPECT_EQ(stand.look("document.querySelector('.stop').getAttribute('aria-pressed')"), "false");
  EXPECT_EQ(stand.look("document.querySelector('[data-name=\"web.speed\"] input.value').value"), "60");
  EXPECT_EQ(stand.look("document.querySelector('#page-panel').inert"), true);
  stand.look("(async () => { window.refused = await drycut.link.act({set: {'panel.start': 0}}); })()");
  EXPECT_TRUE(stand.becomes("window.refused?.[0]?.what.includes('past')"));
  EXPECT_EQ(stand.look("drycut.news.time"), 3.5);

  // Drawn by the bar; the values that are in sight come with it.
  stand.click("#tab-values");
  EXPECT_TRUE(stand.becomes("drycut.values.wanted.length > 5"));
  stand.look(
      "(() => { const bar = document.querySelector('#past-bar'); for (const time of [3, 2.5, 0.7]) { "
      "bar.value = time; bar.dispatchEvent(new Event('input', {bubbles: true})); } })()");
  EXPECT_TRUE(stand.becomes("document.querySelector('#time').innerText === '0.7000'"));
  EXPECT_TRUE(
      stand.becomes("document.querySelector('#values li:not([hidden]) .value').textContent !== '\u2013'"));

  // The present again, by a key.
  stand.key("Escape");
  EXPECT_TRUE(stand.becomes("document.body.dataset.past === 'off'"));
  EXPECT_TRUE(stand.becomes("document.querySelector('#time').innerText === '3.5000'"));
  EXPECT_EQ(stand.look("document.querySelector('.stop').getAttribute('aria-pressed')"), "true");
  // What is no time of the run is told.
  stand.type("#past-time", "soon");
  EXPECT_THAT(stand.text("#say"), HasSubstr("soon"));
  stand.type("#past-time", "99");
  EXPECT_TRUE(stand.becomes("document.querySelector('#say').innerText.includes('has not come to')"));
  EXPECT_EQ(stand.look("document.body.dataset.past"), "off");

  // From there on it is another run.
  stand.type("#past-time", "1.5");
  EXPECT_TRUE(stand.becomes("document.body.dataset.past === 'on'"));
  stand.click("#past-go-on");
  EXPECT_TRUE(stand.becomes("drycut.line.run === 2 && drycut.news.run === 2"));
  EXPECT_TRUE(stand.becomes("document.body.dataset.past === 'off'"));
  EXPECT_TRUE(stand.becomes("document.querySelector('#time').innerText === '1.5000'"));
  EXPECT_EQ(stand.look(poses), then);
  EXPECT_EQ(stand.look("document.querySelector('.stop').getAttribute('aria-pressed')"), "false");
  advance("100 ms", "1.6000");
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

TEST_F(LivePage, PanelGoesByWhatTheScenarioSays) {
  Stand stand;
  stand.open();
  // Push buttons are named, speeds reach what the scenario's own value is, though the web stands.
  EXPECT_EQ(stand.text("[data-name=\"panel.acknowledge\"] .kind"), "push button");
  EXPECT_EQ(stand.text("[data-name=\"panel.start\"] .kind"), "switch");
  EXPECT_EQ(stand.look("Number(document.querySelector('[data-name=\"web.speed\"] input[type=range]').max)"),
            200);
  // Changes take as long as one says, with a comma or a unit too; what is no time is told.
  stand.type("#ramp", "soon");
  stand.type("[data-name=\"web.speed\"] input.value", "0.6 m/s");
  EXPECT_TRUE(stand.becomes(
      "document.querySelector('[data-name=\"web.speed\"] .problem').innerText.includes('soon')"));
  stand.type("#ramp", "0,5");
  stand.type("[data-name=\"web.speed\"] input.value", "0.6 m/s");
  stand.click("#step");
  EXPECT_TRUE(
      stand.becomes("document.querySelector('#events').textContent.includes('-> 0.6 m/s over 0.5 s')"));
  // Names of values are there in full.
  stand.click("#tab-values");
  EXPECT_THAT(stand.look("[...document.querySelectorAll('#values .name')].filter((one) => one.scrollWidth > "
                         "one.clientWidth + 1).map((one) => one.textContent)"),
              IsEmpty());
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
  for (const auto& window : {Window{1280, 720, false}, Window{820, 1180, false}, Window{390, 844, true}}) {
    stand.browser->window(window.width, window.height, window.phone);
    stand.open();
    for (const auto* scheme : {"light", "dark"}) {
      stand.browser->media(scheme);
      for (const auto* tab : {"panel", "program", "values", "events", "checks", "faults"}) {
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

TEST_F(LivePage, BeginsAnewWithAnotherProcess) {
  Stand stand;
  stand.open();
  stand.click("[data-name=\"panel.start\"] button");
  stand.click("#step");
  EXPECT_TRUE(stand.becomes("document.querySelector('#events b') !== null && drycut.scope.traces.count > 0"));
  const auto keeps = [&](const char* process) {
    return stand.look(
        fmt::format("(() => {{ drycut.link.take({{line: {{...drycut.line, process: {}}}}}); return "
                    "[document.querySelector('#events b') !== null, drycut.scope.traces.count > 0]; }})()",
                    process));
  };
  EXPECT_EQ(keeps("drycut.line.process"), json::parse("[true, true]"));
  EXPECT_EQ(keeps("'another'"), json::parse("[false, false]"));
}

}  // namespace
}  // namespace drycut::live_page
