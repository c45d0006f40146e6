// Tells the points of a report's maps: under the pointer, or where the arrow keys have gone.
"use strict";
(function () {
  const data = JSON.parse(document.getElementById("map-data").textContent);

  // The index whose value is nearest.
  function nearest(values, at) {
    let best = 0;
    values.forEach((value, i) => { if (Math.abs(value - at) < Math.abs(values[best] - at)) best = i; });
    return best;
  }

  function element(name, text, parent) {
    const made = document.createElement(name);
    made.textContent = text;
    parent.appendChild(made);
    return made;
  }

  for (const figure of document.querySelectorAll("figure.map")) {
    const map = data[Number(figure.dataset.map)];
    const ground = figure.querySelector(".ground"), told = figure.querySelector(".map-point");
    const cross = document.createElement("div");
    cross.className = "map-cross";
    cross.hidden = true;
    ground.appendChild(cross);
    ground.tabIndex = 0;
    ground.setAttribute("role", "application");
    ground.setAttribute("aria-label", "Map: the arrow keys go from point to point");
    told.setAttribute("aria-live", "polite");
    element("p", "Point at the map, or go over it with the arrow keys: what was measured there, and the command " +
      "that repeats it with pictures.", told);
    let column = 0, row = 0, held = false;

    function show() {
      const share = (value, range) => (value - range[0]) / (range[1] - range[0]);
      cross.hidden = false;
      cross.style.left = 100 * (map.left + share(map.x[column], map.xRange) * (map.right - map.left)) + "%";
      cross.style.top = 100 * (map.bottom - share(map.y[row], map.yRange) * (map.bottom - map.top)) + "%";
      const cells = map.cells[row * map.x.length + column];
      told.replaceChildren();
      const list = element("dl", "", told);
      map.headings.forEach((heading, i) => {
        if (!cells[i]) return;
        const pair = element("div", "", list);
        element("dt", heading, pair);
        element("dd", cells[i], pair);
      });
      let known = true;
      const command = map.command.replace(/\{(\d+)\}/g, (whole, index) => {
        known = known && cells[index] !== "";
        return cells[index];
      });
      if (!known) return;  // no machine to show
      const line = element("p", "", told);
      element("code", command, line);
      const copy = element("button", "copy", line);
      copy.addEventListener("click", () => {
        navigator.clipboard.writeText(command).then(() => { copy.textContent = "copied"; });
      });
    }

    function point(event) {
      const picture = ground.querySelector("img").getBoundingClientRect();
      const value = (share, from, to, range) => range[0] + (share - from) / (to - from) * (range[1] - range[0]);
      const across = (event.clientX - picture.left) / picture.width;
      const down = (event.clientY - picture.top) / picture.height;
      const beside = 0.02;  // a dot at the end of an axis is met from both sides
      if (across < map.left - beside || across > map.right + beside) return false;
      if (down < map.top - beside || down > map.bottom + beside) return false;
      column = nearest(map.x, value(across, map.left, map.right, map.xRange));
      row = nearest(map.y, value(down, map.bottom, map.top, map.yRange));
      show();
      return true;
    }

    // A click holds the point, so that its command can be taken.
    ground.addEventListener("pointermove", event => { if (!held) point(event); });
    ground.addEventListener("click", event => { held = point(event) && !held; cross.classList.toggle("held", held); });
    ground.addEventListener("keydown", event => {
      const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
      if (!step) return;
      event.preventDefault();
      if (!cross.hidden) {
        column = Math.min(Math.max(column + step[0], 0), map.x.length - 1);
        row = Math.min(Math.max(row + step[1], 0), map.y.length - 1);
      }
      show();
    });
  }
})();
