// All values by name, as they are now; what a program may write can be written here.
import { by, icon, make, memory, shown } from "./live_dom.js";
import { write } from "./live_write.js";

const most = 120;  // values that are told at once
const in_order = new Intl.Collator("en", { numeric: true }).compare;  // D100 before D1004

export class Values {
  /// `changed`: told when other values are wanted; `scoped`: puts a channel on the scope.
  constructor(link, changed, scoped) {
    Object.assign(this, { link, changed, scoped, seen: new Set(), rows: new Map(), only: "all" });
    by("value-search").oninput = () => this.filter();
    for (const button of by("value-kinds").children)
      button.onclick = () => {
        this.only = button.dataset.kind;
        this.filter();
      };
    this.watcher = new IntersectionObserver((entries) => {
      for (const entry of entries) this.seen[entry.isIntersecting ? "add" : "delete"](entry.target.dataset.name);
      this.changed();
    }, { root: by("value-list") });
  }

  line(line) {
    this.scenario = line.scenario;
    this.units = new Map(line.targets.map((target) => [target.name, target.unit]));
    this.pinned = new Set(memory.get("watch." + line.scenario, []));
    this.watcher.disconnect();
    this.seen.clear();
    const channels = [...line.channels].sort((one, other) => in_order(one.name, other.name));
    this.rows = new Map(channels.map((channel) => [channel.name, this.row(channel)]));
    this.sort();
  }

  /// What is looked at: those that are kept first, then what the list shows.
  get wanted() {
    const open = by("value-list").clientHeight > 0;
    return open ? [...new Set([...this.pinned, ...this.seen])].filter((name) => this.rows.has(name)).slice(0, most) : [];
  }

  sort() {
    const rows = [...this.rows.values()];
    const first = rows.filter((row) => this.pinned.has(row.channel.name));
    by("values").replaceChildren(...first.map((row) => row.element), ...rows.filter((row) => !first.includes(row)).map((row) => row.element));
    for (const row of rows) this.watcher.observe(row.element);
    this.filter();
  }
  filter() {
    const words = by("value-search").value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const { channel, element } of this.rows.values()) {
      const fits = words.every((word) => channel.name.toLowerCase().includes(word)) &&
        (this.only === "all" || (this.only === "writable" ? channel.writable : this.pinned.has(channel.name)));
      element.hidden = !fits;
      count += fits ? 1 : 0;
    }
    by("value-count").textContent = count + " of " + this.rows.size;
    by("value-none").hidden = count > 0;
    for (const button of by("value-kinds").children) button.setAttribute("aria-pressed", String(button.dataset.kind === this.only));
  }

  news(news) {
    this.time = news.time;
  }
  samples({ watched }) {
    for (const [name, value] of Object.entries(watched)) {
      const row = this.rows.get(name);
      if (row && row.writtenAt !== this.time) row.show(value);
    }
  }

  row(channel) {
    const { name } = channel;
    const keep = make("button", { type: "button", className: "plain pin" }, icon("pin"));
    const label = () => {
      const on = this.pinned.has(name);
      keep.setAttribute("aria-pressed", String(on));
      keep.setAttribute("aria-label", on ? "No longer keep " + name + " at the top" : "Keep " + name + " at the top");
    };
    keep.onclick = () => {
      if (!this.pinned.delete(name)) this.pinned.add(name);
      memory.set("watch." + this.scenario, [...this.pinned]);
      label();
      this.sort();
      this.changed();
      keep.focus();
    };
    label();
    const scope = make("button", { type: "button", className: "plain", title: "Show on the scope",
      onclick: () => this.scoped(name) }, icon("curve"));
    scope.setAttribute("aria-label", "Show " + name + " on the scope");
    const value = channel.writable
      ? make("button", { type: "button", className: "value writable", title: "Write another value" })
      : make("span", { className: "value" });
    value.textContent = "–";
    if (channel.writable) value.setAttribute("aria-label", "Write " + name);
    const problem = make("p", { className: "problem", hidden: true, attributes: { role: "alert" } });
    const element = make("li", { data: { name } }, keep, make("span", { className: "name", textContent: name, title: name }),
      value, make("span", { className: "unit", textContent: channel.unit }), scope, problem);
    const row = { channel, element, show(now) {
      const text = shown(now, 7);
      if (value.textContent !== text) value.textContent = text;
    } };
    if (channel.writable)
      value.onclick = () => write({ link: this.link, name, unit: this.units.get(name) ?? "", value, problem, now: () => this.time,
        written: (text, time) => {
          value.textContent = text;
          row.writtenAt = time;  // it acts in the next step: until then it is told
        } });
    return row;
  }
}
