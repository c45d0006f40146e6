// The way back: a time bar over all of the run. What was to be seen then comes from the line, which goes on meanwhile.
import { by, typed } from "./live_dom.js";

const text = (time) => time.toFixed(9).replace(/0+$/, "").replace(/\.$/, "") + " s";
const back = 1;  // [s] a key goes

export class Past {
  /// `wanted`: gives what is in sight, { names, programs }. `shown` is told what was to be seen, null: it is now again.
  /// `say`: told what is wrong.
  constructor(link, wanted, shown, say) {
    Object.assign(this, { link, wanted, shown, say, seen: null, asked: null, under_way: false, stale: false, end: 0 });
    const bar = by("past-bar");
    bar.oninput = () => (Number(bar.value) > Number(bar.max) - 1e-9 ? this.now() : this.look(Number(bar.value)));
    const field = by("past-time");
    field.onkeydown = (event) => {
      if (event.key !== "Enter") return;
      const time = Number(field.value.trim().replace(",", ".").replace(/ ?s$/, ""));
      if (field.value.trim() === "" || !Number.isFinite(time) || time < 0)
        return this.say([{ what: `'${field.value}' is no time`, remedy: "seconds of the run, such as 12.5" }]);
      this.look(time);
    };
    by("past-now").onclick = () => this.now();
    by("past-go-on").onclick = () => this.goOn();
    this.tell();
  }

  /// The time that is shown; null: the present.
  get time() {
    return this.seen?.time ?? null;
  }

  line(line, anew) {
    this.run = line.run;
    if (anew) this.now();
  }

  /// The run has come so far.
  news(news) {
    this.end = news.time;
    const bar = by("past-bar");
    // Not under the hand of who draws it.
    if (this.asked === null) {
      bar.max = Math.max(Math.ceil(this.end * 1e4) / 1e4, 1e-3);
      bar.value = bar.max;
      if (document.activeElement !== by("past-time")) by("past-time").value = this.end.toFixed(2);
    }
    this.ago();
  }

  /// A key: so many seconds on or back.
  step(by_) {
    const time = (this.asked ?? this.end) + by_ * back;
    if (time >= this.end) this.now();
    else this.look(Math.max(0, time));
  }

  /// Shows that time. One is asked for at a time; when it has come, the latest that was wanted meanwhile.
  async look(time) {
    this.asked = time;
    if (this.under_way) return;
    this.under_way = true;
    let told = null;
    while (this.asked !== null && (this.asked !== told || this.stale)) {
      told = this.asked;
      this.stale = false;
      const { names, programs } = this.wanted();
      const { problems, past } = await this.link.request({ look: text(told), read: names, programs });
      if (this.asked === null) break;
      if (!past) {
        this.say(problems);
        if (this.seen === null) this.now();
        else this.asked = told = this.seen.time;
        break;
      }
      if (past.run !== this.run) continue;
      this.say([]);
      past.watched = Object.fromEntries(names.map((name, i) => [name, past.read[i]]));
      this.seen = past;
      this.tell();
      this.shown(past);
    }
    this.under_way = false;
  }
  /// Something else is in sight.
  again() {
    if (this.asked === null) return;
    this.stale = true;
    this.look(this.asked);
  }

  now() {
    const was = this.seen;
    this.seen = this.asked = null;
    this.tell();
    if (was) this.shown(null);
  }

  async goOn() {
    if (this.seen === null) return;
    by("past-go-on").disabled = true;
    const problems = await this.link.ask({ go_on: text(this.seen.time) });
    by("past-go-on").disabled = this.seen === null;
    this.say(problems);
  }

  tell() {
    const on = this.seen !== null;
    this.link.past = on;
    document.body.dataset.past = on ? "on" : "off";
    for (const id of ["past-now", "past-go-on"]) by(id).disabled = !on;
    for (const id of ["page-panel", "page-faults", "transport"]) by(id).inert = on;
    if (on) {
      if (document.activeElement !== by("past-bar")) by("past-bar").value = this.seen.time;
      by("past-time").value = typed(this.seen.time);
    }
    this.ago();
  }
  ago() {
    const told = this.seen === null ? "" : `${(this.end - this.seen.time).toFixed(2)} s ago`;
    if (by("past-ago").textContent !== told) by("past-ago").textContent = told;
  }
}
