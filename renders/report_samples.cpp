#include "renders/report_data.hpp"

namespace drycut::renders {

// Curves stay as they were recorded; what is drawn is thinned to the lowest and highest value a pixel, so
// that a million samples zoom as fast as a thousand.
const char* const kReportSamples = R"js(
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
)js";

}  // namespace drycut::renders
