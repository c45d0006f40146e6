/* global View */
// The machine in 3-D beside the plots of a report: it stands where it was at the time of their cursor, and played it
// takes the cursor along. Nothing is unpacked before one sees it.
"use strict";
(function () {
  const figure = document.getElementById("machine");
  const sources = ["library", "machine", "motion"].map((name) => document.getElementById("view-" + name));
  if (!figure || sources.some((source) => !source)) return;
  const caption = figure.querySelector("figcaption");

  function make(parent, name, kind, properties) {
    const made = Object.assign(document.createElement(name), { className: kind }, properties);
    parent.append(made);
    return made;
  }
  const called = (element, name) => {
    element.setAttribute("aria-label", name);
    return element;
  };

  // ---- what stands there until then: a frame of the film and a button ----
  const stage = make(figure, "div", "view-stage", {});
  const poster = document.querySelector(".strip img");
  if (poster) make(stage, "img", "view-poster", { src: poster.src, alt: poster.alt });
  const notice = make(stage, "p", "view-notice", {});
  notice.setAttribute("role", "status");
  const starter = make(stage, "button", "view-start", { type: "button", textContent: "Show in 3-D" });
  const holder = make(stage, "div", "view-holder", { hidden: true });
  const bar = make(stage, "div", "view-bar", { hidden: true });
  bar.setAttribute("role", "group");
  called(bar, "Views");
  const controls = make(figure, "div", "view-controls", { hidden: true });
  const player = called(make(controls, "button", "view-play", { type: "button" }), "Play");
  const slider = called(make(controls, "input", "", { type: "range", min: 0, max: 1, step: "any" }), "Time");
  const clock = make(controls, "output", "", {});
  const pace = called(make(controls, "select", "", {}), "Speed");
  for (const [value, text] of [[0.01, "1/100"], [0.05, "1/20"], [0.25, "1/4"], [1, "1 ×"], [4, "4 ×"], [16, "16 ×"]])
    make(pace, "option", "", { value, textContent: text, selected: value === 1 });
  figure.append(caption);
  figure.hidden = false;

  // ---- unpacking ----
  async function unpacked(source) {
    const text = atob(source.textContent), bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    source.remove();
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
  }

  // Differences of whole numbers, column by column, to what they stand for.
  function column(steps, columns, unit) {
    const numbers = new Float64Array(steps.length);
    for (let i = 0; i < steps.length; ++i) numbers[i] = steps[i] + (i < columns ? 0 : numbers[i - columns]);
    return numbers.map((whole) => whole * unit);
  }
  function readTrack(track) {
    const times = column(track.times, 1, 1e-6), rows = times.length, keys = new Float64Array(rows * View.numbersAPart);
    let first = 0;
    for (const [name, width, unit] of [["places", 3, 1e-5], ["turns", 4, 1e-5], ["scales", 3, 1e-5]]) {
      const numbers = column(track[name], width, unit);
      for (let row = 0; row < rows; ++row)
        for (let n = 0; n < width; ++n)
          keys[row * View.numbersAPart + first + n] = numbers[(numbers.length > width ? row * width : 0) + n];
      first += width;
    }
    for (let at = 3; at < keys.length; at += View.numbersAPart) {
      const length = Math.hypot(keys[at], keys[at + 1], keys[at + 2], keys[at + 3]);
      for (let n = 0; n < 4; ++n) keys[at + n] /= length;
    }
    return { times, keys };
  }

  // First row whose time is later than `at`.
  function after(times, at) {
    let low = 0, high = times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] <= at) low = middle + 1; else high = middle;
    }
    return low;
  }

  // ---- the run ----
  let view = null, motion = null, now = 0, playing = false, lastTick = null;

  function posesAt(at) {
    const size = View.numbersAPart, poses = new Float32Array(motion.tracks.length * size);
    motion.tracks.forEach(({ times, keys }, part) => {
      const next = Math.min(after(times, at), times.length - 1), before = Math.max(0, after(times, at) - 1);
      const stretch = times[next] - times[before];
      const share = stretch > 0 ? Math.min(1, Math.max(0, (at - times[before]) / stretch)) : 1;
      View.between(keys, before * size, keys, next * size, share, poses, part * size);
    });
    return poses;
  }

  /// The machine at that time; `told`: the plots know already.
  function go(at, told) {
    now = Math.min(motion.until, Math.max(motion.from, at));
    view.show(posesAt(now));
    slider.value = now;
    slider.setAttribute("aria-valuetext", now.toFixed(3) + " s");
    clock.textContent = now.toFixed(3) + " s";
    if (!told) window.drycutPoint?.("time [s]", now);
  }

  function play(on) {
    playing = on;
    lastTick = null;
    player.textContent = on ? "❚❚" : "▶";
    called(player, on ? "Pause" : "Play");
    if (on && now >= motion.until) go(motion.from, false);
  }

  function tick(at) {
    if (!playing) return;
    const gone = lastTick === null ? 0 : (at - lastTick) / 1000;
    lastTick = at;
    go(now + gone * Number(pace.value), false);
    if (now >= motion.until) play(false);
  }

  async function start() {
    if (start.begun) return;
    start.begun = true;
    starter.hidden = true;
    notice.textContent = "…";
    try {
      if (typeof DecompressionStream === "undefined") throw new Error("this browser is too old for it");
      const [library, machine, motionBytes] = await Promise.all(sources.map(unpacked));
      make(document.head, "script", "", { textContent: new TextDecoder().decode(library) });
      motion = JSON.parse(new TextDecoder().decode(motionBytes));
      motion.tracks = motion.tracks.map(readTrack);
      holder.hidden = bar.hidden = false;
      view = new View(holder, bar, tick);
      await view.load(machine, motion.parts);
    } catch (error) {
      holder.hidden = bar.hidden = true;
      notice.textContent = `The machine cannot be shown in 3-D: ${error.message}.`;
      return;
    }
    notice.remove();
    stage.querySelector(".view-poster")?.remove();
    slider.min = motion.from;
    slider.max = motion.until;
    controls.hidden = false;
    play(false);
    const pointed = start.pointed ?? motion.from;
    go(pointed, true);
    window.drycutView = { view, go, play, get now() { return now; }, get playing() { return playing; }, motion, posesAt };
  }

  starter.onclick = start;
  player.onclick = () => play(!playing);
  slider.oninput = () => {
    play(false);
    go(Number(slider.value), false);
  };
  // Space plays wherever the figure has the keys, but for its buttons, where it presses them.
  figure.addEventListener("keydown", (event) => {
    if (event.key !== " " || !motion || event.target.closest("button, select")) return;
    event.preventDefault();
    play(!playing);
  });
  // The cursor of the plots. While it plays, the mouse on its way over a plot changes nothing, a press does.
  document.addEventListener("drycut-point", (event) => {
    const { label, at, pressed } = event.detail;
    if (label !== "time [s]") return;
    start.pointed = at;
    if (!view?.poses) return;
    if (playing && !pressed) return event.preventDefault();
    if (playing) play(false);
    go(at, true);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => view?.paint());
  // Once the page stands and the figure is seen.
  const seen = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    seen.disconnect();
    (window.requestIdleCallback ?? setTimeout)(start);
  }, { threshold: 0.3 });
  seen.observe(stage);
})();
