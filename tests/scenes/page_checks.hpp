#pragma once
// What a page owes to readers with weak eyes, with none, and without a mouse, asked of the page itself in a
// browser, as it stands in its present window and colours. Each script gives a list of what is wrong.

#include <string>
#include <vector>

#include "tests/scenes/browser.hpp"

namespace drycut {

/// Contrast by WCAG 2 of every text with what lies behind it: those below 4.5.
inline const char* const kFaintText = R"js((() => {
  const channels = text => {
    const numbers = text.match(/[\d.]+(e-?\d+)?/g).map(Number);
    const scale = text.startsWith("color(") ? 1 : 255;
    return {rgb: numbers.slice(0, 3).map(v => v / scale), alpha: numbers.length > 3 ? numbers[3] : 1};
  };
  const over = (top, below) => top.rgb.map((v, i) => top.alpha * v + (1 - top.alpha) * below[i]);
  const behind = one => {
    if (!one) return [1, 1, 1];
    const ground = channels(getComputedStyle(one).backgroundColor);
    return ground.alpha === 1 ? ground.rgb : over(ground, behind(one.parentElement));
  };
  const light = rgb => rgb.map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
                          .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const found = [], texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const one = texts.currentNode.parentElement;
    if (!texts.currentNode.data.trim() || one.closest("script, style") || one.getClientRects().length === 0) continue;
    const ground = behind(one), ink = over(channels(getComputedStyle(one).color), ground);
    const [low, high] = [light(ground), light(ink)].sort((a, b) => a - b);
    if ((high + 0.05) / (low + 0.05) < 4.5) found.push(texts.currentNode.data.trim().slice(0, 40));
  }
  return found;
})())js";

/// What a screen reader cannot name: pictures, films and drawings without a text in their place, controls
/// without a name; a page without title, language or order of headings.
inline const char* const kNameless = R"js((() => {
  const found = [], shown = one => one.getClientRects().length > 0 && !one.closest("[aria-hidden=true]");
  const told = one => one.getAttribute("aria-label")?.trim() || one.getAttribute("title")?.trim() ||
      (one.getAttribute("aria-labelledby") ?? "").split(" ").some(id => document.getElementById(id)?.textContent.trim());
  const piece = one => one.outerHTML.slice(0, 80);
  if (!document.documentElement.lang) found.push("no language");
  if (!document.title.trim()) found.push("no title");
  for (const one of document.images)
    if (shown(one) && !one.alt.trim() && one.getAttribute("role") !== "presentation") found.push("picture " + piece(one));
  for (const one of document.querySelectorAll("canvas, svg")) {
    const of = one.closest("[aria-label], [aria-labelledby]");
    if (shown(one) && !(of && told(of)) && !one.querySelector("title")) found.push("drawing " + piece(one));
  }
  for (const one of document.querySelectorAll("video, audio, iframe, [role=region], [role=group], [role=img], nav"))
    if (shown(one) && !told(one)) found.push("nameless " + piece(one));
  for (const one of document.querySelectorAll("a[href], button, summary, [role=button], [role=link]"))
    if (shown(one) && !one.textContent.trim() && !told(one) && !one.querySelector("img[alt]:not([alt=''])"))
      found.push("control " + piece(one));
  for (const one of document.querySelectorAll("input:not([type=hidden]), select, textarea"))
    if (shown(one) && !one.labels?.length && !told(one)) found.push("field " + piece(one));
  let level = 0;
  for (const one of document.querySelectorAll("h1, h2, h3, h4, h5, h6")) {
    if (!shown(one)) continue;
    const own = Number(one.tagName[1]);
    if (own > level + 1) found.push("heading of level " + own + " behind " + level + ": " + one.textContent.trim());
    level = own;
  }
  return found;
})())js";

/// Links to places of the page that are not there, and names of places that two have.
inline const char* const kDeadAnchors = R"js((() => {
  const found = [], seen = new Set();
  for (const one of document.querySelectorAll("[id]")) {
    if (seen.has(one.id)) found.push("two are called " + one.id);
    seen.add(one.id);
  }
  for (const link of document.querySelectorAll("a[href^='#']")) {
    const to = decodeURIComponent(link.getAttribute("href").slice(1));
    if (to && !document.getElementById(to)) found.push("leads nowhere: #" + to);
  }
  return found;
})())js";

/// Everything a mouse can work, marked with a number, for the test's way through it by keyboard.
inline const char* const kMarkWorkable = R"js((() => {
  let count = 0;
  for (const one of document.querySelectorAll("a[href], button, summary, input, select, textarea, video[controls], [onclick], [tabindex], main *")) {
    const style = getComputedStyle(one);
    const scrolls = (/(auto|scroll)/.test(style.overflowX) && one.scrollWidth > one.clientWidth + 1) ||
                    (/(auto|scroll)/.test(style.overflowY) && one.scrollHeight > one.clientHeight + 1);
    const works = one.matches("a[href], button, summary, input, select, textarea, video[controls], [onclick], [tabindex]");
    if (!scrolls && !works) continue;
    if (one.disabled || one.tabIndex < 0 && works && one.hasAttribute("tabindex")) continue;
    if (one.getClientRects().length === 0 || style.visibility === "hidden" || style.pointerEvents === "none") continue;
    one.dataset.workable = count++;
  }
  document.activeElement?.blur();
  return count;
})())js";

/// The number of what has the focus and whether one sees that it has; what stands outside has none.
inline const char* const kFocused = R"js((() => {
  const one = document.activeElement, style = one ? getComputedStyle(one) : null;
  if (!one || one === document.body) return {at: -1, seen: true, what: ""};
  return {at: Number(one.dataset.workable ?? -1), what: one.outerHTML.slice(0, 80),
          seen: one.tagName === "VIDEO" || style.boxShadow !== "none" ||
                (style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0)};
})())js";

/// What cannot be reached by the Tab key, or not seen to be reached.
inline std::vector<std::string> out_of_keyboards_reach(Browser& browser) {
  const auto count = browser.evaluate(kMarkWorkable).get<int>();
  std::vector<bool> reached(static_cast<std::size_t>(count), false);
  std::vector<std::string> found;
  int left = count;
  // The keys of a film's player are its own, several of them.
  for (int presses = 0; left > 0 && presses < 2 * count + 40; ++presses) {
    browser.key("Tab");
    const auto focused = browser.evaluate(kFocused);
    const int at = focused["at"];
    if (at < 0 || reached[static_cast<std::size_t>(at)]) continue;
    reached[static_cast<std::size_t>(at)] = true;
    --left;
    if (focused["seen"] == false)
      found.push_back("no sign of the focus: " + focused["what"].get<std::string>());
  }
  for (int i = 0; i < count; ++i) {
    if (reached[static_cast<std::size_t>(i)]) continue;
    found.push_back("not reached by Tab: " + browser
                                                 .evaluate("document.querySelector('[data-workable=\"" +
                                                           std::to_string(i) + "\"]').outerHTML.slice(0, 80)")
                                                 .get<std::string>());
  }
  browser.evaluate(
      "for (const one of document.querySelectorAll('[data-workable]')) delete one.dataset.workable");
  return found;
}

/// All of the above, in the present window and colours.
inline std::vector<std::string> hard_to_reach(Browser& browser) {
  std::vector<std::string> found;
  for (const char* script : {kFaintText, kNameless, kDeadAnchors})
    for (const auto& one : browser.evaluate(script)) found.push_back(one);
  for (auto& one : out_of_keyboards_reach(browser)) found.push_back(std::move(one));
  return found;
}

}  // namespace drycut
