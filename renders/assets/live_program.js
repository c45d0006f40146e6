// The controller's programs: their texts, where they stand, what their last scans did, and beside each line the values
// that it names.
import { by, make, memory, shown } from "./live_dom.js";
import { pieces } from "./live_language.js";
import { write } from "./live_write.js";

const most = 120;  // values that are told at once
const marks = { "+": "ran", "-": "idle" };
const plainName = (name, others) => (others.some((other) => other !== name && other.endsWith(name.split(".").at(-1))) ? name : name.split(".").at(-1));

export class Program {
  /// `changed`: told when other values are wanted.
  constructor(link, changed) {
    Object.assign(this, { link, changed, seen: new Set(), rows: [], texts: [], said: new Map(), number: 0, chips: new Map() });
    this.following = memory.get("follow", true);
    this.code = by("code");
    by("program-choice").onchange = () => this.show(Number(by("program-choice").value));
    by("program-follow").onclick = () => this.follow(!this.following);
    by("program-search").oninput = () => this.search(0);
    by("program-search").onkeydown = (event) => {
      if (event.key === "Enter") this.search(event.shiftKey ? -1 : 1);
      if (event.key === "Escape") {
        by("program-search").value = "";
        this.search(0);
      }
    };
    // Who scrolls reads on by himself.
    for (const kind of ["wheel", "touchmove"]) this.code.addEventListener(kind, () => this.follow(false), { passive: true });
    this.code.addEventListener("keydown", (event) => {
      if (event.target === this.code && /^(Arrow|Page|Home|End)/.test(event.key)) this.follow(false);
    });
    this.watcher = new IntersectionObserver((entries) => {
      for (const entry of entries) this.seen[entry.isIntersecting ? "add" : "delete"](entry.target);
      this.changed();
    }, { root: this.code });
    this.mark();
  }

  line(line, anew) {
    if (anew) this.said.clear();
    this.scenario = line.scenario;
    this.texts = line.programs;
    this.channels = new Map(line.channels.map((channel) => [channel.name, channel]));
    this.where = null;
    by("no-program").hidden = this.texts.length > 0;
    by("program-bar").hidden = this.code.hidden = this.texts.length === 0;
    by("program-choice").replaceChildren(...this.texts.map(({ name }, i) => make("option", { value: i, textContent: name })));
    by("program-tasks").replaceChildren();
    const kept = this.texts.findIndex(({ file }) => file === memory.get("program." + this.scenario, ""));
    this.build(Math.max(0, kept));
  }

  /// What is looked at: the values of the lines in sight.
  get wanted() {
    if (!this.open) return [];
    const names = [...this.seen].flatMap((row) => this.names(Number(row.dataset.line)));
    return [...new Set(names)].slice(0, most);
  }
  get open() {
    return this.code.clientHeight > 0;
  }
  names(line) {
    return (this.texts[this.number]?.values[line] ?? []).filter((name) => this.channels.has(name));
  }

  show(number) {
    memory.set("program." + this.scenario, this.texts[number].file);
    this.build(number);
  }

  build(number) {
    this.number = number;
    this.watcher.disconnect();
    this.seen.clear();
    this.chips = new Map();
    this.scanned = "";
    this.told = null;
    this.found = [];
    const program = this.texts[number];
    by("program-choice").value = String(number);
    this.rows = program === undefined ? [] : pieces(program.text.replaceAll("\r\n", "\n"), program.language).map((line, i) => this.row(line, i + 1));
    this.code.replaceChildren(...this.rows);
    this.code.scrollTop = 0;
    for (const row of this.rows) this.watcher.observe(row);
    for (const [place, { text, time }] of this.said) if (place.startsWith(program.file + ":")) this.annotate(place, text, time);
    this.search(0);
    if (this.where) this.stand(this.where);
  }

  row(line, number) {
    const text = make("code", {}, ...line.map(([piece, kind]) => (kind === "" ? document.createTextNode(piece) : make("span", { className: "t-" + kind, textContent: piece }))));
    const row = make("li", { data: { line: number } }, make("i", {}), make("span", { className: "no", textContent: number, attributes: { "aria-hidden": "true" } }), text);
    const names = this.names(number);
    if (names.length > 0) row.append(make("span", { className: "now" }, ...names.map((name) => this.chip(name, names, row))));
    return row;
  }

  chip(name, names, row) {
    const { unit, writable } = this.channels.get(name);
    const label = names.length > 1 ? plainName(name, names) + " " : "";
    const number = make("b", { textContent: "–" });
    const chip = make(writable ? "button" : "span", { className: "chip", title: name + (unit === "" ? "" : " [" + unit + "]") + (writable ? ": write another value" : "") },
      make("small", { textContent: label }), number);
    if (writable) {
      chip.type = "button";
      chip.setAttribute("aria-label", "Write " + name);
      chip.onclick = () => {
        row.querySelector(".problem")?.remove();
        const problem = make("p", { className: "problem", hidden: true, attributes: { role: "alert" } });
        row.append(problem);
        chip.dataset.now = number.textContent;
        write({ link: this.link, name, unit: "", value: chip, problem, now: () => this.time, closed: () => problem.remove(),
          written: (text, time) => {
            for (const one of this.chips.get(name)) {
              one.number.textContent = text;
              one.writtenAt = time;
            }
          } });
      };
    }
    if (!this.chips.has(name)) this.chips.set(name, []);
    this.chips.get(name).push({ number });
    return chip;
  }

