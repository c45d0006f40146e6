// The scope: which curves, how long, triggered by what; cursors; hold.
import { by, icon, make, memory, shown, typed } from "./live_dom.js";
import { Chart, curveCount } from "./live_chart.js";
import { Traces, Trigger } from "./live_traces.js";

const widths = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 60];  // [s]
const widthText = (width) => (width < 1 ? Math.round(width * 1000) + " ms" : width + " s");
const most = 120;  // channels that the picker offers at once

export class Scope {
  /// `changed`: told when other curves are wanted.
  constructor(changed) {
    this.changed = changed;
    this.traces = new Traces();
    this.trigger = new Trigger();
    this.chart = new Chart(by("curves"));
    this.channels = [];  // of the line
    this.curves = [];    // chosen: name, unit, hue
    this.cursors = [];
    this.width = memory.get("scope.width", 2);
    this.held = null;    // [from, until] while it is held
    this.pastTime = null;  // that is shown
    this.listen();
  }

  /// What a line of that scenario is first looked at with.
  line(line, anew) {
    this.channels = line.channels;
    this.scenario = line.scenario;
    if (anew) this.clear();
    const known = new Map(line.channels.map((channel) => [channel.name, channel]));
    const wished = memory.get("scope." + line.scenario, null) ?? this.firstChoice(line);
    this.curves = [];
    for (const name of wished) if (known.has(name)) this.addCurve(known.get(name));
    this.rebuild();
  }
  firstChoice(line) {
    const speeds = line.channels.filter((one) => /(^|\.)(speed|blade\.speed)$/.test(one.name)).slice(0, 2);
    const more = ["motor.torque", "cut.length", "posit"].flatMap((end) =>
      line.channels.filter((one) => one.name.endsWith("." + end)).slice(0, 1));
    return [...speeds, ...more].slice(0, 4).map((one) => one.name);
  }

  get wanted() {
    return this.curves.map((curve) => curve.name);
  }
  addCurve(channel) {
    const taken = this.curves.map((curve) => curve.hue);
    const hue = Array.from({ length: curveCount }, (_, i) => i).find((i) => !taken.includes(i));
    if (hue === undefined || this.wanted.includes(channel.name)) return false;
    this.curves.push({ name: channel.name, unit: channel.unit, hue });
    return true;
  }
  add(name) {
    const channel = this.channels.find((one) => one.name === name);
    if (channel && this.addCurve(channel)) this.chose();
    return this.wanted.includes(name);
  }
  remove(name) {
    this.curves = this.curves.filter((curve) => curve.name !== name);
    this.chose();
  }
  chose() {
    memory.set("scope." + this.scenario, this.wanted);
    this.rebuild();
  }

  /// Legend and trigger's sources anew.
  rebuild() {
    this.traces.want(this.wanted);
    const source = by("trigger-source");
    source.replaceChildren(...this.curves.map(({ name }) => make("option", { value: name, textContent: name })));
    if (!this.wanted.includes(this.trigger.source)) this.trigger.source = this.wanted[0] ?? "";
    source.value = this.trigger.source;
    by("legend-rows").replaceChildren(...this.curves.map((curve) => {
      const cell = () => make("td", { className: "number" });
      curve.cells = { now: cell(), a: cell(), b: cell(), d: cell() };
      const remove = make("button", { type: "button", className: "plain", title: "Take " + curve.name + " away",
        onclick: () => this.remove(curve.name) }, icon("close"));
      remove.setAttribute("aria-label", "Take " + curve.name + " away");
      return make("tr", {}, make("th", { scope: "row", title: curve.name }, make("i", { className: "swatch", style: `background: var(--curve-${curve.hue + 1})` }), curve.name),
        curve.cells.now, curve.cells.a, curve.cells.b, curve.cells.d,
        make("td", { textContent: curve.unit, className: "unit" }), make("td", {}, remove));
    }));
    by("scope-full").hidden = this.curves.length < curveCount;
    by("scope-empty").hidden = this.curves.length > 0;
    this.changed();
    this.stale = true;
  }

  clear() {
    this.traces.clear();
    this.trigger.arm();
    this.hold(false);
    this.stale = true;
  }

  samples(samples) {
    if (samples.names.length === 0) return;
    if (samples.times.at(-1) < this.traces.latest - 1e-9) this.clear();
    const begin = this.traces.push(samples);
    if (begin === this.traces.count) return;
    if (this.trigger.look(this.traces, begin, this.width)) this.tellTrigger();
    this.stale = true;
  }

