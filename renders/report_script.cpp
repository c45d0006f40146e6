#include "renders/report_data.hpp"

namespace drycut::renders {

const char* const kReportPlots = R"js(
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
  function isCounted(plot) {
    const curves = plot.panels.flatMap(panel => panel.curves);
    return curves.length > 0 && curves.every(
        curve => curve.style === "points" && columns[curve.x].every(Number.isInteger));
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
    figure.insertBefore(this.box, figure.querySelector("figcaption"));
    const head = element(this.box, "div", "live-head");
    element(head, "strong", "", plot.title);
    this.all = element(head, "button", "", "whole range");
    this.all.type = "button";
    this.all.onclick = () => self.show(self.whole);
    this.readout = element(head, "span", "live-x", "");
    const names = plot.panels.flatMap(panel => panel.lanes.map(lane => lane.label));
    const narrow = figure.clientWidth < 560;
    const longest = Math.max(0, ...names.map(name => name.length));
    this.axisWidth = Math.min(Math.max(58, 8 * longest + 8), narrow ? 96 : 190);
    this.range = this.whole.slice();
    this.busy = true;
    plot.panels.forEach((panel, index) => self.addPanel(panel, index, narrow));
    this.busy = false;
    this.paint();
    element(this.box, "p", "live-hint", plot.xLabel + " \u00b7 drag: zoom \u00b7 shift and drag: move \u00b7 " +
            "two fingers: zoom and move \u00b7 double click: whole range");
    figure.classList.add("is-live");
  }

  // The colours of the light or the dark page.
  Plot.prototype.paint = function () {
    this.busy = true;
    for (const view of this.graphs) {
      view.holder.querySelectorAll("i").forEach((swatch, i) => { swatch.style.background = curveColour(view.panel.curves[i], i); });
      const options = {axisLineColor: theme("--soft"), gridLineColor: theme("--line")};
      if (view.panel.curves.length) options.colors = view.panel.curves.map(curveColour);
      view.graph.updateOptions(options);
    }
    this.busy = false;
  };

  Plot.prototype.addPanel = function (panel, index, narrow) {
    const self = this, last = index + 1 === this.plot.panels.length;
    const holder = element(this.box, "div", "live-panel");
    const legend = element(holder, "div", "live-legend");
    if (panel.title || panel.yLabel) element(legend, "b", "", (panel.title + " " + panel.yLabel).trim());
    const values = panel.curves.map((curve, i) => {
      const entry = element(legend, "span", "live-entry");
      if (curve.label) {
        element(entry, "i", curve.style);
        element(entry, "span", "", curve.label + " ");
      }
      return element(entry, "output", "", "");
    });
    for (const band of panel.bands) if (band.label) element(legend, "span", "live-band", band.label);
    const canvas = element(holder, "div", "live-canvas");
    const lanes = panel.lanes.length;
    const strip = index === 0 ? stripHeight(this.plot.marks) : 0;
    canvas.style.height = (lanes ? laneHeight * lanes + (last ? 26 : 8) : narrow ? 180 : 220) + strip + "px";
    const cursor = element(canvas, "div", "live-cursor");
    const view = {panel: panel, holder: holder, values: values, cursor: cursor, canvas: canvas, top: strip};
    const series = {};
    panel.curves.forEach((curve, i) => {
      series["c" + i] = curve.style === "points" ? {drawPoints: true, strokeWidth: 0, pointSize: curve.faint ? 1 : 3}
                                                 : {stepPlot: curve.style === "steps"};
    });
    view.pixels = Math.max(200, Math.min(2000, canvas.clientWidth));
    const options = {
      labels: ["x"].concat(panel.curves.map((curve, i) => "c" + i)), series: series, legend: "never",
      colors: panel.curves.map(curveColour), strokeWidth: 1.6, highlightCircleSize: 0,
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
      options.colors = ["#000"];
      options.valueRange = [0, lanes + view.top / laneHeight];
      options.axes.y.drawGrid = false;
      options.axes.y.ticker = () => panel.lanes.map((lane, i) => ({v: lanes - i - 0.5, label: lane.label}));
      rows = [[this.plot.range[0], null], [this.plot.range[1], null]];
    } else {
      options.valueRange = heights(panel, this.range, view);
    }
    view.graph = new Dygraph(canvas, rows, options);
    canvas.appendChild(cursor);
    const point = event => {
      const left = event.clientX - canvas.getBoundingClientRect().left;
      const area = view.graph.getArea();
      if (left >= area.x && left <= area.x + area.w) self.point(view.graph.toDataXCoord(left));
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
  Plot.prototype.point = function (at) {
    for (const plot of made) if (plot.plot.xLabel === this.plot.xLabel) plot.tell(at);
  };
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
    if (shown) view.cursor.style.left = graph.toDomXCoord(this.at) + "px";
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
  dark.addEventListener("change", () => made.forEach(plot => plot.paint()));
  window.drycutPlots = made;
)js";

}  // namespace drycut::renders
