// The operator's panel: switches and lamps of the scenario, settings of its plants as sliders.
import { by, freshId, icon, make, memory, nice, shown, tell, typed } from "./live_dom.js";

const apart = 80;      // [ms] between two values of a slider that moves
const isEmergency = (name) => /emergency|e[_-]?stop/i.test(name);
const isPushed = (name) => /acknowledge|reset|jog|confirm/i.test(name);
const isBad = (name) => /fault|alarm|error|lost|trip|too_/i.test(name);
const isFirst = (name) => /\.(speed|load)$/.test(name);
const plainName = (name) => name.replace(/^panel\./, "").replaceAll("_", " ");

export class Panel {
  constructor(link) {
    this.link = link;
    by("setting-search").oninput = () => this.filter();
  }

  line(line) {
    this.scenario = line.scenario;
    this.pinned = new Set(memory.get("settings." + line.scenario, line.targets.map((one) => one.name).filter(isFirst)));
    this.controls = line.targets.map((target) => (target.panel ? this.switch(target) : this.setting(target)));
    const switches = this.controls.filter((one) => one.switch);
    // What stops comes where the hand finds it.
    switches.sort((a, b) => Number(isEmergency(b.target.name)) - Number(isEmergency(a.target.name)));
    by("switches").replaceChildren(...switches.map((one) => one.element));
    this.lamps = line.lamps.map((name) => this.lamp(name));
    by("lamps").replaceChildren(...this.lamps.map((one) => one.element));
    by("lamps").hidden = this.lamps.length === 0;
    by("no-switches").hidden = switches.length > 0;
    this.sort();
  }

