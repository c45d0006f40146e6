// Small helpers of the live page's parts.

/// An element with properties, attributes (in `attributes`), listeners (`onclick`) and children.
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === "attributes") for (const [key, text] of Object.entries(value)) element.setAttribute(key, text);
    else if (name === "data") Object.assign(element.dataset, value);
    else element[name] = value;
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

export const by = (id) => document.getElementById(id);

/// An icon of live.html's sheet.
export function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const use = document.createElementNS("http://www.w3.org/2000/svg", "use");
  use.setAttribute("href", "#i-" + name);
  svg.append(use);
  return svg;
}

/// A number with as many digits as one reads at a glance.
export function shown(value, digits = 5) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (Number.isInteger(value) && Math.abs(value) < 1e10) return String(value).replace("-", "−");
  const size = Math.abs(value);
  if (size < 1e-12) return "0";
  const text = size >= 1e7 || size < 1e-4 ? value.toExponential(digits - 2) : String(+value.toPrecision(digits));
  return text.replace("-", "−");
}

/// For a field in which one types: all digits that count, no more.
export const typed = (value) => (Number.isFinite(value) ? String(+value.toPrecision(9)) : "");

/// 1, 2 or 5 times a power of ten, not below `value`.
export function nice(value) {
  const decade = 10 ** Math.floor(Math.log10(value));
  for (const step of [1, 2, 5, 10]) if (step * decade >= value * 0.999999) return step * decade;
  return 10 * decade;
}

export const words = (problems) => problems.map((one) => one.what + (one.remedy ? ": " + one.remedy : "")).join("; ");

/// What the server says about a request, below the field where it was typed; nothing: all is well.
export function tell(place, problems) {
  place.textContent = words(problems);
  place.hidden = problems.length === 0;
}

let counter = 0;
/// A name for an element that labels another one.
export const freshId = () => "n" + ++counter;

/// What a reader of this page chose, kept by the browser; works without, too.
export const memory = {
  get(key, otherwise) {
    try {
      return JSON.parse(localStorage.getItem("drycut." + key)) ?? otherwise;
    } catch {
      return otherwise;
    }
  },
  set(key, value) {
    try {
      localStorage.setItem("drycut." + key, JSON.stringify(value));
    } catch {
      // Not kept, then.
    }
  },
};

/// The colour that a variable of live.css stands for, by day or night as it is now.
export function colour(name) {
  const probe = by("probe");
  probe.style.color = `var(--${name})`;
  return getComputedStyle(probe).color;
}
