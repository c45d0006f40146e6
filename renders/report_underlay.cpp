#include "renders/report_data.hpp"

namespace drycut::renders {

const char* const kReportUnderlay = R"js(
  // ---- colours of the light or the dark page ----
  const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#777777"];
  const darkPalette = ["#56b4e9", "#ff8f4a", "#2ec79b", "#e8a3cb", "#f0bb4a", "#8fd0f5", "#c0c6cc"];
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const colour = i => (dark.matches ? darkPalette : palette)[i % palette.length];
  const curveColour = (curve, i) => curve.faint ? (dark.matches ? "#56606b" : "#b9c2cc") : colour(i);
  const theme = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // ---- behind the curves: bands, lanes, marks ----
  function underlay(self, view, index, context, area, graph) {
    context.save();
    context.beginPath();
    context.rect(area.x, area.y, area.w, area.h);
    context.clip();
    drawZones(self.plot.zones, context, area, graph);
    for (const band of view.panel.bands) drawBand(context, area, graph, band);
    view.panel.lanes.forEach((lane, i) => drawLane(context, graph, lane, i, view.panel.lanes.length));
    drawMarks(self.plot.marks, view.top, context, area, graph);
    context.restore();
  }

  // Stretches of x: the strong ones, and every second of the others.
  function drawZones(zones, context, area, graph) {
    zones.forEach((zone, i) => {
      if (!zone.strong && i % 2) return;
      const left = graph.toDomXCoord(zone.from);
      context.fillStyle = zone.strong ? "rgba(0, 158, 115, 0.18)" : "rgba(123, 135, 148, 0.11)";
      context.fillRect(left, area.y, graph.toDomXCoord(zone.to) - left, area.h);
    });
  }

  function drawBand(context, area, graph, band) {
    const high = graph.toDomYCoord(band.high), low = graph.toDomYCoord(band.low);
    context.fillStyle = "rgba(232, 196, 0, 0.20)";
    context.strokeStyle = theme("--fail");
    if (low - high > 1) context.fillRect(area.x, high, area.w, low - high);
    context.setLineDash([6, 4]);
    for (const y of [high, low]) {
      context.beginPath();
      context.moveTo(area.x, y);
      context.lineTo(area.x + area.w, y);
      context.stroke();
    }
    context.setLineDash([]);
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
    const low = graph.toDomYCoord(count - order - 0.82), high = graph.toDomYCoord(count - order - 0.18);
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
      context.strokeStyle = context.fillStyle = colour(order % 4);
      if (!isNaN(starts.y[k])) drawState(context, lane, starts.y[k], left, right, low, high, k > 0);
    }
  }

  function drawState(context, lane, value, left, right, low, high, edge) {
    context.globalAlpha = 0.28;
    if (!lane.digital) {
      context.fillStyle = colour(Math.abs(Math.round(value)));
      context.strokeStyle = theme("--soft");
      context.lineWidth = 1;
      context.fillRect(left, high, right - left, low - high);
      context.globalAlpha = 1;
      context.strokeRect(left, high, right - left, low - high);
      const text = numberText(value), middle = (Math.max(left, 0) + right) / 2;
      context.fillStyle = theme("--ink");
      if (context.measureText(text).width + 6 < right - left) context.fillText(text, middle, (low + high) / 2 + 1);
      return;
    }
    if (value !== 0) context.fillRect(left, high, right - left, low - high);
    context.globalAlpha = 1;
    context.lineWidth = 1.6;
    context.beginPath();
    if (edge) { context.moveTo(left, low); context.lineTo(left, high); }
    context.moveTo(left, value !== 0 ? high : low);
    context.lineTo(right, value !== 0 ? high : low);
    context.stroke();
  }

  function drawMarks(marks, strip, context, area, graph) {
    const shown = marks.map(mark => ({mark: mark, x: graph.toDomXCoord(mark.x)}))
                       .filter(one => one.x >= area.x && one.x <= area.x + area.w);
    const colourOf = mark => mark.strong ? theme("--fail") : theme("--soft");
    context.setLineDash([2, 3]);
    for (const one of shown) {
      context.strokeStyle = colourOf(one.mark);
      context.lineWidth = one.mark.strong ? 1.4 : 0.8;
      context.beginPath();
      context.moveTo(one.x, area.y);
      context.lineTo(one.x, area.y + area.h);
      context.stroke();
    }
    context.setLineDash([]);
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
      context.fillStyle = colourOf(one.mark);
      context.fillText(one.mark.label, 0, 0, strip - 6);
      context.restore();
    }
  }
)js";

}  // namespace drycut::renders
