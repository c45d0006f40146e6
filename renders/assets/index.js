// Sorts the runs by a column: its heading becomes a button that turns the order round.
(() => {
  const table = document.querySelector("table.index");
  const body = table.tBodies[0];
  const headings = [...table.tHead.rows[0].cells];
  const key = (row, column) => row.cells[column].dataset.sort ?? row.cells[column].textContent;
  const collator = new Intl.Collator("en", { numeric: true });
  headings.forEach((heading, column) => {
    if (heading.tagName !== "TH") return;
    const numbers = heading.classList.contains("number");
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = heading.textContent;
    heading.replaceChildren(button);
    heading.setAttribute("aria-sort", "none");
    button.addEventListener("click", () => {
      const up = heading.getAttribute("aria-sort") !== "ascending";
      for (const other of headings) if (other.tagName === "TH") other.setAttribute("aria-sort", "none");
      heading.setAttribute("aria-sort", up ? "ascending" : "descending");
      const order = (a, b) =>
        numbers ? Number(key(a, column)) - Number(key(b, column)) : collator.compare(key(a, column), key(b, column));
      const rows = [...body.rows].sort((a, b) => (up ? order(a, b) : order(b, a)));
      body.append(...rows);
    });
  });
})();