  /// Shows the curves as they were around that time; null: the present.
  past(time) {
    this.pastTime = time;
    this.hold(false);
    if (time !== null) this.held = [time - 0.75 * this.width, time + 0.25 * this.width];
  }

  hold(on) {
    this.held = on ? this.stretch() : null;
    const button = by("scope-hold");
    button.setAttribute("aria-pressed", String(on));
    button.title = on ? "Go on (S)" : "Hold the picture (S)";
    this.stale = true;
  }
  stretch() {
    return this.held ?? this.trigger.stretch(this.traces, this.width);
  }

  tellTrigger() {
    const { mode, found, held } = this.trigger;
    const state = mode === "off" ? "" : held ? "triggered at " + found.toFixed(4) + " s"
      : found === null ? "waits for the edge" : "triggered";
    if (by("trigger-state").textContent !== state) by("trigger-state").textContent = state;
    by("trigger-arm").hidden = mode !== "single";
    for (const id of ["trigger-source", "trigger-edge", "trigger-level"]) by(id).disabled = mode === "off";
  }

  listen() {
    const { trigger } = this;
    const armed = () => {
      trigger.arm();
      this.tellTrigger();
      this.stale = true;
    };
    by("trigger-mode").onchange = (event) => {
      trigger.mode = event.target.value;
      this.hold(false);
      armed();
    };
    by("trigger-source").onchange = (event) => { trigger.source = event.target.value; armed(); };
    by("trigger-edge").onclick = (event) => {
      trigger.rising = !trigger.rising;
      event.currentTarget.replaceChildren(icon(trigger.rising ? "rising" : "falling"));
      event.currentTarget.setAttribute("aria-label", trigger.rising ? "Rising edge" : "Falling edge");
      armed();
    };
    by("trigger-level").onchange = (event) => {
      const level = Number(event.target.value);
      if (Number.isFinite(level) && event.target.value !== "") trigger.level = level;
      event.target.value = typed(trigger.level);
      armed();
    };
    by("trigger-arm").onclick = armed;

    const width = by("scope-width");
    width.replaceChildren(...widths.map((one) => make("option", { value: one, textContent: widthText(one) })));
    width.value = this.width;
    width.onchange = () => this.setWidth(Number(width.value));
    by("scope-narrow").onclick = () => this.zoom(-1);
    by("scope-wide").onclick = () => this.zoom(1);
    by("scope-hold").onclick = () => this.hold(this.held === null);
    by("scope-cursors").onclick = () => this.setCursors(this.cursors.length === 0);

    const { canvas } = this.chart;
    const near = (x) => this.cursors.find((cursor) => Math.abs(this.chart.xOf(cursor.time) - x) < 12);
    canvas.onpointerdown = (event) => {
      const cursor = near(event.offsetX);
      this.dragged = cursor ?? (this.held ? { pan: event.offsetX, held: [...this.held] } : null);
      if (this.dragged) canvas.setPointerCapture(event.pointerId);
    };
    canvas.onpointermove = (event) => {
      this.hover = event.pointerType === "mouse" ? event.offsetX : null;
      if (this.dragged?.held) {
        const by_ = this.chart.timeAt(this.dragged.pan) - this.chart.timeAt(event.offsetX);
        this.held = this.dragged.held.map((time) => time + by_);
      } else if (this.dragged) {
        this.dragged.time = Math.min(this.chart.until, Math.max(this.chart.from, this.chart.timeAt(event.offsetX)));
      }
      canvas.style.cursor = near(event.offsetX) ? "ew-resize" : this.held ? "grab" : "crosshair";
      this.stale = true;
    };
    canvas.onpointerup = canvas.onpointercancel = () => { this.dragged = null; };
    canvas.onpointerleave = () => { this.hover = null; this.stale = true; };
    canvas.addEventListener("wheel", (event) => { event.preventDefault(); this.zoom(Math.sign(event.deltaY)); }, { passive: false });
    canvas.onkeydown = (event) => this.key(event);
    new ResizeObserver(() => { this.stale = true; }).observe(canvas);
    this.tellTrigger();
    this.picker();
    this.draw();
  }

  /// Arrows move cursor A, with Shift B; without cursors the held picture.
  key(event) {
    const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (event.key === "+" || event.key === "-") this.zoom(event.key === "+" ? -1 : 1);
    else if (!way) return;
    else if (this.cursors.length > 0) this.cursors[event.shiftKey ? 1 : 0].time += (way * (this.chart.until - this.chart.from)) / 200;
    else if (this.held) this.held = this.held.map((time) => time + (way * this.width) / 10);
    event.preventDefault();
    this.stale = true;
  }

