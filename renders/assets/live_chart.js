// Draws curves in lanes on a canvas: a lane for each unit, with its own scale.
import { colour, nice, shown } from "./live_dom.js";

const gutter = 72, foot = 22, rim = 10, between = 6;
export const curveCount = 8;

/// Lanes of the channels: those of one unit share one, pure numbers stand alone.
export function lanesOf(channels) {
  const lanes = [];
  for (const channel of channels) {
    const same = channel.unit !== "" && lanes.find((lane) => lane.unit === channel.unit);
    if (same) same.channels.push(channel);
    else lanes.push({ unit: channel.unit, channels: [channel] });
  }
  return lanes;
}

const ticksOf = (low, high, most) => {
  const step = nice((high - low) / Math.max(1, most));
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) ticks.push(i * step);
  return { ticks, step };
};
const tickText = (value, step) => {
  if (Math.abs(value) < step * 1e-6) return "0";
  if (Math.abs(value) >= 1e6 || step < 1e-4) return shown(value, 4);
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9))).replace("-", "−");
};

export class Chart {
  constructor(canvas) {
    this.canvas = canvas;
    this.pen = canvas.getContext("2d");
    this.paint();
  }

  paint() {
    this.colours = Object.fromEntries(["ink", "soft", "line", "card", "accent"].map((name) => [name, colour(name)]));
    this.curves = Array.from({ length: curveCount }, (_, i) => colour("curve-" + (i + 1)));
  }

  /// Canvas pixels as the screen has them.
  fit() {
    const fine = window.devicePixelRatio;
    const { clientWidth, clientHeight } = this.canvas;
    if (this.canvas.width !== Math.round(clientWidth * fine) || this.canvas.height !== Math.round(clientHeight * fine)) {
      this.canvas.width = Math.round(clientWidth * fine);
      this.canvas.height = Math.round(clientHeight * fine);
    }
    this.pen.setTransform(fine, 0, 0, fine, 0, 0);
    this.width = clientWidth;
    this.height = clientHeight;
  }

  timeAt(x) {
    return this.from + ((x - gutter) / (this.width - gutter - rim)) * (this.until - this.from);
  }
  xOf(time) {
    return gutter + ((time - this.from) / (this.until - this.from)) * (this.width - gutter - rim);
  }

  /// `view`: {traces, channels (name, unit, hue), from, until, trigger, cursors: [{time, name}]}
  draw(view) {
    this.fit();
    const { pen, width, height, colours } = this;
    [this.from, this.until] = [view.from, view.until];
    pen.clearRect(0, 0, width, height);
    pen.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    const lanes = lanesOf(view.channels);
    const room = (height - foot - 4 - between * Math.max(0, lanes.length - 1)) / Math.max(1, lanes.length);
    this.times(height - foot);
    lanes.forEach((lane, i) => this.lane(lane, 4 + i * (room + between), room, view));
    for (const cursor of view.cursors) {
      const x = this.xOf(cursor.time);
      if (x < gutter || x > width - rim) continue;
      pen.strokeStyle = colours.ink;
      pen.lineWidth = 1;
      pen.setLineDash(cursor.name === "B" ? [4, 3] : []);
      pen.beginPath();
      pen.moveTo(Math.round(x) + 0.5, 0);
      pen.lineTo(Math.round(x) + 0.5, height - foot);
      pen.stroke();
      pen.setLineDash([]);
      if (!cursor.name) continue;
      pen.fillStyle = colours.ink;
      pen.fillRect(Math.round(x) - 8, 0, 17, 16);
      pen.fillStyle = colours.card;
      pen.textAlign = "center";
      pen.textBaseline = "middle";
      pen.fillText(cursor.name, x, 8.5);
    }
  }

  times(bottom) {
    const { pen, colours, width } = this;
    const { ticks, step } = ticksOf(this.from, this.until, (width - gutter - rim) / 90);
    // Short stretches are told in milliseconds from the left tick on: nobody reads 12.3456 s at every line.
    pen.strokeStyle = colours.line;
    pen.fillStyle = colours.soft;
    pen.lineWidth = 1;
    pen.textAlign = "center";
    pen.textBaseline = "top";
    pen.beginPath();
    for (const tick of ticks) {
      const x = Math.round(this.xOf(tick)) + 0.5;
      pen.moveTo(x, 4);
      pen.lineTo(x, bottom);
      if (tick < -1e-9) continue;
      const half = pen.measureText(tickText(tick, step)).width / 2;
      pen.fillText(tickText(tick, step), Math.min(Math.max(x, gutter + half), width - rim - half), bottom + 5);
    }
    pen.stroke();
    pen.textAlign = "left";
    pen.fillText("time [s]", 2, bottom + 5);
  }

