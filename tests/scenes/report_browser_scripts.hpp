#pragma once
// What the tests of reports ask a page, in its own language.

namespace drycut {

/// True once the machine in 3-D shows, or says why it cannot; also on a page without one. Brings it into
/// sight.
inline const char* const kMachineStands = R"js((() => {
  const figure = document.getElementById("machine");
  if (!figure || figure.hidden) return true;
  figure.scrollIntoView();
  return Boolean(window.drycutView) || /cannot be shown/.test(figure.innerText);
})())js";

/// "all", or the first picture or film that cannot be shown. Waits for the film.
inline const char* const kPicturesLoaded = R"js((async () => {
  for (const image of document.images)
    if (!image.complete || image.naturalWidth === 0) return "picture " + image.alt;
  for (const film of document.querySelectorAll("video")) {
    if (film.readyState < 2 && !film.error)
      await new Promise(done => { film.onloadeddata = film.onerror = done; });
    if (film.error) return film.error.message;
    if (!(film.videoWidth > 0 && film.duration > 0)) return "an empty film";
  }
  return "all";
})())js";

/// Opens what is folded, as a reader would; or folds it again.
inline const char* const kUnfold =
    "for (const more of document.querySelectorAll('details')) more.open = true";
inline const char* const kFold = "for (const more of document.querySelectorAll('details')) more.open = false";

/// What stands out to the right of the window, or is cut off by a box that nobody can scroll.
inline const char* const kOverflow = R"js((() => {
  const found = [], width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > width) found.push("the page, " + document.documentElement.scrollWidth);
  for (const one of document.querySelectorAll("main *")) {
    if (one.getClientRects().length === 0 || one.closest("video")) continue;
    const style = getComputedStyle(one);
    if (style.overflowX === "hidden" && style.textOverflow !== "ellipsis" && one.scrollWidth > one.clientWidth + 1)
      found.push("cut off in " + one.outerHTML.slice(0, 80));
  }
  return found;
})())js";

/// Texts that could not be read on white paper.
inline const char* const kFaintOnPaper = R"js((() => {
  const found = [], texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const one = texts.currentNode.parentElement;
    if (!texts.currentNode.data.trim() || one.closest("script, style") || one.getClientRects().length === 0) continue;
    const rgb = getComputedStyle(one).color.match(/[\d.]+/g).slice(0, 3).map(Number);
    if (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2] > 120) found.push(texts.currentNode.data.trim().slice(0, 40));
  }
  return found;
})())js";

/// Axes of the plots to zoom that have less than two numbers, which tell no scale. Numbers of events are
/// whole: of few of them there may be one.
inline const char* const kAxesWithoutScale = R"js((() => {
  const found = [];
  for (const plot of window.drycutPlots ?? [])
    for (const view of plot.graphs) {
      const labels = axis => [...view.canvas.querySelectorAll(".dygraph-axis-label-" + axis)]
                                 .filter(label => label.textContent).length;
      if (!view.panel.lanes.length && labels("y") < 2) found.push("y of " + plot.plot.title);
      if (view === plot.graphs.at(-1) && !plot.counted && labels("x") < 2) found.push("x of " + plot.plot.title);
    }
  return found;
})())js";

inline const char* const kIsDark = R"js((() => {
  const rgb = getComputedStyle(document.body).backgroundColor.match(/\d+/g).slice(0, 3).map(Number);
  return rgb[0] + rgb[1] + rgb[2] < 200;
})())js";

/// On paper nobody scrolls or unfolds: what is not within the sheet's width or not shown at all, and plots
/// that are not there as pictures.
inline const char* const kClippedOnPaper = R"js((() => {
  const found = [], width = document.documentElement.clientWidth;
  for (const one of document.querySelectorAll("main *")) {
    const boxes = one.getClientRects();
    if (boxes.length === 0 || getComputedStyle(one).visibility === "hidden") continue;
    if (one.getBoundingClientRect().right > width + 1) found.push("outside: " + one.outerHTML.slice(0, 80));
    const style = getComputedStyle(one);
    if (style.overflowX !== "visible" && one.scrollWidth > one.clientWidth + 1)
      found.push("cut off in " + one.outerHTML.slice(0, 80));
  }
  for (const more of document.querySelectorAll("details"))
    for (const inside of more.children)
      if (inside.tagName !== "SUMMARY" && inside.checkVisibility({contentVisibilityAuto: true}) === false)
        found.push("folded: " + more.textContent.trim().slice(0, 40));
  for (const badge of document.querySelectorAll(".badge"))
    if (badge.getClientRects().length > 1 || badge.offsetHeight > 2 * parseFloat(getComputedStyle(badge).fontSize))
      found.push("broken: " + badge.textContent);
  for (const picture of document.querySelectorAll("figure.plot img"))
    if (picture.getClientRects().length === 0) found.push("no picture of " + picture.alt);
  if (document.querySelector(".live")?.getClientRects().length) found.push("plots to zoom");
  return found;
})())js";

/// (plot, share): a place in the window over the plot's last panel at that share of its width, the x that
/// stands there and how much of it a pixel is. Scrolls there.
inline const char* const kPlaceInPlot = R"js((number, share) => {
  const view = drycutPlots[number].graphs.at(-1), area = view.graph.getArea();
  view.canvas.scrollIntoView({block: "center"});
  const box = view.canvas.getBoundingClientRect(), x = Math.round(box.left + area.x + share * area.w);
  const range = view.graph.xAxisRange();
  return {x: x, y: Math.round(box.top + area.y + area.h / 2), at: view.graph.toDataXCoord(x - box.left),
          pixel: (range[1] - range[0]) / area.w};
})js";

/// (plot): of each plot whose x is that of this one and holds the cursor's place: where it is, whether a line
/// stands there in every panel, and the values beside the names.
inline const char* const kToldByCursor = R"js(number => {
  const moved = drycutPlots[number];
  const there = plot => plot.plot.xLabel === moved.plot.xLabel &&
      (plot === moved || (moved.at >= plot.range[0] && moved.at <= plot.range[1]));
  return drycutPlots.filter(there).map(plot => ({
    at: plot.at,
    time: plot.plot.xLabel === "time [s]",
    lines: plot.graphs.every(view => getComputedStyle(view.cursor).display === "block" &&
        Math.abs(parseFloat(view.cursor.style.left) - view.graph.toDomXCoord(moved.at)) < 0.5),
    values: Object.fromEntries(plot.graphs.flatMap(
        view => view.panel.curves.map((curve, i) => [curve.label, view.values[i].textContent])))
  }));
})js";

/// (plot): the stretch of x that each panel shows, and the numbers at the axis.
inline const char* const kRangesOfPlot = R"js(number => {
  const plot = drycutPlots[number];
  return {x: plot.graphs.map(view => view.graph.xAxisRange()),
          labels: [...plot.box.querySelectorAll(".dygraph-axis-label-x")].map(label => label.textContent)};
})js";

}  // namespace drycut