  samples({ watched }) {
    for (const [name, value] of Object.entries(watched))
      for (const chip of this.chips.get(name) ?? []) {
        if (chip.writtenAt === this.time) continue;
        const text = shown(value, 6);
        if (chip.number.textContent !== text) chip.number.textContent = text;
      }
  }

  news(news) {
    this.time = news.time;
    for (const event of news.events ?? []) this.take(event);
    if (!news.programs) return;
    this.where = news.programs;
    if (this.open) this.stand(this.where);
  }

  /// An event that names a line: `file:line: what`.
  take({ time, event, values }) {
    for (const { file } of this.texts) {
      const at = values.indexOf(file + ":");
      const [, line, rest] = at < 0 ? [] : /^(\d+):(?:\d+:)? ?(.*)/s.exec(values.slice(at + file.length + 1)) ?? [];
      if (line === undefined) continue;
      const place = file + ":" + line, text = event + ": " + rest;
      this.said.set(place, { text, time });
      if (this.texts[this.number].file === file) this.annotate(place, text, time);
    }
  }
  annotate(place, text, time) {
    const row = this.rows[Number(place.slice(place.lastIndexOf(":") + 1)) - 1];
    if (!row) return;
    row.classList.add("told");
    row.querySelector(".said")?.remove();
    row.append(make("p", { className: "said", textContent: `${time.toFixed(3)} s  ${text}` }));
  }

  /// Shows where the tasks are and what the last scan did.
  stand({ tasks, scanned }) {
    const told = JSON.stringify([tasks, this.number]);
    if (told !== this.told) {
      this.told = told;
      for (const row of this.code.querySelectorAll(".here, .called")) {
        row.classList.remove("here", "called");
        row.querySelector(".task")?.remove();
      }
      this.bar(tasks);
      for (const task of tasks.filter(({ program }) => program === this.number)) this.point(task);
    }
    const now = scanned[this.number] ?? "";
    if (now !== this.scanned) {
      this.rows.forEach((row, i) => {
        if (now[i] === this.scanned[i]) return;
        row.classList.remove("ran", "idle");
        if (marks[now[i]]) row.classList.add(marks[now[i]]);
      });
      this.scanned = now;
    }
    by("program-legend").hidden = now === "";
    if (this.following) this.bring();
  }
  point({ name, line, doing, calls }) {
    for (const call of calls) this.rows[call - 1]?.classList.add("called");
    const row = this.rows[line - 1];
    if (!row) return;
    row.classList.add("here");
    row.children[2].after(make("span", { className: "task", textContent: (name + " " + doing).trim() }));
  }
  bar(tasks) {
    const bar = by("program-tasks");
    if (bar.children.length !== tasks.length)
      bar.replaceChildren(...tasks.map(() => make("button", { type: "button" })));
    tasks.forEach(({ name, program, line, doing }, i) => {
      const button = bar.children[i];
      const text = [name, line > 0 ? "line " + line : "", doing].filter(Boolean).join(", ");
      if (button.textContent !== text) button.textContent = text;
      button.hidden = line === 0 && doing === "";
      button.title = "Follow " + name;
      button.setAttribute("aria-pressed", String(program === this.number));
      button.onclick = () => {
        if (program !== this.number) this.show(program);
        this.follow(true);
      };
    });
    by("program-follow").disabled = !tasks.some(({ line }) => line > 0);
  }

  follow(on) {
    if (this.following !== on) memory.set("follow", on);
    this.following = on;
    this.mark();
    if (on) this.bring();
  }
  mark() {
    by("program-follow").setAttribute("aria-pressed", String(this.following));
  }
  /// The line where a task stands, into the middle if it is not well in sight.
  bring() {
    const row = this.code.querySelector(".here");
    if (row) this.scroll(row);
  }
  scroll(row) {
    const height = this.code.clientHeight;
    const top = row.offsetTop - this.code.scrollTop;
    if (top < height * 0.1 || top + row.offsetHeight > height * 0.9) this.code.scrollTop = row.offsetTop - height / 2;
  }

  /// Lines with that text; `way` goes on from the one before: 1, -1, or 0 for the first.
  search(way) {
    const text = by("program-search").value.trim().toLowerCase();
    for (const row of this.found ?? []) row.classList.remove("match", "at");
    const before = this.place ?? 0;
    this.found = text === "" ? [] : this.rows.filter((row) => row.children[2].textContent.toLowerCase().includes(text));
    const count = this.found.length;
    this.place = way === 0 || count === 0 ? 0 : (before + way + count) % count;
    for (const row of this.found) row.classList.add("match");
    by("program-found").textContent = text === "" ? "" : count === 0 ? "none" : `${this.place + 1} of ${count}`;
    if (count === 0) return;
    this.follow(false);
    this.found[this.place].classList.add("at");
    this.scroll(this.found[this.place]);
  }
}