  sort() {
    const settings = this.controls.filter((one) => !one.switch);
    by("settings-pinned").replaceChildren(...settings.filter((one) => this.pinned.has(one.target.name)).map((one) => one.element));
    by("settings").replaceChildren(...settings.filter((one) => !this.pinned.has(one.target.name)).map((one) => one.element));
    by("settings-count").textContent = by("settings").children.length;
    this.filter();
  }
  filter() {
    const words = by("setting-search").value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const element of by("settings").children)
      element.hidden = !words.every((word) => element.dataset.name.toLowerCase().includes(word));
  }

  news(news) {
    this.time = news.time;
    this.controls?.forEach((control, i) => control.show(news.values[i]));
    this.lamps?.forEach((lamp, i) => lamp.show(news.lamps[i]));
  }

  /// The first emergency stop, as a key works it.
  emergency() {
    this.controls?.find((one) => one.switch && isEmergency(one.target.name))?.press();
  }

  lamp(name) {
    const element = make("li", { className: "lamp" + (isBad(name) ? " bad" : "") },
      make("i", {}), make("span", { textContent: plainName(name) }), make("small", {}));
    element.title = name;
    return { element, show(on) {
      element.classList.toggle("on", on !== 0);
      element.lastChild.textContent = on !== 0 ? "on" : "off";
    } };
  }

  switch(target) {
    const { name } = target;
    const stop = isEmergency(name);
    const key = "momentary." + name;
    let momentary = !stop && memory.get(key, target.push ?? isPushed(name)), value = 0, held = false;
    let asked = null;  // what acts in the next step, while the line stands still
    const problem = make("p", { className: "problem", hidden: true, attributes: { role: "alert" } });
    const state = make("small", {});
    const button = make("button", { type: "button", className: stop ? "stop" : "switch" },
      make("i", {}), make("span", { textContent: plainName(name) }), state);
    button.title = name + (stop ? " (E)" : "");
    const set = async (on) => {
      const { time } = this;
      const problems = await this.link.act({ set: { [name]: on ? 1 : 0 } });
      tell(problem, problems);
      if (problems.length > 0) return;
      asked = { value: on ? 1 : 0, time };
      show(value);
    };
    const down = () => {
      if (!momentary || held) return;
      held = true;
      set(true);
    };
    const up = () => {
      if (!held) return;
      held = false;
      set(false);
    };
    button.onpointerdown = (event) => {
      if (momentary) button.setPointerCapture(event.pointerId);
      down();
    };
    button.onpointerup = button.onpointercancel = button.onblur = button.onlostpointercapture = up;
    button.onkeydown = (event) => {
      if ((event.key === " " || event.key === "Enter") && momentary) {
        event.preventDefault();
        if (!event.repeat) down();
      }
    };
    button.onkeyup = up;
    const toggle = () => set(value === 0);
    button.onclick = () => { if (!momentary) toggle(); };
    const kind = make("button", { type: "button", className: "kind", hidden: stop });
    const label = () => {
      kind.textContent = momentary ? "push button" : "switch";
      kind.title = momentary ? "On while it is pressed. Change it to a switch that stays"
        : "Stays as it is set. Change it to a push button";
      button.classList.toggle("momentary", momentary);
    };
    kind.onclick = () => {
      momentary = !momentary;
      memory.set(key, momentary);
      label();
    };
    label();
    const element = make("div", { className: stop ? "switch-place wide" : "switch-place", data: { name } }, button, kind, problem);
    const show = (told) => {
      if (asked && (this.time !== asked.time || told === asked.value)) asked = null;
      value = asked ? asked.value : told;
      button.setAttribute("aria-pressed", String(value !== 0));
      const word = stop ? (value !== 0 ? "pressed" : "released") : value !== 0 ? "on" : "off";
      state.textContent = word + (asked ? ", next step" : "");
    };
    return { target, element, switch: true, press: toggle, show };
  }

  /// How long a change takes: "0.5 s"; "" = at once. What is no time the line refuses.
  static over() {
    const text = by("ramp").value.trim().replace(",", ".");
    if (Number(text) === 0) return "";
    return Number.isFinite(Number(text)) ? text + " s" : text;
  }

  /// From where to where the slider goes: about twice the value, or the largest one that the scenario uses, within
  /// what is allowed.
  static reach(value, { low, high }, used) {
    if (high - low <= 200) return [low, high];
    const large = Math.max(Math.abs(value), used);
    const end = large > 1e-9 ? nice(2 * large) : high <= 1000 ? high : 10;
    return [value < 0 ? Math.max(low, -end) : Math.max(low, 0), Math.min(high, end)];
  }

  setting(target) {
    const { name, unit, range } = target;
    const id = freshId();
    const problem = make("p", { className: "problem", hidden: true, attributes: { role: "alert" } });
    const number = make("input", { id, type: "text", inputMode: "decimal", autocomplete: "off", className: "value" });
    const slider = make("input", { type: "range", step: "any", attributes: { "aria-label": name } });
    const from = make("small", {}), until = make("small", {});
    const pin = make("button", { type: "button", className: "plain pin" }, icon("pin"));
    pin.onclick = () => {
      if (!this.pinned.delete(name)) this.pinned.add(name);
      memory.set("settings." + this.scenario, [...this.pinned]);
      this.sort();
      label();
      pin.focus();
    };
    const label = () => {
      const on = this.pinned.has(name);
      pin.setAttribute("aria-pressed", String(on));
      pin.setAttribute("aria-label", on ? `Move ${name} down to the other settings` : `Keep ${name} at the top`);
      pin.title = on ? "Move down to the other settings" : "Keep at the top";
    };
    let ends = null, sent = 0, sentAt = null, last = 0, waiting = null;
    const stretch = (value) => {
      if (!range) return;
      ends = Panel.reach(value, range, target.used);
      [slider.min, slider.max] = ends;
      from.textContent = shown(ends[0]);
      until.textContent = shown(ends[1]) + " " + unit;
    };
    const send = async (value) => {
      sent = performance.now();
      const given = unit === "" || typeof value === "string" ? value : value + " " + unit;
      const over = Panel.over();
      sentAt = this.time;
      tell(problem, await this.link.act(over !== "" && value !== last ? { ramp: { [name]: given }, over } : { set: { [name]: given } }));
    };
    const sendSoon = () => {
      clearTimeout(waiting);
      waiting = setTimeout(() => send(Number(slider.value)), Math.max(0, sent + apart - performance.now()));
    };
    slider.oninput = () => {
      number.value = shown(Number(slider.value));
      // A ramp begins when the slider is let go.
      if (Panel.over() === "") sendSoon();
    };
    slider.onchange = () => {
      clearTimeout(waiting);
      send(Number(slider.value));
      this.touched = null;
    };
    slider.onpointerdown = () => { this.touched = slider; };
    slider.onpointerup = slider.onpointercancel = () => { this.touched = null; };
    const enter = () => {
      const text = number.value.trim().replace("−", "-").replace(",", ".");
      number.dataset.typed = "";
      // With a unit of one's own, or none: then it is the field's.
      const own = text !== "" && Number.isFinite(Number(text));
      if (own && range && (Number(text) < ends[0] || Number(text) > ends[1])) stretch(Number(text));
      send(own ? Number(text) : text);
    };
    number.oninput = () => { number.dataset.typed = "yes"; };
    number.onkeydown = (event) => {
      if (event.key === "Enter") enter();
      if (event.key === "Escape") {
        number.dataset.typed = "";
        tell(problem, []);
        number.blur();
      }
    };
    number.onblur = () => { if (number.dataset.typed === "yes") enter(); };
    const place = make("div", { className: "setting", data: { name } },
      make("div", { className: "setting-head" }, make("label", { htmlFor: id, textContent: name }), pin),
      make("div", { className: "setting-value" }, number, make("span", { className: "unit", textContent: unit })),
      make("div", { className: "setting-slider" }, from, slider, until), problem);
    if (range) number.title = `from ${shown(range.low)} to ${shown(range.high)} ${unit}`;
    label();
    const show = (value) => {
      if (ends === null) stretch(value);
      if (range && (value < ends[0] || value > ends[1])) stretch(value);
      last = value;
      const past = document.body.dataset.past === "on";
      if (this.time === sentAt && problem.hidden && !past) return;  // it acts in the next step
      if (this.touched !== slider && performance.now() - sent > 250) slider.value = value;
      if (document.activeElement !== number && this.touched !== slider) {
        const text = typed(value);
        if (number.value !== text) number.value = text;
      } else if (document.activeElement === number && number.dataset.typed !== "yes") {
        const text = typed(value);
        if (number.value !== text) number.value = text;
      }
    };
    return { target, element: place, show };
  }
}