  lane(lane, top, room, view) {
    const { pen, colours, width } = this;
    const { traces } = view;
    const first = Math.max(traces.first, traces.rowAt(this.from) - 1);
    const last = Math.min(traces.count, traces.rowAt(this.until) + 1);
    let low = Infinity, high = -Infinity;
    for (const channel of lane.channels)
      for (let row = first; row < last; ++row) {
        const value = traces.value(channel.name, row);
        if (value < low) low = value;
        if (value > high) high = value;
      }
    const triggered = view.trigger.mode !== "off" && lane.channels.some((one) => one.name === view.trigger.source);
    const none = low > high;
    if (none) [low, high] = [0, 1];
    if (high - low < 1e-9 * Math.max(1, Math.abs(high))) {
      const about = Math.max(0.5, 0.1 * Math.abs(high));
      [low, high] = [low - about, high + about];
    }
    const { ticks, step } = ticksOf(low, high, Math.max(1, room / 34));
    low = Math.min(low, ticks[0] ?? low) - 0.06 * (high - low);
    high = Math.max(high, ticks[ticks.length - 1] ?? high) + 0.06 * (high - low);
    const yOf = (value) => top + room - ((value - low) / (high - low)) * room;

    pen.strokeStyle = colours.line;
    pen.fillStyle = colours.soft;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    pen.beginPath();
    for (const tick of ticks) {
      const y = Math.round(yOf(tick)) + 0.5;
      pen.moveTo(gutter, y);
      pen.lineTo(width - rim, y);
      if (room >= 24 || tick === ticks[ticks.length - 1])
        pen.fillText(tickText(tick, step), gutter - 6, Math.min(Math.max(y, top + 6), top + room - 6));
    }
    pen.rect(gutter + 0.5, Math.round(top) + 0.5, width - gutter - rim - 1, Math.round(room));
    pen.stroke();

    pen.save();
    pen.beginPath();
    pen.rect(gutter, top, width - gutter - rim, room);
    pen.clip();
    for (const channel of lane.channels) this.curve(channel, traces, first, last, yOf);
    if (triggered) {
      pen.strokeStyle = colours.accent;
      pen.setLineDash([6, 4]);
      pen.beginPath();
      pen.moveTo(gutter, yOf(view.trigger.level));
      pen.lineTo(width - rim, yOf(view.trigger.level));
      pen.stroke();
      pen.setLineDash([]);
    }
    pen.restore();
    const label = lane.unit !== "" ? lane.unit : lane.channels[0].name;
    pen.textAlign = "left";
    pen.textBaseline = "top";
    const wide = pen.measureText(label).width;
    pen.fillStyle = colours.card;
    pen.globalAlpha = 0.85;
    pen.fillRect(gutter + 3, top + 3, wide + 8, 16);
    pen.globalAlpha = 1;
    pen.fillStyle = colours.soft;
    pen.fillText(label, gutter + 7, top + 5);
  }

  /// A column of pixels shows all that was in its time, from the least to the greatest.
  curve(channel, traces, first, last, yOf) {
    const { pen } = this;
    pen.strokeStyle = this.curves[channel.hue];
    pen.lineWidth = 1.6;
    pen.lineJoin = "round";
    pen.beginPath();
    let column = -1, least = 0, most = 0, end = 0, drawn = false;
    const flush = () => {
      if (column < 0) return;
      if (most - least > 0) {
        pen.moveTo(column, yOf(least));
        pen.lineTo(column, yOf(most));
        pen.moveTo(column, yOf(end));
      }
    };
    for (let row = first; row < last; ++row) {
      const value = traces.value(channel.name, row);
      if (!Number.isFinite(value)) {
        flush();
        column = -1;
        drawn = false;
        continue;
      }
      const x = Math.round(2 * this.xOf(traces.time(row))) / 2;
      if (x !== column) {
        flush();
        if (drawn) pen.lineTo(x, yOf(value));
        else pen.moveTo(x, yOf(value));
        drawn = true;
        column = x;
        least = most = value;
      }
      least = Math.min(least, value);
      most = Math.max(most, value);
      end = value;
    }
    flush();
    pen.stroke();
  }
}
