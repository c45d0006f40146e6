// The controller's programs on the page of a live line. Skipped where there is no Chromium or no three.js.
#include "tests/scenes/live_stand.hpp"

namespace drycut::live_page {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

using LiveProgramPage = LivePage;

TEST_F(LiveProgramPage, ShowsTheProgramWithWhatTheScanDidAndItsValues) {
  Stand stand;
  stand.open();
  stand.key("l");
  EXPECT_TRUE(stand.becomes("document.querySelectorAll('#code li').length > 150"));
  EXPECT_EQ(stand.text("#program-choice"), "rotary_knife.st");
  EXPECT_THAT(stand.text("#code li:first-child code"), HasSubstr("// Rotary knife"));
  EXPECT_EQ(stand.text("#code li:first-child .t-comment"), stand.text("#code li:first-child code"));
  EXPECT_EQ(stand.text("#code .t-keyword"), "TYPE");
  EXPECT_EQ(stand.look("document.querySelector('#program-legend').hidden"), true);

  // What a scan executed, as soon as there is one.
  stand.look("drycut.link.ask({advance: '20 ms'})");
  EXPECT_TRUE(stand.becomes("document.querySelectorAll('#code .ran').length > 20"));
  EXPECT_TRUE(stand.becomes("document.querySelectorAll('#code .idle').length > 2"));
  EXPECT_EQ(stand.look("document.querySelector('#program-legend').hidden"), false);
  EXPECT_THAT(stand.text("#code .idle code"), HasSubstr("IF"));

  // Search brings the declaration; its value is told there, and written.
  const auto press = [&](const char* key, bool shift) {
    stand.look(
        fmt::format("document.querySelector('#program-search').dispatchEvent(new KeyboardEvent('keydown', "
                    "{{key: '{}', shiftKey: {}, bubbles: true}}))",
                    key, shift));
  };
  stand.look(
      "(() => { const field = document.querySelector('#program-search'); field.value = 'WEB_AT_TOP'; "
      "field.dispatchEvent(new Event('input')); })()");
  EXPECT_THAT(stand.text("#program-found"), ::testing::StartsWith("1 of "));
  press("Enter", false);
  EXPECT_THAT(stand.text("#program-found"), ::testing::StartsWith("2 of "));
  press("Enter", true);
  EXPECT_THAT(stand.text("#program-found"), ::testing::StartsWith("1 of "));
  const std::string line = "document.querySelector('#code li.match.at')";
  EXPECT_THAT(stand.look(line + ".innerText").get<std::string>(), HasSubstr("WEB_AT_TOP : LREAL"));
  EXPECT_TRUE(stand.becomes(line + ".querySelector('.chip b').textContent === '4600000'"));
  stand.click("#code li.match.at button.chip");
  stand.type("#code li.match.at input", "much");
  EXPECT_TRUE(stand.becomes(line + ".querySelector('.problem')?.innerText.includes('much')"));
  stand.type("#code li.match.at input", "4.7e6");
  EXPECT_TRUE(stand.becomes(line + ".querySelector('button.chip b')?.textContent === '4700000'"));
  EXPECT_TRUE(stand.becomes(line + ".querySelector('.problem') === null"));
  stand.click("#step");
  EXPECT_TRUE(stand.becomes("drycut.news.time > 0.0205"));
  EXPECT_EQ(stand.look(line + ".querySelector('.chip b').textContent"), "4700000");
  press("Escape", false);
  EXPECT_EQ(stand.text("#program-found"), "");

  // Who looks elsewhere costs nothing.
  stand.click("#tab-panel");
  EXPECT_TRUE(stand.becomes("drycut.news.programs === undefined"));
  EXPECT_THAT(stand.browser->complaints(), IsEmpty());
}

TEST_F(LiveProgramPage, FollowsATaskToWhereItWaits) {
  Stand stand(fmt::format("extends: {}/scenes/rotary_knife.yaml\ntimeline: []\n", source_root.string()));
  stand.open();
  stand.click("#tab-program");
  EXPECT_TRUE(stand.becomes("drycut.news.programs !== undefined"));
  stand.look("drycut.link.ask({advance: '200 ms'})");
  EXPECT_TRUE(stand.becomes("document.querySelector('#code .here .task')?.innerText.includes('waits')"));
  EXPECT_THAT(stand.text("#code .here code"), HasSubstr("WAIT"));
  EXPECT_THAT(stand.text("#program-tasks button"), HasSubstr("waits"));
  const std::string in_sight =
      "(() => { const row = document.querySelector('#code .here').getBoundingClientRect(), "
      "code = document.querySelector('#code').getBoundingClientRect(); "
      "return row.top >= code.top - 1 && row.bottom <= code.bottom + 1; })()";
  EXPECT_TRUE(stand.becomes(in_sight));
  // Who scrolls is left alone, until he asks.
  stand.look(
      "(() => { const code = document.querySelector('#code'); code.dispatchEvent(new WheelEvent('wheel')); "
      "code.scrollTop = code.scrollHeight; })()");
  EXPECT_TRUE(stand.becomes("document.querySelector('#program-follow').ariaPressed === 'false'"));
  EXPECT_TRUE(stand.becomes("!" + in_sight));
  stand.click("#program-tasks button");
  EXPECT_TRUE(stand.becomes(in_sight));
  // The configuration is a text of its own, with its values.
  stand.look(
      "(() => { const choice = document.querySelector('#program-choice'); choice.value = '1'; "
      "choice.dispatchEvent(new Event('change')); })()");
  EXPECT_THAT(stand.text("#code"), HasSubstr("INTDEVICE"));
  EXPECT_TRUE(stand.becomes("document.querySelector('#code .chip b').textContent !== '–'"));
  EXPECT_THAT(stand.browser->complaints(), IsEmpty());
}

TEST_F(LiveProgramPage, ShowsThePowerOfAnInstructionListAndAnErrorAtItsLine) {
  {
    Stand stand(
        fmt::format("extends: {}/scenes/flying_saw_lx3vp.yaml\ntimeline: []\n", source_root.string()));
    stand.open();
    stand.click("#tab-program");
    EXPECT_TRUE(stand.becomes("drycut.news.programs !== undefined"));
    stand.look("drycut.link.ask({advance: '20 ms'})");
    EXPECT_TRUE(stand.becomes("document.querySelectorAll('#code .ran').length > 5"));
    EXPECT_TRUE(stand.becomes("document.querySelectorAll('#code .idle').length > 0"));
    EXPECT_EQ(stand.look("document.querySelector('#program-follow').disabled"), true);
    EXPECT_THAT(stand.browser->complaints(), IsEmpty());
  }
  Stand stand(
      "scene: {step: 1 ms, duration: 1 s}\nplants: {web: {type: web}}\n"
      "controller: {plcopen: {program: p.st, cycle: 1 ms}}\n",
      "PROGRAM p\nVAR d : DINT := 3; q : DINT; END_VAR\nd := d - 1;\nq := 8 / d;\nEND_PROGRAM\n");
  stand.open();
  stand.click("#tab-program");
  EXPECT_TRUE(stand.becomes("drycut.news.programs !== undefined"));
  stand.look("drycut.link.ask({advance: '20 ms'})");
  EXPECT_TRUE(stand.becomes("document.querySelector('#code [data-line=\"4\"] .said') !== null"));
  EXPECT_THAT(stand.text("#code [data-line=\"4\"] .said"), HasSubstr("error: "));
  EXPECT_TRUE(stand.becomes("document.querySelector('#code [data-line=\"4\"].here') !== null"));
  stand.click("#restart");
  EXPECT_TRUE(stand.becomes("drycut.line.run === 2"));
  EXPECT_TRUE(stand.becomes("document.querySelector('#code .said') === null"));
  EXPECT_THAT(stand.browser->complaints(), IsEmpty());
}

}  // namespace
}  // namespace drycut::live_page
