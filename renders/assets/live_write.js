// A value that one writes: a field in its place, until Enter or Escape.
import { make, shown, tell } from "./live_dom.js";

/// `value`: the button that shows it, `problem`: where it is told what does not fit. `written` is told the text that
/// was taken, and when: what was written acts in the next step. `closed`: the field is gone.
export function write({ link, name, unit, value, problem, now, written, closed = () => {} }) {
  const field = make("input", { type: "text", className: "value", autocomplete: "off", spellcheck: false });
  field.value = (value.dataset.now ?? value.textContent).replace("−", "-").replace("–", "");
  field.setAttribute("aria-label", "New value of " + name);
  const close = () => {
    if (!field.isConnected) return;
    field.onblur = null;
    field.replaceWith(value);
    tell(problem, []);
    closed();
  };
  const send = async () => {
    const text = field.value.trim().replace(",", ".");
    const number = text !== "" && Number.isFinite(Number(text));
    const given = number ? (unit === "" ? Number(text) : text + " " + unit) : text;  // a program's values are bare numbers
    const time = now();
    const problems = await link.act({ set: { [name]: given } });
    if (problems.length > 0) {
      field.setAttribute("aria-invalid", "true");
      return tell(problem, problems);
    }
    written(number ? shown(Number(text), 7) : text, time);
    close();
    value.focus();
  };
  field.onkeydown = (event) => {
    if (event.key === "Enter") send();
    if (event.key === "Escape") {
      close();
      value.focus();
    }
  };
  // Who goes elsewhere has not written.
  field.onblur = () => { if (problem.hidden) close(); };
  value.replaceWith(field);
  field.select();
}
