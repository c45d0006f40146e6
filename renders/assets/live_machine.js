/* global View */
// The machine of a live line: moved by the poses of the news, drawn in between.
import { by, make } from "./live_dom.js";
import { address } from "./live_link.js";

const jump = 0.25;  // [m] who moves so far between two news is put there

export class Machine {
  constructor() {
    try {
      this.shown = new View(by("view"), by("views"), () => this.place());
    } catch (error) {
      by("view").append(make("p", { className: "notice", textContent: `The machine cannot be shown: ${error.message}.` }));
      by("views").hidden = true;
    }
  }

  /// Pictures drawn so far.
  get frames() { return this.shown?.frames ?? 0; }
  paint() { this.shown?.paint(); }

  /// The machine of another run.
  async line(line) {
    if (!this.shown) return;
    this.wanted = line;
    this.run = null;
    const bytes = await fetch(address("machine.glb")).then((answer) => (answer.ok ? answer.arrayBuffer() : null), () => null);
    if (bytes === null || bytes.byteLength === 0 || this.wanted !== line) return;
    if (!(await this.shown.load(bytes, line.parts))) return;
    this.run = line.run;
    this.before = this.after = null;
    if (this.latest) this.take(this.latest);
  }

  news(news) {
    if (!this.shown) return;
    const told = { poses: Float32Array.from(news.poses), time: news.time, run: news.run, at: performance.now() };
    const still = this.latest?.time === told.time && this.latest.run === told.run;
    this.latest = told;
    if (!still) this.take(told);
  }

  take(told) {
    if (told.run !== this.run || told.poses.length !== this.shown.parts.length * View.numbersAPart) return;
    this.interval = Math.min(100, Math.max(16, this.after ? told.at - this.after.at : 33));
    this.before = this.after ?? told;
    this.after = told;
    this.settled = false;
  }

  /// The parts, a share of the way from the news before to the latest.
  place() {
    if (!this.after || this.settled) return;
    const share = Math.min(1, Math.max(0, (performance.now() - this.after.at) / this.interval));
    this.settled = share >= 1;
    const { poses: a } = this.before;
    const { poses: b } = this.after;
    const now = b.slice();
    for (let i = 0; i < b.length; i += View.numbersAPart) {
      const far = Math.hypot(b[i] - a[i], b[i + 1] - a[i + 1], b[i + 2] - a[i + 2]) > jump;
      if (a[i + 7] === 0 || b[i + 7] === 0 || far) continue;
      View.between(a, i, b, i, share, now, i);
      for (let n = 7; n < View.numbersAPart; ++n) now[i + n] = b[i + n];
    }
    this.shown.show(now);
  }
}
