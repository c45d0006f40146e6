// The page of a live line: what comes over the wire goes to its parts, what one does here goes to the line.
import { by, icon, make, memory, words } from "./live_dom.js";
import { Link } from "./live_link.js";
import { Machine } from "./live_machine.js";
import { Scope } from "./live_scope.js";
import { Panel } from "./live_panel.js";
import { Past } from "./live_past.js";
import { Program } from "./live_program.js";
import { Values } from "./live_values.js";
import { Events, Faults, Verdicts } from "./live_lists.js";

const tabs = ["panel", "scope", "program", "values", "events", "checks", "faults"];
let line = null, news = null;

const link = new Link({ line: takeLine, news: takeNews, samples: takeSamples }, connected);
const machine = new Machine();
const scope = new Scope(want);
const panel = new Panel(link);
const values = new Values(link, want, (name) => {
  if (!scope.add(name)) by("say").textContent = "the scope is full: take a curve away first";
});
const program = new Program(link, want);
const events = new Events((names) => by("events-known").replaceChildren(...names.map((name) => make("option", { value: name }))));
const verdicts = new Verdicts();
const faults = new Faults(link);
const past = new Past(link, () => ({ names: watched(), programs: program.open }), takePast, say);

function takeLine(told) {
  const anew = told.run !== line?.run || told.process !== line?.process;
  line = told;
  by("title").textContent = line.title || line.scenario;
  by("scenario").textContent = `${line.scenario} · run ${line.run}`;
  document.title = (line.title || line.scenario) + " · Drycut live";
  for (const part of [past, panel, program, values, events, verdicts, faults, scope]) part.line(line, anew);
  machine.line(line);
  wanted = "";
  want();
}

function takeNews(told) {
  news = told;
  if (!line || news.run !== line.run) return;
  for (const part of [events, faults, past]) part.news(news);
  if (past.time === null) for (const part of [machine, panel, program, values, verdicts]) part.news(news);
  else program.news({ ...news, programs: undefined, time: past.time });
  const failed = news.failure !== undefined;
  const state = failed ? "failed" : news.running ? "running" : "paused";
  if (document.body.dataset.state !== state) {
    document.body.dataset.state = state;
    by("run").replaceChildren(icon(state === "running" ? "pause" : "play"), state === "running" ? "Pause" : "Run");
    for (const id of ["run", "step", "until"]) by(id).disabled = failed;
  }
  tellTime();
  by("failure").hidden = !failed;
  if (failed) by("failure-text").textContent = news.failure;
  by("record-lost").hidden = news.record_lost === undefined;
  by("record-lost-text").textContent = news.record_lost ?? "";
  for (const button of by("pace").children)
    button.setAttribute("aria-pressed", String(Number(button.dataset.pace) === news.pace));
  tellLateness(news.late, news.pace);
}

/// The clock, of what is shown.
function tellTime() {
  const state = past.time === null ? document.body.dataset.state ?? "–" : "past";
  by("time").textContent = past.time === null ? news.time.toFixed(news.running ? 2 : 4) : past.time.toFixed(4);
  if (by("state").textContent !== state) by("state").textContent = state;
}

/// What was to be seen at a time that is past; null: the present again.
function takePast(seen) {
  scope.past(seen?.time ?? null);
  if (!news || !line) return;
  if (seen === null) return takeNews({ ...news, events: undefined });
  for (const part of [machine, panel, program, values, verdicts]) part.news(seen);
  for (const part of [program, values]) part.samples(seen);
  tellTime();
}

function tellLateness(late, pace) {
  const share = late.cycles > 0 ? (100 * late.late) / late.cycles : 0;
  const worst = (late.worst * 1000).toFixed(late.worst < 0.01 ? 1 : 0);
  const text = pace === 0 || late.cycles === 0 ? ""
    : late.dropped > 0 ? `too slow: ${late.dropped.toFixed(1)} s dropped`
    : `${share.toFixed(share < 10 ? 1 : 0)} % late, worst ${worst} ms`;
  if (by("late").textContent !== text) by("late").textContent = text;
  by("late").classList.toggle("bad", late.dropped > 0);
}

function takeSamples(samples) {
  scope.samples(samples);
  if (past.time !== null) return;
  program.samples(samples);
  values.samples(samples);
}
const watched = () => [...new Set([...program.wanted, ...values.wanted])];

// What is sampled for this page: the scope's curves every cycle, of the values in sight the latest. Told to the
// line once what chose it is done, and before anything that is done next: a step shows what was chosen before it.
let wanted = "", soon = false;
function want() {
  if (soon) return;
  soon = true;
  queueMicrotask(async () => {
    soon = false;
    if (!line) return;
    const sample = scope.wanted;
    const watch = watched();
    const programs = program.open;
    const text = JSON.stringify([sample, watch, programs]);
    if (text === wanted) return;
    wanted = text;
    past.again();
    say(await link.ask({ sample, watch, programs }));
  });
}

