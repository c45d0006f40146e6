// What the scope has seen: the latest rows of every curve, and where they cross the trigger's level.

const capacity = 1 << 17;  // rows: two minutes of cycles
const mask = capacity - 1;

export class Traces {
  constructor() {
    this.times = new Float64Array(capacity);
    this.columns = new Map();  // by channel
    this.clear();
  }

  clear() {
    this.count = 0;  // rows ever, of which the last `capacity` are there
    for (const column of this.columns.values()) column.fill(NaN);
  }

  /// Keeps these curves only; new ones have no past.
  want(names) {
    for (const name of this.columns.keys()) if (!names.includes(name)) this.columns.delete(name);
    for (const name of names) if (!this.columns.has(name)) this.columns.set(name, new Float64Array(capacity).fill(NaN));
  }

  get first() {
    return Math.max(0, this.count - capacity);
  }
  time(row) {
    return this.times[row & mask];
  }
  get latest() {
    return this.count > 0 ? this.time(this.count - 1) : 0;
  }
  value(name, row) {
    return this.columns.get(name)?.[row & mask] ?? NaN;
  }

  /// Takes rows in; those that are not later than the last one are known already.
  push({ names, times, rows }) {
    const columns = names.map((name) => this.columns.get(name));
    const begin = this.count;
    times.forEach((time, i) => {
      if (this.count > 0 && time <= this.latest) return;
      const at = this.count & mask;
      this.times[at] = time;
      for (const column of this.columns.values()) column[at] = NaN;
      columns.forEach((column, k) => {
        const value = rows[i * names.length + k];
        if (column && value !== null) column[at] = value;
      });
      this.count += 1;
    });
    return begin;
  }

  /// The first row at or after `time`.
  rowAt(time) {
    let low = this.first, high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time(middle) < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /// What the curve holds at `time`: the value of the row before or at it.
  at(name, time) {
    const row = this.rowAt(time + 1e-9) - 1;
    return row < this.first ? NaN : this.value(name, row);
  }

  /// The first time from row `from` on at which the curve crosses `level`; null if it does not.
  crossing(name, level, rising, from) {
    for (let row = Math.max(from, this.first + 1); row < this.count; ++row) {
      const before = this.value(name, row - 1), after = this.value(name, row);
      if (rising ? before < level && after >= level : before > level && after <= level) return this.time(row);
    }
    return null;
  }
}

/// Waits for an edge; says what stretch of time is to be shown. `mode`: off, auto, normal, single.
export class Trigger {
  constructor() {
    Object.assign(this, { mode: "off", source: "", rising: true, level: 0.5, share: 0.25 });
    this.arm();
  }

  arm() {
    this.found = null;  // the last edge
    this.held = false;  // a single one has been seen whole
  }

  /// New rows from `begin` on; true if a single picture has just become whole.
  look(traces, begin, width) {
    if (this.mode === "off" || this.held) return false;
    const over = this.found === null || traces.latest >= this.found + (1 - this.share) * width;
    if (over) {
      const from = this.found === null ? begin : Math.max(begin, traces.rowAt(this.found + (1 - this.share) * width));
      const next = this.mode === "single" && this.found !== null ? null
        : traces.crossing(this.source, this.level, this.rising, from);
      if (next !== null) this.found = next;
    }
    if (this.mode !== "single" || this.found === null || traces.latest < this.found + (1 - this.share) * width) return false;
    this.held = true;
    return true;
  }

  /// From when to when.
  stretch(traces, width) {
    const rolling = [traces.latest - width, traces.latest];
    if (this.mode === "off" || this.found === null) return rolling;
    // Nothing for a while: better the present than an old picture.
    if (this.mode === "auto" && traces.latest > this.found + 2 * width + 0.5) return rolling;
    return [this.found - this.share * width, this.found + (1 - this.share) * width];
  }
}
