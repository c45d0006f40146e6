/* global THREE */
// The machine in 3-D: the parts of machine.glb, moved by the poses of the news, drawn in between.
import { by, make } from "./live_dom.js";
import { address } from "./live_link.js";
import { Look, isSlow } from "./live_look.js";

const numbersAPart = 10;  // position 3, quaternion 4, scale 3
const jump = 0.25;        // [m] who moves so far between two news is put there
const slowFrame = 45;     // [ms] then it is drawn plainly
const plainFrame = 28;    // [ms] a plain picture stands at least
const restAfter = 400;    // [ms] without a change: then there is time for a fine picture
const directions = {
  free: [0.5, 0.42, 0.85],
  front: [0, 0.12, 1],
  top: [0, 1, 0.001],
  end: [1, 0.15, 0.001],
};

export class Machine {
  constructor() {
    this.holder = by("view");
    this.parts = [];
    this.frames = 0;  // drawn so far
    this.stale = true;
    this.judged = 0;
    try {
      if (typeof THREE === "undefined")
        throw new Error("The machine cannot be shown: three.js (package libjs-three) is not installed.");
      this.stage();
    } catch (error) {
      this.broken = true;
      const told = /three.js/.test(error.message) ? error.message
        : "The machine cannot be shown: this browser gives no WebGL.";
      this.holder.append(make("p", { className: "notice", textContent: told }));
      by("views").hidden = true;
    }
  }

  stage() {
    // What three.js writes to the console about a missing WebGL is said in the page.
    const canvas = make("canvas", { tabIndex: 0, attributes: {
      "aria-label": "The machine in 3-D. Arrows turn it, plus and minus come nearer and go away.", role: "img" } });
    const slow = isSlow();
    const context = canvas.getContext("webgl", { alpha: true, antialias: !slow, powerPreference: "high-performance" });
    this.renderer = new THREE.WebGLRenderer({ canvas, context, alpha: true });
    this.holder.append(canvas);
    this.canvas = canvas;

    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.02, 200);
    this.orbit = new THREE.OrbitControls(this.camera, canvas);
    this.orbit.enableKeys = false;
    this.orbit.maxPolarAngle = Math.PI / 2 - 0.02;
    this.orbit.addEventListener("change", () => { this.stale = true; });
    this.orbit.addEventListener("start", () => this.choose(null));
    canvas.addEventListener("keydown", (event) => this.key(event));