function connected(on) {
  document.body.dataset.link = on ? "on" : "off";
  by("lost").hidden = on;
  by("work").inert = !on;
  by("transport").inert = !on;
  by("past").inert = !on;
  if (!on) past.now();
}

/// What is wrong with a request that no field asked for.
function say(problems) {
  by("say").textContent = words(problems);
}

async function ask(what) {
  say(await link.ask(what));
}

const work = {
  run: () => ask({ run: !(news?.running ?? false) }),
  step: () => ask({ advance: "1 ms" }),
  until: () => ask({ until: by("event").value.trim() }),
  pace: (pace) => ask({ pace: pace === 0 ? "max" : pace }),
  async restart() {
    by("restart").disabled = true;
    await ask({ restart: true });
    by("restart").disabled = false;
  },
};

for (const id of ["run", "step", "until", "restart"]) by(id).onclick = work[id];
by("restart-failed").onclick = work.restart;
by("event").onkeydown = (event) => { if (event.key === "Enter") work.until(); };
for (const button of by("pace").children) button.onclick = () => work.pace(Number(button.dataset.pace));

// Tabs of the side; on a phone the scope is one of them.
function show(tab, focus = false) {
  document.body.dataset.tab = tab;
  memory.set("tab", tab);
  for (const name of tabs) {
    const button = by("tab-" + name);
    button.setAttribute("aria-selected", String(name === tab));
    button.tabIndex = name === tab ? 0 : -1;
    if (name !== "scope") by("page-" + name).hidden = name !== tab;
    if (name === tab && focus) button.focus();
  }
  want();
}
for (const name of tabs) by("tab-" + name).onclick = () => show(name);
by("tabs").onkeydown = (event) => {
  const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (!way) return;
  const open = tabs.filter((name) => by("tab-" + name).offsetParent !== null);
  show(open[(open.indexOf(document.body.dataset.tab) + way + open.length) % open.length], true);
};
const phone = matchMedia("(max-width: 699px)");
phone.onchange = () => { if (!phone.matches && document.body.dataset.tab === "scope") show("panel"); };
const first = memory.get("tab", "panel");
show(tabs.includes(first) && (first !== "scope" || phone.matches) ? first : "panel");

// Height of the machine beside the scope's.
const split = by("split");
function part(share) {
  const held = Math.min(0.8, Math.max(0.2, share));
  document.documentElement.style.setProperty("--split", held);
  split.setAttribute("aria-valuenow", Math.round(held * 100));
  memory.set("split", held);
}
part(memory.get("split", 0.55));
split.onpointerdown = (event) => split.setPointerCapture(event.pointerId);
split.onpointermove = (event) => {
  if (!split.hasPointerCapture(event.pointerId)) return;
  const { top, height } = by("left").getBoundingClientRect();
  part((event.clientY - top) / height);
};
split.onkeydown = (event) => {
  const way = { ArrowUp: -0.04, ArrowDown: 0.04 }[event.key];
  if (way) part(memory.get("split", 0.55) + way);
};

// Day and night: as the system has it, or as one chose.
const dark = matchMedia("(prefers-color-scheme: dark)");
function theme(chosen) {
  if (chosen) document.documentElement.dataset.theme = chosen;
  machine.paint();
  scope.paint();
}
dark.onchange = () => theme();
by("theme").onclick = () => {
  const now = document.documentElement.dataset.theme ?? (dark.matches ? "dark" : "light");
  const next = now === "dark" ? "light" : "dark";
  memory.set("theme", next);
  theme(next);
};
theme(memory.get("theme", null));

by("help").onclick = () => by("keys").showModal();

// A key alone; in a field or on a button it means what it means there.
const keys = {
  " ": work.run,
  ".": work.step,
  n: work.until,
  1: () => work.pace(0.1),
  2: () => work.pace(1),
  3: () => work.pace(10),
  4: () => work.pace(0),
  R: work.restart,
  e: () => {
    past.now();
    panel.emergency();
  },
  b: () => past.step(-1),
  B: () => past.step(1),
  Escape: () => past.now(),
  s: () => by("scope-hold").click(),
  c: () => by("scope-cursors").click(),
  t: () => by("trigger-arm").hidden || by("trigger-arm").click(),
  p: () => by("pick").focus(),
  l: () => (document.body.dataset.tab === "program" ? by("program-follow").click() : show("program")),
  "/": () => {
    show("values");
    by("value-search").focus();
  },
  "?": () => by("keys").showModal(),
};
document.addEventListener("keydown", (event) => {
  const { target } = event;
  if (event.ctrlKey || event.altKey || event.metaKey || target.closest("dialog")) return;
  if (target.closest("input:not([type=range]), select, textarea")) return;
  if (event.key === " " && target.closest("button, summary, input")) return;
  const does = keys[event.key];
  if (by("transport").inert && " .n1234R".includes(event.key)) return;
  if (!does || event.repeat || document.body.dataset.link !== "on") return;
  event.preventDefault();
  does();
});

// For those who look at the page from outside.
window.drycut = { machine, scope, panel, program, values, past, link, get news() { return news; }, get line() { return line; } };
