// What happened and how it stands: events, notes, checks, drives; faults to inject.
import { by, make, memory, shown, tell } from "./live_dom.js";

const most = 400;  // events that are kept

export class Events {
  constructor(known) {
    this.known = known;  // told names of events
    this.names = new Set();
    this.search = by("event-search");
    this.search.oninput = () => this.filter();
  }

  line(line, anew) {
    by("notes").replaceChildren(...line.notes.map((note) => make("li", { textContent: note })));
    by("notes").hidden = line.notes.length === 0;
    if (!anew) return;
    by("events").replaceChildren();
    this.count = this.left_out = 0;
    this.tell();
  }

  news(news) {
    this.left_out += news.left_out ?? 0;
    if (!news.events) return;
    const list = by("events");
    const rows = news.events.map((event) => {
      const { time, source, event: name, values } = event;
      for (const one of [name, source + "." + name]) this.names.add(one);
      const row = make("tr", {}, make("td", { className: "number", textContent: time.toFixed(4) }),
        make("td", {}, make("b", { textContent: name }), make("small", { textContent: source })), make("td", { textContent: values }));
      row.dataset.text = `${source}.${name} ${values}`.toLowerCase();
      return row;
    });
    this.count += rows.length;
    list.prepend(...rows.reverse().slice(0, most));
    while (list.children.length > most) list.lastChild.remove();
    this.known([...this.names].sort());
    this.filter();
    this.tell();
  }
  tell() {
    const all = this.count + this.left_out, here = Math.min(this.count, most);
    by("event-count").textContent = all > here ? `${all}, ${here} of them here` : String(all);
    by("event-none").hidden = this.count > 0;
  }
  filter() {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const row of by("events").children) row.hidden = !words.every((word) => row.dataset.text.includes(word));
  }
}

export class Verdicts {
  line(line, anew) {
    if (!anew) return;
    by("checks").replaceChildren(...line.checks.map((name) => make("li", {}, make("span", { className: "badge told", textContent: "…" }), make("span", { textContent: name }))));
    by("drives").replaceChildren();
    by("no-checks").hidden = line.checks.length > 0;
  }

  news({ outcome }) {
    if (!outcome) return;
    const failed = outcome.checks.filter((check) => !check.passed).length;
    by("checks").replaceChildren(...outcome.checks.map((check) => make("li", {},
      make("span", { className: "badge " + (check.so_far ? "told" : check.passed ? "pass" : "fail"),
        textContent: check.so_far ? "HELD SO FAR" : check.passed ? "PASS" : "FAIL" }),
      make("div", {}, check.name, make("small", { textContent: check.detail })))));
    const mark = by("checks-mark");
    mark.textContent = failed > 0 ? String(failed) : "";
    mark.title = failed > 0 ? failed + " do not hold" : "";
    by("drives").replaceChildren(...outcome.drives.map((drive) => make("section", {},
      make("h3", {}, drive.name, make("span", { className: "badge " + (drive.holds ? "pass" : "fail"), textContent: drive.holds ? "within its ratings" : "over its ratings" })),
      ...drive.figures.map((figure) => this.bar(figure)))));
    by("no-drives").hidden = outcome.drives.length > 0;
  }

  bar({ name, share }) {
    const bar = make("i", {});
    bar.style.width = Math.min(100, share * 80) + "%";  // the limit stands at 80 % of the width
    return make("div", { className: "load" + (share > 1 ? " over" : share > 0.9 ? " near" : "") },
      make("span", { textContent: name }), make("b", { textContent: Math.round(share * 100) + " %" }), make("div", { className: "bar" }, bar));
  }
}

export class Faults {
  constructor(link) {
    this.link = link;
    by("fault-component").onchange = () => this.choose();
  }

  line(line, anew) {
    this.faults = line.faults;
    const components = [...new Set(line.faults.map((fault) => fault.component))];
    const before = by("fault-component").value || memory.get("fault." + line.scenario, "");
    by("fault-component").replaceChildren(...components.map((name) => make("option", { value: name, textContent: name })));
    by("fault-component").value = components.includes(before) ? before : components[0] ?? "";
    by("faults-injected").hidden ||= anew;
    if (anew) by("fault-log").replaceChildren();
    by("no-faults").hidden = components.length > 0;
    by("fault-choice").hidden = components.length === 0;
    this.choose();
  }
  news(news) {
    this.time = news.time;
  }

  choose() {
    const component = by("fault-component").value;
    by("faults").replaceChildren(...this.faults.filter((fault) => fault.component === component).map((fault) => this.row(fault)));
  }

  row({ component, name, unit, meaning, range }) {
    const problem = make("p", { className: "problem", hidden: true, attributes: { role: "alert" } });
    const inject = async (value) => {
      const given = unit === "" || !Number.isFinite(Number(value)) ? value : value + " " + unit;
      const problems = await this.link.act({ fault: { [component]: { [name]: given } } });
      tell(problem, problems);
      if (problems.length > 0) return;
      by("fault-log").prepend(make("li", { textContent: `${(this.time ?? 0).toFixed(3)} s  ${component}.${name} = ${given}` }));
      by("faults-injected").hidden = false;
    };
    const title = `${component}.${name}`;
    const push = (text, value) => make("button", { type: "button", textContent: text, onclick: () => inject(value),
      attributes: { "aria-label": `${title}: ${text}` } });
    let means;
    if (range.whole && range.low === 0 && range.high === 1) {
      means = [push("on", 1), push("off", 0)];
    } else {
      const field = make("input", { type: "text", inputMode: "decimal", className: "value", autocomplete: "off", attributes: { "aria-label": title } });
      field.placeholder = "value";
      field.title = `from ${shown(range.low)} to ${shown(range.high)} ${unit}`;
      const send = () => {
        const text = field.value.trim().replace(",", ".");
        if (text === "") return tell(problem, [{ what: "there is no value", remedy: field.title }]);
        return inject(range.whole && Number.isFinite(Number(text)) && unit === "" ? Number(text) : text);
      };
      field.onkeydown = (event) => { if (event.key === "Enter") send(); };
      means = [field, make("span", { className: "unit", textContent: unit }), make("button", { type: "button", textContent: "Inject", onclick: send, attributes: { "aria-label": "Inject " + title } })];
    }
    return make("li", { data: { name: title } }, make("div", { className: "fault-head" }, make("b", { textContent: name }), make("span", { className: "means" }, ...means)),
      make("small", { textContent: meaning }), problem);
  }
}