    this.look = new Look(this.renderer, this.scene, !slow);
    new ResizeObserver(() => this.fit()).observe(this.holder);
    requestAnimationFrame((now) => this.draw(now));
  }

  paint() {
    this.look?.paint();
    this.stale = true;
  }

  /// The machine of another run.
  async line(line) {
    if (this.broken) return;
    const run = line.run;
    this.wanted = run;
    const bytes = await fetch(address("machine.glb")).then((answer) => (answer.ok ? answer.arrayBuffer() : null), () => null);
    if (bytes === null || bytes.byteLength === 0 || this.wanted !== run) return;
    const model = await new Promise((done, failed) => new THREE.GLTFLoader().parse(bytes, "", done, failed));
    if (this.wanted !== run) return;
    const first = !this.model;
    if (this.model) this.scene.remove(this.model);
    this.model = model.scene;
    this.look.dress(model.scene);
    // As the loader calls a node: without what its own paths cannot hold.
    const called = (name) => THREE.PropertyBinding.sanitizeNodeName(name);
    const nodes = new Map();
    model.scene.traverse((node) => nodes.set(node.name, node));
    this.parts = line.parts.map((name) => nodes.get(called(name)));
    for (const part of this.parts) if (part) part.matrixAutoUpdate = false;
    this.names = line.parts;
    this.before = this.after = null;
    this.scene.add(model.scene);
    this.offerViews(line.parts);
    this.pending = first || !this.bounds;
    if (this.waiting?.run === run) this.take(this.waiting);
    this.stale = true;
  }

  news(news) {
    if (this.broken) return;
    const poses = Float32Array.from(news.poses);
    const still = this.waiting && this.waiting.time === news.time && this.waiting.run === news.run;
    const told = { poses, time: news.time, run: news.run, at: performance.now() };
    this.waiting = told;
    if (still || !this.model || this.wanted !== news.run) return;
    this.take(told);
  }

  take(told) {
    if (told.poses.length !== this.parts.length * numbersAPart) return;
    const apart = this.after ? told.at - this.after.at : 33;
    this.interval = Math.min(100, Math.max(16, apart));
    this.before = this.after ?? told;
    this.after = told;
    this.settled = false;
    if (this.pending) {
      this.pending = false;
      this.place(1);
      this.view("free", null);
    }
  }

  /// The parts, a share of the way from the news before to the latest.
  place(share) {
    const { poses: a } = this.before;
    const { poses: b } = this.after;
    const position = new THREE.Vector3(), other = new THREE.Vector3(), scale = new THREE.Vector3();
    const turn = new THREE.Quaternion(), otherTurn = new THREE.Quaternion();
    this.parts.forEach((part, i) => {
      if (!part) return;
      const at = i * numbersAPart;
      scale.fromArray(b, at + 7);
      part.visible = scale.x !== 0;
      if (!part.visible) return;
      other.fromArray(b, at);
      otherTurn.fromArray(b, at + 3);
      position.fromArray(a, at);
      turn.fromArray(a, at + 3);
      if (a[at + 7] === 0 || position.distanceToSquared(other) > jump * jump) {
        position.copy(other);
        turn.copy(otherTurn);
      } else {
        position.lerp(other, share);
        turn.slerp(otherTurn, share);
      }
      part.matrix.compose(position, turn, scale);
      part.matrixWorldNeedsUpdate = true;
    });
  }

  /// The boxes of the parts of a plant, of all if it is null; pieces do not count.
  boxesOf(plant) {
    this.scene.updateMatrixWorld(true);
    const counts = (name) => (plant === null || name.startsWith(plant + ".")) && !/\.(piece|belt mark)/.test(name);
    return this.parts.filter((part, i) => part?.visible && counts(this.names[i])).map((part) => new THREE.Box3().setFromObject(part));
  }

  view(from, plant) {
    if (this.broken || !this.after) return;
    const around = (boxes) => boxes.reduce((all, box) => all.union(box), new THREE.Box3());
    const everything = this.boxesOf(null);
    if (everything.length === 0) return;
    const all = around(everything);
    this.bounds = all;
    this.look.furnish(all);
    const own = plant === null ? [] : this.boxesOf(plant);
    const boxes = own.length > 0 ? own : everything;
    const way = new THREE.Vector3(...directions[from]).normalize();
    // As near as all corners are inside the picture.
    const half = Math.tan(THREE.Math.degToRad(this.camera.fov / 2));
    const right = new THREE.Vector3().crossVectors(new THREE.Vector3(0, 1, 0), way).normalize();
    const up = new THREE.Vector3().crossVectors(way, right);
    const { center: centre, radius } = around(boxes).getBoundingSphere(new THREE.Sphere());
    let far = 0.2 * radius;
    for (const { min, max } of boxes)
      for (const x of [min.x, max.x]) for (const y of [min.y, max.y]) for (const z of [min.z, max.z]) {
        const corner = new THREE.Vector3(x, y, z).sub(centre);
        const wide = Math.abs(corner.dot(right)) / this.camera.aspect;
        far = Math.max(far, corner.dot(way) + (1.1 / half) * Math.max(wide, Math.abs(corner.dot(up))));
      }
    this.orbit.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(way, far);
    this.orbit.minDistance = 0.1 * radius;
    this.orbit.maxDistance = 6 * this.look.size;
    this.orbit.update();
    this.choose(from === "free" ? plant ?? "" : from);
    this.stale = true;
  }

  offerViews(parts) {
    const plants = [...new Set(parts.map((name) => name.split(".")[0]))];
    const views = [["whole line", "free", null], ...(plants.length > 1 ? plants.map((name) => [name, "free", name]) : []),
      ["front", "front", null], ["top", "top", null], ["end", "end", null]];
    by("views").replaceChildren(...views.map(([text, from, plant]) => make("button", {
      type: "button", textContent: text, data: { view: from === "free" ? plant ?? "" : from },
      onclick: () => this.view(from, plant) })));
    this.choose(this.chosen ?? null);
  }
  choose(view) {
    this.chosen = view;
    for (const button of by("views").children) button.setAttribute("aria-pressed", String(button.dataset.view === view));
  }

  key(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const offset = this.camera.position.clone().sub(this.orbit.target);
    const ball = new THREE.Spherical().setFromVector3(offset);
    if (event.key in turns) {
      ball.theta += 0.12 * turns[event.key][0];
      ball.phi = Math.min(this.orbit.maxPolarAngle, Math.max(0.02, ball.phi + 0.12 * turns[event.key][1]));
    } else if (event.key === "+" || event.key === "-") {
      ball.radius = Math.min(this.orbit.maxDistance, Math.max(this.orbit.minDistance, ball.radius * (event.key === "+" ? 0.85 : 1.18)));
    } else {
      return;
    }
    event.preventDefault();
    this.camera.position.copy(this.orbit.target).add(offset.setFromSpherical(ball));
    this.orbit.update();
    this.choose(null);
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width === 0 || height === 0) return;
    this.fineness(false);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const { chosen } = this;
    if (chosen !== null && chosen !== undefined && this.bounds)
      this.view(chosen in directions ? chosen : "free", chosen in directions || chosen === "" ? null : chosen);
    this.stale = true;
  }

  /// Pixels of the picture: the screen's, and more where a plain one stands still.
  fineness(resting) {
    if (this.resting === resting) return;
    this.resting = resting;
    const screen = Math.min(2, window.devicePixelRatio);
    this.renderer.setPixelRatio(resting ? 2 : this.look.fine ? screen : 1);
  }

  /// Where the fine look is too much, the plain one is taken.
  judge(now) {
    if (this.look.fine && this.lastDrawn && now - this.lastDrawn < 250) {
      this.mean = 0.95 * (this.mean ?? 16) + 0.05 * (now - this.lastDrawn);
      if (++this.judged > 90 && this.mean > slowFrame) this.plain();
    }
    this.lastDrawn = now;
  }
  plain() {
    this.look.go();
    this.look = new Look(this.renderer, this.scene, false);
    this.look.dress(this.model);
    this.resting = undefined;
    this.fineness(false);
    this.look.furnish(this.bounds);
  }

  draw(now) {
    requestAnimationFrame((then) => this.draw(then));
    if (this.holder.clientHeight === 0 || !this.bounds) return;
    if (!this.look.fine && now - this.lastDrawn < plainFrame) return;
    if (this.after && !this.settled) {
      const share = Math.min(1, Math.max(0, (performance.now() - this.after.at) / this.interval));
      this.place(share);
      this.settled = share >= 1;
      this.stale = true;
    }
    const rested = !this.stale && !this.look.fine && !this.resting && now - this.lastDrawn > restAfter;
    if (!this.stale && !rested) return;
    this.stale = false;
    this.fineness(rested);
    this.renderer.render(this.scene, this.camera);
    this.frames += 1;
    this.judge(now);
  }
}
