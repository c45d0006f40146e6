// Draws the plots of a report with dygraphs in place of their pictures.
"use strict";
(function () {
  // Curves stay as they were recorded; what is drawn is thinned to the lowest and highest value a pixel, so
  // that a million samples zoom as fast as a thousand.
  const source = document.getElementById("plot-data");
  if (!source || typeof Dygraph === "undefined") return;
  const data = JSON.parse(source.textContent);

  // ---- columns: little-endian floats in base64 ----
  function decoded(column) {
    const text = atob(column.base64), bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return column.type === "f8" ? new Float64Array(bytes.buffer) : new Float32Array(bytes.buffer);
  }
  const columns = data.columns.map(decoded);

  // First index whose x is at least `at`.
  function lowerBound(x, at) {
    let low = 0, high = x.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (x[middle] < at) low = middle + 1; else high = middle;
    }
    return low;
  }

  // Lowest and highest value of every `block` samples of a long column, made once.
  const block = 64, digests = new Map();
  function digest(y) {
    let made = digests.get(y);
    if (made) return made;
    const count = Math.ceil(y.length / block);
    made = {low: new Float32Array(count), high: new Float32Array(count)};
    for (let b = 0; b < count; ++b) {
      let low = NaN, high = NaN;
      for (let i = b * block; i < Math.min(y.length, (b + 1) * block); ++i) {
        if (!(y[i] >= low)) low = isNaN(y[i]) ? low : y[i];
        if (!(y[i] <= high)) high = isNaN(y[i]) ? high : y[i];
      }
      made.low[b] = low;
      made.high[b] = high;
    }
    digests.set(y, made);
    return made;
  }

  function extremes(y, from, until) {
    let low = NaN, high = NaN;
    const take = (a, b) => {
      if (a < low || isNaN(low)) low = isNaN(a) ? low : a;
      if (b > high || isNaN(high)) high = isNaN(b) ? high : b;
    };
    let i = from;
    if (until - from > 2 * block) {
      const blocks = digest(y);
      while (i % block) { take(y[i], y[i]); ++i; }
      for (; i + block <= until; i += block) take(blocks.low[i / block], blocks.high[i / block]);
    }
    for (; i < until; ++i) take(y[i], y[i]);
    return [low, high];
  }

  // Rows [x, y of each curve] between two x, thinned to `pixels`; null where a curve has no sample.
  function rowsOf(panel, from, until, pixels) {
    const groups = new Map();
    panel.curves.forEach((curve, index) => {
      if (!groups.has(curve.x)) groups.set(curve.x, []);
      groups.get(curve.x).push(index);
    });
    const rows = [], width = panel.curves.length + 1;
    for (const [column, indexes] of groups) {
      const x = columns[column];
      const begin = Math.max(0, lowerBound(x, from) - 1), end = Math.min(x.length, lowerBound(x, until) + 2);
      const put = (at, values) => {
        const row = new Array(width).fill(null);
        row[0] = at;
        indexes.forEach((index, k) => { row[index + 1] = values[k]; });
        rows.push(row);
      };
      const points = panel.curves[indexes[0]].style === "points";
      if (points || end - begin <= 4 * pixels) {
        for (let i = begin; i < end; ++i) put(x[i], indexes.map(index => columns[panel.curves[index].y][i]));
        continue;
      }
      const step = (end - begin) / pixels;
      for (let p = 0; p < pixels; ++p) {
        const first = Math.floor(begin + p * step), last = Math.floor(begin + (p + 1) * step);
        const pairs = indexes.map(index => extremes(columns[panel.curves[index].y], first, last));
        put(x[first], pairs.map(pair => pair[p % 2 ? 1 : 0]));
        put(x[Math.min((first + last) >> 1, x.length - 1)], pairs.map(pair => pair[p % 2 ? 0 : 1]));
      }
    }
    if (groups.size > 1) rows.sort((a, b) => a[0] - b[0]);
    if (rows.length === 0) rows.push([from].concat(new Array(width - 1).fill(null)));
    return rows;
  }

  // A number with the digits that tell it from its neighbours.
  function numberText(value) {
    if (!isFinite(value)) return "-";
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-3 || size >= 1e7)) return value.toExponential(3);
    return String(Number(value.toPrecision(size >= 1e5 ? 7 : 5)));
  }

  // The value that a curve shows at `at`: of the last sample before it, for points of the nearest; none
  // where nothing was recorded.
  function valueAt(curve, at) {
    const x = columns[curve.x], y = columns[curve.y], last = x.length - 1;
    if (last < 0) return NaN;
    let i = Math.max(0, lowerBound(x, at) - 1);
    if (curve.style === "points") return y[i < last && x[i + 1] - at < at - x[i] ? i + 1 : i];
    if (at < x[0] || at > x[last] + 1e-6 * (x[last] - x[0])) return NaN;
    return y[i < last && x[i + 1] <= at ? i + 1 : i];
  }

  // ---- looks: a tone for the light and one for the dark page, lines a little thinner than in pictures ----
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const shade = tone => tone[Number(dark.matches)];
  const thin = 0.8;
  const theme = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  function fill(context, look, left, top, right, bottom) {
    context.globalAlpha = look.opacity;
    context.fillStyle = shade(look.tone);
    context.fillRect(left, top, right - left, bottom - top);
    context.globalAlpha = 1;
  }
  function stroke(context, look, ...points) {
    context.strokeStyle = shade(look.tone);
    context.lineWidth = thin * look.size;
    context.setLineDash(look.dash);
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    context.stroke();
    context.setLineDash([]);
  }

  // ---- behind the curves: bands, lanes, marks ----
  function underlay(self, view, index, context, area, graph) {
    context.save();
    context.beginPath();
    context.rect(area.x, area.y, area.w, area.h);
    context.clip();
    for (const zone of self.plot.zones)
      fill(context, zone.look, graph.toDomXCoord(zone.from), area.y, graph.toDomXCoord(zone.to), area.y + area.h);
    for (const {look, low, high} of view.panel.bands) {
      const top = graph.toDomYCoord(high), bottom = graph.toDomYCoord(low), right = area.x + area.w;
      if (look.size > 0) stroke(context, look, [area.x, top], [right, top]);
      else fill(context, look, area.x, top, right, bottom);
    }
    view.panel.lanes.forEach((lane, i) => drawLane(context, graph, lane, i, view.panel.lanes.length));
    drawMarks(self.plot, view.top, context, area, graph);
    context.restore();
  }

  // Where the states of a lane begin, found once.
  const startsMade = new Map();
  function startsOf(x, y) {
    let made = startsMade.get(y);
    if (made) return made;
    made = {x: [], y: []};
    for (let i = 0; i < x.length; ++i) {
      if (i > 0 && (y[i] === y[i - 1] || (isNaN(y[i]) && isNaN(y[i - 1])))) continue;
      made.x.push(x[i]);
      made.y.push(y[i]);
    }
    startsMade.set(y, made);
    return made;
  }

  function drawLane(context, graph, lane, order, count) {
    const x = columns[lane.x], y = columns[lane.y];
    const low = graph.toDomYCoord(count - order - 0.8), high = graph.toDomYCoord(count - order - 0.2);
    const starts = startsOf(x, y), range = graph.xAxisRange();
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.font = "12px sans-serif";
    let column = -1;
    for (let k = Math.max(0, lowerBound(starts.x, range[0]) - 1); k < starts.x.length && starts.x[k] < range[1]; ++k) {
      const left = graph.toDomXCoord(starts.x[k]);
      const until = k + 1 < starts.x.length ? starts.x[k + 1] : x[x.length - 1];
      const right = Math.max(left + 1, graph.toDomXCoord(until));
      if (Math.floor(right) === column) continue;  // that pixel is filled already
      column = Math.floor(right);
      if (!isNaN(starts.y[k])) drawState(context, lane, starts.y[k], left, right, low, high, k > 0, graph.getArea());
    }
  }

  function drawState(context, lane, value, left, right, low, high, edge, area) {
    if (lane.states.length === 0) {
      const level = value !== 0 ? high : low;
      if (value !== 0) fill(context, lane.look, left, high, right, low);
      return stroke(context, lane.look, ...(edge ? [[left, low], [left, high]] : []), [left, level], [right, level]);
    }
    const [, tone] = lane.states.find(([state]) => Math.fround(state) === value) ?? [value, lane.look.tone];
    fill(context, {tone: tone, opacity: 1}, left, high, right, low);
    context.strokeStyle = theme("--soft");
    context.lineWidth = 1;
    context.strokeRect(left, high, right - left, low - high);
    // In the middle of what is seen of it, if its text has room there.
    const text = numberText(value), from = Math.max(left, area.x), until = Math.min(right, area.x + area.w);
    context.fillStyle = theme("--ink");
    if (context.measureText(text).width + 6 < until - from) context.fillText(text, (from + until) / 2, (low + high) / 2 + 1);
  }

  function drawMarks(plot, strip, context, area, graph) {
    const shown = plot.marks.map(mark => ({mark: mark, x: graph.toDomXCoord(mark.x)}))
                            .filter(one => one.x >= area.x && one.x <= area.x + area.w);
    for (const {mark, x} of shown) stroke(context, plot.markLooks[Number(mark.strong)], [x, area.y], [x, area.y + area.h]);
    if (!strip) return;
    // Faults first; what would touch a label that stands already has none.
    const labelled = [];
    shown.sort((a, b) => Number(b.mark.strong) - Number(a.mark.strong));
    context.font = markFont;
    context.textAlign = "left";
    context.textBaseline = "middle";
    for (const one of shown) {
      if (labelled.some(x => Math.abs(x - one.x) < 13)) continue;
      labelled.push(one.x);
      context.save();
      context.translate(one.x + (one.x + 14 > area.x + area.w ? -6 : 7), area.y + strip - 4);
      context.rotate(-Math.PI / 2);
      context.fillStyle = theme(one.mark.strong ? "--fail" : "--soft");
      context.fillText(one.mark.label, 0, 0, strip - 6);
      context.restore();
    }
  }

  function element(parent, name, kind, text) {
    const made = document.createElement(name);
    if (kind) made.className = kind;
    if (text) made.textContent = text;
    parent.appendChild(made);
    return made;
  }

  // A number at an axis, with the digits that tell it from the next one.
  function tickText(value, range) {
    if (value === 0) return "0";
    const step = Math.abs(range[1] - range[0]) / 10;
    if (Math.abs(value) >= 1e7 || step < 1e-9) return Number(value.toPrecision(6)).toExponential();
    return String(Number(value.toFixed(Math.max(0, Math.ceil(-Math.log10(step))))));
  }

  // Two numbers at least, closer to each other if need be; where all x are whole, none between them.
  function ticker(counted) {
    return (from, until, pixels, options, ...more) => {
      let ticks = [];
      for (const closer of [1, 0.6, 0.35]) {
        const wanted = name => name === "pixelsPerLabel" ? closer * options(name) : options(name);
        ticks = Dygraph.numericTicks(from, until, pixels, wanted, ...more).filter(
            tick => tick.v >= from && tick.v <= until && (!counted || Number.isInteger(tick.v)));
        if (ticks.length > 1) break;
      }
      return ticks;
    };
  }
  // What has no unit and only whole numbers is counted: trials, pieces.
  function isCounted(plot) {
    const curves = plot.panels.flatMap(panel => panel.curves);
    return !plot.xLabel.includes("[") && curves.length > 0 &&
        curves.every(curve => columns[curve.x].every(Number.isInteger));
  }

  const laneHeight = 30;
  const pen = document.createElement("canvas").getContext("2d");
  const markFont = "11px sans-serif";

  // Height of the strip for the labels of the marks, which stand across.
  function stripHeight(marks) {
    pen.font = markFont;
    const widest = Math.max(0, ...marks.map(mark => pen.measureText(mark.label).width));
    return marks.length ? Math.min(160, Math.ceil(widest) + 8) : 0;
  }

  // ---- one plot: panels over a common x ----
  function Plot(figure, plot) {
    const self = this;
    this.plot = plot;
    // A little more than there is: a label at the very end would be left out.
    this.whole = [plot.range[0], plot.range[1] + 1e-9 * (plot.range[1] - plot.range[0])];
    this.counted = isCounted(plot);
    this.graphs = [];
    this.box = element(figure, "div", "live");
    this.box.tabIndex = 0;
    this.box.setAttribute("role", "group");
    this.box.setAttribute("aria-label", plot.title + ", plot to zoom: arrow keys move the cursor, plus and minus zoom, Home shows the whole range");
    this.box.addEventListener("keydown", event => { if (event.target === self.box && self.key(event)) event.preventDefault(); });
    figure.insertBefore(this.box, figure.querySelector("figcaption"));
    const head = element(this.box, "div", "live-head");
    element(head, "strong", "", plot.title);
    this.all = element(head, "button", "", "whole range");
    this.all.type = "button";
    this.all.onclick = () => self.show(self.whole);
    this.readout = element(head, "span", "live-x", "");
    this.readout.setAttribute("aria-live", "polite");
    const names = plot.panels.flatMap(panel => panel.lanes.map(lane => lane.label));
    const narrow = figure.clientWidth < 560;
    const longest = Math.max(0, ...names.map(name => name.length));
    this.axisWidth = Math.min(Math.max(58, 8 * longest + 8), narrow ? 96 : 190);
    this.range = this.whole.slice();
    this.busy = true;
    plot.panels.forEach((panel, index) => self.addPanel(panel, index, narrow));
    this.busy = false;
    this.paint();
    element(this.box, "p", "live-hint", plot.xLabel);
    figure.classList.add("is-live");
  }

  // The colours of the light or the dark page.
  Plot.prototype.paint = function () {
    this.busy = true;
    for (const view of this.graphs) {
      for (const [swatch, look] of view.swatches) swatch.style.color = shade(look.tone);
      const options = {axisLineColor: theme("--soft"), gridLineColor: theme("--line")};
      if (view.panel.curves.length) options.colors = view.panel.curves.map(curve => shade(curve.look.tone));
      view.graph.updateOptions(options);
    }
    this.busy = false;
  };

  Plot.prototype.addPanel = function (panel, index, narrow) {
    const self = this, last = index + 1 === this.plot.panels.length;
    const holder = element(this.box, "div", "live-panel");
    const legend = element(holder, "div", "live-legend");
    if (panel.title || panel.yLabel) element(legend, "b", "", (panel.title + " " + panel.yLabel).trim());
    const swatches = [];  // of curves and bands with a name
    const values = panel.curves.map(curve => {
      const entry = element(legend, "span", "live-entry");
      if (curve.label) {
        swatches.push([element(entry, "i", curve.style), curve.look]);
        element(entry, "span", "", curve.label + " ");
      }
      entry.hidden = curve.faint && !curve.label;  // a guide for the eye behind the others
      return element(entry, "output", "", "");
    });
    for (const band of panel.bands.filter(band => band.label)) {
      const entry = element(legend, "span", "live-band");
      swatches.push([element(entry, "i", band.look.size > 0 ? "limit" : "band"), band.look]);
      entry.append(band.label);
    }
    const canvas = element(holder, "div", "live-canvas");
    canvas.setAttribute("role", "img");
    const names = panel.curves.concat(panel.lanes).map(one => one.label).filter(Boolean).join(", ");
    canvas.setAttribute("aria-label", [panel.title, panel.yLabel, names].filter(Boolean).join(" ") || this.plot.title);
    const lanes = panel.lanes.length;
    const strip = index === 0 ? stripHeight(this.plot.marks) : 0;
    canvas.style.height = (lanes ? laneHeight * lanes + (last ? 26 : 8) : narrow ? 180 : 220) + strip + "px";
    const cursor = element(canvas, "div", "live-cursor");
    const states = panel.lanes.map(() => element(canvas, "output", "live-state"));
    const view = {panel: panel, holder: holder, swatches: swatches, values: values, states: states, cursor: cursor, canvas: canvas, top: strip};
    const series = {};
    panel.curves.forEach((curve, i) => {
      series["c" + i] = curve.style === "points" ? {drawPoints: true, strokeWidth: 0, pointSize: Math.round(curve.look.size)}
        : {stepPlot: curve.style === "steps", strokeWidth: thin * curve.look.size, strokePattern: curve.look.dash.length ? curve.look.dash : null};
    });
    view.pixels = Math.max(200, Math.min(2000, canvas.clientWidth));
    const options = {
      labels: ["x"].concat(panel.curves.map((curve, i) => "c" + i)), series: series, legend: "never",
      highlightCircleSize: 0,
      gridLineWidth: 0.8,
      connectSeparatedPoints: true, dateWindow: this.range.slice(), axisLabelFontSize: 12, rightGap: 12,
      xRangePad: 0, interactionModel: interaction(() => self.show(self.whole)),
      axes: {x: {axisLabelHeight: 18, drawAxis: last, pixelsPerLabel: narrow ? 56 : 90,
                 axisLabelFormatter: (value, g, o, graph) => tickText(value, graph.xAxisRange())},
             y: {axisLabelWidth: this.axisWidth, pixelsPerLabel: 24,
                 axisLabelFormatter: (value, g, o, graph) => tickText(value, graph.yAxisRange())}},
      underlayCallback: (context, area, graph) => underlay(self, view, index, context, area, graph),
      drawCallback: graph => {
        self.place(view, graph);
        self.moved(graph.xAxisRange());
      }
    };
    options.axes.x.ticker = ticker(this.counted);
    options.axes.y.ticker = ticker(false);
    let rows = rowsOf(panel, this.range[0], this.range[1], view.pixels);
    if (lanes) {
      options.labels = ["x", "none"];
      options.series = {};
      options.valueRange = [0, lanes + view.top / laneHeight];
      options.axes.y.drawGrid = false;
      options.axes.y.ticker = () => panel.lanes.map((lane, i) => ({v: lanes - i - 0.5, label: lane.label}));
      rows = [[this.plot.range[0], null], [this.plot.range[1], null]];
    } else {
      options.valueRange = heights(panel, this.range, view);
    }
    view.graph = new Dygraph(canvas, rows, options);
    canvas.appendChild(cursor);
    for (const state of states) canvas.appendChild(state);
    const point = event => {
      const left = event.clientX - canvas.getBoundingClientRect().left;
      const area = view.graph.getArea();
      if (left >= area.x && left <= area.x + area.w)
        self.point(view.graph.toDataXCoord(left), event.type === "pointerdown" || event.buttons > 0);
    };
    canvas.addEventListener("pointermove", point);
    canvas.addEventListener("pointerdown", point);
    this.graphs.push(view);
  };

  // Room for the marks' labels is kept above the curves of the first panel.
  function heights(panel, range, view) {
    let low = Infinity, high = -Infinity;
    const take = value => { if (isFinite(value)) { low = Math.min(low, value); high = Math.max(high, value); } };
    for (const curve of panel.curves) {
      const x = columns[curve.x];
      const pair = extremes(columns[curve.y], Math.max(0, lowerBound(x, range[0]) - 1),
                            Math.min(x.length, lowerBound(x, range[1]) + 1));
      pair.forEach(take);
    }
    for (const band of panel.bands) { take(band.low); take(band.high); }
    panel.least.forEach(take);
    if (!(low <= high)) { low = 0; high = 1; }
    // What differs by rounding only is one number: its noise must not fill the panel.
    if (high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high))) low = high = (low + high) / 2;
    if (low === high) { const add = low === 0 ? 1 : Math.abs(low) * 0.1; low -= add; high += add; }
    const border = 0.06 * (high - low);
    low -= border;
    high += border;
    if (view.top) high += (high - low) * view.top / Math.max(100, view.canvas.clientHeight - view.top - 30);
    return [low, high];
  }

  // Shows a stretch of x in all panels, with the samples that it needs.
  Plot.prototype.show = function (range) {
    const least = 1e-9 * Math.max(1, Math.abs(range[1]));
    if (!(range[1] - range[0] > least)) return;
    this.range = range.slice();
    this.busy = true;
    for (const view of this.graphs) {
      const options = {dateWindow: this.range.slice()};
      if (!view.panel.lanes.length) {
        options.file = rowsOf(view.panel, this.range[0], this.range[1], view.pixels);
        options.valueRange = heights(view.panel, this.range, view);
      }
      view.graph.updateOptions(options);
    }
    this.busy = false;
  };
  Plot.prototype.moved = function (range) {
    if (this.busy || (range[0] === this.range[0] && range[1] === this.range[1])) return;
    this.show(range);
  };

  // The cursor: a line in all panels of all plots over the same x, the values under it beside the names.
  Plot.prototype.point = function (at, pressed) {
    // Who shows that time elsewhere may know better.
    const detail = {label: this.plot.xLabel, at: at, pressed: pressed};
    if (document.dispatchEvent(new CustomEvent("drycut-point", {detail: detail, cancelable: true})))
      pointAt(this.plot.xLabel, at);
  };
  function pointAt(label, at) {
    for (const plot of made) if (plot.plot.xLabel === label) plot.tell(at);
  }
  Plot.prototype.tell = function (at) {
    const within = at >= this.whole[0] && at <= this.whole[1];
    const [, name, unit] = this.plot.xLabel.match(/^(.*?)(?: \[(.*)\])?$/);
    this.at = within ? at : undefined;
    this.readout.textContent = within ? name + " " + at.toFixed(4) + (unit ? " " + unit : "") + this.second(at) : "";
    for (const view of this.graphs) {
      this.place(view, view.graph);
      view.panel.curves.forEach((curve, i) => {
        view.values[i].textContent = within ? numberText(valueAt(curve, at)) : "";
      });
    }
  };
  // The same place on the second scale.
  Plot.prototype.second = function (at) {
    const second = this.plot.second;
    if (!second) return "";
    const [, name, unit] = second.label.match(/^(.*?)(?: \[(.*)\])?$/);
    return " \u00b7 " + name + " " + numberText(at * second.factor) + (unit ? " " + unit : "");
  };
  Plot.prototype.place = function (view, graph) {
    const [from, until] = graph.xAxisRange();
    const shown = this.at >= from && this.at <= until;
    view.cursor.style.display = shown ? "block" : "none";
    view.states.forEach(state => { state.style.display = shown ? "block" : "none"; });
    if (!shown) return;
    const area = graph.getArea(), x = graph.toDomXCoord(this.at), lanes = view.panel.lanes;
    view.cursor.style.left = x + "px";
    // The state of each lane beside the line, on the side that has room.
    view.states.forEach((state, i) => {
      state.textContent = numberText(valueAt(lanes[i], this.at));
      state.style.left = x + "px";
      state.style.top = graph.toDomYCoord(lanes.length - i - 0.5) + "px";
      state.classList.toggle("before", x > area.x + 0.8 * area.w);
    });
  };

  // The keys of a plot that has the focus; false of any other.
  Plot.prototype.key = function (event) {
    const [from, until] = this.range, wide = until - from, whole = this.whole;
    if (event.ctrlKey || event.altKey || event.metaKey) return false;
    const inside = this.at >= from && this.at <= until ? this.at : (from + until) / 2;
    if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
      const step = (event.key === "ArrowLeft" ? -1 : 1) * wide * (event.shiftKey ? 0.1 : 0.01);
      const at = Math.min(whole[1], Math.max(whole[0], inside + step));
      const move = at < from ? at - from : at > until ? at - until : 0;
      if (move !== 0) this.show([from + move, until + move]);
      this.point(at, true);
    } else if ("+=-".includes(event.key)) {
      const scale = event.key === "-" ? 2 : 0.5;
      this.show([Math.max(whole[0], inside - (inside - from) * scale), Math.min(whole[1], inside + (until - inside) * scale)]);
    } else if (event.key === "Home") {
      this.show(whole);
    } else {
      return false;
    }
    return true;
  };

  // One finger scrolls the page; two zoom and move the plot.
  function interaction(showAll) {
    const usual = Dygraph.defaultInteractionModel, model = Object.assign({}, usual);
    model.dblclick = showAll;
    for (const name of ["touchstart", "touchmove", "touchend"]) {
      model[name] = (event, graph, context) => {
        if (name === "touchstart" && event.touches.length < 2) return;
        if (name !== "touchstart" && !context.initialTouches) return;
        usual[name](event, graph, context);
      };
    }
    return model;
  }

  const figures = document.querySelectorAll("figure.plot[data-plot]"), made = [];
  figures.forEach(figure => made.push(new Plot(figure, data.plots[Number(figure.dataset.plot)])));
  // Said once, where it is first needed.
  if (made.length)
    element(made[0].box, "p", "live-hint", "In every plot: drag to zoom \u00b7 shift and drag to move \u00b7 two fingers zoom and move \u00b7 " +
            "double click for the whole range \u00b7 keys \u2190 \u2192 + \u2212 Home");
  dark.addEventListener("change", () => made.forEach(plot => plot.paint()));
  window.drycutPlots = made;
  window.drycutPoint = pointAt;
})();