  setWidth(width) {
    this.width = width;
    memory.set("scope.width", width);
    by("scope-width").value = width;
    if (this.held) {
      const middle = (this.held[0] + this.held[1]) / 2;
      this.held = [middle - width / 2, middle + width / 2];
    }
    this.stale = true;
  }
  zoom(by_) {
    const at = widths.indexOf(this.width) + by_;
    if (at >= 0 && at < widths.length) this.setWidth(widths[at]);
  }

  setCursors(on) {
    const [from, until] = this.stretch();
    this.cursors = on ? [{ name: "A", time: from + 0.35 * (until - from) }, { name: "B", time: from + 0.65 * (until - from) }] : [];
    // They measure one picture.
    if (on && this.held === null) this.hold(true);
    by("scope-cursors").setAttribute("aria-pressed", String(on));
    by("legend").classList.toggle("measures", on);
    this.stale = true;
  }

  /// Searches channels; arrows and Enter, or the mouse, choose one.
  picker() {
    const field = by("pick"), list = by("pick-list");
    let offered = [], at = 0;
    const close = () => {
      list.hidden = true;
      field.setAttribute("aria-expanded", "false");
      field.removeAttribute("aria-activedescendant");
    };
    const mark = () => {
      [...list.children].forEach((item, i) => item.setAttribute("aria-selected", String(i === at)));
      list.children[at]?.scrollIntoView({ block: "nearest" });
      if (offered[at]) field.setAttribute("aria-activedescendant", "pick-" + at);
    };
    const choose = (i) => {
      if (!offered[i]) return;
      this.add(offered[i].name);
      field.value = "";
      close();
    };
    const offer = () => {
      const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
      offered = this.channels.filter(({ name }) => !this.wanted.includes(name) && words.every((word) => name.toLowerCase().includes(word))).slice(0, most);
      at = 0;
      list.replaceChildren(...offered.map(({ name, unit }, i) => make("li", { id: "pick-" + i, attributes: { role: "option" },
        onpointerdown: (event) => { event.preventDefault(); choose(i); } }, name, make("small", { textContent: unit }))));
      if (offered.length === 0) list.replaceChildren(make("li", { className: "none", textContent: "no such channel" }));
      list.hidden = false;
      field.setAttribute("aria-expanded", "true");
      mark();
    };
    field.oninput = field.onfocus = offer;
    field.onblur = close;
    field.onkeydown = (event) => {
      if (event.key === "ArrowDown" || event.key === "ArrowUp") {
        if (list.hidden) offer();
        else at = Math.max(0, Math.min(offered.length - 1, at + (event.key === "ArrowDown" ? 1 : -1)));
        mark();
      } else if (event.key === "Enter") choose(at);
      else if (event.key === "Escape") close();
      else return;
      event.preventDefault();
    };
  }

  paint() {
    this.chart.paint();
    this.stale = true;
  }

  draw() {
    requestAnimationFrame(() => this.draw());
    if (!this.stale || this.chart.canvas.clientHeight === 0) return;
    this.stale = false;
    const [from, until] = this.stretch();
    const cursors = [...this.cursors];
    if (cursors.length === 0 && this.hover !== null && this.hover !== undefined) cursors.push({ time: this.chart.timeAt(this.hover), name: "" });
    if (cursors.length === 0 && this.pastTime !== null) cursors.push({ time: this.pastTime, name: "" });
    this.chart.draw({ traces: this.traces, channels: this.curves, from, until, trigger: this.trigger, cursors });
    this.legend(cursors);
    this.tellTrigger();
  }

  legend(cursors) {
    const hovered = cursors.length === 1 ? cursors[0].time : null;
    for (const { name, cells } of this.curves) {
      const now = hovered === null ? this.traces.value(name, this.traces.count - 1) : this.traces.at(name, hovered);
      cells.now.textContent = shown(now);
      if (cursors.length !== 2) continue;
      const [a, b] = cursors.map((cursor) => this.traces.at(name, cursor.time));
      cells.a.textContent = shown(a);
      cells.b.textContent = shown(b);
      cells.d.textContent = shown(b - a);
    }
    by("legend-now").textContent = hovered === null ? "now" : hovered.toFixed(4) + " s";
    const apart = cursors.length === 2 ? cursors[1].time - cursors[0].time : 0;
    by("cursor-times").textContent = cursors.length !== 2 ? "" : `A ${cursors[0].time.toFixed(4)} s · B ${cursors[1].time.toFixed(4)} s · ` +
      `B − A ${shown(apart * 1000, 6)} ms` + (apart !== 0 ? ` · ${shown(1 / Math.abs(apart), 4)} Hz` : "");
  }
}
