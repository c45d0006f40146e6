// Tells the cells of a report's matrices: under the pointer, or where the arrow keys have gone; a click holds the cell, so
// that its file can be taken.
"use strict";
(function () {
  const data = JSON.parse(document.getElementById("matrix-data").textContent);

  function element(name, text, parent) {
    const made = document.createElement(name);
    made.textContent = text;
    parent.appendChild(made);
    return made;
  }

  for (const figure of document.querySelectorAll("figure.matrix")) {
    const matrix = data[Number(figure.dataset.matrix)];
    const field = figure.querySelector(".field"), told = figure.querySelector(".map-point");
    const rows = Array.from(figure.querySelectorAll(".runs"));
    const cursor = document.createElement("b");
    cursor.className = "cursor";
    field.tabIndex = 0;
    field.setAttribute("role", "application");
    field.setAttribute("aria-label", "Matrix: the arrow keys go from cell to cell");
    told.setAttribute("aria-live", "polite");
    element("p", "Point at a cell, or go over them with the arrow keys: what came of it. A click holds it and gives the " +
      "scenario that repeats it with pictures.", told);
    let row = 0, column = 0, held = false, address = "";

    function texts() { return matrix.cells[row * matrix.columns + column].map(i => matrix.texts[i]); }

    function show() {
      const cell = texts();
      const filled = text => text.replace(/\{(\d+)\}/g, (whole, index) => cell[index]);
      rows[row].appendChild(cursor);
      cursor.style.left = 100 * column / matrix.columns + "%";
      cursor.style.width = 100 / matrix.columns + "%";
      told.replaceChildren();
      const list = element("dl", "", told);
      matrix.headings.forEach((heading, i) => {
        if (!cell[i]) return;
        const pair = element("div", "", list);
        element("dt", heading, pair);
        element("dd", cell[i], pair);
      });
      if (!matrix.file) return;
      URL.revokeObjectURL(address);
      address = URL.createObjectURL(new Blob([filled(matrix.file)], {type: "text/yaml"}));
      const link = element("a", filled(matrix.fileName), element("p", "Once more with pictures: ", told));
      link.href = address;
      link.download = filled(matrix.fileName);
    }

    function point(event) {
      const found = rows.findIndex(one => {
        const box = one.parentElement.getBoundingClientRect();
        return event.clientY >= box.top && event.clientY < box.bottom;
      });
      if (found < 0) return false;
      const box = rows[found].getBoundingClientRect();
      const at = Math.floor((event.clientX - box.left) / box.width * matrix.columns);
      if (at < 0 || at >= matrix.columns) return false;
      row = found;
      column = at;
      show();
      return true;
    }

    field.addEventListener("pointermove", event => { if (!held) point(event); });
    field.addEventListener("click", event => { held = point(event) && !held; cursor.classList.toggle("held", held); });
    field.addEventListener("keydown", event => {
      const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
      if (!step) return;
      event.preventDefault();
      if (cursor.parentElement) {
        column = Math.min(Math.max(column + step[0], 0), matrix.columns - 1);
        row = Math.min(Math.max(row + step[1], 0), matrix.rows - 1);
      }
      show();
    });
  }
})();
